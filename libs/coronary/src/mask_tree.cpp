#include "ostia/coronary/mask_tree.h"

#include "line_graph.h"
#include "mask_axes.h"
#include "mask_bridges.h"
#include "mask_ends.h"
#include "mask_ostia.h"
#include "mask_parting.h"
#include "mask_parts.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/centerline/skeleton_radius.h"
#include "ostia/centerline/thinning.h"
#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace ostia::coronary {
namespace {

using centerline::SkeletonGraph;

constexpr double first_prune_mm = 1.5;  // the skeleton's own bristles
constexpr double largest_section_mm = 8.0;
constexpr double beside_bridge_mm = 2.0, beside_cut_mm = 6.0;

void check_range(double value, double least, double most, const char* name, const char* unit) {
  if (value >= least && value <= most) return;
  throw InvalidInput(std::string("tree of a mask: ") + name + " is " + core::shortest_text(value) +
                     "; it must be in [" + core::shortest_text(least) + ", " + core::shortest_text(most) +
                     "]" + unit);
}

/// Lines of noise close circle after circle; to part them all would take hours.
void refuse_sponge(const SkeletonGraph& skeleton) {
  constexpr std::size_t most_circles = 300;  // where vessels of a mask touch: a few
  if (skeleton.edges.size() < skeleton.nodes.size() + most_circles) return;
  throw GeometryError("the mask is a sponge, as noise is: its middle lines close " +
                      std::to_string(skeleton.edges.size() - skeleton.nodes.size()) +
                      " circles or more, where those of vessels that touch close a few; take a higher "
                      "threshold for it, or smooth it: `ostia filter MASK -o OUT.nrrd --with "
                      "median:radius_mm=1`");
}

/// Lines as splines. Where a line's points are too few for one, it swings out far from them: that line stays
/// as it is.
SkeletonGraph gently_smoothed(const SkeletonGraph& lines) {
  constexpr double most_off_mm = 2.5;
  SkeletonGraph result = centerline::smoothed(lines);
  for (centerline::SkeletonEdge& edge : result.edges) {
    const auto before = std::find_if(lines.edges.begin(), lines.edges.end(),
                                     [&](const centerline::SkeletonEdge& e) { return e.id == edge.id; });
    const auto swings_out = [&](const Vec3& p) {
      return (geometry::closest(before->points, p).point - p).norm() > most_off_mm;
    };
    if (before == lines.edges.end() || std::none_of(edge.points.begin(), edge.points.end(), swings_out))
      continue;
    edge.points = before->points;
    edge.radius_mm = before->radius_mm;
  }
  return result;
}

/// Directed from the roots, and in the middle of the lumen; as docs/methods/skeleton.md has it.
SkeletonGraph centred_lines(const SkeletonGraph& graph, const std::vector<std::int32_t>& roots,
                            const imaging::MaskVolume& lumen, const core::TaskContext& task) {
  SkeletonGraph lines = centerline::ends_extended(graph, lumen);
  std::vector<Vec3> inlets;
  for (const std::int32_t root : roots) inlets.push_back(centerline::node(lines, root).position);
  lines = centerline::oriented(lines, inlets).graph;
  centerline::SectionOptions sections;
  sections.largest_radius_mm = largest_section_mm;
  return centerline::measured(gently_smoothed(lines), lumen, sections, task).graph;
}

/// Short lines at bends where neither an ostium nor a bridge turned out to be.
void remove_unused(LineGraph& graph, const std::vector<std::int32_t>& stubs,
                   const std::vector<std::int32_t>& roots) {
  for (const std::int32_t id : stubs) {
    const auto found = graph.lines().find(id);
    if (found == graph.lines().end()) continue;  // a bridge goes on from it
    const std::int32_t end = found->second.to;
    if (graph.degree(end) == 1 && std::find(roots.begin(), roots.end(), end) == roots.end())
      graph.remove_line(id);
  }
  graph.tidy({roots.begin(), roots.end()});
}

/// The part of a tree that hangs on some of its roots.
geometry::VesselTree hanging_on(const geometry::VesselTree& tree, const std::set<std::int32_t>& roots,
                                bool on_them) {
  std::map<std::int32_t, std::int32_t> up;
  for (const geometry::TreeSegment& segment : tree.segments) up[segment.to] = segment.from;
  const auto taken = [&](std::int32_t node) {
    for (auto at = up.find(node); at != up.end(); at = up.find(node)) node = at->second;
    return roots.contains(node) == on_them;
  };
  geometry::VesselTree part;
  for (const geometry::TreeNode& node : tree.nodes)
    if (taken(node.id)) part.nodes.push_back(node);
  std::set<std::int32_t> segments;
  for (const geometry::TreeSegment& segment : tree.segments)
    if (taken(segment.from)) {
      part.segments.push_back(segment);
      segments.insert(segment.id);
    }
  for (const geometry::Vessel& vessel : tree.vessels)
    if (segments.contains(vessel.segments.front())) part.vessels.push_back(vessel);
  return part;
}

/// Names by course of what hangs on the ostia; what joined neither tree would lead the rules astray.
LabelledTree named_tree(const geometry::VesselTree& tree, const std::vector<std::int32_t>& roots,
                        const LabelOptions& options) {
  const std::set<std::int32_t> ostia(roots.begin(), roots.end());
  LabelledTree result = label_branches(hanging_on(tree, ostia, true), options);
  const geometry::VesselTree rest = hanging_on(tree, ostia, false);
  auto unnamed = static_cast<int>(
      std::count_if(result.tree.vessels.begin(), result.tree.vessels.end(),
                    [](const geometry::Vessel& vessel) { return vessel.name.front() == 'V'; }));
  result.tree.nodes.insert(result.tree.nodes.end(), rest.nodes.begin(), rest.nodes.end());
  result.tree.segments.insert(result.tree.segments.end(), rest.segments.begin(), rest.segments.end());
  for (geometry::Vessel vessel : rest.vessels) {
    vessel.name = "V" + std::to_string(++unnamed);
    VesselLabel nameless;
    nameless.vessel = vessel.id;
    result.labels.push_back(std::move(nameless));
    result.tree.vessels.push_back(std::move(vessel));
  }
  return result;
}

/// Points of the segments that no vessel before owns.
std::vector<Vec3> own_points(const geometry::VesselTree& tree, std::size_t index,
                             std::set<std::int32_t>& owned) {
  std::vector<Vec3> points;
  for (const std::int32_t id : tree.vessels[index].segments) {
    if (!owned.insert(id).second) continue;
    const geometry::Centerline& axis = geometry::segment(tree, id).axis;
    points.insert(points.end(), axis.points.begin(), axis.points.end());
  }
  return points;
}

double nearest_mm(const std::vector<Vec3>& points, const Vec3& place) {
  double nearest = 1e9;
  for (const Vec3& point : points) nearest = std::min(nearest, (point - place).norm());
  return nearest;
}

std::string bridge_in_words(const MaskBridge& bridge) {
  return "a gap of " + core::rounded_text(bridge.length_mm(), 1) + " mm was bridged at " +
         place_in_words(0.5 * (bridge.from + bridge.to)) + ", probability " +
         core::rounded_text(100.0 * bridge.probability, 0) + " %" +
         (bridge.to_side ? ", to the side of a vessel" : "");
}

void add_notes(MaskTree& result, const std::set<std::int32_t>& ostia) {
  const geometry::VesselTree& tree = result.vessels.tree;
  std::set<std::int32_t> owned;
  for (std::size_t i = 0; i < tree.vessels.size(); ++i) {
    AxisNotes notes{tree.vessels[i].id, 1.0, {}};
    const std::vector<Vec3> own = own_points(tree, i, owned);
    for (const MaskBridge& bridge : result.bridges) {
      if (nearest_mm(own, 0.5 * (bridge.from + bridge.to)) > beside_bridge_mm) continue;
      notes.evidence = std::min(notes.evidence, bridge.probability);
      notes.warnings.push_back(bridge_in_words(bridge));
    }
    for (const MaskCut& cut : result.cuts)
      if (nearest_mm(own, cut.place) < beside_cut_mm)
        notes.warnings.push_back("it touched another vessel at " + place_in_words(cut.place) +
                                 ", where they were parted");
    if (!ostia.contains(geometry::segment(tree, tree.vessels[i].segments.front()).from)) {
      notes.evidence = 0.0;
      notes.warnings.emplace_back("it is joined to neither coronary tree");
    }
    result.notes.push_back(std::move(notes));
  }
}

std::string end_in_words(const MaskEndChange& end, const geometry::VesselTree& tree) {
  const std::string mm = core::rounded_text(end.length_mm, 1) + " mm", at = place_in_words(end.place);
  const auto vessel = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                   [&](const geometry::Vessel& v) { return v.id == end.vessel; });
  const std::string name = vessel == tree.vessels.end() ? "a vessel" : vessel->name;
  if (end.kind == MaskEndChange::Kind::left_out)
    return "a stub of " + mm + " at " + at +
           " was left out: it ends within reach of the vessel that it comes from, and no plane can cut it";
  if (end.kind == MaskEndChange::Kind::shortened)
    return name + " was shortened by " + mm + " at " + at + ", where its end touches another vessel";
  return name + " begins " + mm + " before the mask does, at " + at + ": a branch leaves right at its ostium";
}

void tell_mask(MaskTree& result, const MaskOstia& found, std::size_t trees) {
  for (const MaskBridge& bridge : result.bridges) result.warnings.push_back(bridge_in_words(bridge));
  for (const MaskCut& cut : result.cuts)
    result.warnings.push_back("vessels that touch were parted at " + place_in_words(cut.place));
  for (const MaskEndChange& end : result.ends)
    result.warnings.push_back(end_in_words(end, result.vessels.tree));
  if (!found.right)
    result.warnings.push_back("one coronary tree alone was found; its ostium is taken to be at " +
                              place_in_words(result.ostia.front()));
  if (found.right && found.doubt_sigma > 2.5)
    result.warnings.emplace_back(
        "the two ostia lie otherwise to each other than they usually do: look whether the vessels begin "
        "where they should, and whether the mask is in LPS or mirrored");
  if (trees > result.ostia.size()) {
    const std::size_t more = trees - result.ostia.size();
    result.warnings.push_back(std::to_string(more) + (more == 1 ? " part is" : " parts are") +
                              " joined to neither coronary tree; connect by hand what belongs to one");
  }
  for (const std::string& warning : result.vessels.warnings) result.warnings.push_back(warning);
}

}  // namespace

void validate(const MaskTreeOptions& o) {
  check_range(o.thick_mm, 3.0, 15.0, "thick_mm", " mm");
  check_range(o.speck_mm, 0.0, 50.0, "speck_mm", " mm");
  check_range(o.least_branch_mm, 0.5, 50.0, "least_branch_mm", " mm");
  check_range(o.longest_gap_mm, 0.0, 50.0, "longest_gap_mm", " mm");
  check_range(o.least_probability, 0.0, 1.0, "least_probability", "");
  check_range(o.smooth_radii, 0.0, 50.0, "smooth_radii", " radii");
  check_range(o.step_mm, 0.1, 2.0, "step_mm", " mm");
  validate(o.labels);
}

MaskTree mask_tree(const imaging::MaskVolume& labels, const MaskTreeOptions& options,
                   const core::TaskContext& task) {
  validate(options);
  task.set_stage("what of the mask is vessel");
  MaskParts parts = parts_of_mask(labels, options, task);
  MaskTree result;
  result.lumen = std::move(parts.lumen);
  result.warnings = std::move(parts.warnings);
  task.set_stage("thinning");
  const centerline::Thinned thin =
      centerline::thinned(result.lumen, {.keep_ends = true, .fill_cavities = true}, task.sub(0.1, 0.4));
  const SkeletonGraph skeleton = centerline::skeleton_graph(thin, task.sub(0.4, 0.45));
  refuse_sponge(skeleton);
  LineGraph graph(skeleton);
  prune_lines(graph, {}, first_prune_mm, options.speck_mm);
  graph = LineGraph(centerline::ends_extended(graph.graph(), result.lumen));
  task.set_stage("ostia, gaps and what touches");
  const std::vector<std::int32_t> stubs = add_ends_at_bends(graph, result.lumen);
  const MaskOstia found = ostia_of_lines(graph, parts.contacts);
  if (!found.left)
    throw GeometryError("the mask holds no line longer than " + core::rounded_text(options.speck_mm, 0) +
                        " mm, and so no vessel; look whether the right label was exported");
  std::vector<std::int32_t> roots{*found.left};
  if (found.right) roots.push_back(*found.right);
  result.bridges = bridge_gaps(graph, roots, options);
  remove_unused(graph, stubs, roots);
  result.cuts = part_touching(graph, roots, result.lumen);
  prune_lines(graph, roots, options.least_branch_mm, options.speck_mm);
  task.set_stage("centring the vessels");
  const SkeletonGraph lines = centred_lines(graph.graph(), roots, result.lumen, task.sub(0.45, 0.95));
  MaskAxes axes = axes_of_lines(lines, roots, options.smooth_radii, options.step_mm);
  result.ends = settle_ends(axes);
  task.set_stage("naming the vessels");
  result.vessels = named_tree(axes.tree, axes.ostia, options.labels);
  for (const std::int32_t root : axes.ostia)
    result.ostia.push_back(geometry::node(result.vessels.tree, root).position);
  add_notes(result, {axes.ostia.begin(), axes.ostia.end()});
  tell_mask(result, found, geometry::roots(axes.tree).size());
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::coronary
