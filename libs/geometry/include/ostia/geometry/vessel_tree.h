#pragma once
/// \file A tree of vessels: nodes, segments, named vessels.

#include "ostia/geometry/centerline.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::geometry {

/// A point where axes begin, end or join.
struct TreeNode {
  std::int32_t id = 0;
  Vec3 position = Vec3::Zero();
};

/// An edge between two nodes; owns axis and radius. The axis runs from `from` (proximal) to `to` (distal).
struct TreeSegment {
  std::int32_t id = 0;
  std::int32_t from = 0, to = 0;  ///< node ids
  Centerline axis;
};

/// A named path of segments from a root to an end, or to where another vessel goes on.
struct Vessel {
  std::int32_t id = 0;
  std::string name;
  std::vector<std::int32_t> segments;  ///< segment ids, proximal first
};

/// Ids are stable and never used again; they are not indices.
struct VesselTree {
  std::vector<TreeNode> nodes;
  std::vector<TreeSegment> segments;
  std::vector<Vessel> vessels;
};

const TreeNode& node(const VesselTree& tree, std::int32_t id);        ///< throws InvalidInput
const TreeSegment& segment(const VesselTree& tree, std::int32_t id);  ///< throws InvalidInput
/// The axis of a whole vessel: its segments joined, shared end points once, abscissa and frames from the
/// root.
Centerline vessel_axis(const VesselTree& tree, const Vessel& vessel);
std::vector<std::int32_t> roots(const VesselTree& tree);  ///< nodes without a parent segment
std::vector<std::int32_t> ends(const VesselTree& tree);   ///< nodes without a child segment
/// What is wrong with the tree (repeated or unknown ids, loops, a node with two parents, a vessel whose
/// segments do not join, that does not begin at a root, or that ends within the tree where no vessel goes on,
/// axes that are incomplete or miss their nodes by 1e-3 mm); nothing if sound.
std::optional<std::string> find_fault(const VesselTree& tree);

}  // namespace ostia::geometry
