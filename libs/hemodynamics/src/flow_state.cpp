#include "ostia/hemodynamics/flow_state.h"

#include <optional>

namespace ostia::hemodynamics {
namespace {

/// A bed asks for its flow as long as its resistance need not fall below the least. All begin wide open; one
/// that gets more than it asks for takes that alone. This only raises the pressure elsewhere, so no bed is
/// asked twice.
FlowState at_rest(const PreparedNetwork& network, const Conditions& conditions, const RestingFlow& resting,
                  const Microcirculation& beds, Boundary boundary, const Solution* from) {
  FlowState state{State::rest, std::move(boundary), {}, {}};
  const double venous = conditions.venous_mmhg * pa_of_mmhg;
  auto& outlets = state.boundary.outlets;
  const auto asks = [&](std::size_t k) {
    return !outlets[k].flow_ml_s && !network.beyond_occlusion(network.outlets()[k]);
  };
  for (std::size_t k = 0; k < outlets.size(); ++k)
    outlets[k] = {beds.hyperaemic_pa_s_ml[k], venous, std::nullopt};
  for (bool changed = true; changed;) {
    state.solution = solve(network, state.boundary, from);
    changed = false;
    for (std::size_t k = 0; k < outlets.size(); ++k) {
      if (!asks(k) || state.solution.flow_ml_s[network.outlets()[k]] < resting.outlets_ml_s[k]) continue;
      outlets[k].flow_ml_s = resting.outlets_ml_s[k];
      changed = true;
    }
  }
  for (std::size_t k = 0; k < outlets.size(); ++k)
    if (asks(k)) state.exhausted.push_back(k);
  return state;
}

}  // namespace

std::string_view name_of(State state) {
  return state == State::rest ? "rest" : "hyperaemia";
}

FlowState flow_state(const PreparedNetwork& network, const Conditions& conditions, const RestingFlow& resting,
                     State state, const Solution* from) {
  const Microcirculation beds = microcirculation(resting, conditions);
  Boundary boundary;
  boundary.inlet_pa = conditions.mean_aortic_mmhg() * pa_of_mmhg;
  boundary.outlets.resize(resting.outlets_ml_s.size());
  if (state == State::rest) return at_rest(network, conditions, resting, beds, std::move(boundary), from);
  for (std::size_t k = 0; k < boundary.outlets.size(); ++k)
    boundary.outlets[k] = {beds.hyperaemic_pa_s_ml[k], conditions.venous_mmhg * pa_of_mmhg, std::nullopt};
  FlowState out{state, std::move(boundary), {}, {}};
  out.solution = solve(network, out.boundary, from);
  return out;
}

}  // namespace ostia::hemodynamics
