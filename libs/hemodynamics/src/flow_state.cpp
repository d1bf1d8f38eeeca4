#include "ostia/hemodynamics/flow_state.h"

#include <algorithm>

namespace ostia::hemodynamics {
namespace {

/// A bed asks for its flow as long as its resistance need not fall below the least.
FlowState at_rest(const PreparedNetwork& network, const Conditions& conditions, const RestingFlow& resting,
                  const Microcirculation& beds, Boundary boundary, const Solution* from) {
  FlowState state{State::rest, std::move(boundary), {}, {}};
  const double venous = conditions.venous_mmhg * pa_of_mmhg;
  for (std::size_t k = 0; k < resting.outlets_ml_s.size(); ++k)
    state.boundary.outlets[k] = {beds.hyperaemic_pa_s_ml[k], venous, resting.outlets_ml_s[k]};
  for (;;) {
    state.solution = solve(network, state.boundary, from);
    bool changed = false;
    for (std::size_t k = 0; k < state.boundary.outlets.size(); ++k) {
      Outlet& outlet = state.boundary.outlets[k];
      if (!outlet.flow_ml_s || network.beyond_occlusion(network.outlets()[k])) continue;
      const double pressure = state.solution.to_pa[network.outlets()[k]];
      if (pressure >= venous + outlet.resistance_pa_s_ml * *outlet.flow_ml_s * (1.0 - 1e-9)) continue;
      outlet.flow_ml_s.reset();
      state.exhausted.push_back(k);
      changed = true;
    }
    if (!changed) break;
  }
  std::sort(state.exhausted.begin(), state.exhausted.end());
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
