#include "ostia/geometry/aabb_tree.h"

#include "bvh.h"
#include "mesh_checks.h"
#include "nearest_on_triangle.h"
#include "winding.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>

namespace ostia::geometry {
namespace {

using detail::Bvh;
using detail::BvhBox;
using detail::BvhNode;
using detail::CornerPoints;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A ray in the frame where it starts at the origin and runs along +z (Woop, Benthin and Wald 2013).
struct Ray {
  Vec3 origin;
  Vec3 direction;
  Vec3 inverse;
  int kx, ky, kz;
  double sx, sy, sz;

  Ray(const Vec3& from, const Vec3& along) : origin(from) {
    const double length = along.stableNorm();
    if (!from.allFinite() || !std::isfinite(length) || !(length > 0.0)) {
      throw InvalidInput("ray: the origin must be finite and the direction finite and not zero");
    }
    direction = along / length;
    inverse = direction.cwiseInverse();
    direction.cwiseAbs().maxCoeff(&kz);
    kx = (kz + 1) % 3;
    ky = (kx + 1) % 3;
    sx = direction[kx] / direction[kz];
    sy = direction[ky] / direction[kz];
    sz = 1.0 / direction[kz];
  }

  bool meets(const BvhBox& box, double farthest) const {
    double near = 0.0, far = farthest;
    for (int a = 0; a < 3; ++a) {
      if (direction[a] == 0.0) {
        if (origin[a] < box.lower[a] || origin[a] > box.upper[a]) return false;
        continue;
      }
      double t0 = (box.lower[a] - origin[a]) * inverse[a];
      double t1 = (box.upper[a] - origin[a]) * inverse[a];
      if (t0 > t1) std::swap(t0, t1);
      // Widened by the rounding of the three operations (Ize 2013), so that no box on the ray is missed.
      near = std::max(near, t0 - 4e-16 * std::abs(t0));
      far = std::min(far, t1 + 4e-16 * std::abs(t1));
    }
    return near <= far;
  }
};

/// Twice the signed area of (ray, a, b) in the plane across the ray. A zero is settled as if the ray stood a
/// hair off towards +x and a hair of a hair towards +y, the same for every triangle: a ray through an edge or
/// a corner then hits one triangle of the fan, no more and no less.
struct BoxSide {
  double value;
  int sign;
};
BoxSide side(const Vec2& a, const Vec2& b) {
  const double value = a.x() * b.y() - a.y() * b.x();
  if (value != 0.0) return {value, value > 0.0 ? 1 : -1};
  if (a.y() != b.y()) return {0.0, a.y() > b.y() ? 1 : -1};
  if (a.x() != b.x()) return {0.0, b.x() > a.x() ? 1 : -1};
  return {0.0, 0};
}

/// Distance along the ray where it crosses the triangle; negative or NaN: nowhere.
double crossing(const Ray& ray, const CornerPoints& p) {
  Vec2 flat[3];
  double depth[3];
  for (int i = 0; i < 3; ++i) {
    const Vec3 q = p[i] - ray.origin;
    flat[i] = {q[ray.kx] - ray.sx * q[ray.kz], q[ray.ky] - ray.sy * q[ray.kz]};
    depth[i] = ray.sz * q[ray.kz];
  }
  const BoxSide u = side(flat[1], flat[2]), v = side(flat[2], flat[0]), w = side(flat[0], flat[1]);
  if (u.sign == 0 || u.sign != v.sign || v.sign != w.sign) return -1.0;
  const double sum = u.value + v.value + w.value;
  if (sum == 0.0) return -1.0;
  return (u.value * depth[0] + v.value * depth[1] + w.value * depth[2]) / sum;
}

}  // namespace

struct AabbTree::Impl {
  Bvh bvh;
  std::vector<CornerPoints> triangles;  // in the order of the leaves
  std::vector<char> needles;
  std::vector<detail::TrianglePlane> planes;

  /// Made when it is first asked for: most trees are only asked for distances and hits.
  const detail::WindingTree& winding() const {
    std::call_once(winding_made_, [&] { winding_ = detail::WindingTree(bvh, triangles); });
    return winding_;
  }

  explicit Impl(const TriMesh& mesh) {
    if (mesh.triangles.empty()) throw InvalidInput("AABB tree: the surface has no triangles");
    detail::check_indices(mesh, "AABB tree");
    detail::check_finite(mesh, "AABB tree");
    std::vector<BvhBox> boxes(mesh.triangles.size(), BvhBox::nothing());
    for (std::size_t t = 0; t < boxes.size(); ++t) {
      for (int i = 0; i < 3; ++i) boxes[t].extend(detail::corner(mesh, mesh.triangles[t], i).data());
    }
    bvh = detail::build_bvh(boxes);
    triangles.resize(boxes.size());
    needles.resize(boxes.size());
    planes.resize(boxes.size());
    for (std::size_t place = 0; place < boxes.size(); ++place) {
      const Triangle& triangle = mesh.triangles[static_cast<std::size_t>(bvh.order[place])];
      for (int i = 0; i < 3; ++i) triangles[place][i] = detail::corner(mesh, triangle, i);
      needles[place] = detail::is_needle(triangles[place]) ? 1 : 0;
      planes[place] = detail::TrianglePlane(triangles[place]);
    }
  }

  /// The nearest point with squared distance below `bound`; triangle -1 when there is none.
  SurfacePoint nearest(const Vec3& query, double bound) const;
  /// Calls found(t, place) for each triangle that the ray crosses at t <= farthest; found may lower
  /// `farthest`.
  template <class Found>
  void trace(const Ray& ray, double& farthest, const Found& found) const;

 private:
  mutable std::once_flag winding_made_;
  mutable detail::WindingTree winding_;
};

AabbTree::AabbTree(const TriMesh& mesh) : impl_(std::make_unique<Impl>(mesh)) {}
AabbTree::~AabbTree() = default;
AabbTree::AabbTree(AabbTree&&) noexcept = default;
AabbTree& AabbTree::operator=(AabbTree&&) noexcept = default;

SurfacePoint AabbTree::Impl::nearest(const Vec3& query, double bound) const {
  detail::Nearest best;
  best.squared = bound;
  std::int32_t place = -1;
  detail::search_nearest(bvh, triangles, needles, planes, query, best, place);
  return detail::surface_point(bvh, triangles, query, best, place);
}

template <class Found>
void AabbTree::Impl::trace(const Ray& ray, double& farthest, const Found& found) const {
  std::int32_t stack[detail::bvh_stack_size];
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::int32_t index = stack[--size];
    const BvhNode& node = bvh.nodes[static_cast<std::size_t>(index)];
    if (!ray.meets(node.box, farthest)) continue;
    if (node.count == 0) {
      const BvhBox& left = bvh.nodes[static_cast<std::size_t>(index) + 1].box;
      const BvhBox& right = bvh.nodes[static_cast<std::size_t>(node.next)].box;
      double lead = 0.0;  // how far the right child's middle lies beyond the left one's
      for (int a = 0; a < 3; ++a) {
        lead += ray.direction[a] * (right.lower[a] + right.upper[a] - left.lower[a] - left.upper[a]);
      }
      stack[size++] = lead >= 0.0 ? node.next : index + 1;
      stack[size++] = lead >= 0.0 ? index + 1 : node.next;
      continue;
    }
    for (std::int32_t place = node.next; place < node.next + node.count; ++place) {
      const double t = crossing(ray, triangles[static_cast<std::size_t>(place)]);
      if (t >= 0.0 && t <= farthest) found(t, bvh.order[static_cast<std::size_t>(place)]);
    }
  }
}

SurfacePoint AabbTree::closest(const Vec3& query) const {
  if (!query.allFinite())
    throw InvalidInput("AABB tree: the query point has a coordinate that is not finite");
  return impl_->nearest(query, infinity);
}

std::optional<SurfacePoint> AabbTree::closest_within(const Vec3& query, double max_distance) const {
  if (!query.allFinite())
    throw InvalidInput("AABB tree: the query point has a coordinate that is not finite");
  if (!(max_distance >= 0.0)) {
    throw InvalidInput("AABB tree: the largest distance is " + std::to_string(max_distance) +
                       " mm; it must be 0 or more");
  }
  const SurfacePoint result = impl_->nearest(query, std::nextafter(max_distance * max_distance, infinity));
  if (result.triangle < 0) return std::nullopt;
  return result;
}

std::optional<RayHit> AabbTree::first_hit(const Vec3& origin, const Vec3& direction) const {
  const Ray ray(origin, direction);
  std::optional<RayHit> best;
  double farthest = infinity;
  impl_->trace(ray, farthest, [&](double t, std::int32_t triangle) {
    if (best && t == best->t && triangle > best->triangle) return;
    best = RayHit{t, triangle, ray.origin + t * ray.direction};
    farthest = t;
  });
  return best;
}

std::vector<RayHit> AabbTree::all_hits(const Vec3& origin, const Vec3& direction) const {
  const Ray ray(origin, direction);
  std::vector<RayHit> hits;
  double farthest = infinity;
  impl_->trace(ray, farthest, [&](double t, std::int32_t triangle) {
    hits.push_back({t, triangle, ray.origin + t * ray.direction});
  });
  std::sort(hits.begin(), hits.end(), [](const RayHit& a, const RayHit& b) {
    return a.t < b.t || (a.t == b.t && a.triangle < b.triangle);
  });
  return hits;
}

double AabbTree::winding_number(const Vec3& query) const {
  if (!query.allFinite())
    throw InvalidInput("AABB tree: the query point has a coordinate that is not finite");
  return impl_->winding().at(query, impl_->triangles);
}

double AabbTree::signed_distance(const Vec3& query) const {
  const double distance = closest(query).distance;
  return inside(query) ? -distance : distance;
}

}  // namespace ostia::geometry
