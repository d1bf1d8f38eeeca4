#include "tree_draws.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::hemodynamics {
namespace {

constexpr std::size_t most_directions = 24;  // of walls, that are drawn evenly
constexpr std::size_t first_directions = 3;  // of these, that have the best of the sequence

std::vector<double> relative_spreads(const Network& network, const WallSpread& wall) {
  if (!wall.station_sd_mm.empty() && wall.station_sd_mm.size() != network.branches.size())
    throw InvalidInput("uncertainty: the walls' spreads are of " + std::to_string(wall.station_sd_mm.size()) +
                       " branches, the tree has " + std::to_string(network.branches.size()));
  std::vector<double> relative;
  for (std::size_t b = 0; b < network.branches.size(); ++b) {
    const auto& stations = network.branches[b].stations;
    const bool told = !wall.station_sd_mm.empty() && !wall.station_sd_mm[b].empty();
    if (told && wall.station_sd_mm[b].size() != stations.size())
      throw InvalidInput("uncertainty: branch " + std::to_string(b) + " has " +
                         std::to_string(stations.size()) + " sections and spreads for " +
                         std::to_string(wall.station_sd_mm[b].size()));
    for (std::size_t i = 0; i < stations.size(); ++i) {
      const double radius = 0.5 * stations[i].diameter_mm();
      const double sd = told ? wall.station_sd_mm[b][i] : wall.radius_sd_mm;
      relative.push_back(stations[i].area_mm2 > shut_mm2 ? std::min(sd / radius, wall.most_relative) : 0.0);
    }
  }
  return relative;
}

/// How much a station's number changes the pressure that friction takes: of flow 1, but for a factor.
struct LossWeights {
  const Network& network;
  const std::vector<double>& relative;
  std::vector<std::size_t> first;  // station of each branch

  LossWeights(const Network& of, const std::vector<double>& spreads) : network(of), relative(spreads) {
    std::size_t count = 0;
    for (const Branch& branch : network.branches) first.push_back(count), count += branch.stations.size();
  }
  void add(std::size_t b, double from_mm, double to_mm, double flow, std::vector<double>& weights) const {
    const auto& stations = network.branches[b].stations;
    for (std::size_t i = 0; i < stations.size(); ++i) {
      const Station& station = stations[i];
      if (station.s_mm < from_mm || station.s_mm > to_mm || station.area_mm2 <= shut_mm2) continue;
      const double before = i > 0 ? stations[i - 1].s_mm : station.s_mm;
      const double behind = i + 1 < stations.size() ? stations[i + 1].s_mm : station.s_mm;
      weights[first[b] + i] += 0.5 * (behind - before) * flow * station.shape.viscous *
                               relative[first[b] + i] / (station.area_mm2 * station.area_mm2);
    }
  }
};

/// Along each lesion, and along the way to each outlet.
std::vector<std::vector<double>> loss_influences(const Network& network, const std::vector<double>& flows,
                                                 const std::vector<LesionPlace>& lesions,
                                                 const std::vector<double>& relative,
                                                 const WallField& field) {
  const LossWeights weights(network, relative);
  std::vector<std::vector<double>> influences;
  const auto keep = [&](const std::vector<double>& of) {
    if (influences.size() < most_directions) influences.push_back(field.influence(of));
  };
  for (const LesionPlace& lesion : lesions) {
    std::vector<double> of(field.stations(), 0.0);
    for (std::size_t b = 0; b < network.branches.size(); ++b)
      if (network.branches[b].vessel == network.branches[lesion.throat.branch].vessel)
        weights.add(b, lesion.from.s_mm, lesion.to.s_mm, 1.0, of);
    keep(of);
  }
  for (const std::size_t outlet : outlets_of(network)) {
    std::vector<double> of(field.stations(), 0.0);
    for (int b = static_cast<int>(outlet); b >= 0; b = network.branches[static_cast<std::size_t>(b)].parent)
      weights.add(static_cast<std::size_t>(b), -HUGE_VAL, HUGE_VAL, flows[static_cast<std::size_t>(b)], of);
    keep(of);
  }
  return influences;
}

}  // namespace

TreeDraws::TreeDraws(const Network& network, const std::vector<double>& flows_ml_s,
                     const std::vector<LesionPlace>& lesions, const std::vector<InputSpread>& spreads,
                     const UncertaintyOptions& options)
    : field_(network, options.wall.correlation_mm),
      relative_(relative_spreads(network, options.wall)),
      common_(std::sqrt(options.wall.common_share)),
      local_(std::sqrt(1.0 - options.wall.common_share)),
      inputs_(spreads.size()),
      seed_(options.seed) {
  certain_ = std::all_of(relative_.begin(), relative_.end(), [](double one) { return one == 0.0; });
  directions_.emplace(loss_influences(network, flows_ml_s, lesions, relative_, field_));
  points_.emplace(2 * (1 + inputs_ + directions_->count()), options.seed);
}

TreeDraw TreeDraws::draw(std::size_t pair, bool second) const {
  std::size_t number = 0;
  const auto next = [&] { return core::normal_quantile(points_->at(pair, dimension(number++, second))); };
  TreeDraw draw;
  const double common = next();
  std::vector<double> even;
  while (even.size() < std::min(first_directions, directions_->count())) even.push_back(next());
  for (std::size_t k = 0; k < inputs_; ++k) draw.inputs.push_back(next());
  while (even.size() < directions_->count()) even.push_back(next());
  draw.wall.assign(field_.stations(), 0.0);
  if (certain_) return draw;
  std::vector<double> independent(field_.innovations());
  core::fill_normal_numbers(seed_ * 0x9e3779b97f4a7c15ULL + 2 * pair + (second ? 1 : 0), independent);
  directions_->put(even, independent);
  field_.values(independent, draw.wall);
  for (double& z : draw.wall) z = common_ * common + local_ * z;
  return draw;
}

Network TreeDraws::moved(const Network& network, std::span<const double> wall) const {
  constexpr double most_form = 4.0;  // a lumen that is all but shut is no slit
  Network out = network;
  if (certain_) return out;
  std::size_t at = 0;
  for (Branch& branch : out.branches)
    for (Station& station : branch.stations) {
      const double z = wall[at], relative = relative_[at];
      ++at;
      if (relative == 0.0) continue;
      const double square = std::exp(2.0 * z * relative);
      station.area_mm2 = std::max(station.area_mm2 * square, 2.0 * shut_mm2);
      const double form = std::min(most_form, 1.0 / square);
      station.shape.viscous = 1.0 + (station.shape.viscous - 1.0) * form;
      station.shape.perimeter = 1.0 + (station.shape.perimeter - 1.0) * form;
    }
  return out;
}

}  // namespace ostia::hemodynamics
