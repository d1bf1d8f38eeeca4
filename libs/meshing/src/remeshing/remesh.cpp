#include "ostia/meshing/remesh.h"

#include "cutting/cap_filling.h"
#include "remeshing/remesher.h"

#include "ostia/core/error.h"
#include "ostia/geometry/faces.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/quality.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ostia::meshing {

using geometry::Vec3;

void validate(const RemeshOptions& o) {
  auto refuse = [](const std::string& what) { throw InvalidInput("remeshing: " + what); };
  if (o.iterations < 1 || o.iterations > 100)
    refuse("iterations " + std::to_string(o.iterations) + " must lie in [1, 100]");
  if (o.mending_rounds < 0 || o.mending_rounds > 100)
    refuse("mending_rounds " + std::to_string(o.mending_rounds) + " must lie in [0, 100]");
  if (!(o.mend_below_angle_deg >= 0.0 && o.mend_below_angle_deg <= 50.0))
    refuse("mend_below_angle_deg " + std::to_string(o.mend_below_angle_deg) + " must lie in [0, 50] degrees");
  if (!(o.max_cap_deviation > 0.0 && o.max_cap_deviation <= 1.0))
    refuse("max_cap_deviation " + std::to_string(o.max_cap_deviation) + " must lie in (0, 1]");
}

namespace {

void check_sizes(const geometry::TriMesh& surface, const std::vector<double>& sizes) {
  if (surface.triangles.empty()) throw InvalidInput("remeshing: the surface has no triangles");
  if (sizes.size() != surface.points.size())
    throw InvalidInput("remeshing: " + std::to_string(sizes.size()) + " target edge lengths for " +
                       std::to_string(surface.points.size()) + " points; one a point is needed");
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!(sizes[i] > 0.0) || !std::isfinite(sizes[i]))
      throw InvalidInput("remeshing: target edge length " + std::to_string(sizes[i]) + " mm at point " +
                         std::to_string(i) + "; it must be positive");
    if (!surface.points[i].allFinite())
      throw InvalidInput("remeshing: point " + std::to_string(i) +
                         " is not finite; repair the surface first");
  }
}

void run(Remesher& remesher, const RemeshOptions& options, const core::TaskContext& task) {
  remesher.set_task(task);
  const double steps = options.iterations + 0.3 * options.mending_rounds;
  for (int i = 0; i < options.iterations; ++i) {
    task.throw_if_cancelled();
    remesher.split_long();
    remesher.collapse_short();
    // Valence first opens the mesh; the last rounds settle the angles.
    if (i + 2 < options.iterations)
      remesher.flip_for_valence();
    else
      remesher.flip_for_angle();
    remesher.relax();
    if (i >= 1 && i + 3 < options.iterations) remesher.calibrate();
    task.set_progress((i + 1) / steps);
  }
  remesher.flip_for_angle();
  remesher.relax();
  std::size_t before = 0;
  for (int i = 0; i < options.mending_rounds; ++i) {
    task.throw_if_cancelled();
    const std::size_t bad = remesher.mend(options.mend_below_angle_deg);
    if (bad == 0 || (i > 3 && bad == before)) break;
    before = bad;
    task.set_progress((options.iterations + 0.3 * (i + 1)) / steps);
  }
}

RemeshReport report_of(const Remesher& remesher, const RemeshOptions& options) {
  RemeshReport report;
  report.iterations = options.iterations;
  report.splits = remesher.splits;
  report.collapses = remesher.collapses;
  report.flips = remesher.flips;
  const EditMesh& mesh = remesher.mesh();
  double count = 0.0;
  for (std::int32_t h = 0; h < mesh.half_edge_count(); ++h) {
    if (!mesh.canonical(h)) continue;
    const double ratio = mesh.length(h) / remesher.target_length(h);
    report.mean_edge_ratio += ratio;
    report.edge_ratio_deviation += std::abs(ratio - 1.0);
    count += 1.0;
  }
  report.mean_edge_ratio /= count;
  report.edge_ratio_deviation /= count;
  return report;
}

void judge(const geometry::TriMesh& mesh, RemeshReport& report, const core::TaskContext& task) {
  const SurfaceQuality quality = surface_quality(mesh, true, task);
  report.min_angle_deg = quality.min_angle_deg;
  report.self_intersections = quality.self_intersections;
  if (quality.self_intersections > 0)
    report.warnings.push_back(std::to_string(quality.self_intersections) +
                              " pairs of triangles intersect after remeshing; check the input surface for "
                              "self-intersections, or use a smaller edge ratio");
}

struct Wall {
  geometry::TriMesh mesh;
  std::vector<double> sizes;
  std::vector<std::int32_t> face_ids;
  std::vector<std::int32_t> full_vertex;  // number in the whole surface
};

const geometry::Face& face_of(const geometry::FacedSurface& surface, std::int32_t id) {
  return geometry::face_of(surface, id, "remeshing");
}

Wall wall_of(const geometry::FacedSurface& surface, const std::vector<double>& sizes) {
  Wall wall;
  std::vector<std::int32_t> number(surface.mesh.points.size(), -1);
  for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i) {
    if (!is_wall(face_of(surface, surface.face_ids[i]))) continue;
    geometry::Triangle t = surface.mesh.triangles[i];
    for (std::int32_t& v : t) {
      const auto old = static_cast<std::size_t>(v);
      if (number[old] < 0) {
        number[old] = static_cast<std::int32_t>(wall.mesh.points.size());
        wall.mesh.points.push_back(surface.mesh.points[old]);
        wall.sizes.push_back(sizes[old]);
        wall.full_vertex.push_back(v);
      }
      v = number[old];
    }
    wall.mesh.triangles.push_back(t);
    wall.face_ids.push_back(surface.face_ids[i]);
  }
  if (wall.mesh.triangles.empty())
    throw InvalidInput("remeshing: no triangle of the surface belongs to a wall");
  return wall;
}

/// The cap across each border curve of the wall, after checks that caps are flat and have one ring each.
std::vector<std::int32_t> caps_across(const geometry::FacedSurface& surface, const Wall& wall,
                                      const std::vector<BorderCurve>& curves, double max_deviation) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> directed;  // edges of caps
  std::map<std::int32_t, std::vector<Vec3>> cap_points;
  for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i) {
    const std::int32_t id = surface.face_ids[i];
    if (is_wall(face_of(surface, id))) continue;
    const geometry::Triangle& t = surface.mesh.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      directed[{t[k], t[(k + 1) % 3]}] = id;
      cap_points[id].push_back(surface.mesh.points[static_cast<std::size_t>(t[k])]);
    }
  }
  std::vector<std::int32_t> ids;
  for (const BorderCurve& curve : curves) {
    std::int32_t id = -1;
    for (std::size_t i = 0; i < curve.vertices.size(); ++i) {
      const auto full = [&](std::size_t k) {
        return wall.full_vertex[static_cast<std::size_t>(curve.vertices[k % curve.vertices.size()])];
      };
      const auto across = directed.find({full(i + 1), full(i)});  // there is one: the surface is closed
      if (id >= 0 && across->second != id)
        throw GeometryError("remeshing: faces " + face_of(surface, id).name + " and " +
                            face_of(surface, across->second).name +
                            " share a ring; a cap needs a ring of its own");
      id = across->second;
    }
    const std::string& name = face_of(surface, id).name;
    if (std::find(ids.begin(), ids.end(), id) != ids.end())
      throw GeometryError("remeshing: " + name + " has more than one ring");
    const Vec3 normal = loop_normal(curve.points).normalized();
    for (const Vec3& p : cap_points[id])
      if (!(std::abs((p - curve.points[0]).dot(normal)) <= max_deviation * curve.length / 3.0))
        throw GeometryError("remeshing: " + name + " is not flat (a point " +
                            std::to_string(std::abs((p - curve.points[0]).dot(normal))) +
                            " mm off its plane); clip the end first");
    ids.push_back(id);
  }
  for (const auto& [id, points] : cap_points)
    if (std::find(ids.begin(), ids.end(), id) == ids.end())
      throw GeometryError("remeshing: " + face_of(surface, id).name + " does not touch the wall");
  return ids;
}

std::vector<std::int32_t> wall_ids(const geometry::TriMesh& mesh, const Wall& wall) {
  if (std::all_of(wall.face_ids.begin(), wall.face_ids.end(),
                  [&](std::int32_t id) { return id == wall.face_ids[0]; }))
    return std::vector<std::int32_t>(mesh.triangles.size(), wall.face_ids[0]);
  const geometry::AabbTree tree(wall.mesh);
  std::vector<std::int32_t> ids;
  for (const geometry::Triangle& t : mesh.triangles) {
    Vec3 centroid = Vec3::Zero();
    for (const std::int32_t v : t) centroid += mesh.points[static_cast<std::size_t>(v)] / 3.0;
    ids.push_back(wall.face_ids[static_cast<std::size_t>(tree.closest(centroid).triangle)]);
  }
  return ids;
}

}  // namespace

RemeshedOpen remesh(const geometry::TriMesh& surface, const std::vector<double>& edge_lengths_mm,
                    const RemeshOptions& options, const core::TaskContext& task) {
  validate(options);
  check_sizes(surface, edge_lengths_mm);
  task.set_stage("remeshing");
  Remesher remesher(surface, edge_lengths_mm);
  run(remesher, options, task.sub(0.0, 0.95));
  RemeshedOpen result{remesher.mesh().compact(), report_of(remesher, options)};
  judge(result.mesh, result.report, task);
  task.set_progress(1.0);
  return result;
}

RemeshedSurface remesh(const geometry::FacedSurface& surface, const std::vector<double>& edge_lengths_mm,
                       const RemeshOptions& options, const core::TaskContext& task) {
  validate(options);
  check_sizes(surface.mesh, edge_lengths_mm);
  if (surface.face_ids.size() != surface.mesh.triangles.size())
    throw InvalidInput("remeshing: " + std::to_string(surface.face_ids.size()) + " face ids for " +
                       std::to_string(surface.mesh.triangles.size()) +
                       " triangles; one a triangle is needed");
  task.set_stage("remeshing");
  const EditMesh whole(surface.mesh);  // refuses what is not manifold before any work
  for (std::int32_t h = 0; h < whole.half_edge_count(); ++h)
    if (whole.twin(h) == EditMesh::none)
      throw GeometryError("remeshing: the surface is open at point " + std::to_string(whole.origin(h)) +
                          "; cap its ends first, or remesh it as an open surface");
  const Wall wall = wall_of(surface, edge_lengths_mm);
  Remesher remesher(wall.mesh, wall.sizes);
  const std::vector<std::int32_t> caps =
      caps_across(surface, wall, remesher.curves(), options.max_cap_deviation);
  run(remesher, options, task.sub(0.0, 0.9));

  RemeshedSurface result{{}, report_of(remesher, options)};
  std::vector<std::int32_t> old_vertices;
  result.surface.mesh = remesher.mesh().compact(&old_vertices);
  result.surface.faces = surface.faces;
  result.surface.face_ids = wall_ids(result.surface.mesh, wall);
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(remesher.mesh().vertex_count()), -1);
  for (std::size_t i = 0; i < old_vertices.size(); ++i)
    numbers[static_cast<std::size_t>(old_vertices[i])] = static_cast<std::int32_t>(i);
  for (const BorderCurve& ring : border_curves(remesher.mesh())) {
    std::vector<std::int32_t> loop;
    for (const std::int32_t v : ring.vertices) loop.push_back(numbers[static_cast<std::size_t>(v)]);
    const std::int32_t id = caps[static_cast<std::size_t>(remesher.curve(ring.vertices[0]))];
    fill_cap(result.surface, loop, 1.0, face_of(surface, id), options.mend_below_angle_deg);
  }
  judge(result.surface.mesh, result.report, task);
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::meshing
