#pragma once
/// \file The bed behind an outlet over the beat: resistances and compliances in the heart's muscle (Kim et
/// al. 2010, Ann Biomed Eng 38:3195).

#include "ostia/hemodynamics/network_solver.h"

namespace ostia::hemodynamics {

/// Artery, small vessels and veins in a row; a compliance behind the first against no pressure and one behind
/// the second against the muscle's.
struct CoronaryBed {
  double artery_pa_s_ml = 0.0, small_pa_s_ml = 0.0, vein_pa_s_ml = 0.0;
  double artery_ml_pa = 0.0, muscle_ml_pa = 0.0;
  double venous_pa = 0.0;
  double resistance_pa_s_ml() const { return artery_pa_s_ml + small_pa_s_ml + vein_pa_s_ml; }
};
/// Shares 0.32, 0.52 and 0.16 of the resistance, 0.11 and 0.89 of the compliance: a usual choice, after Kim
/// et al.
CoronaryBed coronary_bed(double resistance_pa_s_ml, double compliance_ml_pa, double venous_pa);

/// Pressures behind the artery and in the muscle's vessels.
struct BedState {
  double artery_pa = 0.0, muscle_pa = 0.0;
};
/// At rest under a flow that does not change.
BedState steady_state(const CoronaryBed& bed, double flow_ml_s);

/// One implicit Euler step: pressure at the outlet at its end = distal_pa + resistance x flow, exactly.
/// `muscle_rise_pa`: of the pressure about the vessels in the muscle, over the step.
Outlet step_outlet(const CoronaryBed& bed, const BedState& before, double step_s, double muscle_rise_pa);
/// The state at the end of that step, with the flow that it turned out to have.
BedState after_step(const CoronaryBed& bed, const BedState& before, double step_s, double muscle_rise_pa,
                    double flow_ml_s);

}  // namespace ostia::hemodynamics
