#pragma once
/// \file The figures of a finished run: flows, pressures, shear stress on the wall, and whether to trust
/// them.

#include "ostia/solver/flow_result.h"

#include <string>
#include <vector>

namespace ostia::solver {

/// Bounds of what counts as low and high shear stress: 4 and 70 dyn/cm2 (Malek, Alper and Izumo, JAMA 1999).
struct ShearLimits {
  double low_pa = 0.4;   ///< positive
  double high_pa = 7.0;  ///< above `low_pa`
};
void validate(const ShearLimits& limits);

/// Of a wall, weighted with area; of a pulsatile flow the time-averaged shear stress.
struct WallFigures {
  std::string name;
  double area_mm2 = 0.0;
  double mean_pa = 0.0, least_pa = 0.0, greatest_pa = 0.0, p05_pa = 0.0, p95_pa = 0.0;
  double low_share = 0.0, high_share = 0.0;  ///< of the area, below and above the limits
};

struct FlowReport {
  std::vector<WallFigures> walls;
  ShearLimits limits;
  std::vector<std::string> reasons;  ///< why a person must look; none: all is well
  bool passed() const { return reasons.empty(); }
};
/// Not passed are a run that has not converged and a mass balance that is off by more than 1 %.
FlowReport flow_report(const FlowResult& result, const ShearLimits& limits = {});

/// The least value that `share` of the weight does not exceed; `values` and `weights` of the same length, not
/// empty.
double weighted_percentile(const std::vector<double>& values, const std::vector<double>& weights,
                           double share);

/// `result.json` (docs/schemas/flow-result.schema.json) and `faces.csv`.
std::string report_json(const FlowResult& result, const FlowReport& report);
std::string faces_csv(const FlowResult& result, const FlowReport& report);

}  // namespace ostia::solver
