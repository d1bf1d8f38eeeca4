#include "ostia/reconstruction/surface.h"

#include "assembly.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/graph_faults.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace ostia::reconstruction {
namespace {

void require(bool fine, const std::string& field, const std::string& bounds) {
  if (!fine) throw InvalidInput("reconstruction: " + field + " must be " + bounds);
}

ReconstructedSurface result_of(Made&& made, const std::vector<Tube>& tubes) {
  ReconstructedSurface result;
  result.surface.mesh.triangles = triangles_of(made.mesh);
  result.surface.faces = {{1, "wall", geometry::FaceKind::wall}};
  std::vector<std::array<std::int32_t, 2>> ids(tubes.size(), {0, 0});
  const auto add = [&](const std::string& name, geometry::FaceKind kind) {
    const auto id = static_cast<std::int32_t>(result.surface.faces.size() + 1);
    result.surface.faces.push_back({id, name, kind});
    return id;
  };
  for (std::size_t i = 0; i < tubes.size(); ++i)
    if (tubes[i].inlet) ids[i][0] = add("inlet_" + std::to_string(i), geometry::FaceKind::inlet);
  for (std::size_t i = 0; i < tubes.size(); ++i)
    if (tubes[i].outlet) ids[i][1] = add("outlet_" + std::to_string(i), geometry::FaceKind::outlet);
  result.surface.face_ids.resize(2 * made.mesh.quads.size());
  core::parallel_for(made.mesh.quads.size(), 4096, [&](std::size_t i) {
    const int face = made.mesh.face_of_quad[i];
    const auto& own = ids[static_cast<std::size_t>(made.mesh.branch_of_quad[i])];
    const std::int32_t id = face == 0 ? 1 : own[static_cast<std::size_t>(face - 1)];
    result.surface.face_ids[2 * i] = result.surface.face_ids[2 * i + 1] = id;
  });
  for (const Tube& tube : tubes) result.axis_ends.push_back({tube.points.front(), tube.points.back()});
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const double least = *std::min_element(tubes[i].factor.begin(), tubes[i].factor.end());
    if (least < 1.0) result.narrowed.push_back({static_cast<std::int32_t>(i), least});
  }
  result.self_intersections = made.crossings.size();
  result.surface.mesh.points = made.mesh.points;
  result.points = std::move(made.mesh.points);
  result.quads = std::move(made.mesh.quads);
  result.branch_of_quad = std::move(made.mesh.branch_of_quad);
  return result;
}

ReconstructedSurface made_of(const geometry::VesselGraph& graph, const EllipticSections* sections,
                             const ReconstructionOptions& options, const core::TaskContext& task) {
  validate(options);
  task.throw_if_cancelled();
  if (graph.edges.empty())
    throw InvalidInput("the network of vessels has no segments: nothing to make a surface of");
  geometry::require_sound(graph, "the network of vessels", false, task.sub(0.0, 0.05));
  const core::TaskContext making = task.sub(0.05, 0.95);
  Assembly assembly(graph, sections, options, making);
  Made made = assembly.made();
  ReconstructedSurface result = result_of(std::move(made), assembly.tubes());
  result.sides = options.sides;
  result.level = options.level;
  for (std::size_t i = 0; i < assembly.moved().size(); ++i)
    if (assembly.moved()[i] != 0) result.moved.push_back(static_cast<std::int32_t>(i));
  task.set_progress(1.0);
  return result;
}

}  // namespace

void validate(const ReconstructionOptions& o) {
  require(o.level >= 0 && o.level <= 3, "level", "0 to 3");
  require(o.sides >= 4 && o.sides <= 32 && o.sides % 2 == 0, "sides", "an even number from 4 to 32");
  require(o.spacing >= 0.1 && o.spacing <= 10.0, "spacing", "0.1 to 10 radii");
  require(o.bending >= 0.0 && o.bending <= 100.0, "bending", "0 to 100");
  require(o.lambda >= 0.0 && o.lambda <= 1.0, "lambda", "0 to 1");
  require(o.blend >= 0.0 && o.blend <= 1.0, "blend", "0 to 1 radii");
  require(o.untangling >= 0 && o.untangling <= 200, "untangling", "0 to 200 rounds");
}

ReconstructedSurface reconstruct_surface(const geometry::VesselGraph& graph,
                                         const ReconstructionOptions& options,
                                         const core::TaskContext& task) {
  return made_of(graph, nullptr, options, task);
}

ReconstructedSurface reconstruct_surface(const geometry::VesselGraph& graph, const EllipticSections& sections,
                                         const ReconstructionOptions& options,
                                         const core::TaskContext& task) {
  validate(sections, graph);
  return made_of(graph, &sections, options, task);
}

}  // namespace ostia::reconstruction
