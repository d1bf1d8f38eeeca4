#include "ostia/glview/shown_surface.h"

#include "neighbourhood.h"
#include "vertex_floats.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <string>

namespace ostia::glview {
namespace {

std::array<float, 3> floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

void validate(const geometry::TriMesh& mesh) {
  if (mesh.triangles.empty()) throw InvalidInput("the surface to be shown has no triangles");
  for (const Vec3& p : mesh.points)
    if (!p.allFinite()) throw InvalidInput("the surface to be shown has points that are not finite");
  for (const geometry::Triangle& t : mesh.triangles)
    for (const std::int32_t i : t)
      if (i < 0 || static_cast<std::size_t>(i) >= mesh.points.size())
        throw InvalidInput("a triangle of the surface to be shown names the point " + std::to_string(i) +
                           " of " + std::to_string(mesh.points.size()));
}

ShownVertex placed(const geometry::CageGrid& grid, const Vec3& point) {
  ShownVertex vertex;
  std::array<int, 3> cell{};
  for (int axis = 0; axis < 3; ++axis) {
    const double at = std::clamp((point[axis] - grid.origin[axis]) / grid.cell_mm[axis], 0.0,
                                 static_cast<double>(grid.cells));
    const auto k = static_cast<std::size_t>(axis);
    cell[k] = std::min(static_cast<int>(at), grid.cells - 1);
    vertex.local[k] = static_cast<float>(at - cell[k]);
  }
  vertex.corner = grid.point(cell[0], cell[1], cell[2]);
  vertex.rest = floats(point);
  return vertex;
}

/// The mesh's triangles, turned outward, and those that close its holes behind them. Returns the points that
/// closing adds.
std::vector<Vec3> close(const geometry::TriMesh& mesh, ShownSurface& shown) {
  shown.triangles = mesh.triangles;
  shown.open_triangles = mesh.triangles.size();
  try {
    const geometry::FilledHoles filled = geometry::fill_holes(mesh);
    shown.triangles = filled.mesh.triangles;
    shown.closed = geometry::boundary_loops(filled.mesh).empty();
    if (shown.closed && geometry::volume(filled.mesh) < 0.0)
      for (geometry::Triangle& t : shown.triangles) std::swap(t[1], t[2]);
    return {filled.mesh.points.begin() + static_cast<std::ptrdiff_t>(mesh.points.size()),
            filled.mesh.points.end()};
  } catch (const GeometryError&) {  // no manifold: both of its sides are drawn, and projections have streaks
  }
  return {};
}

std::vector<geometry::Triangle> open_triangles(const ShownSurface& shown) {
  return {shown.triangles.begin(),
          shown.triangles.begin() + static_cast<std::ptrdiff_t>(shown.open_triangles)};
}

/// Across a tube normals point everywhere but along its axis.
Vec3 least_spread(const std::vector<Vec3>& normals, const std::vector<std::int32_t>& near, const Vec3& own) {
  geometry::Mat3 spread = geometry::Mat3::Zero();
  for (const std::int32_t k : near) {
    const Vec3& n = normals[static_cast<std::size_t>(k)];
    spread += n * n.transpose();
  }
  // the vertex' own normal is across, whatever its surroundings say
  spread += spread.trace() * own * own.transpose();
  Vec3 along = Eigen::SelfAdjointEigenSolver<geometry::Mat3>(spread).eigenvectors().col(0);
  along -= along.dot(own) * own;
  if (along.norm() > 1e-9) along.normalize();
  return along;
}

}  // namespace

ShownSurface shown_surface(const geometry::TriMesh& mesh, const geometry::CageGrid& grid,
                           const core::TaskContext& task) {
  validate(mesh);
  ShownSurface shown;
  shown.grid = grid;
  const std::vector<Vec3> centres = close(mesh, shown);
  task.throw_if_cancelled();
  const std::vector<Vec3> normals = geometry::vertex_normals({mesh.points, open_triangles(shown)});
  task.throw_if_cancelled();
  shown.vertices.resize(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    shown.vertices[i] = placed(grid, mesh.points[i]);
    shown.vertices[i].normal = floats(normals[i]);
  }
  if (centres.empty()) return shown;
  geometry::TriMesh whole{mesh.points, shown.triangles};
  whole.points.insert(whole.points.end(), centres.begin(), centres.end());
  const std::vector<Vec3> whole_normals = geometry::vertex_normals(whole);
  for (std::size_t i = mesh.points.size(); i < whole.points.size(); ++i) {
    shown.vertices.push_back(placed(grid, whole.points[i]));
    shown.vertices.back().normal = floats(whole_normals[i]);
  }
  return shown;
}

std::vector<Direction> find_directions(const ShownSurface& surface, double reach_mm,
                                       const core::TaskContext& task) {
  geometry::TriMesh mesh{{}, open_triangles(surface)};
  std::vector<Vec3> normals;
  for (const ShownVertex& vertex : surface.vertices) {
    mesh.points.push_back(in_double(vertex.rest));
    normals.push_back(in_double(vertex.normal));
  }
  Neighbourhood around(mesh);
  std::vector<Direction> along(mesh.points.size());
  for (std::size_t i = 0; i < along.size(); ++i) {
    if (i % 1024 == 0) task.throw_if_cancelled();
    const auto& near = around.of(static_cast<std::int32_t>(i), reach_mm);
    // the centre of a hole that was closed has no surroundings
    along[i] =
        floats(near.size() > 1 ? least_spread(normals, near, normals[i]) : Vec3(normals[i].unitOrthogonal()));
  }
  return along;
}

std::vector<Eigen::Matrix3d> gradients(const ShownSurface& surface, const std::vector<Vec3>& control_points) {
  const geometry::CageGrid& grid = surface.grid;
  const int side = grid.points_a_side();
  std::vector<Eigen::Matrix3d> result(surface.vertices.size());
  core::parallel_for(result.size(), 2048, [&](std::size_t i) {
    const ShownVertex& vertex = surface.vertices[i];
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    for (int c = 0; c < 8; ++c) {
      const std::array<int, 3> step{c & 1, c >> 1 & 1, c >> 2};
      const Vec3& p = control_points[static_cast<std::size_t>(vertex.corner + step[0] +
                                                              side * (step[1] + side * step[2]))];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        double slope = step[axis] == 1 ? 1.0 : -1.0;
        for (std::size_t other = 0; other < 3; ++other) {
          const double at = static_cast<double>(vertex.local[other]);
          if (other != axis) slope *= step[other] == 1 ? at : 1.0 - at;
        }
        const auto column = static_cast<Eigen::Index>(axis);
        gradient.col(column) += slope / grid.cell_mm[column] * p;
      }
    }
    result[i] = gradient;
  });
  return result;
}

}  // namespace ostia::glview
