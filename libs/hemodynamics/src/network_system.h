#pragma once
/// \file The equations of a tree: flows of the open outlets, one equation each.

#include "ostia/hemodynamics/network_solver.h"

#include <Eigen/Dense>

#include <vector>

namespace ostia::hemodynamics {

/// The tree's links, made once a solve.
struct Links {
  std::vector<std::vector<std::size_t>> children;
  std::vector<std::size_t> open;                ///< branches of outlets that something flows through
  std::vector<std::size_t> open_outlets;        ///< their indices into outlets()
  std::vector<std::vector<std::size_t>> below;  ///< of each branch: indices into `open` behind it
};

/// A derivative by the flow of a branch.
struct ByFlow {
  std::size_t branch = 0;
  double value = 0.0;
};

/// What each branch takes of the pressure at the flows of the open outlets, and how it changes with them.
struct Losses {
  std::vector<double> flow, along, by_flow;  // of a branch
  std::vector<double> start_momentum;
  /// How `along` changes with the flows of branches before it, whose jets reach it.
  std::vector<std::vector<ByFlow>> by_others;
  std::vector<double> at_fork, by_own, by_parent;  // before it
};

Links links_of(const PreparedNetwork& network);
Losses losses_of(const PreparedNetwork& network, const FlowModel& model, const Links& links,
                 const Eigen::VectorXd& open);

/// Of the unknowns: flows of the open outlets and, where the inlet's flow is told, the inlet's pressure last.
struct Equations {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
};

class System {
 public:
  System(const PreparedNetwork& network, const Boundary& boundary)
      : network_(network), boundary_(boundary), links_(links_of(network)), model_(network.model()) {}

  const Links& links() const { return links_; }
  FlowModel& model() { return model_; }
  Eigen::Index unknowns() const {
    return static_cast<Eigen::Index>(links_.open.size()) + (boundary_.inlet_flow_ml_s ? 1 : 0);
  }
  double inlet_pa(const Eigen::VectorXd& x) const {
    return boundary_.inlet_flow_ml_s ? x[unknowns() - 1] : boundary_.inlet_pa;
  }
  Losses losses(const Eigen::VectorXd& x) const { return losses_of(network_, model_, links_, x); }

  Equations equations(const Eigen::VectorXd& x) const {
    const Losses losses = this->losses(x);
    const auto count = static_cast<Eigen::Index>(links_.open.size());
    Equations out{Eigen::VectorXd::Zero(unknowns()), Eigen::MatrixXd::Zero(unknowns(), unknowns())};
    for (Eigen::Index i = 0; i < count; ++i) add_outlet(i, x, losses, out);
    if (boundary_.inlet_flow_ml_s) {
      out.residual[count] = (*boundary_.inlet_flow_ml_s - x.head(count).sum()) * flow_scale;
      out.jacobian.row(count).head(count).setConstant(-flow_scale);
    }
    return out;
  }

  static constexpr double flow_scale = 1e4;  // Pa s / ml: an error in flow beside errors in pressure

 private:
  const Outlet& outlet(Eigen::Index i) const {
    return boundary_.outlets[links_.open_outlets[static_cast<std::size_t>(i)]];
  }
  void add_outlet(Eigen::Index i, const Eigen::VectorXd& x, const Losses& losses, Equations& out) const {
    if (outlet(i).flow_ml_s) {
      out.residual[i] = (*outlet(i).flow_ml_s - x[i]) * flow_scale;
      out.jacobian(i, i) = -flow_scale;
      return;
    }
    double pressure = inlet_pa(x) - outlet(i).distal_pa - outlet(i).resistance_pa_s_ml * x[i];
    out.jacobian(i, i) -= outlet(i).resistance_pa_s_ml;
    const auto& branches = network_.network().branches;
    for (int b = static_cast<int>(links_.open[static_cast<std::size_t>(i)]); b >= 0;
         b = branches[static_cast<std::size_t>(b)].parent) {
      const auto at = static_cast<std::size_t>(b);
      pressure -= losses.along[at] + losses.at_fork[at];
      for (const std::size_t k : links_.below[at])
        out.jacobian(i, static_cast<Eigen::Index>(k)) -= losses.by_flow[at] + losses.by_own[at];
      for (const ByFlow& other : losses.by_others[at])
        for (const std::size_t k : links_.below[other.branch])
          out.jacobian(i, static_cast<Eigen::Index>(k)) -= other.value;
      if (branches[at].parent < 0 || losses.by_parent[at] == 0.0) continue;
      for (const std::size_t k : links_.below[static_cast<std::size_t>(branches[at].parent)])
        out.jacobian(i, static_cast<Eigen::Index>(k)) -= losses.by_parent[at];
    }
    out.residual[i] = pressure;
    if (boundary_.inlet_flow_ml_s) out.jacobian(i, unknowns() - 1) = 1.0;
  }

  const PreparedNetwork& network_;
  const Boundary& boundary_;
  Links links_;
  FlowModel model_;
};

}  // namespace ostia::hemodynamics
