#include "motion/motion_input.h"

#include "motion/phase_surface.h"
#include "output/refusal.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/io/surface_file.h"
#include "ostia/session/phase_images.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

constexpr const char* lumen_of_a_phase = "lumen.vtp";  // in a folder of a phase

bool is_phase_file(const fs::path& path) {
  return io::is_surface_file(path) || path.extension() == ".vtk" || path.extension() == ".ostia" ||
         is_image_name(path.filename().string());
}

/// Without all extensions that are no part of a number: "p12.5.nii.gz" is "p12.5".
std::string stem_of(const fs::path& path) {
  const fs::path name = path.filename();
  return name.extension() == ".gz" ? name.stem().stem().string() : name.stem().string();
}

/// The image in a folder of a phase, not the labels beside it; empty where there is none.
fs::path image_in(const fs::path& folder) {
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && is_image_name(name) && !name.starts_with("labels"))
      images.push_back(entry.path());
  }
  std::ranges::sort(images);
  // The same image may be there in several formats.
  for (const fs::path& one : images)
    if (stem_of(one) != stem_of(images.front()))
      throw InvalidInput(folder.string() + " holds several images, " + images.front().filename().string() +
                         " and " + one.filename().string() + "; a phase has one");
  if (!images.empty()) return images.front();
  return fs::is_directory(folder / "dicom") ? folder / "dicom" : fs::path();
}

/// What a folder holds of its phase; empty where it is none.
fs::path content_of(const fs::path& folder, PhaseContent content) {
  if (!folder.filename().string().starts_with("phase-")) return {};
  const fs::path lumen = fs::exists(folder / lumen_of_a_phase) ? folder / lumen_of_a_phase : fs::path();
  if (content == PhaseContent::surfaces) return lumen;
  const fs::path image = image_in(folder);
  return image.empty() ? lumen : image;
}

struct NumberedFile {
  double number = 0.0;
  std::string name;  ///< for messages
  fs::path file;
  bool exact = false;  ///< percent of the cycle, said elsewhere than in the name
};

/// A synthetic case says its phases exactly: a folder's name has whole percents alone.
std::map<std::string, double> exact_percents(const fs::path& folder) {
  std::map<std::string, double> out;
  if (!fs::is_regular_file(folder / "heartbeat.json")) return out;
  const auto beat = nlohmann::json::parse(core::read_file(folder / "heartbeat.json"), nullptr, false);
  if (!beat.is_object() || !beat.contains("phases")) return out;
  for (const auto& phase : beat["phases"])
    if (phase.is_object() && phase.contains("folder") && phase.contains("percent") &&
        phase["folder"].is_string() && phase["percent"].is_number())
      out[phase["folder"].get<std::string>()] = phase["percent"].get<double>();
  return out;
}

std::optional<double> number_in(const std::string& stem) {
  const std::string text = phase_of(stem);
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<NumberedFile> numbered_files(const fs::path& folder, PhaseContent content) {
  if (!fs::is_directory(folder))
    throw InvalidInput(folder.string() +
                       " is no folder: a motion is fitted to a folder of surfaces, masks, cases or images, "
                       "one a phase");
  std::vector<NumberedFile> files, in_folders;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    const fs::path inside = entry.is_directory() ? content_of(path, content) : fs::path();
    if (inside.empty() && !(entry.is_regular_file() && is_phase_file(path))) continue;
    const std::string name = path.filename().string();
    if (core::log_format() == core::LogFormat::json) core::redact_in_logs(name, "FILE");
    const auto number = number_in(inside.empty() ? stem_of(path) : name);
    if (!number) {
      core::log_info(name + " has no number in its name: it is taken for no phase");
      continue;
    }
    (inside.empty() ? files : in_folders).push_back({*number, name, inside.empty() ? path : inside, false});
  }
  if (!in_folders.empty()) {
    const auto exact = exact_percents(folder);
    for (NumberedFile& one : in_folders)
      if (const auto found = exact.find(one.name); found != exact.end()) {
        one.number = found->second;
        one.exact = true;
      }
    files = std::move(in_folders);
  }
  std::ranges::sort(files, [](const NumberedFile& a, const NumberedFile& b) {
    return a.number != b.number ? a.number < b.number : a.name < b.name;
  });
  return files;
}

/// The phases that DICOM files tell.
std::vector<PhaseFile> dicom_phases(const fs::path& folder, const core::TaskContext& task) {
  std::vector<PhaseFile> phases;
  for (session::PhaseSource& one : naming(folder, [&] { return session::find_phase_images(folder, task); }))
    phases.push_back({one.phase, one.series ? folder : one.file, std::move(one.series)});
  return phases;
}

/// Names count 0, 1, 2, ... or 1, 2, 3, ..., some left out perhaps: percents of a whole cycle are never so.
bool seem_frames(const std::vector<NumberedFile>& files) {
  constexpr double fewest_percents = 50.0;  // a cycle's last phase lies beyond
  if (files.size() < 3 || files.front().number > 1.0) return false;
  double least = 100.0, most = 0.0;  // of the steps
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (files[k].exact || files[k].number != std::floor(files[k].number)) return false;
    if (k == 0 || files[k].number == files[k - 1].number) continue;  // twice: told elsewhere
    least = std::min(least, files[k].number - files[k - 1].number);
    most = std::max(most, files[k].number - files[k - 1].number);
  }
  return least == 1.0 && (most == 1.0 || files.back().number < fewest_percents);
}

void require_percents(const fs::path& folder, const std::vector<NumberedFile>& files) {
  if (!seem_frames(files)) return;
  const double first = files.front().number, last = files.back().number;
  const std::string percents =
      first == 1.0 && last == 100.0 ? ", name the last one 0" : ", with --frames 100";
  throw InvalidInput(folder.string() + ": the names' numbers are 1 apart, from " + files.front().name +
                     " to " + files.back().name +
                     "; if they count frames of one cycle, say so with --frames " +
                     std::to_string(std::lround(last - first + 1.0)) + ", if they are percent" + percents);
}

/// The number of the R peak's frame.
double first_frame(const std::vector<NumberedFile>& files, int frames) {
  double least = frames, most = 0.0;
  for (const NumberedFile& one : files) {
    if (one.exact) continue;
    least = std::min(least, one.number);
    most = std::max(most, one.number);
  }
  if (frames == 0 || least != 1.0 || most <= frames - 1.0) return 0.0;
  core::log_info("frames are counted from 1 to " + std::to_string(frames) + ": frame 1 is phase 0 %");
  return 1.0;
}

}  // namespace

std::string phase_of(const std::string& stem) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::size_t last = stem.find_last_of("0123456789");
  if (last == std::string::npos) return stem;
  std::size_t from = last;
  while (from > 0 && is_digit(stem[from - 1])) --from;
  if (from > 1 && stem[from - 1] == '.' && is_digit(stem[from - 2])) {  // "12.5"
    from -= 2;
    while (from > 0 && is_digit(stem[from - 1])) --from;
  }
  while (from < last && stem[from] == '0' && is_digit(stem[from + 1])) ++from;
  return stem.substr(from, last - from + 1);
}

std::vector<PhaseFile> phase_files(const fs::path& folder, int frames, PhaseContent content,
                                   const core::TaskContext& task) {
  const std::vector<NumberedFile> files = numbered_files(folder, content);
  if (files.empty() && content == PhaseContent::images) return dicom_phases(folder, task);
  if (files.empty())
    throw InvalidInput(
        folder.string() +
        " holds no phases: one surface (.vtp .stl .ply .obj .vtk), case (.ostia) or mask a phase is "
        "expected, "
        "its percent of the cycle in its name, as in phase_35.vtp; images need --template FILE, the lumen's "
        "surface at one of the phases");
  if (frames == 0) require_percents(folder, files);
  const double first = first_frame(files, frames);
  std::vector<PhaseFile> phases;
  for (const NumberedFile& one : files) {
    const double whole = frames == 0 || one.exact ? 100.0 : frames;
    if (one.number > whole)
      throw InvalidInput((folder / one.name).string() + ": its number is beyond " +
                         (whole == 100.0
                              ? "100 percent of the cycle; if it counts frames, say how many a cycle "
                                "has with --frames"
                              : "the " + std::to_string(frames) + " frames of a cycle"));
    const double count = one.exact ? one.number : one.number - first;
    phases.push_back({count == whole ? 0.0 : count / whole, one.file});
  }
  std::ranges::stable_sort(phases, {}, &PhaseFile::phase);
  for (std::size_t k = 1; k < phases.size(); ++k)
    if (phases[k].phase == phases[k - 1].phase)
      throw InvalidInput(folder.string() + ": " + phases[k - 1].file.lexically_relative(folder).string() +
                         " and " + phases[k].file.lexically_relative(folder).string() + " are both phase " +
                         pipeline::percent_text(phases[k].phase) + "; leave one of the two out");
  return phases;
}

std::string name_of(const PhaseFile& one) {
  if (one.series) return one.series->phase.empty() ? "a DICOM series" : one.series->phase;
  const fs::path parent = one.file.parent_path().filename();
  const bool in_folder = parent.string().starts_with("phase-");
  return ((in_folder ? parent : fs::path()) / one.file.filename()).string();
}

std::size_t layers_at_end(const io::LayeredMesh& layered) {
  const std::size_t all = std::min(layered.in_layers.size(), layered.mesh.tetrahedra.size());
  const auto begin = layered.in_layers.begin(), end = begin + static_cast<std::ptrdiff_t>(all);
  const auto first = std::find(begin, end, true);
  if (std::find(first, end, false) == end) return static_cast<std::size_t>(end - first);
  core::log_info("the mesh's marks of layers are not kept: its tetrahedra are in another order");
  return 0;
}

fs::path motion_path(const fs::path& motion) {
  return fs::is_directory(motion) ? motion / "motion.json" : motion;
}

fs::path template_path(const fs::path& motion, const io::CageMotionFile& file, const fs::path& surface) {
  if (!surface.empty()) return surface;
  if (file.surface.empty())
    throw InvalidInput(motion.string() + " names no surface of the template; name one with --surface");
  return motion_path(motion).parent_path() / file.surface;
}

}  // namespace ostia::app
