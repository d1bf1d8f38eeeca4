#pragma once
/// \file What is read off a tree's pressures at places of a vessel's way from its root to its end.

#include "ostia/analysis/stenosis.h"
#include "ostia/session/pressure_report.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ostia::session {

/// The branches of a vessel's way, from its root on: those of its parents, then its own; empty where it owns
/// none.
std::vector<std::size_t> branches_on_way(const hemodynamics::Network& network, std::int32_t vessel);
/// The place of that way that is nearest to an abscissa; nothing where none of it has sections.
std::optional<hemodynamics::TreePlace> place_on_way(const hemodynamics::Network& network, std::int32_t vessel,
                                                    double s_mm);

/// FFR at a place; nothing behind an occlusion, and where the vessel has no sections.
std::optional<double> ffr_at(const PressureReport& report, std::int32_t vessel, double s_mm);
/// The same with the stretches of the report's options; nothing without any.
std::optional<double> ffr_after_at(const PressureReport& report, std::int32_t vessel, double s_mm);

/// How sure FFR is at a place.
struct FfrInterval {
  double low = 0.0, high = 0.0;  ///< 95 %
  double probability = 0.0;      ///< of being at or below the threshold
};
/// At the nearest station; nothing while it is not known.
std::optional<FfrInterval> ffr_interval_at(const PressureReport& report, std::int32_t vessel, double s_mm);

/// Along a vessel's way, station by station; NaN where it is not known.
struct FfrPoint {
  double s_mm = 0.0;
  double ffr = 1.0, after = 1.0;  ///< `after` is NaN without stretches, too
  double low = 0.0, high = 0.0;   ///< 95 % of what FFR may be; NaN while that is not known
};
std::vector<FfrPoint> ffr_along(const PressureReport& report, std::int32_t vessel);
/// Where FFR falls to the threshold along the way, first; nothing where it does not.
std::optional<double> falls_to_threshold_mm(const std::vector<FfrPoint>& along, double threshold);

/// What a list tells of a lesion.
struct LesionFfr {
  hemodynamics::LesionReading now;
  std::optional<hemodynamics::LesionReading> after;
};
/// One for each, nothing for one whose vessel has no sections.
std::vector<std::optional<LesionFfr>> ffr_of_lesions(const PressureReport& report,
                                                     const std::vector<analysis::Stenosis>& lesions);

}  // namespace ostia::session
