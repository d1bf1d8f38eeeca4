#include "ostia/hemodynamics/network_solver.h"

#include "network_system.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::hemodynamics {
namespace {

constexpr std::size_t most_outlets = 2000;
constexpr int most_iterations = 60;

/// Newton with halved steps. True when the residual is at rounding; the best point found is left in `x`.
bool newton(const System& system, double scale_pa, Eigen::VectorXd& x, int& iterations, double& residual) {
  Equations now = system.equations(x);
  residual = now.residual.cwiseAbs().maxCoeff();
  for (int i = 0; i < most_iterations; ++i) {
    if (residual <= 1e-12 * scale_pa) return true;
    const Eigen::VectorXd step = now.jacobian.partialPivLu().solve(-now.residual);
    if (!step.allFinite()) return false;
    ++iterations;
    double length = 1.0, least = HUGE_VAL;
    Eigen::VectorXd best;
    Equations next;
    for (; length > 1e-4; length *= 0.5) {
      best = x + length * step;
      next = system.equations(best);
      least = next.residual.cwiseAbs().maxCoeff();
      if (least < (1.0 - 0.1 * length) * residual) break;
    }
    // Rounding: nothing gets better any more, and what is left is far below what anyone could see.
    if (!(least < residual)) return residual <= 1e-9 * scale_pa;
    x = best;
    now = std::move(next);
    residual = least;
  }
  return residual <= 1e-9 * scale_pa;
}

void check(const PreparedNetwork& network, const Boundary& boundary, const Links& links) {
  if (boundary.outlets.size() != network.outlets().size())
    throw InvalidInput("the network has " + std::to_string(network.outlets().size()) +
                       " outlets and is told " + std::to_string(boundary.outlets.size()));
  if (!std::isfinite(boundary.inlet_pa) ||
      (boundary.inlet_flow_ml_s && !std::isfinite(*boundary.inlet_flow_ml_s)))
    throw InvalidInput("the pressure or the flow at the inlet is no number");
  std::size_t told = 0;
  for (const Outlet& outlet : boundary.outlets) {
    if (!(outlet.resistance_pa_s_ml >= 0.0) || !std::isfinite(outlet.resistance_pa_s_ml) ||
        !std::isfinite(outlet.distal_pa) || (outlet.flow_ml_s && !std::isfinite(*outlet.flow_ml_s)))
      throw InvalidInput(
          "an outlet's resistance, pressure or flow is no number, or its resistance is below 0");
  }
  for (const std::size_t k : links.open_outlets) told += boundary.outlets[k].flow_ml_s ? 1 : 0;
  if (boundary.inlet_flow_ml_s && told == links.open.size())
    throw InvalidInput(
        "the flow at the inlet is told, and no outlet is left that it could take: all are shut, or their "
        "flows told");
}

/// The whole tree with friction alone is linear: one step from rest is its solution.
Eigen::VectorXd linear_start(System& system) {
  system.model().inertia = false;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(system.unknowns());
  const Equations at_rest = system.equations(x);
  const Eigen::VectorXd step = at_rest.jacobian.partialPivLu().solve(-at_rest.residual);
  if (step.allFinite()) x = step;
  return x;
}

Solution told_of(const PreparedNetwork& network, const Boundary& boundary, const System& system,
                 const Eigen::VectorXd& x) {
  const Losses losses = system.losses(x);
  Solution solution;
  solution.inlet_pa = system.inlet_pa(x);
  solution.flow_ml_s = losses.flow;
  solution.start_momentum = losses.start_momentum;
  solution.from_pa.assign(network.size(), 0.0);
  solution.to_pa.assign(network.size(), 0.0);
  // Behind an occlusion: the mean of what its outlets rest at.
  std::vector<double> rest(network.size(), 0.0), outlets(network.size(), 0.0);
  const auto& branches = network.network().branches;
  for (std::size_t k = 0; k < network.outlets().size(); ++k)
    for (int b = static_cast<int>(network.outlets()[k]); b >= 0;
         b = branches[static_cast<std::size_t>(b)].parent) {
      rest[static_cast<std::size_t>(b)] += boundary.outlets[k].distal_pa;
      outlets[static_cast<std::size_t>(b)] += 1.0;
    }
  for (std::size_t b = 0; b < network.size(); ++b) {
    const int parent = branches[b].parent;
    const double before = parent < 0 ? solution.inlet_pa : solution.to_pa[static_cast<std::size_t>(parent)];
    const bool open = !network.beyond_occlusion(b);
    const bool beyond = parent >= 0 && network.beyond_occlusion(static_cast<std::size_t>(parent));
    solution.from_pa[b] = beyond ? rest[b] / outlets[b] : before - losses.at_fork[b];
    solution.to_pa[b] = open ? solution.from_pa[b] - losses.along[b] : rest[b] / outlets[b];
  }
  return solution;
}

}  // namespace

PreparedNetwork::PreparedNetwork(Network network, const FlowModel& model) : model_(model) {
  validate(network);
  outlets_ = std::make_shared<const std::vector<std::size_t>>(outlets_of(network));
  if (outlets_->size() > most_outlets)
    throw InvalidInput("the network has " + std::to_string(outlets_->size()) + " outlets; up to " +
                       std::to_string(most_outlets) + " are solved");
  for (const Branch& branch : network.branches)
    prepared_.push_back(std::make_shared<const PreparedBranch>(prepare(branch, model)));
  network_ = std::make_shared<const Network>(std::move(network));
}

PreparedNetwork PreparedNetwork::with_branch(std::size_t index, Branch branch) const {
  if (index >= size()) throw InvalidInput("the network has no branch " + std::to_string(index));
  branch.parent = network_->branches[index].parent;
  PreparedNetwork other = *this;
  other.prepared_[index] = std::make_shared<const PreparedBranch>(prepare(branch, model_));
  Network network = *network_;
  network.branches[index] = std::move(branch);
  other.network_ = std::make_shared<const Network>(std::move(network));
  return other;
}

bool PreparedNetwork::beyond_occlusion(std::size_t index) const {
  for (int b = static_cast<int>(index); b >= 0; b = network_->branches[static_cast<std::size_t>(b)].parent)
    if (prepared_[static_cast<std::size_t>(b)]->shut()) return true;
  return false;
}

Solution solve(const PreparedNetwork& network, const Boundary& boundary, const Solution* from) {
  System system(network, boundary);
  check(network, boundary, system.links());
  const auto count = static_cast<Eigen::Index>(system.links().open.size());
  if (count == 0) {
    Solution still = told_of(network, boundary, system, Eigen::VectorXd::Zero(system.unknowns()));
    return still;
  }
  const FlowModel whole = network.model();
  Eigen::VectorXd x;
  if (from && from->flow_ml_s.size() == network.size()) {
    x.resize(system.unknowns());
    for (Eigen::Index i = 0; i < count; ++i)
      x[i] = from->flow_ml_s[system.links().open[static_cast<std::size_t>(i)]];
    if (boundary.inlet_flow_ml_s) x[count] = from->inlet_pa;
  } else {
    x = linear_start(system);
    system.model() = whole;
  }
  double scale = 1.0;
  for (const Outlet& outlet : boundary.outlets) scale = std::max(scale, std::abs(outlet.distal_pa));
  scale = std::max({scale, std::abs(boundary.inlet_pa), boundary.inlet_flow_ml_s ? std::abs(x[count]) : 0.0});
  int iterations = 0;
  double residual = 0.0;
  bool done = newton(system, scale, x, iterations, residual);
  if (!done) {  // From linear to whole in growing steps.
    x = linear_start(system);
    for (const double part : {1e-3, 1e-2, 0.05, 0.15, 0.3, 0.5, 0.75, 1.0}) {
      system.model() = whole;
      system.model().inertia_scale = whole.inertia_scale * part;
      done = newton(system, scale, x, iterations, residual);
    }
  }
  if (!done)
    throw NumericalError("the pressures of the tree do not settle: " + core::significant_text(residual, 3) +
                         " Pa are left after " + std::to_string(iterations) + " steps");
  Solution solution = told_of(network, boundary, system, x);
  solution.iterations = iterations;
  solution.residual_pa = residual;
  return solution;
}

std::vector<StationFlow> along(const PreparedNetwork& network, const Solution& solution, std::size_t branch) {
  return pressure_along(network.branch(branch), network.model(), solution.flow_ml_s.at(branch),
                        solution.from_pa.at(branch), solution.to_pa.at(branch),
                        solution.start_momentum.at(branch));
}

Residuals residuals(const PreparedNetwork& network, const Boundary& boundary, double inlet_pa,
                    const std::vector<double>& open_flows_ml_s) {
  Boundary at = boundary;
  at.inlet_pa = inlet_pa;
  at.inlet_flow_ml_s.reset();
  const System system(network, at);
  check(network, at, system.links());
  if (open_flows_ml_s.size() != system.links().open.size())
    throw InvalidInput("the network has " + std::to_string(system.links().open.size()) + " open outlets");
  const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(open_flows_ml_s.data(), system.unknowns());
  const Equations equations = system.equations(x);
  Residuals out{system.links().open_outlets, {}, {}};
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    out.pa.push_back(equations.residual[i]);
    for (Eigen::Index j = 0; j < x.size(); ++j) out.jacobian_pa_s_ml.push_back(equations.jacobian(i, j));
  }
  return out;
}

}  // namespace ostia::hemodynamics
