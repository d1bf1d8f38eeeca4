#include "ostia/view/wall_owner.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::view {
namespace {

constexpr double node_step_mm = 0.5;
constexpr std::size_t nodes_of_block = 8;
constexpr std::size_t places_of_group = 64;

/// Mean distance of the wall's samples from the axis about each node; negative where there is none.
std::vector<double> sampled_radii(const lumen::VesselLumen& vessel, double from_mm, double step_mm,
                                  std::size_t count) {
  constexpr double half_window_mm = 0.75;
  std::vector<double> sum(count, 0.0), weight(count, 0.0);
  for (const lumen::SurfaceSample& sample : vessel.samples) {
    if (sample.origin == lumen::SampleOrigin::cap) continue;
    const double rho = (sample.position - vessel.axis->point(sample.s_mm)).norm();
    const auto low =
        static_cast<std::ptrdiff_t>(std::ceil((sample.s_mm - half_window_mm - from_mm) / step_mm));
    const auto high =
        static_cast<std::ptrdiff_t>(std::floor((sample.s_mm + half_window_mm - from_mm) / step_mm));
    for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(low, 0);
         i <= std::min(high, static_cast<std::ptrdiff_t>(count) - 1); ++i) {
      sum[static_cast<std::size_t>(i)] += rho;
      weight[static_cast<std::size_t>(i)] += 1.0;
    }
  }
  for (std::size_t i = 0; i < count; ++i) sum[i] = weight[i] > 0.0 ? sum[i] / weight[i] : -1.0;
  return sum;
}

}  // namespace

std::shared_ptr<const WallOwner::OfVessel> WallOwner::nodes_of(const lumen::VesselLumen& vessel) {
  auto made = std::make_shared<OfVessel>();
  const double from = std::clamp(vessel.own_from_mm, 0.0, vessel.axis->length());
  const double length = vessel.axis->length() - from;
  const auto pieces = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length / node_step_mm)));
  const double step = std::max(length / static_cast<double>(pieces), 1e-9);
  const std::vector<double> radii = sampled_radii(vessel, from, step, pieces + 1);
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double s = from + step * static_cast<double>(i);
    made->nodes.push_back({vessel.axis->point(s), radii[i] > 0.0 ? radii[i] : vessel.axis->radius(s), s});
  }
  return made;
}

void WallOwner::add_blocks(std::size_t vessel) {
  const std::vector<Node>& nodes = of_vessels_[vessel]->nodes;
  for (std::size_t first = 0; first < nodes.size(); first += nodes_of_block) {
    Block block;
    block.vessel = vessel;
    block.first = first;
    block.last = std::min(first + nodes_of_block, nodes.size());
    block.centre = 0.5 * (nodes[block.first].point + nodes[block.last - 1].point);
    for (std::size_t i = block.first; i < block.last; ++i) {
      block.reach = std::max(block.reach, (nodes[i].point - block.centre).norm());
      block.widest = std::max(block.widest, nodes[i].radius);
    }
    blocks_.push_back(block);
  }
}

WallOwner::WallOwner(const lumen::LumenModel& model, const WallOwner* before) {
  if (model.vessels.empty()) throw InvalidInput("the model has no vessels; add one before it is shown");
  for (const auto& vessel : model.vessels) {
    std::shared_ptr<const OfVessel> kept;
    if (before != nullptr)
      for (const auto& old : before->of_vessels_)
        if (old->source == vessel) kept = old;
    if (!kept) {
      auto made = std::make_shared<OfVessel>(*nodes_of(*vessel));
      made->source = vessel;
      kept = std::move(made);
    }
    vessel_ids_.push_back(vessel->vessel);
    of_vessels_.push_back(std::move(kept));
    add_blocks(of_vessels_.size() - 1);
  }
}

WallPlace WallOwner::at(const Vec3& place) const {
  WallPlace found;
  search({&place, 1}, {&found, 1});
  return found;
}

std::vector<WallPlace> WallOwner::at(std::span<const Vec3> places) const {
  std::vector<WallPlace> found(places.size());
  core::parallel_chunks(places.size(), 32 * places_of_group, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; i += places_of_group) {
      const std::size_t count = std::min(places_of_group, last - i);
      search(places.subspan(i, count), std::span(found).subspan(i, count));
    }
  });
  return found;
}

/// Candidates are all nodes that may be the nearest of some place in the group's ball: the score changes by
/// no more than the ball's radius from its centre.
void WallOwner::search(std::span<const Vec3> group, std::span<WallPlace> out) const {
  geometry::Box3 box;
  for (const Vec3& place : group) box.extend(place);
  const Vec3 centre = box.center();
  const double half = 0.5 * box.sizes().norm();
  double best = std::numeric_limits<double>::infinity();
  std::vector<double> least(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const double away = (blocks_[b].centre - centre).norm();
    least[b] = away - blocks_[b].reach - blocks_[b].widest;
    best = std::min(best, away + blocks_[b].reach);
  }
  struct Candidate {
    const Node* node;
    std::size_t vessel;
    double score;
  };
  std::vector<Candidate> near;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (least[b] > best + 2.0 * half) continue;
    for (std::size_t i = blocks_[b].first; i < blocks_[b].last; ++i) {
      const Node& node = of_vessels_[blocks_[b].vessel]->nodes[i];
      const double score = (node.point - centre).norm() - node.radius;
      best = std::min(best, score);
      near.push_back({&node, blocks_[b].vessel, score});
    }
  }
  std::erase_if(near, [&](const Candidate& c) { return c.score > best + 2.0 * half; });
  for (std::size_t k = 0; k < group.size(); ++k) {
    double lowest = std::numeric_limits<double>::infinity();
    const Candidate* chosen = &near.front();
    for (const Candidate& c : near) {
      const double score = (c.node->point - group[k]).norm() - c.node->radius;
      if (score < lowest) {
        lowest = score;
        chosen = &c;
      }
    }
    out[k] = {vessel_ids_[chosen->vessel], chosen->node->s_mm, chosen->node->radius};
  }
}

}  // namespace ostia::view
