#include "mask_axes.h"

#include "line_graph.h"
#include "mask_kinks.h"

#include "ostia/centerline/tree_builder.h"
#include "ostia/geometry/polyline.h"
#include "ostia/geometry/tree_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace ostia::coronary {
namespace {

using centerline::Axis;
using centerline::Chain;
using centerline::SkeletonEdge;

constexpr double dome_radii = 0.6;      // a wall ends in a dome about so much beyond its axis
constexpr double most_shortened = 0.3;  // of a line
constexpr double least_stem_mm = 1.5, ahead_mm = 3.0;
constexpr double stem_radii = 2.0;  // of the first fork, that are left before it
constexpr double moved_mm = 0.4,
                 moved_radii = 0.4;  // by smoothing, at most: stairs, and forks of wide vessels
constexpr double usual_smooth_radii = 5.0;
constexpr double longest_hook_mm = 8.0, hook_share = 0.55;
constexpr double inside_parent = 0.7;  // of its radius: so far a daughter's own line says nothing
constexpr double parent_lead_mm = 6.0;

double line_length(const Axis& axis) {
  return geometry::length(axis.points);
}

void shorten_end(Axis& axis, double mm) {
  if (mm <= 0.0) return;
  const double whole = line_length(axis);
  const geometry::PolylineLocation end =
      geometry::at_abscissa(axis.points, whole - std::min(mm, most_shortened * whole));
  const double radius = (1.0 - end.t) * axis.radius[end.segment] + end.t * axis.radius[end.segment + 1];
  axis.points.resize(end.segment + 1);
  axis.radius.resize(end.segment + 1);
  if (end.t < 1e-6 && axis.points.size() > 1) return;
  axis.points.push_back(end.point);
  axis.radius.push_back(radius);
}

void turn_round(Axis& axis) {
  std::reverse(axis.points.begin(), axis.points.end());
  std::reverse(axis.radius.begin(), axis.radius.end());
}

class Chaining {
 public:
  Chaining(const centerline::SkeletonGraph& lines, double smooth_radii, double step_mm)
      : smooth_radii_(smooth_radii), step_mm_(step_mm) {
    for (const SkeletonEdge& edge : lines.edges) leaving_[edge.from].push_back(&edge);
  }

  struct Chains {
    centerline::ChainTree tree;  ///< parents first
    double led_on_mm = 0.0;      ///< by which the root lies before the mask's
    Vec3 began = Vec3::Zero();
  };
  Chains chains_of(std::int32_t root) {
    Chains chains;
    follow(root, chains.tree);
    if (!chains.tree.chains.empty()) give_stem(chains);
    return chains;
  }

 private:
  struct Begin {
    const SkeletonEdge* edge;
    std::int32_t parent;
  };

  double reach(const SkeletonEdge& edge) {
    const auto known = reach_.find(edge.id);
    if (known != reach_.end()) return known->second;
    double beyond = 0.0;
    for (const SkeletonEdge* next : leaving_[edge.to]) beyond = std::max(beyond, reach(*next));
    return reach_[edge.id] = centerline::length_mm(edge) + beyond;
  }
  const SkeletonEdge* farthest(std::int32_t node) {
    const SkeletonEdge* best = nullptr;
    for (const SkeletonEdge* edge : leaving_[node])
      if (best == nullptr || reach(*edge) > reach(*best)) best = edge;
    return best;
  }

  /// All chains from a root; daughters are made when their parent is smooth.
  void follow(std::int32_t root, centerline::ChainTree& tree) {
    std::vector<Begin> open;
    if (const SkeletonEdge* first = farthest(root)) open.push_back({first, -1});
    for (std::size_t next = 0; next < open.size(); ++next) {
      const Begin begin = open[next];
      Axis raw;
      const auto id = static_cast<std::int32_t>(tree.chains.size());
      for (const SkeletonEdge* edge = begin.edge; edge != nullptr; edge = farthest(edge->to)) {
        raw.points.insert(raw.points.end(), edge->points.begin() + (raw.points.empty() ? 0 : 1),
                          edge->points.end());
        raw.radius.insert(raw.radius.end(), edge->radius_mm.begin() + (raw.radius.empty() ? 0 : 1),
                          edge->radius_mm.end());
        const SkeletonEdge* on = farthest(edge->to);
        for (const SkeletonEdge* side : leaving_[edge->to])
          if (side != on) open.push_back({side, id});
      }
      tree.chains.push_back(chain_of(std::move(raw), begin, tree));
      tree.ends.emplace_back(id, tree.chains.back().axis.points.size() - 1);
    }
  }

  /// A fork right at a root gets a stem, away from all that leaves there: a vessel has one beginning.
  void give_stem(Chains& chains) const {
    std::vector<centerline::Chain>& all = chains.tree.chains;
    const auto wanted = static_cast<std::size_t>(std::ceil(least_stem_mm / step_mm_));
    std::size_t first = wanted;
    Vec3 inward = ahead(all[0].axis, 0);
    for (const Chain& chain : all) {
      if (chain.parent != 0 || chain.at >= wanted) continue;
      first = std::min(first, chain.at);
      inward += ahead(chain.axis, 0);
    }
    if (first == wanted) return;
    Axis& trunk = all[0].axis;
    inward = inward.norm() > 0.2 ? Vec3(inward.normalized()) : ahead(trunk, 0);
    const std::size_t more = wanted - first;
    chains.began = trunk.points.front();
    chains.led_on_mm = static_cast<double>(more) * step_mm_;
    const std::size_t fork = std::min(trunk.points.size() - 1, first + wanted);
    const double radius = trunk.radius[fork];  // at the edge of the mask it says nothing
    for (std::size_t k = 1; k <= more; ++k) {
      trunk.points.insert(trunk.points.begin(), trunk.points.front() - step_mm_ * inward);
      trunk.radius.insert(trunk.radius.begin(), radius);
    }
    for (Chain& chain : all)
      if (chain.parent == 0) chain.at += more;
    for (auto& [chain, at] : chains.tree.ends)
      if (chain == 0) at += more;
  }
  /// Where a line goes within its first millimetres.
  static Vec3 ahead(const Axis& axis, std::size_t from) {
    const Vec3 to = geometry::at_abscissa(axis.points, ahead_mm).point;
    return (to - axis.points[from]).normalized();
  }

  Axis smooth(const Axis& axis) const {
    const Axis even = centerline::at_equal_steps(without_hooks(axis), step_mm_);
    if (even.points.size() < 4) return even;
    std::vector<double> bound;
    for (const double radius : even.radius)
      bound.push_back((moved_mm + moved_radii * radius) * std::max(1.0, smooth_radii_ / usual_smooth_radii));
    Axis made = centerline::smoothed_axis(even, smooth_radii_, bound);
    ease_kinks(made);
    return made;
  }

  /// Hooks that a rough mask's line makes: a stretch whose ends are near to each other goes straight.
  Axis without_hooks(const Axis& axis) const {
    if (smooth_radii_ <= usual_smooth_radii) return axis;
    const std::vector<double> s = geometry::abscissas(axis.points);
    Axis result;
    for (std::size_t i = 0; i < s.size();) {
      result.points.push_back(axis.points[i]);
      result.radius.push_back(axis.radius[i]);
      std::size_t next = i + 1;
      for (std::size_t j = i + 2; j < s.size() && s[j] - s[i] <= longest_hook_mm; ++j)
        if ((axis.points[j] - axis.points[i]).norm() < hook_share * (s[j] - s[i])) next = j;
      i = next;
    }
    if ((result.points.back() - axis.points.back()).norm() > 1e-9) {
      result.points.push_back(axis.points.back());
      result.radius.push_back(axis.radius.back());
    }
    return result;
  }

  Chain chain_of(Axis raw, const Begin& begin, const centerline::ChainTree& tree) const {
    Chain chain;
    chain.parent = begin.parent;
    shorten_end(raw, dome_radii * raw.radius.back());
    if (begin.parent < 0) {
      // The first fork is no end: a stem of some length stays before it.
      const double stem = centerline::length_mm(*begin.edge) - stem_radii * begin.edge->radius_mm.back();
      turn_round(raw);
      shorten_end(raw, std::min(dome_radii * raw.radius.back(), stem));
      turn_round(raw);
      chain.axis = smooth(raw);
      trim_hooked_end(chain.axis);
      return chain;
    }
    const Axis& trunk = tree.chains[static_cast<std::size_t>(begin.parent)].axis;
    const Vec3 fork = raw.points.front();
    const auto nearest = std::min_element(
        trunk.points.begin(), trunk.points.end(),
        [&](const Vec3& a, const Vec3& b) { return (a - fork).squaredNorm() < (b - fork).squaredNorm(); });
    // A root has one vessel.
    chain.at = std::max<std::size_t>(1, static_cast<std::size_t>(nearest - trunk.points.begin()));
    const auto joint = trunk.points.begin() + static_cast<std::ptrdiff_t>(chain.at);
    // Within its parent's lumen the line was led by the thinning.
    const double inside_mm = std::min(inside_parent * trunk.radius[chain.at], 0.4 * line_length(raw));
    Axis own{{*joint}, {trunk.radius[chain.at]}};
    for (std::size_t i = 1; i < raw.points.size(); ++i) {
      if ((raw.points[i] - *joint).norm() < inside_mm && i + 2 < raw.points.size()) continue;
      own.points.push_back(raw.points[i]);
      own.radius.push_back(raw.radius[i]);
    }
    chain.axis = smooth(own);
    const std::size_t lead = static_cast<std::size_t>(parent_lead_mm / step_mm_);
    const std::vector<Vec3> before(joint - static_cast<std::ptrdiff_t>(std::min(lead, chain.at)), joint + 1);
    chain.axis = centerline::led_out_of(before, chain.axis, smooth_radii_);
    chain.axis.points.front() = *joint;
    ease_kinks(chain.axis);
    trim_hooked_end(chain.axis);
    return chain;
  }

  double smooth_radii_, step_mm_;
  std::map<std::int32_t, std::vector<const SkeletonEdge*>> leaving_;
  std::map<std::int32_t, double> reach_;
};

}  // namespace

MaskAxes axes_of_lines(const centerline::SkeletonGraph& lines, const std::vector<std::int32_t>& roots,
                       double smooth_radii, double step_mm) {
  std::set<std::int32_t> entered;
  for (const SkeletonEdge& edge : lines.edges) entered.insert(edge.to);
  std::vector<std::int32_t> all = roots;
  for (const centerline::SkeletonNode& node : lines.nodes)
    if (node.kind != centerline::SkeletonNodeKind::point && !entered.contains(node.id) &&
        std::find(roots.begin(), roots.end(), node.id) == roots.end())
      all.push_back(node.id);
  Chaining chaining(lines, smooth_radii, step_mm);
  MaskAxes result;
  for (const std::int32_t root : all) {
    const auto [chains, led_on_mm, began] = chaining.chains_of(root);
    if (chains.chains.empty()) continue;
    const auto first = static_cast<std::int32_t>(result.tree.vessels.size()) + 1;
    const centerline::SplitTree split =
        centerline::split_tree(chains, step_mm, std::vector<std::string>(chains.ends.size(), "V"));
    std::int32_t next = first;
    geometry::append_tree(result.tree, split.tree, 1, [&](std::int32_t) { return next++; });
    if (led_on_mm > 0.0) result.led_on.push_back({MaskEndChange::Kind::led_on, began, led_on_mm, first});
    if (result.ostia.size() < roots.size())
      result.ostia.push_back(
          geometry::segment(result.tree, result.tree.vessels.back().segments.front()).from);
  }
  for (geometry::Vessel& vessel : result.tree.vessels) vessel.name = "V" + std::to_string(vessel.id);
  return result;
}

}  // namespace ostia::coronary
