#include "line_tree.h"

#include "surface_formats.h"

#include "ostia/geometry/graph_repair.h"
#include "ostia/geometry/graph_tree.h"
#include "ostia/geometry/kd_tree.h"

#include <optional>
#include <set>
#include <utility>

namespace ostia::io {
namespace {

using geometry::Vec3;
using geometry::Vessel;
using geometry::VesselGraph;
using geometry::VesselTree;

constexpr double same_place_mm = 1e-6;

std::int32_t node_at(VesselTree& tree, const Vec3& position) {
  for (const geometry::TreeNode& known : tree.nodes) {
    if ((known.position - position).norm() <= same_place_mm) return known.id;
  }
  tree.nodes.push_back({static_cast<std::int32_t>(tree.nodes.size()), position});
  return tree.nodes.back().id;
}

std::string numbered_name(std::size_t vessels_before) {
  return "vessel_" + std::to_string(vessels_before + 1);
}

VesselGraph graph_of_lines(const std::vector<FileLine>& lines) {
  VesselGraph graph;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const FileLine& line = lines[l];
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      graph.points.push_back(line.points[i]);
      if (i == 0) continue;
      const auto here = static_cast<std::int32_t>(graph.points.size()) - 1;
      graph.edges.push_back({here - 1, here, line.radius[i - 1], line.radius[i]});
      graph.references.push_back(static_cast<std::int64_t>(l));
    }
  }
  return graph;
}

/// Nothing where it is no tree, nor several.
std::optional<VesselTree> sound_tree_of(VesselGraph graph, double within_mm) {
  geometry::GraphRepairOptions how;
  how.merge_within_mm = within_mm;
  geometry::RepairedGraph joined = geometry::repaired(std::move(graph), how);
  if (!joined.left.sound_trees()) return std::nullopt;
  return geometry::tree_of(joined.graph);
}

/// The vessels that a line runs to the end of come in the lines' order, with their names; then the others.
void name_by_lines(const std::vector<FileLine>& lines, const VesselNames& names, VesselTree& tree) {
  std::vector<Vessel> found = std::exchange(tree.vessels, {});
  std::vector<Vec3> ends;
  for (const Vessel& vessel : found)
    ends.push_back(geometry::segment(tree, vessel.segments.back()).axis.points.back());
  const geometry::KdTree places(ends);
  std::vector<bool> taken(found.size(), false);
  const auto take = [&](std::size_t v, std::string name) {
    taken[v] = true;
    tree.vessels.push_back(
        {static_cast<std::int32_t>(tree.vessels.size()), std::move(name), std::move(found[v].segments)});
  };
  const auto take_end = [&](const Vec3& place, const FileLine& line) {
    for (const std::int32_t near : places.within(place, same_place_mm)) {
      const auto v = static_cast<std::size_t>(near);
      if (taken[v]) continue;
      const auto name = names.find(line.vessel);
      take(v, name != names.end() ? name->second : numbered_name(tree.vessels.size()));
      return true;
    }
    return false;
  };
  for (const FileLine& line : lines)
    if (!take_end(line.points.back(), line)) take_end(line.points.front(), line);
  for (std::size_t v = 0; v < found.size(); ++v)
    if (!taken[v]) take(v, numbered_name(tree.vessels.size()));
}

}  // namespace

VesselTree tree_of_groups(const std::vector<FileLine>& lines, const VesselNames& names) {
  VesselTree tree;
  std::set<std::int32_t> groups;
  std::map<std::int32_t, std::size_t> vessels;
  for (const FileLine& line : lines) {
    if (groups.insert(line.group).second) {
      geometry::TreeSegment segment;
      segment.id = line.group;
      segment.axis.points = line.points;
      segment.axis.radius = line.radius;
      segment.from = node_at(tree, line.points.front());
      segment.to = node_at(tree, line.points.back());
      geometry::complete(segment.axis);
      tree.segments.push_back(std::move(segment));
    }
    const auto [found, added] = vessels.try_emplace(line.vessel, tree.vessels.size());
    if (added) {
      const auto name = names.find(line.vessel);
      tree.vessels.push_back(
          {line.vessel, name != names.end() ? name->second : numbered_name(tree.vessels.size()), {}});
    }
    tree.vessels[found->second].segments.push_back(line.group);
  }
  return tree;
}

VesselTree tree_of_lines(const std::vector<FileLine>& lines, const VesselNames& names) {
  std::optional<VesselTree> joined = sound_tree_of(graph_of_lines(lines), same_place_mm);
  if (!joined) return tree_of_groups(lines, names);
  name_by_lines(lines, names, *joined);
  return std::move(*joined);
}

VesselTree tree_of_network(VesselGraph graph, const std::filesystem::path& path) {
  std::optional<VesselTree> tree = sound_tree_of(std::move(graph), 0.0);
  if (!tree)
    refuse(path,
           "its network is no tree: it has loops, points of several parents, or segments without a radius; "
           "`ostia info` counts them");
  return std::move(*tree);
}

}  // namespace ostia::io
