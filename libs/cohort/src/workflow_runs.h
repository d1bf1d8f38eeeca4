#pragma once
/// \file What runs of the workflow have left in a cohort beside results: `workflow/` and `logs/runs/`.

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::cohort {

inline constexpr const char* workflow_folder = "workflow";

/// Of the chain that made a stage's result, without `.json`; empty where the step's record does not say it.
std::string chain_of_step(const std::filesystem::path& cohort, const std::string& scan, const char* stage);

/// Records of runs by their number (schema docs/schemas/cohort-run.schema.json). Throws InvalidInput where
/// there is none, or `workflow/Snakefile` is not there; those that cannot be read are left out.
std::vector<nlohmann::json> workflow_runs(const std::filesystem::path& cohort);

/// Files of `workflow/`, from the cohort's folder on, sorted.
std::vector<std::string> workflow_files(const std::filesystem::path& cohort);

}  // namespace ostia::cohort
