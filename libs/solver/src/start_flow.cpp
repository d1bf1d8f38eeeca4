#include "ostia/solver/start_flow.h"

#include "ostia/core/error.h"
#include "ostia/solver/boundary_conditions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ostia::solver {
namespace {

using geometry::Vec3;

/// Between two sections of a branch.
struct Piece {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  double radius_mm[2] = {}, pressure_pa[2] = {}, momentum[2] = {};
  double flow_ml_s = 0.0;
};

double between(const double (&ends)[2], double t) {
  return ends[0] + t * (ends[1] - ends[0]);
}

/// Share of a piece's length at which a place's foot is.
double foot_share(const Piece& piece, const Vec3& place) {
  const Vec3 along = piece.to - piece.from;
  return std::clamp((place - piece.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
}

/// Speed over the mean one at a share of the radius, for a profile of this momentum coefficient.
double relative_speed(double momentum, double rho) {
  constexpr double flattest = 40.0;  // as its exponent
  if (momentum >= hemodynamics::developed_momentum) {
    const double jet = hemodynamics::developed_momentum / momentum;  // of the section's area
    return std::max(0.0, 2.0 / jet * (1.0 - rho * rho / jet));
  }
  const double n = std::min(flattest, (2.0 - momentum) / std::max(1e-3, momentum - 1.0));
  return rho < 1.0 ? (n + 2.0) / n * (1.0 - std::pow(rho, n)) : 0.0;
}

StartFlow flow_in(const Piece& piece, double t, double rho) {
  const double radius = between(piece.radius_mm, t);
  const double mean = piece.flow_ml_s / (M_PI * radius * radius);  // ml/s over mm2 is m/s
  return {mean * relative_speed(between(piece.momentum, t), rho) * (piece.to - piece.from).normalized(),
          between(piece.pressure_pa, t)};
}

std::vector<Piece> pieces_of(const hemodynamics::PreparedNetwork& network,
                             const hemodynamics::Solution& solution) {
  double behind = 0.0, most = -1.0;
  for (const std::size_t outlet : network.outlets()) {
    if (solution.flow_ml_s[outlet] <= most) continue;
    most = solution.flow_ml_s[outlet];
    behind = solution.to_pa[outlet];
  }
  std::vector<Piece> pieces;
  for (std::size_t b = 0; b < network.size(); ++b) {
    const std::vector<hemodynamics::Station>& stations = network.network().branches[b].stations;
    const std::vector<hemodynamics::StationFlow> flows = hemodynamics::along(network, solution, b);
    for (std::size_t i = 1; i < stations.size(); ++i) {
      Piece piece{stations[i - 1].point, stations[i].point, {}, {}, {}, solution.flow_ml_s[b]};
      if ((piece.to - piece.from).norm() <= 0.0) continue;
      for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
        piece.radius_mm[k] = 0.5 * stations[i - 1 + k].diameter_mm();
        piece.pressure_pa[k] = flows[i - 1 + k].pressure_pa - behind;
        piece.momentum[k] = flows[i - 1 + k].momentum;
      }
      if (std::min(piece.radius_mm[0], piece.radius_mm[1]) > 0.0) pieces.push_back(piece);
    }
  }
  return pieces;
}

}  // namespace

StartFlowAt start_flow(const hemodynamics::PreparedNetwork& network, const hemodynamics::Solution& solution) {
  const auto pieces = std::make_shared<const std::vector<Piece>>(pieces_of(network, solution));
  if (pieces->empty()) throw InvalidInput("a run cannot start from a network that has no sections");
  return [pieces](const Vec3& place) {
    const Piece* nearest = nullptr;
    double share = 0.0, least = std::numeric_limits<double>::infinity();
    for (const Piece& piece : *pieces) {
      const double t = foot_share(piece, place);
      const double rho =
          (place - piece.from - t * (piece.to - piece.from)).norm() / between(piece.radius_mm, t);
      if (rho >= least) continue;
      least = rho;
      nearest = &piece;
      share = t;
    }
    return flow_in(*nearest, share, least);
  };
}

StartOf start_from(hemodynamics::Network network) {
  hemodynamics::FlowModel model;
  model.root_momentum = hemodynamics::developed_momentum;
  const auto prepared = std::make_shared<const hemodynamics::PreparedNetwork>(std::move(network), model);
  return [prepared](const BoundaryFlow& flow) -> StartFlowAt {
    constexpr double any_pa = 12000.0;  // pressures are told above an outlet's
    hemodynamics::Boundary boundary;
    boundary.inlet_pa = any_pa;
    bool known = false;
    for (const std::size_t outlet : prepared->outlets()) {
      const std::string face = "outlet_" + prepared->network().branches[outlet].name;
      double share = 0.0;
      for (const Outlet& one : flow.outlets)
        if (one.name == face) share = one.share;
      known = known || share > 0.0;
      boundary.outlets.emplace_back().flow_ml_s = share * flow.flow_ml_s(0.0);
    }
    if (!known) return {};
    return start_flow(*prepared, hemodynamics::solve(*prepared, boundary));
  };
}

}  // namespace ostia::solver
