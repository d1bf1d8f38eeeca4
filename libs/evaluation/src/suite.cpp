#include "ostia/evaluation/suite.h"

#include "suite_files.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/surface_file.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <tuple>

namespace ostia::evaluation {
namespace {

namespace fs = std::filesystem;

/// Files of a tree by relative path, `/` between the parts.
std::map<std::string, fs::path> files_in(const fs::path& root, const char* which,
                                         const Tolerances& tolerances) {
  std::error_code error;
  if (!fs::exists(root, error))
    throw InvalidInput("cannot compare " + root.string() + ": there is no such folder");
  if (!fs::is_directory(root, error))
    throw InvalidInput("cannot compare " + root.string() + ": a suite is a folder of cases");
  std::map<std::string, fs::path> files;
  try {
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      if (!entry.is_regular_file()) continue;
      const std::string name = entry.path().lexically_relative(root).generic_string();
      const bool ignored = std::any_of(tolerances.ignored_files.begin(), tolerances.ignored_files.end(),
                                       [&](const std::string& p) { return fits(p, name); });
      if (!ignored) files[name] = entry.path();
    }
  } catch (const fs::filesystem_error& failure) {
    throw IoError("cannot read the " + std::string(which) + " folder " + root.string() + ": " +
                  failure.code().message());
  }
  if (files.empty())
    throw InvalidInput("the " + std::string(which) + " folder " + root.string() +
                       " holds no file to compare");
  return files;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool starts_with_any(const std::string& text, std::initializer_list<const char*> beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const char* one) { return text.rfind(one, 0) == 0; });
}

/// A VTP's header says how many lines and polygons follow.
bool holds_lines(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string head(16384, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  const std::size_t lines = head.find("NumberOfLines=\""), polygons = head.find("NumberOfPolys=\"");
  const auto none = [&](std::size_t at) { return at == std::string::npos || head[at + 15] == '0'; };
  return !none(lines) && none(polygons);
}

void compare_pair(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                  std::vector<Finding>& findings, const core::TaskContext& task) {
  switch (file.kind) {
    case FileKind::figures:
      return compare_figures(pair, tolerances, file, findings);
    case FileKind::surface:
      return compare_surface_files(pair, tolerances, file, findings, task);
    case FileKind::lines:
      return compare_line_files(pair, tolerances, file, findings);
    case FileKind::contours:
      return compare_contour_files(pair, tolerances, file, findings);
    case FileKind::points:
      return compare_point_files(pair, tolerances, file, findings);
    case FileKind::mask:
    case FileKind::image:
      return compare_image_files(pair, tolerances, file, findings, task);
    case FileKind::other:
      if ((fs::file_size(pair.golden) == 0) != (fs::file_size(pair.result) == 0)) {
        findings.push_back({FindingKind::regression, file.file, "", std::nullopt, std::nullopt, 0.0,
                            "one of the two files is empty"});
        file.differs = true;
      }
  }
}

ComparedFile compared(const FilePair& pair, const Tolerances& tolerances, std::vector<Finding>& findings,
                      const core::TaskContext& task) {
  ComparedFile file;
  file.file = pair.name;
  try {
    file.kind = kind_of(pair.golden);
    compare_pair(pair, tolerances, file, findings, task);
  } catch (const Cancelled&) {
    throw;
  } catch (const ResourceError&) {
    throw;
  } catch (const Error& failure) {
    findings.push_back({FindingKind::regression, pair.name, "", std::nullopt, std::nullopt, 0.0,
                        std::string("cannot be compared: ") + failure.what()});
    file.differs = true;
  }
  return file;
}

}  // namespace

FileKind kind_of(const fs::path& path) {
  const std::string extension = lower(path.extension().string()), name = lower(path.filename().string());
  if (extension == ".json")
    return name.find("contours") != std::string::npos ? FileKind::contours : FileKind::figures;
  if (extension == ".vtp") return holds_lines(path) ? FileKind::lines : FileKind::surface;
  if (extension == ".vtu" || io::is_surface_file(path)) return FileKind::surface;
  if (extension == ".csv") {
    std::ifstream in(path);
    std::string header;
    std::getline(in, header);
    const bool axes = header.find("x,y,z") != std::string::npos && header.find("radius") != std::string::npos;
    return axes ? FileKind::lines : FileKind::other;
  }
  if (extension == ".txt")
    return starts_with_any(name, {"reference", "result", "point", "observer"}) ? FileKind::points
                                                                               : FileKind::other;
  if (extension == ".nrrd" || extension == ".mhd" || extension == ".mha" || extension == ".nii") {
    const bool named = name.find("label") != std::string::npos || name.find("mask") != std::string::npos;
    return named || imaging::looks_like_mask(path) ? FileKind::mask : FileKind::image;
  }
  return FileKind::other;
}

std::string name_of(FindingKind kind) {
  static constexpr const char* names[] = {"regression", "missing", "improvement", "change", "extra"};
  return names[static_cast<int>(kind)];
}

std::string name_of(FileKind kind) {
  static constexpr const char* names[] = {"figures", "surface", "lines",  "contours",
                                          "mask",    "image",   "points", "other"};
  return names[static_cast<int>(kind)];
}

std::size_t SuiteResult::count(FindingKind kind) const {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.kind == kind; }));
}

SuiteResult compare_suites(const fs::path& golden, const fs::path& result, const Tolerances& tolerances,
                           const core::TaskContext& task) {
  validate(tolerances);
  const auto golden_files = files_in(golden, "golden", tolerances);
  const auto result_files = files_in(result, "result", tolerances);
  SuiteResult suite;
  std::vector<FilePair> pairs;
  for (const auto& [name, path] : golden_files) {
    const auto found = result_files.find(name);
    if (found != result_files.end()) {
      pairs.push_back({name, path, found->second});
    } else {
      suite.findings.push_back({FindingKind::missing, name, "", std::nullopt, std::nullopt, 0.0,
                                "the result does not have this file"});
    }
  }
  if (pairs.empty())
    throw InvalidInput("cannot compare " + golden.string() + " and " + result.string() +
                       ": they have no file in common (the first has " + golden_files.begin()->first +
                       ", the second " + result_files.begin()->first +
                       "); both must be runs of the same suite");
  for (const auto& item : result_files)
    if (!golden_files.contains(item.first))
      suite.findings.push_back({FindingKind::extra, item.first, "", std::nullopt, std::nullopt, 0.0,
                                "the golden run does not have this file"});
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    task.throw_if_cancelled();
    task.set_stage("comparing " + pairs[i].name);
    task.set_progress(static_cast<double>(i) / static_cast<double>(pairs.size()));
    suite.files.push_back(compared(pairs[i], tolerances, suite.findings, task));
    suite.figures += suite.files.back().figures.size();
  }
  std::stable_sort(suite.findings.begin(), suite.findings.end(), [](const Finding& a, const Finding& b) {
    return std::tie(a.kind, a.file, a.key) < std::tie(b.kind, b.file, b.key);
  });
  task.set_progress(1.0);
  return suite;
}

}  // namespace ostia::evaluation
