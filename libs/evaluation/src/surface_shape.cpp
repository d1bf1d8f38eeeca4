#include "ostia/evaluation/surface_shape.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::evaluation {
namespace {

using geometry::TriMesh;
using geometry::Vec3;
using Neighbours = std::vector<std::vector<std::int32_t>>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t unknowns = 5;  // of the quadric

void check(const TriMesh& mesh) {
  if (mesh.triangles.empty()) throw InvalidInput("a surface without triangles has no shape to speak of");
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (!mesh.points[i].allFinite())
      throw InvalidInput("point " + std::to_string(i) + " of the surface is not finite");
}

/// Vertices at an edge that only one triangle has: their neighbours lie to one side.
std::vector<bool> at_border(const TriMesh& mesh) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const geometry::Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.push_back(std::minmax(t[i], t[(i + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  std::vector<bool> border(mesh.points.size(), false);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end - i == 1)
      border[static_cast<std::size_t>(edges[i].first)] = border[static_cast<std::size_t>(edges[i].second)] =
          true;
    i = end;
  }
  return border;
}

std::vector<std::int32_t> ring_of(std::int32_t vertex, const Neighbours& neighbours) {
  std::vector<std::int32_t> ring = neighbours[static_cast<std::size_t>(vertex)];
  if (ring.size() >= unknowns) return ring;
  const std::vector<std::int32_t> direct = ring;
  for (const std::int32_t n : direct)
    ring.insert(ring.end(), neighbours[static_cast<std::size_t>(n)].begin(),
                neighbours[static_cast<std::size_t>(n)].end());
  std::sort(ring.begin(), ring.end());
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  ring.erase(std::remove(ring.begin(), ring.end(), vertex), ring.end());
  return ring;
}

/// Curvatures of the graph z = a x^2 + b x y + c y^2 + d x + e y at the origin, by its shape operator.
PrincipalCurvatures of_quadric(double a, double b, double c, double d, double e) {
  const double E = 1.0 + d * d, F = d * e, G = 1.0 + e * e;
  const double root = std::sqrt(1.0 + d * d + e * e);
  const double L = -2.0 * a / root, M = -b / root, N = -2.0 * c / root;  // outward bulge counts positive
  const double area2 = E * G - F * F;
  const double gauss = (L * N - M * M) / area2;
  const double mean = (E * N - 2.0 * F * M + G * L) / (2.0 * area2);
  const double spread = std::sqrt(std::max(0.0, mean * mean - gauss));
  return {mean + spread, mean - spread};
}

PrincipalCurvatures at_vertex(const TriMesh& mesh, const std::vector<std::int32_t>& ring, const Vec3& centre,
                              const Vec3& normal) {
  if (ring.size() < unknowns || !(normal.norm() > 0.5)) return {nan, nan};
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  double scale = 0.0;  // so that the columns are of like size
  for (const std::int32_t n : ring)
    scale = std::max(scale, (mesh.points[static_cast<std::size_t>(n)] - centre).norm());
  if (!(scale > 0.0)) return {nan, nan};
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(ring.size()), static_cast<Eigen::Index>(unknowns));
  Eigen::VectorXd heights(static_cast<Eigen::Index>(ring.size()));
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 p = (mesh.points[static_cast<std::size_t>(ring[i])] - centre) / scale;
    const double x = p.dot(u), y = p.dot(v);
    rows.row(static_cast<Eigen::Index>(i)) << x * x, x * y, y * y, x, y;
    heights[static_cast<Eigen::Index>(i)] = p.dot(normal);
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(rows);
  solver.setThreshold(1e-8);
  if (solver.rank() < static_cast<Eigen::Index>(unknowns)) return {nan, nan};
  const Eigen::VectorXd q = solver.solve(heights);
  const PrincipalCurvatures scaled = of_quadric(q[0], q[1], q[2], q[3], q[4]);
  return {scaled.kappa1 / scale, scaled.kappa2 / scale};
}

/// A third of the area of the triangles around each vertex.
std::vector<double> areas_of_vertices(const TriMesh& mesh) {
  std::vector<double> areas(mesh.points.size(), 0.0);
  for (const geometry::Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.points[static_cast<std::size_t>(t[0])];
    const Vec3& b = mesh.points[static_cast<std::size_t>(t[1])];
    const Vec3& c = mesh.points[static_cast<std::size_t>(t[2])];
    for (const std::int32_t corner : t)
      areas[static_cast<std::size_t>(corner)] += (b - a).cross(c - a).norm() / 6.0;
  }
  return areas;
}

}  // namespace

std::vector<PrincipalCurvatures> curvatures(const TriMesh& mesh, const core::TaskContext& task) {
  check(mesh);
  task.throw_if_cancelled();
  const Neighbours neighbours = geometry::vertex_neighbours(mesh);
  const std::vector<Vec3> normals = geometry::vertex_normals(mesh);
  const std::vector<bool> border = at_border(mesh);
  std::vector<PrincipalCurvatures> out(mesh.points.size(), {nan, nan});
  core::parallel_chunks(mesh.points.size(), 4096, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i) {
      if (border[i]) continue;
      out[i] = at_vertex(mesh, ring_of(static_cast<std::int32_t>(i), neighbours), mesh.points[i], normals[i]);
    }
  });
  return out;
}

SurfaceShape shape_of(const TriMesh& mesh, const core::TaskContext& task) {
  const std::vector<PrincipalCurvatures> all = curvatures(mesh, task);
  const geometry::SurfaceFaults faults = geometry::find_faults(mesh, false);
  SurfaceShape shape;
  shape.area_mm2 = geometry::area(mesh);
  shape.closed = faults.open_edges == 0;
  shape.volume_mm3 = shape.closed ? geometry::volume(mesh) : nan;
  const std::vector<double> areas = areas_of_vertices(mesh);
  double weight = 0.0, first = 0.0, second = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!(areas[i] > 0.0)) continue;  // no triangle has it
    if (!std::isfinite(all[i].kappa1)) {
      ++shape.vertices_left_out;
      continue;
    }
    weight += areas[i];
    first += areas[i] * all[i].kappa1 * all[i].kappa1;
    second += areas[i] * all[i].kappa2 * all[i].kappa2;
  }
  shape.rms_kappa1 = std::sqrt(first / weight);  // NaN without a vertex that counts
  shape.rms_kappa2 = std::sqrt(second / weight);
  shape.rms_curvature = std::sqrt((first + second) / weight);
  return shape;
}

}  // namespace ostia::evaluation
