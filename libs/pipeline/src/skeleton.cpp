#include "ostia/pipeline/skeleton.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <iomanip>
#include <locale>
#include <sstream>

namespace ostia::pipeline {
namespace {

using centerline::MeasuredSkeleton;
using centerline::SkeletonEdge;
using centerline::SkeletonGraph;
using geometry::Vec3;

std::string places(const std::vector<std::int32_t>& nodes, const SkeletonGraph& graph) {
  std::string text;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3& at = centerline::node(graph, nodes[i]).position;
    text += (i == 0 ? "" : "; ") + core::fixed_text(at.x(), 1) + "," + core::fixed_text(at.y(), 1) + "," +
            core::fixed_text(at.z(), 1);
  }
  return text;
}

std::vector<std::string> warnings_of(const SkeletonResult& result, const centerline::Thinned& thin,
                                     const centerline::OrientedSkeleton& directed) {
  std::vector<std::string> warnings;
  if (thin.filled_cavity_voxels > 0)
    warnings.push_back(std::to_string(thin.filled_cavity_voxels) +
                       " voxels of cavities inside the object were filled");
  if (!directed.guessed.empty())
    warnings.push_back("no inlet was given for " + std::to_string(directed.guessed.size()) +
                       " part(s); the flow begins at their widest ends, " +
                       places(directed.guessed, directed.graph) + " mm (LPS)");
  if (!result.tree.opened_edges.empty())
    warnings.push_back(std::to_string(result.tree.opened_edges.size()) +
                       " loop(s) were opened, since a tree has none");
  if (result.skeleton.interpolated > 0)
    warnings.push_back("at " + std::to_string(result.skeleton.interpolated) +
                       " points, as at junctions, no wall was found about the line; radii there are "
                       "interpolated");
  return warnings;
}

SkeletonGraph commanded(SkeletonGraph graph, const SkeletonCommands& commands) {
  for (const Vec3& place : commands.cuts) graph = centerline::cut(graph, place);
  for (const Vec3& place : commands.removals)
    graph = centerline::removed(graph, centerline::edge_at(graph, place));
  for (const auto& [from, to] : commands.connections) graph = centerline::connected(graph, from, to);
  if (graph.edges.empty()) throw InvalidInput("remove: no line would be left");
  return graph;
}

}  // namespace

void validate(const SkeletonOptions& options) {
  validate(options.prune);
  validate(options.ends);
  validate(options.gaps);
  validate(options.orient);
  if (options.smooth) validate(*options.smooth);
  if (options.settle) validate(*options.settle);
  validate(options.sections);
  if (!(options.step_mm > 0.0 && options.step_mm <= 10.0))
    throw InvalidInput("the step between a skeleton's points must be above 0 and at most 10 mm");
}

SkeletonResult skeleton_of(const imaging::MaskVolume& mask, const imaging::ImageVolume* image,
                           const SkeletonOptions& options, const core::TaskContext& task) {
  validate(options);
  task.set_stage("thinning");
  const centerline::Thinned thin = centerline::thinned(
      mask, {.keep_ends = true, .fill_cavities = options.fill_cavities}, task.sub(0.0, 0.4));
  if (thin.voxels.empty()) throw InvalidInput("the mask has no object: all its voxels are 0");
  task.set_stage("lines");
  SkeletonGraph graph = centerline::skeleton_graph(thin, task.sub(0.4, 0.5));
  graph = centerline::pruned(graph, options.prune);
  if (options.open_loops) graph = centerline::pruned(centerline::loops_opened(graph), options.prune);
  if (graph.edges.empty())
    throw InvalidInput("nothing of the skeleton is longer than " + std::to_string(options.prune.length_mm) +
                       " mm; prune less");
  graph = centerline::gaps_closed(centerline::ends_extended(graph, mask, options.ends), options.gaps);
  graph = commanded(std::move(graph), options.commands);
  const centerline::OrientedSkeleton directed = centerline::oriented(graph, options.inlets, options.orient);
  task.throw_if_cancelled();
  const auto smooth = [&](const SkeletonGraph& lines) {
    return options.smooth ? centerline::smoothed(lines, *options.smooth) : lines;
  };
  const auto sections = [&](const SkeletonGraph& lines, const centerline::SectionOptions& how,
                            const core::TaskContext& part) {
    return image ? centerline::measured(lines, *image, how, part)
                 : centerline::measured(lines, mask, how, part);
  };
  task.set_stage("sections");
  SkeletonResult result;
  result.skeleton = sections(smooth(directed.graph), options.sections, task.sub(0.5, 0.7));
  if (options.settle) {
    SkeletonGraph lines = centerline::junctions_settled(result.skeleton.graph, *options.settle);
    lines = centerline::ends_extended(lines, mask, options.ends);
    centerline::SectionOptions how = options.sections;
    how.move_points = !options.smooth;
    result.skeleton = sections(smooth(lines), how, task.sub(0.7, 0.95));
  }
  result.tree = centerline::vessel_tree(result.skeleton.graph, options.step_mm);
  result.object_voxels = thin.object_voxels;
  result.skeleton_voxels = static_cast<std::int64_t>(thin.voxels.size());
  result.components = centerline::component_count(result.skeleton.graph);
  result.loops = centerline::loop_count(result.skeleton.graph);
  for (const SkeletonEdge& edge : result.skeleton.graph.edges)
    result.length_mm += centerline::length_mm(edge);
  result.warnings = warnings_of(result, thin, directed);
  task.set_progress(1.0);
  return result;
}

std::string sections_csv(const MeasuredSkeleton& skeleton) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed << std::setprecision(4)
      << "edge,point,x_mm,y_mm,z_mm,normal_x,normal_y,normal_z,radius_mm,semi_major_mm,semi_minor_mm,"
         "major_x,major_y,major_z,support,measured\n";
  const auto write = [&](const Vec3& v) { out << v.x() << ',' << v.y() << ',' << v.z() << ','; };
  for (std::size_t e = 0; e < skeleton.sections.size(); ++e)
    for (std::size_t i = 0; i < skeleton.sections[e].size(); ++i) {
      const centerline::SkeletonSection& one = skeleton.sections[e][i];
      out << skeleton.graph.edges[e].id << ',' << i << ',';
      write(one.centre);
      write(one.normal);
      out << one.radius_mm << ',' << one.semi_major_mm << ',' << one.semi_minor_mm << ',';
      write(one.major_axis);
      out << one.support << ',' << (one.measured ? 1 : 0) << '\n';
    }
  return out.str();
}

}  // namespace ostia::pipeline
