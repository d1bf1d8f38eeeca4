#include "ostia/meshing/quality.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace ostia::meshing {

using core::trimmed_text;
using geometry::Vec3;

namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

double angle_deg(const Vec3& u, const Vec3& v) {
  return degrees * std::atan2(u.cross(v).norm(), u.dot(v));
}

struct Edge {
  std::int32_t low, high;
  bool forward;
};

std::vector<Edge> sorted_edges(const geometry::TriMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const geometry::Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = t[i], b = t[(i + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
    return std::tie(x.low, x.high, x.forward) < std::tie(y.low, y.high, y.forward);
  });
  return edges;
}

}  // namespace

double min_angle_deg(const Vec3& a, const Vec3& b, const Vec3& c) {
  if ((b - a).cross(c - a).squaredNorm() == 0.0) return 0.0;
  return std::min({angle_deg(b - a, c - a), angle_deg(c - b, a - b), angle_deg(a - c, b - c)});
}

double frobenius_aspect(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double twice_area = (b - a).cross(c - a).norm();
  const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return twice_area > 0.0 ? squares / (2.0 * std::sqrt(3.0) * twice_area)
                          : std::numeric_limits<double>::infinity();
}

std::array<double, 2> dihedral_range_deg(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const std::array<const Vec3*, 4> p{&a, &b, &c, &d};
  constexpr std::array<std::array<std::size_t, 4>, 6> edges{
      {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
  if ((b - a).cross(c - a).dot(d - a) == 0.0) return {0.0, 180.0};
  std::array<double, 2> range{180.0, 0.0};
  for (const auto& e : edges) {
    const Vec3 axis = *p[e[1]] - *p[e[0]];
    // Both other corners seen along the edge.
    const Vec3 u = axis.cross(*p[e[2]] - *p[e[0]]), v = axis.cross(*p[e[3]] - *p[e[0]]);
    const double angle = angle_deg(u, v);
    range = {std::min(range[0], angle), std::max(range[1], angle)};
  }
  return range;
}

double scaled_jacobian(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double det = (b - a).cross(c - a).dot(d - a);
  const double ab = (b - a).norm(), ac = (c - a).norm(), ad = (d - a).norm();
  const double bc = (c - b).norm(), bd = (d - b).norm(), cd = (d - c).norm();
  const double largest = std::max({ab * ac * ad, ab * bc * bd, ac * bc * cd, ad * bd * cd});
  return largest > 0.0 ? std::sqrt(2.0) * det / largest : 0.0;
}

SurfaceQuality surface_quality(const geometry::TriMesh& mesh, bool with_self_intersections,
                               const core::TaskContext& task) {
  SurfaceQuality q;
  q.points = mesh.points.size();
  q.triangles = mesh.triangles.size();
  if (mesh.triangles.empty()) return q;
  q.min_angle_deg = 180.0;
  for (const geometry::Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.points[static_cast<std::size_t>(t[0])],
               &b = mesh.points[static_cast<std::size_t>(t[1])],
               &c = mesh.points[static_cast<std::size_t>(t[2])];
    const double angle = min_angle_deg(a, b, c), aspect = frobenius_aspect(a, b, c);
    q.min_angle_deg = std::min(q.min_angle_deg, angle);
    q.mean_min_angle_deg += angle / static_cast<double>(q.triangles);
    q.max_frobenius_aspect = std::max(q.max_frobenius_aspect, aspect);
    q.mean_frobenius_aspect += aspect / static_cast<double>(q.triangles);
  }
  task.throw_if_cancelled();
  std::vector<std::size_t> valence(mesh.points.size(), 0);
  const auto edges = sorted_edges(mesh);
  double unique = 0.0;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i, forward = 0;
    for (; j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high; ++j)
      forward += edges[j].forward ? 1 : 0;
    if (j - i == 1) ++q.open_edges;
    if (j - i > 2) ++q.non_manifold_edges;
    if (j - i == 2 && forward != 1) ++q.inconsistent_edges;
    const auto a = static_cast<std::size_t>(edges[i].low), b = static_cast<std::size_t>(edges[i].high);
    ++valence[a];
    ++valence[b];
    q.mean_edge_mm += (mesh.points[a] - mesh.points[b]).norm();
    unique += 1.0;
    i = j;
  }
  q.mean_edge_mm /= unique;
  for (const std::size_t n : valence)
    if (n > 0) ++q.valence[std::min<std::size_t>(n, q.valence.size() - 1)];
  q.area_mm2 = geometry::area(mesh);
  if (q.open_edges == 0) q.volume_mm3 = geometry::volume(mesh);
  task.throw_if_cancelled();
  if (with_self_intersections) q.self_intersections = geometry::self_intersections(mesh).size();
  return q;
}

VolumeQuality volume_quality(const geometry::VolumeMesh& mesh, const core::TaskContext& task) {
  VolumeQuality q;
  q.points = mesh.points.size();
  q.tetrahedra = mesh.tetrahedra.size();
  q.boundary_triangles = mesh.boundary.size();
  if (mesh.tetrahedra.empty()) return q;
  q.min_dihedral_deg = 180.0;
  q.min_scaled_jacobian = 1.0;
  const auto count = static_cast<double>(q.tetrahedra);
  // Each face of a tetrahedron outward; inner faces come twice, turned against each other.
  constexpr std::array<std::array<std::size_t, 3>, 4> faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  std::vector<std::array<std::int32_t, 4>> sides;
  sides.reserve(4 * q.tetrahedra + mesh.boundary.size());
  auto add_side = [&](std::array<std::int32_t, 3> t, std::int32_t sign) {
    // Sorting a triangle by swaps; an odd number of them turns it over.
    if (t[0] > t[1]) std::swap(t[0], t[1]), sign = -sign;
    if (t[1] > t[2]) std::swap(t[1], t[2]), sign = -sign;
    if (t[0] > t[1]) std::swap(t[0], t[1]), sign = -sign;
    sides.push_back({t[0], t[1], t[2], sign});
  };
  double edges = 0.0;
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    if (i % 65536 == 0) task.throw_if_cancelled();
    const geometry::Tetrahedron& t = mesh.tetrahedra[i];
    const Vec3 &a = mesh.points[static_cast<std::size_t>(t[0])],
               &b = mesh.points[static_cast<std::size_t>(t[1])],
               &c = mesh.points[static_cast<std::size_t>(t[2])],
               &d = mesh.points[static_cast<std::size_t>(t[3])];
    const auto range = dihedral_range_deg(a, b, c, d);
    q.min_dihedral_deg = std::min(q.min_dihedral_deg, range[0]);
    q.max_dihedral_deg = std::max(q.max_dihedral_deg, range[1]);
    q.mean_min_dihedral_deg += range[0] / count;
    ++q.min_dihedral_histogram[std::min<std::size_t>(static_cast<std::size_t>(range[0] / 5.0), 17)];
    const double jacobian = scaled_jacobian(a, b, c, d);
    q.min_scaled_jacobian = std::min(q.min_scaled_jacobian, jacobian);
    q.mean_scaled_jacobian += jacobian / count;
    const double six_volumes = (b - a).cross(c - a).dot(d - a);
    if (!(six_volumes > 0.0)) ++q.inverted;
    q.volume_mm3 += six_volumes / 6.0;
    edges +=
        (b - a).norm() + (c - a).norm() + (d - a).norm() + (c - b).norm() + (d - b).norm() + (d - c).norm();
    for (const auto& f : faces) add_side({t[f[0]], t[f[1]], t[f[2]]}, 1);
  }
  q.mean_edge_mm = edges / (6.0 * count);
  for (const geometry::Triangle& t : mesh.boundary) add_side({t[0], t[2], t[1]}, 1);  // as from outside
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i;
    std::int32_t sum = 0;
    for (; j < sides.size() && std::equal(sides[j].begin(), sides[j].begin() + 3, sides[i].begin()); ++j)
      sum += sides[j][3];
    if (sum != 0 || j - i != 2) ++q.boundary_mismatches;
    i = j;
  }
  return q;
}

void validate(const QualityBounds& b) {
  auto refuse = [](const std::string& what) { throw InvalidInput("quality bounds: " + what); };
  if (!(b.min_angle_deg >= 0.0 && b.min_angle_deg < 60.0))
    refuse("min_angle_deg must lie in [0, 60) degrees");
  if (!(b.max_frobenius_aspect >= 1.0)) refuse("max_frobenius_aspect must be at least 1");
}

std::string QualityVerdict::summary() const {
  if (ok()) return "passed";
  std::string text;
  for (const std::string& reason : reasons) text += (text.empty() ? "" : "; ") + reason;
  return text;
}

QualityVerdict check(const SurfaceQuality& q, const QualityBounds& bounds) {
  validate(bounds);
  QualityVerdict verdict;
  auto none = [&](std::size_t count, const std::string& what) {
    if (count > 0) verdict.reasons.push_back(std::to_string(count) + " " + what);
  };
  if (q.triangles == 0) verdict.reasons.push_back("no triangles");
  none(q.open_edges, "open edges");
  none(q.non_manifold_edges, "non-manifold edges");
  none(q.inconsistent_edges, "edges whose triangles are turned against each other");
  none(q.self_intersections, "self-intersections");
  if (q.triangles > 0 && q.open_edges == 0 && !(q.volume_mm3 > 0.0))
    verdict.reasons.push_back("volume " + trimmed_text(q.volume_mm3, 6) + " mm3: the surface points inward");
  if (!(q.min_angle_deg >= bounds.min_angle_deg))
    verdict.reasons.push_back("smallest angle " + trimmed_text(q.min_angle_deg, 6) + " degrees is below " +
                              trimmed_text(bounds.min_angle_deg, 6));
  if (!(q.max_frobenius_aspect <= bounds.max_frobenius_aspect))
    verdict.reasons.push_back("largest Frobenius aspect ratio " + trimmed_text(q.max_frobenius_aspect, 6) +
                              " is above " + trimmed_text(bounds.max_frobenius_aspect, 6));
  return verdict;
}

}  // namespace ostia::meshing
