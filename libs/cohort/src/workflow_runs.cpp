#include "workflow_runs.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <algorithm>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr std::uint64_t most_run_bytes = 1 << 20;

json document_or_null(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return {};
  json document = json::parse(core::read_file(file, most_run_bytes), nullptr, false);
  return document.is_object() ? document : json();
}

bool is_run(const json& document) {
  const auto is_text = [&](const char* name) {
    return document.contains(name) && document.at(name).is_string();
  };
  return document.is_object() && document.value("kind", json()) == "cohort run" && is_text("begun") &&
         is_text("program") && document.value("number", json()).is_number_integer() &&
         document.value("engine", json()).is_object() && document.value("settings", json()).is_object() &&
         document.value("machine", json()).is_object();
}

}  // namespace

std::string chain_of_step(const fs::path& cohort, const std::string& scan, const char* stage) {
  const json record = document_or_null(cohort / "logs" / scan / (std::string(stage) + ".json"));
  const auto chain = record.find("chain");
  const bool is_named = record.is_object() && chain != record.end() && chain->is_string();
  return is_named ? chain->get<std::string>() : "";
}

std::vector<json> workflow_runs(const fs::path& cohort) {
  std::vector<json> out;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(cohort / "logs" / "runs", error))
    if (json document = document_or_null(entry.path()); is_run(document)) out.push_back(std::move(document));
  if (out.empty() || !fs::is_regular_file(cohort / workflow_folder / "Snakefile", error))
    throw InvalidInput("cannot tell how " + cohort.string() +
                       " was made: no run of the workflow has left itself there; run it once, even if "
                       "nothing is left to do but one step");
  std::ranges::sort(out, {}, [](const json& run) { return run.at("number").get<long>(); });
  return out;
}

std::vector<std::string> workflow_files(const fs::path& cohort) {
  std::vector<std::string> out;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(cohort / workflow_folder))
    if (entry.is_regular_file()) out.push_back(entry.path().lexically_relative(cohort).generic_string());
  std::ranges::sort(out);
  return out;
}

}  // namespace ostia::cohort
