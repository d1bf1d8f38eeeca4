#include "ostia/hemodynamics/coronary_outlet.h"

namespace ostia::hemodynamics {
namespace {

/// Pressure behind the artery at the step's end, as a straight line over the flow; and the muscle's by it.
struct Line {
  double constant = 0.0, slope = 0.0;                // of the artery's pressure over the flow
  double muscle_constant = 0.0, muscle_slope = 0.0;  // of the muscle's over the artery's
};

Line line_of(const CoronaryBed& bed, const BedState& before, double step_s, double rise) {
  const double a = bed.artery_ml_pa / step_s, m = bed.muscle_ml_pa / step_s;
  const double small = 1.0 / bed.small_pa_s_ml, vein = 1.0 / bed.vein_pa_s_ml;
  Line line;
  const double whole = m + small + vein;
  line.muscle_constant = (m * (before.muscle_pa + rise) + vein * bed.venous_pa) / whole;
  line.muscle_slope = small / whole;
  const double own = a + small - small * line.muscle_slope;
  line.constant = (a * before.artery_pa + small * line.muscle_constant) / own;
  line.slope = 1.0 / own;
  return line;
}

}  // namespace

CoronaryBed coronary_bed(double resistance_pa_s_ml, double compliance_ml_pa, double venous_pa) {
  return {0.32 * resistance_pa_s_ml, 0.52 * resistance_pa_s_ml, 0.16 * resistance_pa_s_ml,
          0.11 * compliance_ml_pa,   0.89 * compliance_ml_pa,   venous_pa};
}

BedState steady_state(const CoronaryBed& bed, double flow_ml_s) {
  BedState state;
  state.muscle_pa = bed.venous_pa + bed.vein_pa_s_ml * flow_ml_s;
  state.artery_pa = state.muscle_pa + bed.small_pa_s_ml * flow_ml_s;
  return state;
}

Outlet step_outlet(const CoronaryBed& bed, const BedState& before, double step_s, double muscle_rise_pa) {
  const Line line = line_of(bed, before, step_s, muscle_rise_pa);
  return {bed.artery_pa_s_ml + line.slope, line.constant, std::nullopt};
}

BedState after_step(const CoronaryBed& bed, const BedState& before, double step_s, double muscle_rise_pa,
                    double flow_ml_s) {
  const Line line = line_of(bed, before, step_s, muscle_rise_pa);
  BedState after;
  after.artery_pa = line.constant + line.slope * flow_ml_s;
  after.muscle_pa = line.muscle_constant + line.muscle_slope * after.artery_pa;
  return after;
}

}  // namespace ostia::hemodynamics
