#pragma once
/// \file Files of a pressure report for other programs: the wall, and cases of solvers.

#include "ostia/session/pressure_report.h"

namespace ostia::session {

/// wall.vtp where the report has a wall; what `exports` of its options name. Throws IoError, and InvalidInput
/// as hemodynamics::export_network does.
void write_pressure_extras(const std::filesystem::path& folder, const PressureReport& report);

}  // namespace ostia::session
