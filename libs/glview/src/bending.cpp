#include "neighbourhood.h"
#include "vertex_floats.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/glview/surface_values.h"

#include <algorithm>

namespace ostia::glview {
namespace {

constexpr double same_side = 0.85;  // cosine between normals

using Lists = std::vector<std::vector<std::int32_t>>;

/// Chosen once, at rest, so that all phases are compared over the same part of the wall.
Lists same_side_lists(const geometry::TriMesh& mesh, const std::vector<Vec3>& normals, double reach_mm,
                      const core::TaskContext& task) {
  Neighbourhood around(mesh);
  Lists lists(mesh.points.size());
  for (std::size_t i = 0; i < lists.size(); ++i) {
    if (i % 1024 == 0) task.throw_if_cancelled();
    for (const std::int32_t k : around.of(static_cast<std::int32_t>(i), reach_mm))
      if (normals[static_cast<std::size_t>(k)].dot(normals[i]) > same_side) lists[i].push_back(k);
  }
  return lists;
}

/// How fast normals turn along `along`, which is turned into the tangent plane.
double curvature_along(const geometry::TriMesh& mesh, const std::vector<Vec3>& normals,
                       const std::vector<std::int32_t>& list, std::size_t i, Vec3 along) {
  along -= along.dot(normals[i]) * normals[i];
  if (along.norm() < 1e-9) return 0.0;
  along.normalize();
  double products = 0.0, squares = 0.0;
  for (const std::int32_t other : list) {
    const auto k = static_cast<std::size_t>(other);
    const double way = (mesh.points[k] - mesh.points[i]).dot(along);
    products += way * normals[k].dot(along);
    squares += way * way;
  }
  return squares > 1e-9 ? products / squares : 0.0;
}

std::vector<double> curvatures(const geometry::TriMesh& mesh, const Lists& lists,
                               const std::vector<Vec3>& along) {
  const std::vector<Vec3> normals = geometry::vertex_normals(mesh);
  std::vector<double> result(mesh.points.size());
  core::parallel_for(result.size(), 1024, [&](std::size_t i) {
    result[i] = curvature_along(mesh, normals, lists[i], i, along[i]);
  });
  return result;
}

}  // namespace

BendingTable bending_table(const ShownSurface& surface, const motion::MovingCage& cage, int phases,
                           double reach_mm, const core::TaskContext& task) {
  if (phases < 2) throw InvalidInput("curvatures need two phases of the cycle at least");
  if (surface.along.size() != surface.vertices.size())
    throw InvalidInput("curvatures need the directions along the vessel");
  geometry::TriMesh mesh;
  std::vector<Vec3> rest_along;
  for (const ShownVertex& vertex : surface.vertices) mesh.points.push_back(in_double(vertex.rest));
  for (const Direction& along : surface.along) rest_along.push_back(in_double(along));
  mesh.triangles.assign(surface.triangles.begin(),
                        surface.triangles.begin() + static_cast<std::ptrdiff_t>(surface.open_triangles));
  const Lists lists = same_side_lists(mesh, geometry::vertex_normals(mesh), reach_mm, task);
  const std::vector<double> rest = curvatures(mesh, lists, rest_along);
  const motion::CarriedPoints carried(cage.grid(), mesh.points);
  BendingTable table;
  table.phases = phases;
  std::vector<Vec3> along(rest_along.size());
  for (int k = 0; k < phases; ++k) {
    task.throw_if_cancelled();
    const std::vector<Vec3> control_points = cage.at(static_cast<double>(k) / phases);
    mesh.points = carried.places(control_points);
    const auto gradient = gradients(surface, control_points);
    for (std::size_t i = 0; i < along.size(); ++i) along[i] = gradient[i] * rest_along[i];
    const std::vector<double> now = curvatures(mesh, lists, along);
    for (std::size_t i = 0; i < now.size(); ++i) table.values.push_back(static_cast<float>(now[i] - rest[i]));
  }
  return table;
}

}  // namespace ostia::glview
