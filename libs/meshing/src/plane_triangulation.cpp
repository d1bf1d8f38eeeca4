#include "plane_triangulation.h"

#include "ostia/core/error.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

namespace ostia::meshing {

using geometry::Vec2;
using geometry::Vec3;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

bool inside(const std::vector<Vec2>& loop, const Vec2& p) {
  bool in = false;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    const Vec2 &a = loop[i], &b = loop[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      in = !in;
  }
  return in;
}

double distance_to_loop(const std::vector<Vec2>& loop, const Vec2& p) {
  double best = 1e300;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 &a = loop[i], edge = loop[(i + 1) % loop.size()] - a;
    const double t = std::clamp((p - a).dot(edge) / std::max(edge.squaredNorm(), 1e-300), 0.0, 1.0);
    best = std::min(best, (p - a - t * edge).norm());
  }
  return best;
}

/// A hexagonal lattice inside the loop, clear of it.
std::vector<Vec2> lattice(const std::vector<Vec2>& loop, double edge) {
  Vec2 low = loop[0], high = loop[0];
  for (const Vec2& p : loop) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vec2 centre = 0.5 * (low + high);
  const double row = edge * std::sqrt(3.0) / 2.0;
  const auto rows = static_cast<int>(std::ceil((high.y() - low.y()) / 2.0 / row)) + 1;
  const auto columns = static_cast<int>(std::ceil((high.x() - low.x()) / 2.0 / edge)) + 1;
  std::vector<Vec2> points;
  for (int j = -rows; j <= rows; ++j)
    for (int i = -columns; i <= columns; ++i) {
      const Vec2 p = centre + Vec2((i + (j % 2 != 0 ? 0.5 : 0.0)) * edge, j * row);
      if (inside(loop, p) && distance_to_loop(loop, p) > 0.6 * edge) points.push_back(p);
    }
  return points;
}

double cross(const Vec2& u, const Vec2& v) {
  return u.x() * v.y() - u.y() * v.x();
}

void refuse_crossing(const std::vector<Vec2>& loop, const std::string& name) {
  const std::size_t n = loop.size();
  auto opposite = [](const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
    return cross(b - a, p - a) * cross(b - a, q - a) < 0.0;
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      const Vec2 &a = loop[i], &b = loop[i + 1], &p = loop[j], &q = loop[(j + 1) % n];
      if (opposite(a, b, p, q) && opposite(p, q, a, b))
        throw GeometryError("the border of " + name +
                            " crosses itself in its plane; clip the end farther inside");
    }
}

std::vector<geometry::Triangle> delaunay(const std::vector<Vec2>& loop, const std::vector<Vec2>& inner,
                                         const std::string& name) {
  Delaunay triangulation;
  std::vector<Delaunay::Vertex_handle> handles;
  auto add = [&](const Vec2& p) {
    const auto handle = triangulation.insert(Delaunay::Point(p.x(), p.y()));
    handle->info() = static_cast<std::int32_t>(handles.size());
    handles.push_back(handle);
  };
  for (const Vec2& p : loop) add(p);
  for (const Vec2& p : inner) add(p);
  if (triangulation.dimension() < 2) throw GeometryError("the border of " + name + " is a line");
  if (triangulation.number_of_vertices() != loop.size() + inner.size())
    throw GeometryError("the border of " + name + " has points that coincide; clip the end farther inside");
  try {
    for (std::size_t i = 0; i < loop.size(); ++i)
      triangulation.insert_constraint(handles[i], handles[(i + 1) % loop.size()]);
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    throw GeometryError("the border of " + name +
                        " crosses itself in its plane; clip the end farther inside");
  }
  // Outside is what can be reached from infinity without crossing the loop; a test of centroids would err on
  // needles.
  std::set<Delaunay::Face_handle> outside{triangulation.infinite_face()};
  std::vector<Delaunay::Face_handle> stack{triangulation.infinite_face()};
  while (!stack.empty()) {
    const Delaunay::Face_handle f = stack.back();
    stack.pop_back();
    for (int i = 0; i < 3; ++i)
      if (!f->is_constrained(i) && outside.insert(f->neighbor(i)).second) stack.push_back(f->neighbor(i));
  }
  std::vector<geometry::Triangle> triangles;
  for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f)
    if (!outside.contains(f))
      triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// Each inner point to the mean of its neighbours.
void relax(const std::vector<Vec2>& loop, const std::vector<geometry::Triangle>& triangles,
           std::vector<Vec2>& inner) {
  std::vector<Vec2> sum(inner.size(), Vec2::Zero());
  std::vector<double> count(inner.size(), 0.0);
  const auto first = static_cast<std::int32_t>(loop.size());
  auto at = [&](std::int32_t v) {
    return v < first ? loop[static_cast<std::size_t>(v)] : inner[static_cast<std::size_t>(v - first)];
  };
  for (const geometry::Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      if (t[i] < first) continue;
      sum[static_cast<std::size_t>(t[i] - first)] += at(t[(i + 1) % 3]) + at(t[(i + 2) % 3]);
      count[static_cast<std::size_t>(t[i] - first)] += 2.0;
    }
  for (std::size_t i = 0; i < inner.size(); ++i)
    if (count[i] > 0.0) inner[i] = sum[i] / count[i];
}

}  // namespace

Vec3 loop_normal(const std::vector<Vec3>& loop) {
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    normal += (loop[i] - loop[0]).cross(loop[i + 1] - loop[0]);
  return normal;
}

double mean_edge(const std::vector<Vec3>& loop) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) sum += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  return sum / static_cast<double>(loop.size());
}

FlatPatch triangulate_flat(const std::vector<Vec3>& loop, double edge_mm, const std::string& name) {
  if (loop.size() < 3) throw GeometryError("the border of " + name + " has fewer than three points");
  const Vec3 normal = loop_normal(loop).normalized();
  if (!(normal.squaredNorm() > 0.5)) throw GeometryError("the border of " + name + " encloses no area");
  Vec3 origin = Vec3::Zero();
  for (const Vec3& p : loop) origin += p / static_cast<double>(loop.size());
  const Vec3 u = normal.unitOrthogonal(), w = normal.cross(u);
  std::vector<Vec2> flat;
  for (const Vec3& p : loop) flat.emplace_back((p - origin).dot(u), (p - origin).dot(w));
  refuse_crossing(flat, name);
  std::vector<Vec2> inner = lattice(flat, edge_mm > 0.0 ? edge_mm : mean_edge(loop));
  FlatPatch patch;
  patch.triangles = delaunay(flat, inner, name);
  for (int round = 0; round < 20 && !inner.empty(); ++round) {
    relax(flat, patch.triangles, inner);
    patch.triangles = delaunay(flat, inner, name);
  }
  for (const Vec2& p : inner) patch.inner_points.push_back(origin + p.x() * u + p.y() * w);
  return patch;
}

}  // namespace ostia::meshing
