#pragma once
/// \file The tree over the beat: resting Pd/Pa and the wave-free period.

#include "ostia/hemodynamics/coronary_outlet.h"
#include "ostia/hemodynamics/flow_state.h"

#include <vector>

namespace ostia::hemodynamics {

struct PulseOptions {
  int steps = 200;  ///< of a beat, [50, 5000]
  int most_beats = 30;
  /// Of a bed, for each ml/s that flows through it: about 0.05 ml/mmHg of a left coronary artery.
  double compliance_s_mmhg = 0.025;
  /// Of the left ventricle's pressure, about the vessels in the muscle: behind a right coronary artery (a
  /// root called RCA) and behind all others.
  double right_muscle_share = 0.5, left_muscle_share = 1.0;
};
void validate(const PulseOptions& options);  ///< throws InvalidInput

/// Aortic pressure over a beat that begins with systole: a usual course between the cuff's two pressures,
/// bent so that its mean is the conditions'. `phase` in [0, 1).
double aortic_pressure_pa(const Conditions& conditions, double phase);
/// Of the left ventricle.
double ventricular_pressure_pa(const Conditions& conditions, double phase);
/// The wave-free period: from a quarter of diastole to 5 ms before its end (Sen et al. 2012).
struct Phases {
  double from = 0.0, to = 0.0;
};
Phases wave_free_period(const Conditions& conditions);

/// A place of the tree: of a branch, at an abscissa of its vessel.
struct TreePlace {
  std::size_t branch = 0;
  double s_mm = 0.0;
};
struct PulsePlace {
  TreePlace place;
  std::vector<double> pressure_pa;  ///< one a step of the last beat
  double mean_ratio = 1.0;          ///< mean pressure over mean aortic pressure
  double wave_free_ratio = 1.0;     ///< the same within the wave-free period: iFR
};
struct Pulse {
  std::vector<double> time_s, aortic_pa;              ///< of the last beat
  std::vector<double> mean_flow_ml_s;                 ///< of each branch
  std::vector<std::vector<double>> outlet_flow_ml_s;  ///< of each outlet, one a step
  std::vector<PulsePlace> places;
  int beats = 0;
  double change_pa = 0.0;  ///< of the beds' pressures over the last beat: how far from periodic
};

/// From the steady state on, beat by beat, until beds come back to within 1 Pa. The epicardial vessels are
/// rigid and without inertia of their own. Throws as solve does, and InvalidInput for options and places.
Pulse pulse(const PreparedNetwork& network, const Conditions& conditions, const FlowState& mean,
            const std::vector<TreePlace>& places, const PulseOptions& options = {});

}  // namespace ostia::hemodynamics
