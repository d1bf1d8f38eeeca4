#include "ostia/reconstruction/surface.h"

#include "base_mesh.h"
#include "catmull_clark.h"
#include "untangle.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/graph_faults.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace ostia::reconstruction {
namespace {

void require(bool fine, const std::string& field, const std::string& bounds) {
  if (!fine) throw InvalidInput("reconstruction: " + field + " must be " + bounds);
}

/// Makes the polygon of a section have its circle's area.
double polygon_scale(const ReconstructionOptions& options, int level) {
  const double side = 2.0 * std::numbers::pi / (options.sides << level);
  return std::sqrt(side / std::sin(side));
}

struct Made {
  QuadMesh mesh;
  std::vector<std::pair<std::int32_t, std::int32_t>> crossings;
};

/// Along the shorter diagonal.
std::vector<geometry::Triangle> triangles_of(const QuadMesh& mesh) {
  std::vector<geometry::Triangle> triangles;
  triangles.reserve(2 * mesh.quads.size());
  const auto squared = [&](std::int32_t a, std::int32_t b) {
    return (mesh.points[static_cast<std::size_t>(a)] - mesh.points[static_cast<std::size_t>(b)])
        .squaredNorm();
  };
  for (const geometry::Quad& q : mesh.quads) {
    if (squared(q[0], q[2]) <= squared(q[1], q[3])) {
      triangles.push_back({q[0], q[1], q[2]});
      triangles.push_back({q[0], q[2], q[3]});
    } else {
      triangles.push_back({q[1], q[2], q[3]});
      triangles.push_back({q[1], q[3], q[0]});
    }
  }
  return triangles;
}

Made made_at(const std::vector<Tube>& tubes, const geometry::VesselGraph& graph,
             const ReconstructionOptions& options, int level, const core::TaskContext& task) {
  const std::vector<Joint> joints = joints_of(tubes, graph, options);
  task.throw_if_cancelled();
  Made made;
  made.mesh = base_mesh(tubes, joints, options);
  place(made.mesh, tubes, joints, polygon_scale(options, 0));
  for (int l = 1; l <= level; ++l) {
    task.throw_if_cancelled();
    made.mesh = subdivided(made.mesh);
    place(made.mesh, tubes, joints, polygon_scale(options, l));
  }
  task.throw_if_cancelled();
  made.crossings = geometry::self_intersections({made.mesh.points, triangles_of(made.mesh)});
  return made;
}

/// Coarse rounds first, since they are quick.
Made untangled(std::vector<Tube>& tubes, const geometry::VesselGraph& graph,
               const ReconstructionOptions& options, const core::TaskContext& task) {
  int rounds = options.untangling;
  for (int level = std::min(1, options.level);; level = options.level) {
    for (;;) {
      Made made = made_at(tubes, graph, options, level, task);
      const bool done = made.crossings.empty() || rounds == 0;
      task.set_progress(0.9 * (1.0 - static_cast<double>(rounds) / (options.untangling + 1.0)));
      if (done && level == options.level) return made;
      if (done) break;
      give_way(tubes, made.mesh, made.crossings);
      --rounds;
    }
  }
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
  for (std::size_t i = 0; i < made.mesh.quads.size(); ++i) {
    const int face = made.mesh.face_of_quad[i];
    const auto& own = ids[static_cast<std::size_t>(made.mesh.branch_of_quad[i])];
    const std::int32_t id = face == 0 ? 1 : own[static_cast<std::size_t>(face - 1)];
    result.surface.face_ids.insert(result.surface.face_ids.end(), 2, id);
  }
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
  validate(options);
  task.throw_if_cancelled();
  if (graph.edges.empty())
    throw InvalidInput("the network of vessels has no segments: nothing to make a surface of");
  geometry::require_sound(graph, "the network of vessels", false, task.sub(0.0, 0.05));
  std::vector<Tube> tubes = tubes_of(graph);
  Made made = untangled(tubes, graph, options, task.sub(0.05, 0.95));
  ReconstructedSurface result = result_of(std::move(made), tubes);
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::reconstruction
