#include "ostia/analysis/graph_overlaps.h"

#include "growth/cone_tree.h"
#include "growth/joint_rule.h"
#include "growth/round_cones.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>

namespace ostia::analysis {
namespace {

using geometry::GraphIncidence;
using geometry::VesselGraph;

constexpr double largest = 1e30;  // boxes are in single precision

void check_cones(const VesselGraph& graph) {
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const RoundCone cone = round_cone(graph, static_cast<std::int32_t>(e));
    const double least = std::min(cone.radius_from, cone.radius_to);
    if (!cone.from.allFinite() || !cone.to.allFinite() || !std::isfinite(cone.radius_from + cone.radius_to) ||
        !(least >= 0.0) || cone.from.cwiseAbs().maxCoeff() > largest ||
        cone.to.cwiseAbs().maxCoeff() > largest || std::max(cone.radius_from, cone.radius_to) > largest)
      throw InvalidInput("segment " + std::to_string(e) +
                         " has a place or radius that is not a finite number of a sensible size, or a radius "
                         "below 0: overlaps " +
                         "cannot be found; ostia convert --repair mends what can be mended");
  }
}

/// The edge that arrives at each point, the first of several; -1: none.
std::vector<std::int32_t> arriving_edges(const VesselGraph& graph, const GraphIncidence& incidence) {
  std::vector<std::int32_t> result(graph.points.size(), -1);
  for (std::size_t p = 0; p < result.size(); ++p) {
    const auto arriving = incidence.arriving(static_cast<std::int32_t>(p));
    if (!arriving.empty()) result[p] = arriving[0];
  }
  return result;
}

/// Where an edge lies along its branch, mm.
struct PlaceAlong {
  std::int32_t branch = -1;
  double begin = 0.0, end = 0.0;
};
std::vector<PlaceAlong> places_along(const VesselGraph& graph, const GraphIncidence& incidence) {
  std::vector<PlaceAlong> result(graph.edges.size());
  std::int32_t number = 0;
  for (const geometry::GraphBranch& branch : geometry::branches(graph, incidence)) {
    double way = 0.0;
    for (const std::int32_t e : branch.edges) {
      const geometry::GraphEdge& edge = graph.edges[static_cast<std::size_t>(e)];
      const double begin = way;
      way += (graph.points[static_cast<std::size_t>(edge.to)] -
              graph.points[static_cast<std::size_t>(edge.from)])
                 .norm();
      result[static_cast<std::size_t>(e)] = {number, begin, way};
    }
    ++number;
  }
  return result;
}

class OverlapFinder {
 public:
  OverlapFinder(const VesselGraph& graph, const GraphIncidence& incidence, const OverlapOptions& options)
      : graph_(graph),
        arriving_(arriving_edges(graph, incidence)),
        joints_(graph, arriving_, options),
        bend_reach_(options.bend_reach),
        least_depth_(options.least_depth),
        along_(places_along(graph, incidence)),
        tree_(graph) {}
  OverlapFinder(const OverlapFinder&) = delete;

  std::vector<GraphOverlap> of(std::int32_t edge, std::vector<std::int32_t>& scratch) const {
    scratch.clear();
    tree_.partners(edge, scratch);
    std::sort(scratch.begin(), scratch.end());
    std::vector<GraphOverlap> found;
    const RoundCone cone = round_cone(graph_, edge);
    for (const std::int32_t other : scratch) {
      if (joints_.share_a_point(edge, other) || are_of_one_bend(edge, other)) continue;
      const RoundCone against = round_cone(graph_, other);
      const std::optional<ConeContact> hit = contact(cone, against);
      const double thinner = std::min(std::max(cone.radius_from, cone.radius_to),
                                      std::max(against.radius_from, against.radius_to));
      if (!hit || hit->depth <= least_depth_ * thinner) continue;
      if (!joints_.covers(edge, other, *hit)) found.push_back({edge, other, hit->depth, hit->place});
    }
    return found;
  }

 private:
  /// Whatever their contact is like, the way along their branch is short enough. Finely sampled lines have
  /// hundreds of such pairs for each segment: they are told without looking at the cones.
  bool are_of_one_bend(std::int32_t a, std::int32_t b) const {
    const PlaceAlong &one = along_[static_cast<std::size_t>(a)], &other = along_[static_cast<std::size_t>(b)];
    if (one.branch != other.branch) return false;
    const geometry::GraphEdge &e = graph_.edges[static_cast<std::size_t>(a)],
                              &f = graph_.edges[static_cast<std::size_t>(b)];
    const double radii = std::max(e.radius_from, e.radius_to) + std::max(f.radius_from, f.radius_to);
    return std::max(one.end, other.end) - std::min(one.begin, other.begin) <= bend_reach_ * radii;
  }

  const VesselGraph& graph_;
  std::vector<std::int32_t> arriving_;
  JointRule joints_;
  double bend_reach_, least_depth_;
  std::vector<PlaceAlong> along_;
  ConeTree tree_;
};

}  // namespace

void validate(const OverlapOptions& options) {
  const auto check = [](double value, const char* name) {
    if (!std::isfinite(value) || value < 0.0)
      throw InvalidInput(std::string("overlaps: ") + name + " is " + std::to_string(value) +
                         "; give a finite number, 0 or more");
  };
  check(options.bend_reach, "the reach along a bend");
  check(options.fork_reach, "the reach round a fork");
  check(options.least_depth, "the least depth");
}

std::vector<GraphOverlap> find_overlaps(const VesselGraph& graph, const GraphIncidence& incidence,
                                        const OverlapOptions& options, const core::TaskContext& task) {
  validate(options);
  check_cones(graph);
  task.throw_if_cancelled();
  if (graph.edges.empty()) return {};
  const OverlapFinder finder(graph, incidence, options);
  using List = std::vector<GraphOverlap>;
  std::atomic<std::int64_t> count = 0;
  return core::parallel_reduce<List>(
      graph.edges.size(), 4096, {},
      [&](std::size_t first, std::size_t last) {
        List list;
        std::vector<std::int32_t> scratch;
        for (std::size_t e = first; e < last; ++e) {
          task.throw_if_cancelled();
          const List own = finder.of(static_cast<std::int32_t>(e), scratch);
          list.insert(list.end(), own.begin(), own.end());
          if ((count += static_cast<std::int64_t>(own.size())) > options.most)
            throw ResourceError("more than " + std::to_string(options.most) +
                                " pairs of segments run into each other: are places and radii in one unit? "
                                "`ostia convert --units m --radius-units mm` brings both to mm");
        }
        return list;
      },
      [](List all, const List& more) {
        all.insert(all.end(), more.begin(), more.end());
        return all;
      });
}

}  // namespace ostia::analysis
