#pragma once
/// \file The tree at rest and under adenosine.

#include "ostia/hemodynamics/conditions.h"

namespace ostia::hemodynamics {

enum class State { rest, hyperaemia };
std::string_view name_of(State state);  ///< "rest", "hyperaemia"

struct FlowState {
  State state = State::hyperaemia;
  Boundary boundary;  ///< what was solved
  Solution solution;
  /// At rest: outlets whose bed is open as far as it can be and still gets less than it asks for.
  std::vector<std::size_t> exhausted;  ///< indices into PreparedNetwork::outlets
};

/// Hyperaemia: every bed at its least resistance. Rest: a bed takes the flow that it asks for, down to its
/// least resistance (autoregulation). `from`: as of solve.
FlowState flow_state(const PreparedNetwork& network, const Conditions& conditions, const RestingFlow& resting,
                     State state, const Solution* from = nullptr);

}  // namespace ostia::hemodynamics
