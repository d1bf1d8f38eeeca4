#include "ostia/pipeline/manifest.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/version.h"

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>

namespace ostia::pipeline {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr const char* manifest_name = "manifest.json";

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

json library_versions() {
  return {{"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION)},
          {"compiler", __VERSION__},
          {"cgal", OSTIA_CGAL_VERSION},
          {"vtk", OSTIA_VTK_VERSION},
          {"tetgen", "1.5"}};
}

json outputs_of(const fs::path& folder) {
  json outputs = json::object();
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    outputs[fs::relative(entry.path(), folder).generic_string()] = core::sha256_file(entry.path());
  }
  return outputs;
}

json key_of(const JobKey& key) {
  return {{"command", key.command}, {"inputs", key.inputs}, {"parameters", json::parse(key.parameters)}};
}

json parsed_manifest_of(const fs::path& folder) {
  if (!fs::exists(folder / manifest_name)) return json();
  return json::parse(core::read_file(folder / manifest_name), nullptr, false);
}

bool is_jobs_folder(const fs::path& folder) {
  const json manifest = parsed_manifest_of(folder);
  if (!manifest.is_object() || !manifest.contains("outputs") || !manifest["outputs"].is_object())
    return fs::is_empty(folder);
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory()) continue;
    const std::string name = fs::relative(entry.path(), folder).generic_string();
    if (name != manifest_name && !manifest["outputs"].contains(name)) return false;
  }
  return true;
}

}  // namespace

void require_free_folder(const fs::path& folder) {
  if (folder.filename() == "." || folder.filename() == "..")
    throw InvalidInput("cannot write " + folder.string() + ": name a new folder");
  const core::StagedFolder trial(folder);  // made and taken away again
  if (fs::exists(folder) && !is_jobs_folder(folder)) {
    throw InvalidInput("cannot write " + folder.string() +
                       ": the folder holds files that are not an earlier result's; name another one");
  }
}

double peak_memory_mb() {
  rusage own{}, children{};
  ::getrusage(RUSAGE_SELF, &own);
  ::getrusage(RUSAGE_CHILDREN, &children);
  return static_cast<double>(std::max(own.ru_maxrss, children.ru_maxrss)) / 1024.0;
}

namespace {

/// Those of the record, then what else was warned of while the job ran.
json warnings_of(const ManifestRecord& record) {
  std::vector<std::string> all = record.warnings;
  for (const std::string& heard : core::heard_warnings())
    if (std::ranges::find(all, heard) == all.end()) all.push_back(heard);
  json texts = json::array();
  for (const std::string& warning : all) texts.push_back(core::redacted(warning));
  return texts;
}

}  // namespace

void write_manifest(const fs::path& folder, const ManifestRecord& record) {
  json manifest = key_of(record.key);
  manifest["v"] = 1;
  manifest["program"] = {{"name", "ostia"}, {"version", core::version()}, {"libraries", library_versions()}};
  manifest["exit_code"] = static_cast<int>(record.exit_code);
  manifest["finished"] = utc_now();
  manifest["seconds"] = record.seconds;
  manifest["peak_mb"] = std::max(record.peak_mb, peak_memory_mb());
  manifest["warnings"] = warnings_of(record);
  manifest["quality"] = record.quality.empty() ? json::object() : json::parse(record.quality);
  manifest["outputs"] = outputs_of(folder);
  core::write_file(folder / manifest_name,
                   manifest.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

std::string manifest_of(const fs::path& folder) {
  return fs::exists(folder / manifest_name) ? core::read_file(folder / manifest_name) : std::string();
}

std::optional<ExitCode> already_done(const fs::path& folder, const JobKey& key) {
  const json manifest = parsed_manifest_of(folder);
  if (!manifest.is_object() || manifest.value("v", 0) != 1) return std::nullopt;
  const json wanted = key_of(key);
  for (const char* field : {"command", "inputs", "parameters"}) {
    if (manifest.value(field, json()) != wanted[field]) return std::nullopt;
  }
  if (manifest.value("/program/version"_json_pointer, std::string()) != core::version()) return std::nullopt;
  const json outputs = manifest.value("outputs", json::object());
  for (const auto& [name, digest] : outputs.items()) {
    if (!fs::exists(folder / name) || core::sha256_file(folder / name) != digest) return std::nullopt;
  }
  return static_cast<ExitCode>(manifest.value("exit_code", 0));
}

}  // namespace ostia::pipeline
