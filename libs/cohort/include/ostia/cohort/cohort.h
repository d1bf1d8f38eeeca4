#pragma once
/// \file The folder of a cohort, and how one is begun. Layout: docs/reference/cohort.md.

#include "ostia/cohort/scan_table.h"
#include "ostia/core/task_context.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace ostia::cohort {

/// A step that every scan goes through. Its result is `folder`/PSEUDONYM, made by `ostia run`.
struct Stage {
  const char* name;
  const char* folder;
  int after;           ///< index of the stage whose result it reads; -1: the scan itself
  const char* result;  ///< the file in its folder that stands for it, and that others read
};
inline constexpr std::array<Stage, 6> stages{{{"import", "inputs", -1, "scan.nrrd"},
                                              {"extract", "cases", 0, "case.ostia"},
                                              {"lumen", "lumens", 1, "lumen.vtp"},
                                              {"mesh", "meshes", 1, "mesh/mesh.vtu"},
                                              {"measures", "measures", 1, "report/report.json"},
                                              {"pressure", "flow", 1, "pressure/ffr.json"}}};
constexpr std::size_t stage_of(std::string_view name) {
  std::size_t i = 0;
  while (i < stages.size() && name != stages[i].name) ++i;
  return i;
}

inline constexpr const char* database_name = "cohort.sqlite";

struct InitOptions {
  std::filesystem::path table;
  std::filesystem::path output;  ///< the cohort's folder
  bool skip_bad = false;         ///< leave rows out that cannot be used, instead of making nothing
};

struct InitResult {
  TableCheck check;
  std::size_t scans = 0;                 ///< in the cohort
  bool made = false;                     ///< false: rows were refused, and nothing was written
  std::filesystem::path private_folder;  ///< the key, and what each pseudonym stands for
};

/// Checks the table, then makes the cohort's folder and, beside it, the private one (`NAME.private`, mode
/// 700, its files 600), which holds a new key, identifiers and paths, and is not to be shared. Both appear
/// whole or not at all. Throws InvalidInput where a folder is there already and holds anything, what
/// ScanTable::read throws, ResourceError (a full disk), IoError, Cancelled.
InitResult init_cohort(const InitOptions& options, const core::TaskContext& task = core::no_task());

/// The private folder of a cohort.
std::filesystem::path private_folder_of(const std::filesystem::path& cohort);

}  // namespace ostia::cohort
