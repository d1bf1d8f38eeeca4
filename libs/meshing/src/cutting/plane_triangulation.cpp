#include "cutting/plane_triangulation.h"

#include "ostia/core/error.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

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

/// A hexagonal lattice inside the loop, clear of it. `shift`: of its middle, in edges.
std::vector<Vec2> lattice(const std::vector<Vec2>& loop, double edge, const Vec2& shift) {
  Vec2 low = loop[0], high = loop[0];
  for (const Vec2& p : loop) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vec2 centre = 0.5 * (low + high) + edge * shift;
  const double row = edge * std::sqrt(3.0) / 2.0;
  const auto rows = static_cast<int>(std::ceil((high.y() - low.y()) / 2.0 / row)) + 2;
  const auto columns = static_cast<int>(std::ceil((high.x() - low.x()) / 2.0 / edge)) + 2;
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

bool has_crossing(const std::vector<Vec2>& loop) {
  const std::size_t n = loop.size();
  auto opposite = [](const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
    return cross(b - a, p - a) * cross(b - a, q - a) < 0.0;
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      const Vec2 &a = loop[i], &b = loop[i + 1], &p = loop[j], &q = loop[(j + 1) % n];
      if (opposite(a, b, p, q) && opposite(p, q, a, b)) return true;
    }
  return false;
}

/// A loop in the plane through the mean of its points.
struct LaidLoop {
  Vec3 origin = Vec3::Zero(), u, w;
  std::vector<Vec2> flat;
};

LaidLoop laid(const std::vector<Vec3>& loop, const Vec3& normal) {
  LaidLoop result;
  for (const Vec3& p : loop) result.origin += p / static_cast<double>(loop.size());
  result.u = normal.unitOrthogonal();
  result.w = normal.cross(result.u);
  for (const Vec3& p : loop)
    result.flat.emplace_back((p - result.origin).dot(result.u), (p - result.origin).dot(result.w));
  return result;
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

/// A loop's triangulation in its plane.
struct Filling {
  std::vector<Vec2> inner;
  std::vector<geometry::Triangle> triangles;
  double min_angle_deg = 0.0;
};

/// Largest cosine of the angles of a triangle's corners, that of the smallest angle: min_angle_cosine in a
/// plane.
double sharpest(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - b, w = a - c;
  const double x = u.squaredNorm(), y = v.squaredNorm(), z = w.squaredNorm();
  double product = z * x, dot = -w.dot(u);
  if (x <= y && x <= z) {
    product = y * z, dot = -v.dot(w);
  } else if (z <= y) {
    product = x * y, dot = -u.dot(v);
  }
  return product > 0.0 ? dot / std::sqrt(product) : 1.0;
}

/// The directions of the pattern search.
const std::array<Vec2, 8>& eight_ways() {
  static const std::array<Vec2, 8> ways = [] {
    std::array<Vec2, 8> out;
    for (int k = 0; k < 8; ++k) {
      const double angle = k * std::numbers::pi / 4.0;
      out[static_cast<std::size_t>(k)] = Vec2(std::cos(angle), std::sin(angle));
    }
    return out;
  }();
  return ways;
}

/// Moves each inner point to where the smallest angle around it is largest, by a pattern search.
class AngleOpening {
 public:
  AngleOpening(const std::vector<Vec2>& loop, Filling& filling)
      : loop_(loop), filling_(filling), around_(filling.inner.size()) {
    for (const geometry::Triangle& t : filling.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        if (t[i] >= first()) around_[inner(t[i])].push_back({t[(i + 1) % 3], t[(i + 2) % 3]});
  }

  void run() {
    for (std::size_t i = 0; i < around_.size(); ++i) open(i);
  }
  double min_angle_deg() const {
    double worst = 0.0;
    for (const geometry::Triangle& t : filling_.triangles)
      worst = std::max(worst, sharpest(at(t[0]), at(t[1]), at(t[2])));
    return std::acos(std::clamp(worst, -1.0, 1.0)) * 180.0 / std::numbers::pi;
  }

 private:
  std::int32_t first() const { return static_cast<std::int32_t>(loop_.size()); }
  std::size_t inner(std::int32_t v) const { return static_cast<std::size_t>(v - first()); }
  const Vec2& at(std::int32_t v) const {
    return v < first() ? loop_[static_cast<std::size_t>(v)] : filling_.inner[inner(v)];
  }
  double worst_of(const std::pair<std::int32_t, std::int32_t>& edge, const Vec2& p) const {
    const Vec2 &a = at(edge.first), &b = at(edge.second);
    return cross(a - p, b - p) > 0.0 ? sharpest(p, a, b) : 2.0;
  }
  /// Of the triangles around, or no less than `enough` once one reaches it; `first` of them is tried first,
  /// and then the one that reached it.
  double worst_around(std::size_t i, const Vec2& p, double enough, std::size_t& first) const {
    const auto& edges = around_[i];
    double worst = edges.empty() ? 0.0 : std::max(0.0, worst_of(edges[first], p));
    for (std::size_t n = 0; n < edges.size() && worst < enough; ++n) {
      if (n == first) continue;
      worst = std::max(worst, worst_of(edges[n], p));
      if (worst >= enough) first = n;
    }
    return worst;
  }
  void open(std::size_t i) {
    constexpr double least_gain = 1e-6;
    Vec2& p = filling_.inner[i];
    std::size_t first = 0;
    double best = worst_around(i, p, std::numeric_limits<double>::infinity(), first), edge = 0.0;
    for (const auto& [a, b] : around_[i]) edge += (at(a) - p).norm() / static_cast<double>(around_[i].size());
    for (double step = 0.2 * edge; step > 0.01 * edge; step *= 0.5)
      for (const Vec2& way : eight_ways()) {
        const Vec2 there = p + step * way;
        const double now = worst_around(i, there, best - least_gain, first);
        if (now < best - least_gain) best = now, p = there;
      }
  }

  const std::vector<Vec2>& loop_;
  Filling& filling_;
  std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> around_;  // edges opposite each inner point
};

Filling fill(const std::vector<Vec2>& loop, double edge, const Vec2& shift, const std::string& name) {
  Filling filling;
  filling.inner = lattice(loop, edge, shift);
  filling.triangles = delaunay(loop, filling.inner, name);
  for (int round = 0; round < 20 && !filling.inner.empty(); ++round) {
    relax(loop, filling.triangles, filling.inner);
    filling.triangles = delaunay(loop, filling.inner, name);
  }
  filling.min_angle_deg = AngleOpening(loop, filling).min_angle_deg();
  return filling;
}

/// Delaunay's triangles of points have the largest smallest angle of all, so both steps raise it.
void open_angles(const std::vector<Vec2>& loop, Filling& filling, const std::string& name) {
  constexpr int rounds = 8;
  for (int round = 0; round < rounds && !filling.inner.empty(); ++round) {
    AngleOpening(loop, filling).run();
    filling.triangles = delaunay(loop, filling.inner, name);
  }
  filling.min_angle_deg = AngleOpening(loop, filling).min_angle_deg();
}

Filling best_filling(const std::vector<Vec2>& loop, double edge, const std::string& name,
                     double good_angle_deg) {
  Filling best = fill(loop, edge, Vec2::Zero(), name);
  if (best.min_angle_deg >= good_angle_deg) return best;
  open_angles(loop, best, name);
  // Along a long rough border its own corners decide, and each try takes seconds.
  constexpr std::size_t long_loop = 160;
  if (loop.size() > long_loop) return best;
  // Other lattices: a point more or fewer in the middle of a small loop decides.
  for (const double density : {1.0, 1.12, 0.9})
    for (const Vec2& shift : {Vec2(0.0, 0.0), Vec2(0.5, 0.3), Vec2(0.25, 0.0)}) {
      if (best.min_angle_deg >= good_angle_deg) return best;
      Filling other = fill(loop, density * edge, shift, name);
      open_angles(loop, other, name);
      if (other.min_angle_deg > best.min_angle_deg) best = std::move(other);
    }
  return best;
}

}  // namespace

Vec3 loop_normal(const std::vector<Vec3>& loop) {
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    normal += (loop[i] - loop[0]).cross(loop[i + 1] - loop[0]);
  return normal;
}

std::vector<Vec3> loop_points(const geometry::TriMesh& mesh, const std::vector<std::int32_t>& loop) {
  std::vector<Vec3> points;
  for (const std::int32_t v : loop) points.push_back(mesh.points[static_cast<std::size_t>(v)]);
  return points;
}

bool crosses_itself(const std::vector<Vec3>& loop) {
  const Vec3 normal = loop_normal(loop).normalized();
  return !(normal.squaredNorm() > 0.5) || has_crossing(laid(loop, normal).flat);
}

double mean_edge(const std::vector<Vec3>& loop) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) sum += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  return sum / static_cast<double>(loop.size());
}

FlatPatch triangulate_flat(const std::vector<Vec3>& loop, double edge_mm, const std::string& name,
                           double good_angle_deg) {
  if (loop.size() < 3) throw GeometryError("the border of " + name + " has fewer than three points");
  const Vec3 normal = loop_normal(loop).normalized();
  if (!(normal.squaredNorm() > 0.5)) throw GeometryError("the border of " + name + " encloses no area");
  const auto [origin, u, w, flat] = laid(loop, normal);
  if (has_crossing(flat))
    throw GeometryError("the border of " + name +
                        " crosses itself in its plane; clip the end farther inside");
  // A border much finer than its cap is wide need not make the whole cap as fine.
  constexpr double most_across = 100.0;
  const double least_edge_mm = std::sqrt(0.5 * loop_normal(loop).norm()) / most_across;
  const double wanted_mm = edge_mm > 0.0 ? edge_mm : mean_edge(loop);
  const Filling filling = best_filling(flat, std::max(wanted_mm, least_edge_mm), name, good_angle_deg);
  FlatPatch patch;
  patch.triangles = filling.triangles;
  for (const Vec2& p : filling.inner) patch.inner_points.push_back(origin + p.x() * u + p.y() * w);
  return patch;
}

}  // namespace ostia::meshing
