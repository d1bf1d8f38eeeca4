#include "ostia/geometry/curvature.h"

#include "edge_table.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::geometry {
namespace {

using detail::HalfEdge;
using Tensor = Eigen::Matrix3d;

/// Each point's share of the normal cycle: half of its edges' turning, a third of its triangles' area.
struct Shares {
  std::vector<Tensor> tensor;
  std::vector<double> area;
};

/// Of the two outward normals' angle, positive where the surface is convex.
double turning(const Vec3& n1, const Vec3& n2, const Vec3& along) {
  return std::atan2(along.dot(n1.cross(n2)), n1.dot(n2));
}

Shares shares_of(const TriMesh& mesh) {
  const std::size_t count = mesh.points.size();
  Shares shares{std::vector<Tensor>(count, Tensor::Zero()), std::vector<double>(count, 0.0)};
  const auto at = [&](std::int32_t p) -> const Vec3& { return mesh.points[static_cast<std::size_t>(p)]; };
  std::vector<Vec3> normals;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 twice = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
    normals.push_back(twice.norm() > 0.0 ? twice.normalized() : Vec3::Zero());
    for (const std::int32_t p : t) shares.area[static_cast<std::size_t>(p)] += twice.norm() / 6.0;
  }
  std::vector<char> border(count, 0);
  detail::for_each_edge(detail::half_edges(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
    const auto low = static_cast<std::size_t>(first->low), high = static_cast<std::size_t>(first->high);
    if (last - first != 2 || first->ascending == (first + 1)->ascending) {
      border[low] = border[high] = 1;
      return;
    }
    const Vec3 edge = at(first->to()) - at(first->from());
    const double length = edge.norm();
    if (!(length > 0.0)) return;
    const double bend = turning(normals[static_cast<std::size_t>(first->triangle)],
                                normals[static_cast<std::size_t>((first + 1)->triangle)], edge / length);
    const Tensor half = (0.5 * bend / length) * edge * edge.transpose();
    shares.tensor[low] += half;
    shares.tensor[high] += half;
  });
  for (std::size_t p = 0; p < count; ++p)
    if (border[p] != 0) {
      shares.tensor[p].setZero();
      shares.area[p] = 0.0;
    }
  return shares;
}

/// The edge's tensor lies along the edge and counts the bending across it, so the directions change places.
PrincipalCurvatures across(const Tensor& tensor, const Vec3& normal) {
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  Eigen::Matrix2d inner;
  inner << u.dot(tensor * u), u.dot(tensor * v), v.dot(tensor * u), v.dot(tensor * v);
  const Eigen::Vector2d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(inner, Eigen::EigenvaluesOnly).eigenvalues();
  return std::abs(values[0]) > std::abs(values[1]) ? PrincipalCurvatures{values[0], values[1]}
                                                   : PrincipalCurvatures{values[1], values[0]};
}

/// Points that the surface joins to `start` within `reach`, each once. Its marks serve one query after
/// another.
class Surroundings {
 public:
  Surroundings(const TriMesh& mesh, const std::vector<std::vector<std::int32_t>>& neighbours)
      : mesh_(mesh), neighbours_(neighbours), seen_(mesh.points.size(), -1) {}
  const std::vector<std::int32_t>& of(std::int32_t start, double reach) {
    found_.assign(1, start);
    seen_[static_cast<std::size_t>(start)] = start;
    const Vec3& centre = mesh_.points[static_cast<std::size_t>(start)];
    for (std::size_t next = 0; next < found_.size(); ++next)
      for (const std::int32_t p : neighbours_[static_cast<std::size_t>(found_[next])]) {
        std::int32_t& mark = seen_[static_cast<std::size_t>(p)];
        if (mark == start || (mesh_.points[static_cast<std::size_t>(p)] - centre).norm() >= reach) continue;
        mark = start;
        found_.push_back(p);
      }
    return found_;
  }

 private:
  const TriMesh& mesh_;
  const std::vector<std::vector<std::int32_t>>& neighbours_;
  std::vector<std::int32_t> seen_, found_;
};

void check(const TriMesh& mesh, const std::vector<double>& reach_mm) {
  if (reach_mm.size() != mesh.points.size())
    throw InvalidInput("curvature: " + std::to_string(reach_mm.size()) + " reaches for " +
                       std::to_string(mesh.points.size()) + " points; it needs one a point");
  for (const double reach : reach_mm)
    if (!(reach > 0.0) || !std::isfinite(reach))
      throw InvalidInput("curvature: a reach of " + std::to_string(reach) +
                         " mm must be positive and finite");
}

}  // namespace

std::vector<PrincipalCurvatures> principal_curvatures(const TriMesh& mesh,
                                                      const std::vector<double>& reach_mm,
                                                      const core::TaskContext& task) {
  check(mesh, reach_mm);
  const Shares shares = shares_of(mesh);
  const std::vector<Vec3> normals = vertex_normals(mesh);
  const auto neighbours = vertex_neighbours(mesh);
  std::vector<PrincipalCurvatures> result(mesh.points.size());
  core::parallel_chunks(result.size(), 16384, [&](std::size_t first, std::size_t last) {
    Surroundings surroundings(mesh, neighbours);
    for (std::size_t i = first; i < last; ++i) {
      if (i % 1024 == 0) task.throw_if_cancelled();
      Tensor tensor = Tensor::Zero();
      double area = 0.0;
      for (const std::int32_t p : surroundings.of(static_cast<std::int32_t>(i), reach_mm[i])) {
        const auto at = static_cast<std::size_t>(p);
        const double far = (mesh.points[at] - mesh.points[i]).norm() / reach_mm[i];
        const double weight = (1.0 - far) * (1.0 - far);
        tensor += weight * shares.tensor[at];
        area += weight * shares.area[at];
      }
      if (area > 0.0 && normals[i].squaredNorm() > 0.0) result[i] = across(tensor / area, normals[i]);
    }
  });
  return result;
}

}  // namespace ostia::geometry
