#include "network_pieces.h"

#include "circle.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::hemodynamics {
namespace {

constexpr double stub_mm = 0.1;  // of a branch without sections

double root_of_area(const Station& station) {
  return std::sqrt(station.area_mm2);
}

/// The last section up to which a cone from `first` is near enough to all between.
std::size_t end_of_cone(const std::vector<Station>& stations, std::size_t first, double tolerance) {
  std::size_t end = first + 1;
  for (std::size_t last = first + 2; last < stations.size(); ++last) {
    const double a = root_of_area(stations[first]), b = root_of_area(stations[last]);
    for (std::size_t i = first + 1; i < last; ++i) {
      const double t =
          (stations[i].s_mm - stations[first].s_mm) / (stations[last].s_mm - stations[first].s_mm);
      const double own = root_of_area(stations[i]);
      if (std::abs((1.0 - t) * a + t * b - own) > tolerance * own) return end;
    }
    end = last;
  }
  return end;
}

/// Of the developed friction, up to each section.
std::vector<double> friction_to(const PreparedBranch& branch, double viscosity_mpa_s) {
  std::vector<double> sums{0.0};
  double sum = 0.0;
  for (const PreparedBranch::Step& step : branch.steps) {
    sum += 8.0 * pi * viscosity_mpa_s * step.friction_mm3;
    if (step.station) sums.push_back(sum);
  }
  return sums;
}

NetworkPiece stub_of(const PreparedNetwork& network, std::size_t b, const NetworkPiece* before) {
  const LumpedDrop& lumped = network.network().branches[b].lumped;
  NetworkPiece piece;
  piece.length_mm = stub_mm;
  piece.from_mm2 = piece.to_mm2 = before ? before->to_mm2 : 1.0;
  piece.from = piece.to = before ? before->to : Vec3(Vec3::Zero());
  piece.friction_pa_s_ml = lumped.linear_pa_s_ml;
  return piece;
}

std::vector<NetworkPiece> cones_of(const PreparedNetwork& network, const Solution& solution, std::size_t b,
                                   double tolerance) {
  const Branch& branch = network.network().branches[b];
  const std::vector<double> friction = friction_to(network.branch(b), network.model().viscosity_mpa_s);
  const std::vector<StationFlow> flows = along(network, solution, b);
  std::vector<NetworkPiece> cones;
  for (std::size_t i = 0; i + 1 < branch.stations.size();) {
    const std::size_t k = end_of_cone(branch.stations, i, tolerance);
    const Station &from = branch.stations[i], &to = branch.stations[k];
    NetworkPiece piece;
    piece.length_mm = to.s_mm - from.s_mm;
    piece.from_mm2 = from.area_mm2;
    piece.to_mm2 = to.area_mm2;
    piece.from = from.point;
    piece.to = to.point;
    piece.friction_pa_s_ml = friction[k] - friction[i];
    piece.to_pa = flows[k].pressure_pa;
    cones.push_back(piece);
    i = k;
  }
  cones.front().friction_pa_s_ml += branch.lumped.linear_pa_s_ml;
  return cones;
}

}  // namespace

std::string_view name_of(NetworkFormat format) {
  constexpr std::array<std::string_view, 3> names = {"svzerod", "svoned", "openbf"};
  return names[static_cast<std::size_t>(format)];
}

NetworkFormat network_format(std::string_view name) {
  for (const NetworkFormat format : {NetworkFormat::svzerod, NetworkFormat::svoned, NetworkFormat::openbf})
    if (name == name_of(format)) return format;
  throw InvalidInput("a network is written as svzerod, svoned or openbf, not as " + std::string(name));
}

std::vector<NetworkPiece> pieces_of(const PreparedNetwork& network, const Solution& solution,
                                    double tolerance) {
  const auto& branches = network.network().branches;
  std::vector<NetworkPiece> pieces;
  std::vector<int> last(branches.size(), -1);  // piece of each branch
  for (std::size_t b = 0; b < branches.size(); ++b) {
    if (network.beyond_occlusion(b)) continue;
    const int parent = branches[b].parent;
    int before = parent < 0 ? -1 : last[static_cast<std::size_t>(parent)];
    std::vector<NetworkPiece> own;
    if (branches[b].stations.empty())
      own.push_back(stub_of(network, b, before < 0 ? nullptr : &pieces[static_cast<std::size_t>(before)]));
    else
      own = cones_of(network, solution, b, tolerance);
    own.back().to_pa = solution.to_pa[b];
    for (std::size_t i = 0; i < own.size(); ++i) {
      own[i].branch = b;
      own[i].first = i == 0;
      own[i].parent = before;
      own[i].from_pa = before < 0 ? solution.inlet_pa : pieces[static_cast<std::size_t>(before)].to_pa;
      own[i].flow_ml_s = solution.flow_ml_s[b];
      before = static_cast<int>(pieces.size());
      pieces.push_back(own[i]);
    }
    last[b] = before;
  }
  for (NetworkPiece& piece : pieces) piece.outlet = true;
  for (const NetworkPiece& piece : pieces)
    if (piece.parent >= 0) pieces[static_cast<std::size_t>(piece.parent)].outlet = false;
  return pieces;
}

const Outlet& outlet_of(const PreparedNetwork& network, const Boundary& boundary, std::size_t branch) {
  // What ends before an occlusion is no outlet of the network: nothing flows there.
  static const Outlet shut{0.0, 0.0, 0.0};
  const auto& outlets = network.outlets();
  const auto found = std::lower_bound(outlets.begin(), outlets.end(), branch);
  if (found == outlets.end() || *found != branch) return shut;
  return boundary.outlets[static_cast<std::size_t>(found - outlets.begin())];
}

std::vector<NetworkFile> export_network(const PreparedNetwork& network, const Boundary& boundary,
                                        const Solution& solution, NetworkFormat format,
                                        const NetworkExportOptions& options) {
  if (!(options.tolerance >= 0.001 && options.tolerance <= 0.5))
    throw InvalidInput("a cone is off by 0.001 to 0.5 of the radius, not by " +
                       core::shortest_text(options.tolerance));
  const std::vector<NetworkPiece> pieces = pieces_of(network, solution, options.tolerance);
  if (pieces.empty()) throw InvalidInput("all roots of the network are occluded: there is nothing to write");
  if (format == NetworkFormat::svzerod) return {svzerod_file(network, boundary, solution, pieces)};
  std::vector<std::vector<NetworkPiece>> trees;  // one a root, pieces numbered anew
  std::vector<std::size_t> tree_of(pieces.size()), place(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    // Neither program has an outlet that is shut: what nothing flows through is left out.
    if (!(pieces[i].flow_ml_s > 0.0)) continue;
    const auto parent = static_cast<std::size_t>(std::max(0, pieces[i].parent));
    if (pieces[i].parent < 0) trees.emplace_back();
    tree_of[i] = pieces[i].parent < 0 ? trees.size() - 1 : tree_of[parent];
    place[i] = trees[tree_of[i]].size();
    trees[tree_of[i]].push_back(pieces[i]);
    if (pieces[i].parent >= 0) trees[tree_of[i]].back().parent = static_cast<int>(place[parent]);
  }
  if (trees.empty())
    throw InvalidInput("nothing flows through the network; " + std::string(name_of(format)) +
                       " has no case for it");
  std::vector<NetworkFile> files;
  for (std::size_t t = 0; t < trees.size(); ++t) {
    const int number = trees.size() > 1 ? static_cast<int>(t) + 1 : 0;
    if (format == NetworkFormat::svoned) {
      files.push_back(svoned_file(network, boundary, solution, trees[t], number));
      continue;
    }
    for (NetworkFile& file : openbf_files(network, boundary, trees[t], number))
      files.push_back(std::move(file));
  }
  return files;
}

}  // namespace ostia::hemodynamics
