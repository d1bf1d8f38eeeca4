#include "ostia/hemodynamics/flow_model.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <numbers>
#include <string>

namespace ostia::hemodynamics {
namespace {

void require_within(const char* what, double value, double low, double high, const char* unit) {
  if (value >= low && value <= high) return;
  throw InvalidInput(std::string(what) + " is " + core::shortest_text(value) + unit + "; choose " +
                     core::shortest_text(low) + " to " + core::shortest_text(high) + unit);
}

}  // namespace

void validate(const FlowModel& model) {
  require_within("the density of blood", model.density_kg_m3, 900.0, 1200.0, " kg/m3");
  require_within("the viscosity of blood", model.viscosity_mpa_s, 0.5, 20.0, " mPa s");
  require_within("the momentum coefficient at a root", model.root_momentum, 1.0, developed_momentum, "");
  require_within("the development of profiles", model.development, 0.001, 0.1, "");
  require_within("the friction of a layer", model.layer_friction, 0.0, 2.0, "");
  require_within("the friction in a widening lumen", model.adverse_friction, 0.0, 1.5, "");
  require_within("the friction of dead water", model.backflow, 0.0, 3.0, "");
  require_within("the spread of a jet", model.jet_spread, 0.1, 20.0, "");
  require_within("the step of the integration", model.step_mm, 0.01, 2.0, " mm");
  require_within("the scale of inertia", model.inertia_scale, 0.0, 1.0, "");
}

double reynolds(const FlowModel& model, double flow_ml_s, double diameter_mm) {
  return 4.0 * model.density_kg_m3 * flow_ml_s / (std::numbers::pi * model.viscosity_mpa_s * diameter_mm);
}

}  // namespace ostia::hemodynamics
