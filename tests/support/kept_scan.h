#pragma once
/// \file Scans of the synthetic patients, made once for all tests of a build.

#include "ostia/phantom/phantom_case.h"

#include <filesystem>

namespace ostia::testing {

/// `phantom::scan_case(plan)`, read from the build folder where a test has made it before. `plan` is as
/// `phantom::plan_case` drew it; nothing but `options.scan` may have been changed since. A kept scan is no
/// longer used once one of the libraries that scan has been built anew.
phantom::Scan kept_scan(const phantom::CasePlan& plan);

/// The same in a given folder.
phantom::Scan kept_scan(const phantom::CasePlan& plan, const std::filesystem::path& folder);

}  // namespace ostia::testing
