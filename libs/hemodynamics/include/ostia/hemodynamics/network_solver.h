#pragma once
/// \file Flows and pressures of a whole tree: Newton's method with the exact Jacobian.

#include "ostia/hemodynamics/vessel_pressure.h"

#include <memory>
#include <optional>
#include <vector>

namespace ostia::hemodynamics {

/// A network with what does not depend on flow worked out: a value that shares the branches that copies have
/// in common. An edit makes another by `with_branch`; only that branch is worked out again.
class PreparedNetwork {
 public:
  /// Throws InvalidInput as validate of network and model do, and for more than 2,000 outlets.
  PreparedNetwork(Network network, const FlowModel& model);
  /// The same with another branch in the place of the `index`th; its parent is the former one's.
  PreparedNetwork with_branch(std::size_t index, Branch branch) const;

  const Network& network() const { return *network_; }
  const FlowModel& model() const { return model_; }
  const PreparedBranch& branch(std::size_t index) const { return *prepared_[index]; }
  std::size_t size() const { return prepared_.size(); }
  const std::vector<std::size_t>& outlets() const { return *outlets_; }
  /// The branch, or one before it, lets nothing through.
  bool beyond_occlusion(std::size_t index) const;

 private:
  std::shared_ptr<const Network> network_;
  std::shared_ptr<const std::vector<std::size_t>> outlets_;
  std::vector<std::shared_ptr<const PreparedBranch>> prepared_;
  FlowModel model_;
};

/// What a tree's end flows into: pressure = distal + resistance x flow, or a flow that is told.
struct Outlet {
  double resistance_pa_s_ml = 0.0;  ///< >= 0
  double distal_pa = 0.0;
  std::optional<double> flow_ml_s;  ///< taken before the resistance
};
struct Boundary {
  double inlet_pa = 0.0;                  ///< at all roots
  std::optional<double> inlet_flow_ml_s;  ///< through all roots together; then the pressure is sought
  std::vector<Outlet> outlets;            ///< in the order of PreparedNetwork::outlets
};

struct Solution {
  double inlet_pa = 0.0;
  /// One a branch: flow; static pressure at its beginning and its end. Behind an occlusion nothing flows, and
  /// the pressure is the outlet's distal one: collateral flow is not modelled.
  std::vector<double> flow_ml_s, from_pa, to_pa;
  /// Of the profile at each branch's beginning: a jet goes on through a fork.
  std::vector<double> start_momentum;
  int iterations = 0;
  double residual_pa = 0.0;
};

/// `from`: flows to begin with, of the same network before an edit; the result does not depend on it to 1e-9
/// of the pressure. An outlet's flow that is told behind an occlusion is none. Throws InvalidInput for
/// another number of outlets, numbers that are none, or an inlet flow that no outlet is left to take;
/// NumericalError where it does not converge.
Solution solve(const PreparedNetwork& network, const Boundary& boundary, const Solution* from = nullptr);

/// Pressures along a branch of a solution.
std::vector<StationFlow> along(const PreparedNetwork& network, const Solution& solution, std::size_t branch);

/// Residuals (inlet pressure less all that is lost on the way to each open outlet, Pa) and their Jacobian by
/// the flows of the open outlets, row by row: for tests and for sensitivities.
struct Residuals {
  std::vector<std::size_t> open;  ///< indices into PreparedNetwork::outlets
  std::vector<double> pa, jacobian_pa_s_ml;
};
Residuals residuals(const PreparedNetwork& network, const Boundary& boundary, double inlet_pa,
                    const std::vector<double>& open_flows_ml_s);

}  // namespace ostia::hemodynamics
