#include "ostia/hemodynamics/junction_loss.h"

#include "circle.h"

#include <cmath>

namespace ostia::hemodynamics {
namespace {

/// Below this share of the flow the loss fades to none (the authors' own remedy, in their published code).
constexpr double least_share = 0.02;
/// Of a branch's stream, exchanged with the others: kept below the whole of it.
constexpr double most_exchange = 0.8;

double wrapped(double angle) {
  return std::remainder(angle, 2.0 * pi);
}

/// What of a branch does not depend on the flows.
struct Geometry {
  double exchange = 0.0;  // of energy with the other streams, of a branch that takes nothing
  double cosine = 0.0;    // of three quarters of the turn
};

/// With one supplier the authors' construction is this: branches stand about the fork at their angles, the
/// supplier at pi; all are turned until the mean branch stands at 0, and mirrored until the supplier is in
/// the upper half.
std::vector<Geometry> geometry_of(std::span<const ForkBranch> branches) {
  double mean = 0.0;
  for (const ForkBranch& branch : branches) mean += branch.angle_rad / static_cast<double>(branches.size());
  const double turned = wrapped(pi - mean);
  const double side = turned < 0.0 ? -1.0 : 1.0;
  const double supplier = std::abs(turned);
  std::vector<Geometry> all;
  for (const ForkBranch& branch : branches) {
    const double angle = side * wrapped(branch.angle_rad - mean);
    const double sign = angle > 0.0 ? 1.0 : angle < 0.0 ? -1.0 : 0.0;
    double phi = supplier - angle;
    if (phi < 0.0) phi += 2.0 * pi;
    all.push_back({0.8 * (pi - supplier) * sign - 0.2, std::cos(0.75 * (pi - phi))});
  }
  return all;
}

}  // namespace

std::vector<ForkDrop> fork_drops(double density_kg_m3, double parent_flow_ml_s, double parent_area_mm2,
                                 std::span<const ForkBranch> branches) {
  std::vector<ForkDrop> drops(branches.size());
  if (!(parent_flow_ml_s > 0.0)) return drops;
  const std::vector<Geometry> geometry = geometry_of(branches);
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const ForkBranch& branch = branches[i];
    if (!(branch.flow_ml_s > 0.0)) continue;
    // rho / a^2 fade (q^2 - a / A (1 - e (1 - share)) cos q Q), which is C rho u^2 with the authors' C.
    const double q = branch.flow_ml_s, Q = parent_flow_ml_s, share = q / Q;
    const double kept = std::exp(-share / least_share), fade = 1.0 - kept;
    const double ratio = branch.area_mm2 / parent_area_mm2 * geometry[i].cosine;
    double slope = geometry[i].exchange, stream = 1.0 - slope * (1.0 - share);
    if (stream < 1.0 - most_exchange) {
      stream = 1.0 - most_exchange;
      slope = 0.0;
    }
    const double scale = density_kg_m3 / (branch.area_mm2 * branch.area_mm2);
    const double inner = q * q - ratio * stream * q * Q;
    const double inner_by_own = 2.0 * q - ratio * (stream * Q + slope * q);
    const double inner_by_parent = -ratio * (stream * q - slope * share * q);
    const double fade_by_share = kept / least_share;
    drops[i].pa = scale * fade * inner;
    drops[i].by_own_pa_s_ml = scale * (fade * inner_by_own + fade_by_share / Q * inner);
    drops[i].by_parent_pa_s_ml = scale * (fade * inner_by_parent - fade_by_share * share / Q * inner);
  }
  return drops;
}

}  // namespace ostia::hemodynamics
