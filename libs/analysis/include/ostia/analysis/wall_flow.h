#pragma once
/// \file Shear stress and pressure of a flow computation, along a vessel (docs/methods/flow-along-vessel.md).

#include <cstdint>
#include <span>
#include <vector>

namespace ostia::analysis {

/// A bit of wall with what was computed there.
struct WallFlowSample {
  std::int32_t vessel = 0;  ///< whose wall it is
  double s_mm = 0.0;        ///< abscissa of the foot on its axis
  double area_mm2 = 0.0;
  double shear_pa = 0.0, pressure_pa = 0.0;  ///< magnitude; NaN where not known
};

/// What there is about one place of the axis.
struct FlowStation {
  double s_mm = 0.0;
  double area_mm2 = 0.0;  ///< of the wall that counts; 0: nothing is known here
  /// Weighted with area, and the extremes. NaN where not known.
  double mean_shear_pa = 0.0, least_shear_pa = 0.0, greatest_shear_pa = 0.0;
  double pressure_pa = 0.0;  ///< of a line through the samples by least squares, at the station; NaN
};
struct FlowStationOptions {
  double step_mm = 0.5;    ///< between stations, [0.05, 10]
  double window_mm = 1.0;  ///< of the axis that counts for one, half on either side, [step_mm, 20]
};
void validate(const FlowStationOptions& options);  ///< throws InvalidInput

/// Stations from `from_mm` to `to_mm`, both included, at whole steps from the first; only samples of `vessel`
/// count, and of those no sample outside of the stretch. Throws InvalidInput for bad options, a stretch that
/// is none, or an abscissa or area that is not finite.
std::vector<FlowStation> flow_stations(std::span<const WallFlowSample> samples, std::int32_t vessel,
                                       double from_mm, double to_mm, const FlowStationOptions& options = {});

/// Between two stations, NaN beside them and where one of them knows nothing.
FlowStation station_at(const std::vector<FlowStation>& stations, double s_mm);

}  // namespace ostia::analysis
