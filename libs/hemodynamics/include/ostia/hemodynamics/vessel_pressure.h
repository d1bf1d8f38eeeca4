#pragma once
/// \file Pressure along one branch: steady momentum in one dimension, with the profile as a second unknown
/// (docs/methods/hemodynamics.md).

#include "ostia/hemodynamics/flow_model.h"
#include "ostia/hemodynamics/network.h"

#include <vector>

namespace ostia::hemodynamics {

/// A branch cut into steps; what does not depend on the flow is worked out once. A value, cheap to copy
/// beside its branch.
struct PreparedBranch {
  struct Step {
    double length_mm = 0.0;
    double area_mm2[3] = {0.0, 0.0, 0.0};  ///< before, in the middle, behind
    double friction_mm3 = 0.0;             ///< integral of viscous shape / area^2, 1/mm^3
    double mean_friction_mm4 = 0.0;        ///< viscous shape / area^2 in the middle, 1/mm^4
    double widening = 0.0;                 ///< of the area's logarithm, over a diameter, 1/mm
    /// Of a jet that goes straight on from the last throat: 0 in the lumen's middle, 1 at its wall.
    double lean = 0.0;
    double bend = 0.0;  ///< Dean's number over Reynolds'
    double diameter_mm = 0.0, perimeter_mm = 0.0;
    bool station = false;  ///< ends at a station
  };
  std::vector<Step> steps;
  LumpedDrop lumped;
  double start_momentum = 1.0;
  double first_area_mm2 = 0.0, last_area_mm2 = 0.0;  ///< 0 without stations
  std::size_t stations = 0, open_stations = 0;  ///< how many there are; how many before the first shut one
  bool shut() const { return open_stations < stations; }  ///< a section lets nothing through
};
/// Throws as validate(branch) and validate(model) do.
PreparedBranch prepare(const Branch& branch, const FlowModel& model);

/// A branch passed forward (or backward, from its end) by a flow whose profile has a momentum coefficient.
struct Passage {
  double pa = 0.0, by_flow_pa_s_ml = 0.0, by_momentum_pa = 0.0;  ///< fall of pressure, and its derivatives
  /// Of the profile behind; above 4/3 a jet, that goes on into what comes there.
  double momentum = 4.0 / 3.0, momentum_by_flow_s_ml = 0.0, momentum_by_momentum = 0.0;
};
/// `mixes`: what is left of a jet mixes at the end. `by_momentum`: with the derivatives by it, else they are
/// 0.
Passage pass(const PreparedBranch& branch, const FlowModel& model, double flow_ml_s, double start_momentum,
             bool mixes, bool by_momentum = true);

struct Drop {
  double pa = 0.0;       ///< pressure before less pressure behind
  double pa_s_ml = 0.0;  ///< its exact derivative by the flow
};
/// Of the branch by itself: its profile begins as it is told there, and a jet mixes at its end. Odd where the
/// branch is the same from both ends; of a shut one it is 0 (nothing flows).
Drop pressure_drop(const PreparedBranch& branch, const FlowModel& model, double flow_ml_s);

/// What there is at a station.
struct StationFlow {
  double pressure_pa = 0.0;
  double momentum = 1.0;       ///< mean square over squared mean of the velocity; above 4/3 the flow is a jet
  double wall_shear_pa = 0.0;  ///< mean about the rim, of the step that ends here; below 0: backwards
  double reynolds = 0.0;
  bool separated() const { return momentum > 4.0 / 3.0 + 0.02; }
};
/// One a station, from `inlet_pa` at the first. Of a shut branch the pressure is `inlet_pa` up to the first
/// shut section and `behind_pa` from there on.
std::vector<StationFlow> pressure_along(const PreparedBranch& branch, const FlowModel& model,
                                        double flow_ml_s, double inlet_pa, double behind_pa = 0.0);
/// The same with another profile at its beginning.
std::vector<StationFlow> pressure_along(const PreparedBranch& branch, const FlowModel& model,
                                        double flow_ml_s, double inlet_pa, double behind_pa,
                                        double start_momentum);

}  // namespace ostia::hemodynamics
