#pragma once
/// \file How sure a tree's pressures are, as JSON and as columns of tables. Of a report with `uncertainty`.

#include "ostia/session/pressure_report.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace ostia::session {

/// The member "uncertainty" of ffr.json.
nlohmann::ordered_json uncertainty_of_report(const PressureReport& report);
/// conditions.json: the conditions with their spreads.
std::string uncertain_conditions_json(const PressureReport& report);
/// A row a reading and group of inputs.
std::string sobol_csv(const PressureReport& report);

/// Columns that tables have more where there is uncertainty, and their cells; neither where there is none.
std::vector<std::string> uncertain_columns(const PressureReport& report);
std::vector<std::string> uncertain_cells(const PressureReport& report,
                                         const hemodynamics::Distribution& ratio);
std::vector<std::string> joined_cells(std::vector<std::string> cells, const std::vector<std::string>& more);

}  // namespace ostia::session
