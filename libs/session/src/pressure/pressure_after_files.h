#pragma once
/// \file A tree with stretches of another calibre beside the tree as it is, as JSON and as tables.

#include "ostia/session/pressure_report.h"

#include <nlohmann/json.hpp>

#include <string>

namespace ostia::session {

/// The member "what_if" of ffr.json. Of a report with `after`.
nlohmann::ordered_json what_if_json(const PressureReport& report);
/// Both curves, a row a station; both readings, a row a lesion and a row an outlet.
std::string what_if_stations_csv(const PressureReport& report);
std::string what_if_readings_csv(const PressureReport& report);

}  // namespace ostia::session
