#pragma once
/// \file A cohort as a page for a browser, with its data beside it.

#include "ostia/core/task_context.h"

#include <cstddef>
#include <filesystem>

namespace ostia::cohort {

struct PageResult {
  std::size_t scans = 0;
  std::size_t files = 0;
  std::filesystem::path page;  ///< to be opened by a browser, from the disk
};

/// Makes the folder `page` of the cohort, whole or not at all: index.html, and data/ with what `read_status`
/// finds, the scans in blocks and the last reviews. It names scans by pseudonym alone and reads nothing from
/// a network. Throws as `read_status`, ResourceError.
PageResult write_page(const std::filesystem::path& cohort, const core::TaskContext& task = core::no_task());

}  // namespace ostia::cohort
