#include "graph/formats.h"
#include "line_tree.h"

#include "ostia/core/error.h"
#include "ostia/geometry/graph_tree.h"
#include "ostia/io/markups_file.h"

#include <algorithm>
#include <map>
#include <set>

namespace ostia::io {
namespace {

using geometry::Vec3;
using geometry::VesselTree;

constexpr double one_place_mm = 1e-6;

FileLine line_of(const Markup& markup, const std::string& what) {
  const std::string name = markup.name.empty() ? "a curve" : "the curve \"" + markup.name + "\"";
  if (markup.radius.size() != markup.points.size())
    throw InvalidInput(what + ": " + name + " has no measurement Radius; centerlines need one at each point");
  FileLine line;
  for (std::size_t i = 0; i < markup.points.size(); ++i) {
    if (i > 0 && (markup.points[i] - line.points.back()).norm() <= one_place_mm) continue;
    line.points.push_back(markup.points[i]);
    line.radius.push_back(markup.radius[i]);
  }
  if (line.points.size() < 2) throw InvalidInput(what + ": " + name + " has one place; a line needs two");
  return line;
}

/// Of each of the segments the first vessel that runs through it, in the tree's order: "LAD/D1".
std::string names_through(const VesselTree& tree, std::set<std::int32_t> segments) {
  std::string names;
  for (const geometry::Vessel& vessel : tree.vessels) {
    const bool first = std::any_of(vessel.segments.begin(), vessel.segments.end(),
                                   [&](std::int32_t id) { return segments.count(id) > 0; });
    if (!first || vessel.name.empty()) continue;
    names += (names.empty() ? "" : "/") + vessel.name;
    for (const std::int32_t id : vessel.segments) segments.erase(id);
  }
  return names;
}

/// The vessels that end with one of the segments.
std::string names_ending(const VesselTree& tree, const std::set<std::int32_t>& segments) {
  std::string names;
  for (const geometry::Vessel& vessel : tree.vessels)
    if (!vessel.segments.empty() && !vessel.name.empty() && segments.count(vessel.segments.back()) > 0)
      names += (names.empty() ? "" : "/") + vessel.name;
  return names;
}

void add_place(Markup& list, const Vec3& place, const std::string& names, const char* what) {
  list.points.push_back(place);
  list.labels.push_back(
      (names.empty() ? std::string(what) + " " + std::to_string(list.points.size()) : names + " " + what));
}

}  // namespace

std::vector<Markup> curves_of(const VesselTree& tree) {
  std::vector<Markup> curves;
  for (const geometry::Vessel& vessel : tree.vessels) {
    const geometry::Centerline axis = geometry::vessel_axis(tree, vessel);
    Markup curve{MarkupKind::curve, vessel.name, axis.points, {}, axis.radius};
    if (curve.name.empty()) curve.name = "vessel_" + std::to_string(vessel.id);
    curves.push_back(std::move(curve));
  }
  return curves;
}

VesselTree tree_of(const std::vector<Markup>& markups, const std::string& what) {
  std::vector<FileLine> lines;
  VesselNames names;
  for (const Markup& markup : markups) {
    if (markup.kind != MarkupKind::curve && markup.kind != MarkupKind::line) continue;
    FileLine line = line_of(markup, what);
    line.vessel = line.group = static_cast<std::int32_t>(lines.size());
    if (!markup.name.empty()) names[line.vessel] = markup.name;
    lines.push_back(std::move(line));
  }
  if (lines.empty()) throw InvalidInput(what + ": it has no curve, and a tree is made of curves");
  return tree_of_lines(lines, names);
}

LoadedGraph read_graph_markups(const std::filesystem::path& path) {
  const MarkupsFile file = read_markups(path);
  LoadedGraph loaded;
  loaded.graph = geometry::graph_of(tree_of(file.markups, "cannot read " + path.string()));
  loaded.reference_name = "branch";
  loaded.warnings = file.warnings;
  return loaded;
}

std::vector<Markup> landmarks_of(const VesselTree& tree) {
  std::map<std::int32_t, std::set<std::int32_t>> leaving, arriving;  // segments, by node
  for (const geometry::TreeSegment& segment : tree.segments) {
    leaving[segment.from].insert(segment.id);
    arriving[segment.to].insert(segment.id);
  }
  Markup ostia{MarkupKind::fiducials, "ostia", {}, {}, {}};
  Markup bifurcations{MarkupKind::fiducials, "bifurcations", {}, {}, {}};
  Markup ends{MarkupKind::fiducials, "ends", {}, {}, {}};
  for (const geometry::TreeNode& node : tree.nodes) {
    const std::set<std::int32_t>& out = leaving[node.id];
    const std::set<std::int32_t>& in = arriving[node.id];
    if (in.empty() && !out.empty()) add_place(ostia, node.position, names_through(tree, out), "ostium");
    if (!in.empty() && out.size() > 1)
      add_place(bifurcations, node.position, names_through(tree, out), "bifurcation");
    if (out.empty() && !in.empty()) add_place(ends, node.position, names_ending(tree, in), "end");
  }
  std::vector<Markup> lists;
  for (Markup* list : {&ostia, &bifurcations, &ends})
    if (!list->points.empty()) lists.push_back(std::move(*list));
  return lists;
}

}  // namespace ostia::io
