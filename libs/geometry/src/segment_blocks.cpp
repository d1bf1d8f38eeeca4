#include "ostia/geometry/segment_blocks.h"

#include "morton_leaves.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace ostia::geometry {
namespace {

constexpr std::size_t block_size = 256;

float radius_of(double radius) {
  return std::isfinite(radius) && radius > 0.0 ? static_cast<float>(radius) : 0.0f;
}

float length(const DrawnSegment& one) {
  float sum = 0.0f;
  for (std::size_t a = 0; a < 3; ++a) sum += (one.to[a] - one.from[a]) * (one.to[a] - one.from[a]);
  return std::sqrt(sum);
}

/// Edges that can be drawn, in an order in which neighbours in space are mostly neighbours.
std::vector<std::int32_t> ordered(const VesselGraph& graph, const std::vector<std::int32_t>& edges,
                                  const Vec3& low, const Vec3& high) {
  detail::BvhBox bounds{};
  for (int a = 0; a < 3; ++a) bounds.lower[a] = low[a], bounds.upper[a] = high[a];
  const detail::UnitCube cube(bounds);
  std::vector<detail::FloatBox> boxes(edges.size());
  core::parallel_for(edges.size(), 4096, [&](std::size_t i) {
    const GraphEdge& edge = graph.edges[static_cast<std::size_t>(edges[i])];
    const Vec3 &from = graph.points[static_cast<std::size_t>(edge.from)],
               &to = graph.points[static_cast<std::size_t>(edge.to)];
    detail::BvhBox box{};
    for (int a = 0; a < 3; ++a)
      box.lower[a] = std::min(from[a], to[a]), box.upper[a] = std::max(from[a], to[a]);
    boxes[i] = cube(box);
  });
  std::vector<std::int32_t> order = detail::morton_leaves(boxes).order;
  for (std::int32_t& one : order) one = edges[static_cast<std::size_t>(one)];
  return order;
}

}  // namespace

SegmentBlocks::SegmentBlocks(const VesselGraph& graph, const core::TaskContext& task)
    : place_(graph.edges.size(), -1) {
  std::vector<std::int32_t> edges;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const Vec3 &from = graph.points[static_cast<std::size_t>(graph.edges[e].from)],
               &to = graph.points[static_cast<std::size_t>(graph.edges[e].to)];
    if (!from.allFinite() || !to.allFinite()) continue;
    if (edges.empty()) low_ = high_ = from;
    low_ = low_.cwiseMin(from.cwiseMin(to));
    high_ = high_.cwiseMax(from.cwiseMax(to));
    edges.push_back(static_cast<std::int32_t>(e));
  }
  centre_ = 0.5 * low_ + 0.5 * high_;
  task.set_progress(0.1);
  task.throw_if_cancelled();
  const std::vector<std::int32_t> order = ordered(graph, edges, low_, high_);
  task.set_progress(0.5);
  task.throw_if_cancelled();
  segments_.resize(order.size());
  core::parallel_for(order.size(), 4096, [&](std::size_t i) {
    const GraphEdge& edge = graph.edges[static_cast<std::size_t>(order[i])];
    const Vec3 from = graph.points[static_cast<std::size_t>(edge.from)] - centre_,
               to = graph.points[static_cast<std::size_t>(edge.to)] - centre_;
    DrawnSegment& one = segments_[i];
    for (int a = 0; a < 3; ++a) {
      one.from[static_cast<std::size_t>(a)] = static_cast<float>(from[a]);
      one.to[static_cast<std::size_t>(a)] = static_cast<float>(to[a]);
    }
    one.radius_from = radius_of(edge.radius_from);
    one.radius_to = radius_of(edge.radius_to);
    one.edge = order[i];
  });
  blocks_.resize((order.size() + block_size - 1) / block_size);
  core::parallel_for(blocks_.size(), 16, [&](std::size_t b) {
    blocks_[b].first = static_cast<std::uint32_t>(b * block_size);
    blocks_[b].count = static_cast<std::uint32_t>(std::min(block_size, order.size() - b * block_size));
    fill_block(blocks_[b]);
  });
  for (std::size_t i = 0; i < segments_.size(); ++i)
    place_[static_cast<std::size_t>(segments_[i].edge)] = static_cast<std::int32_t>(i);
  task.set_progress(1.0);
}

void SegmentBlocks::fill_block(Block& block) {
  const auto begin = segments_.begin() + block.first, end = begin + block.count;
  std::sort(begin, end, [](const DrawnSegment& a, const DrawnSegment& b) {
    return a.thickness() != b.thickness() ? a.thickness() > b.thickness() : a.edge < b.edge;
  });
  std::array<float, 3> lower = begin->from, upper = begin->from;
  float lengths = 0.0f;
  for (auto one = begin; one != end; ++one) {
    lengths += length(*one);
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] = std::min({lower[a], one->from[a] - one->radius_from, one->to[a] - one->radius_to});
      upper[a] = std::max({upper[a], one->from[a] + one->radius_from, one->to[a] + one->radius_to});
    }
  }
  block.mean_length = lengths / static_cast<float>(block.count);
  for (std::size_t a = 0; a < 3; ++a) {
    block.middle[a] = 0.5f * (lower[a] + upper[a]);
    block.half[a] = 0.5f * (upper[a] - lower[a]);
  }
}

const DrawnSegment* SegmentBlocks::segment(std::int32_t edge) const {
  if (edge < 0 || static_cast<std::size_t>(edge) >= place_.size()) return nullptr;
  const std::int32_t place = place_[static_cast<std::size_t>(edge)];
  return place < 0 ? nullptr : &segments_[static_cast<std::size_t>(place)];
}

}  // namespace ostia::geometry
