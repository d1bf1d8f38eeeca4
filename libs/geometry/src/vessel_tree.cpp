#include "ostia/geometry/vessel_tree.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace ostia::geometry {
namespace {

// An axis may miss its node by no more than files in single precision make it miss.
constexpr double node_tolerance_mm = 1e-3;

template <class Item>
const Item& find(const std::vector<Item>& items, std::int32_t id, const char* what) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.id == id; });
  if (found == items.end()) {
    throw InvalidInput("the vessel tree has no " + std::string(what) + " " + std::to_string(id));
  }
  return *found;
}

template <class Item>
std::optional<std::string> repeated_id(const std::vector<Item>& items, const char* what) {
  std::unordered_set<std::int32_t> seen;
  for (const Item& item : items) {
    if (!seen.insert(item.id).second)
      return "two " + std::string(what) + "s have the id " + std::to_string(item.id);
  }
  return std::nullopt;
}

std::optional<std::string> axis_fault(const VesselTree& tree, const TreeSegment& segment) {
  const std::string name = "segment " + std::to_string(segment.id);
  const Centerline& axis = segment.axis;
  if (axis.size() < 2) return name + " has an axis of fewer than two points";
  if (axis.radius.size() != axis.size() || axis.abscissa.size() != axis.size() ||
      axis.frames.size() != axis.size()) {
    return name + " has an axis whose points, radii, abscissas and frames differ in number";
  }
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (!axis.points[i].allFinite() || !std::isfinite(axis.radius[i])) {
      return name + " has an axis that is not finite at point " + std::to_string(i);
    }
    if (axis.radius[i] < 0.0) return name + " has a negative radius at point " + std::to_string(i);
    if (i > 0 && !(axis.abscissa[i] > axis.abscissa[i - 1])) {
      return name + " has abscissas that do not increase at point " + std::to_string(i);
    }
  }
  const auto misses = [&](const Vec3& point, std::int32_t id) {
    return !((point - node(tree, id).position).norm() <= node_tolerance_mm);
  };
  if (misses(axis.points.front(), segment.from)) {
    return "the axis of " + name + " does not begin at its node " + std::to_string(segment.from);
  }
  if (misses(axis.points.back(), segment.to)) {
    return "the axis of " + name + " does not end at its node " + std::to_string(segment.to);
  }
  return std::nullopt;
}

using ParentOf = std::unordered_map<std::int32_t, const TreeSegment*>;

std::optional<std::string> link_fault(const VesselTree& tree, const TreeSegment& segment,
                                      const std::unordered_set<std::int32_t>& nodes, ParentOf& parent) {
  for (const std::int32_t id : {segment.from, segment.to}) {
    if (!nodes.count(id))
      return "segment " + std::to_string(segment.id) + " names an unknown node " + std::to_string(id);
  }
  if (segment.from == segment.to) return "segment " + std::to_string(segment.id) + " returns to its own node";
  const auto [other, first] = parent.emplace(segment.to, &segment);
  if (!first) {
    return "segments " + std::to_string(other->second->id) + " and " + std::to_string(segment.id) +
           " both lead to node " + std::to_string(segment.to);
  }
  return axis_fault(tree, segment);
}

std::optional<std::string> loop_fault(const VesselTree& tree, const ParentOf& parent) {
  for (const TreeSegment& start : tree.segments) {
    std::size_t steps = 0;
    for (auto up = parent.find(start.from); up != parent.end(); up = parent.find(up->second->from)) {
      if (++steps > tree.segments.size()) return "segment " + std::to_string(start.id) + " hangs on a loop";
    }
  }
  return std::nullopt;
}

/// Whether another vessel runs the whole way of this one and on.
bool goes_on(const VesselTree& tree, const Vessel& vessel) {
  return std::any_of(tree.vessels.begin(), tree.vessels.end(), [&](const Vessel& other) {
    return other.segments.size() > vessel.segments.size() &&
           std::equal(vessel.segments.begin(), vessel.segments.end(), other.segments.begin());
  });
}

std::optional<std::string> vessel_fault(const VesselTree& tree, const Vessel& vessel,
                                        const std::unordered_set<std::int32_t>& segments,
                                        const ParentOf& parent) {
  const std::string name = "vessel " + std::to_string(vessel.id) + " (" + vessel.name + ")";
  if (vessel.segments.empty()) return name + " has no segments";
  for (const std::int32_t id : vessel.segments) {
    if (!segments.count(id)) return name + " names an unknown segment " + std::to_string(id);
  }
  for (std::size_t i = 1; i < vessel.segments.size(); ++i) {
    if (segment(tree, vessel.segments[i - 1]).to != segment(tree, vessel.segments[i]).from) {
      return name + " has segments " + std::to_string(vessel.segments[i - 1]) + " and " +
             std::to_string(vessel.segments[i]) + " that do not join";
    }
  }
  if (parent.count(segment(tree, vessel.segments.front()).from)) return name + " does not begin at a root";
  const std::int32_t last = segment(tree, vessel.segments.back()).to;
  const bool at_end = std::none_of(tree.segments.begin(), tree.segments.end(),
                                   [&](const TreeSegment& s) { return s.from == last; });
  if (at_end || goes_on(tree, vessel)) return std::nullopt;
  return name + " does not run to an end of the tree";
}

}  // namespace

const TreeNode& node(const VesselTree& tree, std::int32_t id) {
  return find(tree.nodes, id, "node");
}

const TreeSegment& segment(const VesselTree& tree, std::int32_t id) {
  return find(tree.segments, id, "segment");
}

Centerline vessel_axis(const VesselTree& tree, const Vessel& vessel) {
  if (vessel.segments.empty()) {
    throw InvalidInput("vessel " + std::to_string(vessel.id) + " (" + vessel.name + ") has no segments");
  }
  Centerline line;
  Vec3 first_normal = Vec3::Zero();
  for (const std::int32_t id : vessel.segments) {
    const Centerline& axis = segment(tree, id).axis;
    if (axis.radius.size() != axis.size()) {
      throw InvalidInput("segment " + std::to_string(id) + " has " + std::to_string(axis.size()) +
                         " points and " + std::to_string(axis.radius.size()) + " radii; give one a point");
    }
    if (axis.size() == 0) continue;
    if (line.points.empty() && !axis.frames.empty()) first_normal = axis.frames.front().normal;
    const bool shared =
        !line.points.empty() && (line.points.back() - axis.points.front()).norm() <= node_tolerance_mm;
    line.points.insert(line.points.end(), axis.points.begin() + (shared ? 1 : 0), axis.points.end());
    line.radius.insert(line.radius.end(), axis.radius.begin() + (shared ? 1 : 0), axis.radius.end());
  }
  complete(line, first_normal);
  return line;
}

std::vector<std::int32_t> roots(const VesselTree& tree) {
  std::unordered_set<std::int32_t> below;
  for (const TreeSegment& s : tree.segments) below.insert(s.to);
  std::vector<std::int32_t> result;
  for (const TreeNode& n : tree.nodes) {
    if (!below.count(n.id)) result.push_back(n.id);
  }
  return result;
}

std::vector<std::int32_t> ends(const VesselTree& tree) {
  std::unordered_set<std::int32_t> above;
  for (const TreeSegment& s : tree.segments) above.insert(s.from);
  std::vector<std::int32_t> result;
  for (const TreeNode& n : tree.nodes) {
    if (!above.count(n.id)) result.push_back(n.id);
  }
  return result;
}

std::optional<std::string> find_fault(const VesselTree& tree) {
  if (auto fault = repeated_id(tree.nodes, "node")) return fault;
  if (auto fault = repeated_id(tree.segments, "segment")) return fault;
  if (auto fault = repeated_id(tree.vessels, "vessel")) return fault;
  std::unordered_set<std::int32_t> nodes, segments;
  for (const TreeNode& n : tree.nodes) {
    if (!n.position.allFinite()) return "node " + std::to_string(n.id) + " has a position that is not finite";
    nodes.insert(n.id);
  }
  ParentOf parent;
  for (const TreeSegment& s : tree.segments) {
    segments.insert(s.id);
    if (auto fault = link_fault(tree, s, nodes, parent)) return fault;
  }
  if (auto fault = loop_fault(tree, parent)) return fault;
  for (const Vessel& v : tree.vessels) {
    if (auto fault = vessel_fault(tree, v, segments, parent)) return fault;
  }
  return std::nullopt;
}

}  // namespace ostia::geometry
