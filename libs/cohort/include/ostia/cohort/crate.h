#pragma once
/// \file A cohort's provenance as a Workflow Run RO-Crate.

#include "ostia/core/task_context.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace ostia::cohort {

inline constexpr const char* crate_name = "ro-crate-metadata.json";

struct CrateOptions {
  std::string name = "A cohort of coronary CT scans";
  std::string license;  ///< a URL, or a sentence; empty: it is said that none was given
};

struct CrateResult {
  std::size_t scans = 0;     ///< of the cohort
  std::size_t steps = 0;     ///< told of, with a result
  std::size_t failed = 0;    ///< likewise, without
  std::size_t files = 0;     ///< of results, by digest
  std::size_t left_out = 0;  ///< results whose record does not say what made them
  std::filesystem::path file;
};

/// Writes `ro-crate-metadata.json` into the cohort's folder, whole or not at all, by which the folder is a
/// crate: RO-Crate 1.1 and the profiles Process, Workflow and Provenance Run Crate 0.5
/// (https://www.researchobject.org/workflow-run-crate). It tells of the workflow as the cohort keeps it, its
/// runs, programs and libraries with versions, the machine, and of each step that is done what it read and
/// made (by digest), with which parameters, or why it failed. Scans have their pseudonyms; nothing else names
/// anybody. The same cohort gives the same bytes. Throws as `read_status`; InvalidInput where no run of the
/// workflow has left itself in the cohort; ResourceError.
CrateResult write_crate(const std::filesystem::path& cohort, const CrateOptions& options = {},
                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::cohort
