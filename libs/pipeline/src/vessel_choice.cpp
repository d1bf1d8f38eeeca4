#include "ostia/pipeline/vessel_choice.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <map>
#include <set>

namespace ostia::pipeline {
namespace {

using geometry::Vessel;
using geometry::VesselTree;

/// The vessel whose wall each segment has: the first that passes through it.
std::map<std::int32_t, std::int32_t> owners(const VesselTree& tree) {
  std::map<std::int32_t, std::int32_t> owner;
  for (const Vessel& vessel : tree.vessels)
    for (const std::int32_t id : vessel.segments) owner.emplace(id, vessel.id);
  return owner;
}

const Vessel& vessel_of(const VesselTree& tree, std::int32_t id) {
  const auto found =
      std::find_if(tree.vessels.begin(), tree.vessels.end(), [&](const Vessel& v) { return v.id == id; });
  if (found == tree.vessels.end())
    throw InvalidInput("vessel " + std::to_string(id) + " is chosen, and the model has no such vessel");
  return *found;
}

VesselTree pruned(const VesselTree& tree, const std::set<std::int32_t>& vessels) {
  std::set<std::int32_t> segments, nodes;
  VesselTree part;
  for (const Vessel& vessel : tree.vessels) {
    if (!vessels.contains(vessel.id)) continue;
    part.vessels.push_back(vessel);
    segments.insert(vessel.segments.begin(), vessel.segments.end());
  }
  for (const geometry::TreeSegment& segment : tree.segments) {
    if (!segments.contains(segment.id)) continue;
    part.segments.push_back(segment);
    nodes.insert({segment.from, segment.to});
  }
  for (const geometry::TreeNode& node : tree.nodes)
    if (nodes.contains(node.id)) part.nodes.push_back(node);
  return part;
}

}  // namespace

std::vector<std::int32_t> with_parents(const VesselTree& tree, const std::vector<std::int32_t>& vessels) {
  if (vessels.empty()) throw InvalidInput("no vessel is chosen; choose at least one");
  const auto owner = owners(tree);
  std::set<std::int32_t> needed;
  std::vector<std::int32_t> open = vessels;
  while (!open.empty()) {
    const std::int32_t id = open.back();
    open.pop_back();
    const Vessel& vessel = vessel_of(tree, id);
    if (!needed.insert(id).second) continue;
    for (const std::int32_t segment : vessel.segments) open.push_back(owner.at(segment));
  }
  std::vector<std::int32_t> ordered;
  for (const Vessel& vessel : tree.vessels)
    if (needed.contains(vessel.id)) ordered.push_back(vessel.id);
  return ordered;
}

lumen::LumenModel part_of(const lumen::LumenModel& model, const std::vector<std::int32_t>& vessels) {
  const std::vector<std::int32_t> ids = with_parents(model.tree, vessels);
  const std::set<std::int32_t> kept(ids.begin(), ids.end());
  lumen::LumenModel part;
  part.tree = pruned(model.tree, kept);
  for (const auto& vessel : model.vessels)
    if (kept.contains(vessel->vessel)) part.vessels.push_back(vessel);
  part.blend = model.blend;
  part.next_sample_id = model.next_sample_id;
  part.next_tree_id = model.next_tree_id;
  return part;
}

std::vector<RootedModel> rooted_parts(const lumen::LumenModel& model) {
  if (model.tree.vessels.empty()) throw InvalidInput("the model has no vessel");
  std::vector<std::pair<std::int32_t, std::vector<std::int32_t>>> by_root;
  for (const Vessel& vessel : model.tree.vessels) {
    const std::int32_t root = geometry::segment(model.tree, vessel.segments.front()).from;
    auto found =
        std::find_if(by_root.begin(), by_root.end(), [&](const auto& one) { return one.first == root; });
    if (found == by_root.end()) found = by_root.insert(by_root.end(), {root, {}});
    found->second.push_back(vessel.id);
  }
  std::vector<RootedModel> parts;
  for (const auto& [root, vessels] : by_root) {
    lumen::LumenModel part = part_of(model, vessels);
    std::string name = part.tree.vessels.front().name;
    parts.push_back({std::move(name), std::move(part)});
  }
  return parts;
}

}  // namespace ostia::pipeline
