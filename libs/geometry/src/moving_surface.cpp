#include "ostia/geometry/moving_surface.h"

#include "mesh_checks.h"
#include "nearest_on_triangle.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <string>

namespace ostia::geometry {

using detail::BvhBox;
using detail::BvhNode;
using detail::CornerPoints;

struct MovingSurface::Impl {
  std::size_t points = 0;
  std::vector<Triangle> corners;  // in the order of the leaves, as all that follows
  detail::Bvh bvh;
  std::vector<std::int32_t> place_of;  // of each triangle
  std::vector<CornerPoints> triangles;
  std::vector<char> needles;
  std::vector<detail::TrianglePlane> planes;

  explicit Impl(const TriMesh& mesh) : points(mesh.points.size()) {
    if (mesh.triangles.empty()) throw InvalidInput("moving surface: the surface has no triangles");
    detail::check_indices(mesh, "moving surface");
    detail::check_finite(mesh, "moving surface");
    const std::size_t count = mesh.triangles.size();
    std::vector<BvhBox> boxes(count, BvhBox::nothing());
    for (std::size_t t = 0; t < count; ++t)
      for (int i = 0; i < 3; ++i) boxes[t].extend(detail::corner(mesh, mesh.triangles[t], i).data());
    bvh = detail::build_bvh(boxes);
    corners.resize(count);
    place_of.resize(count);
    triangles.resize(count);
    needles.resize(count);
    planes.resize(count);
    for (std::size_t place = 0; place < count; ++place) {
      const auto t = static_cast<std::size_t>(bvh.order[place]);
      corners[place] = mesh.triangles[t];
      place_of[t] = static_cast<std::int32_t>(place);
    }
    move(mesh.points);
  }

  void move(const std::vector<Vec3>& to) {
    core::parallel_for(triangles.size(), 1024, [&](std::size_t place) {
      for (std::size_t i = 0; i < 3; ++i)
        triangles[place][i] = to[static_cast<std::size_t>(corners[place][i])];
      needles[place] = detail::is_needle(triangles[place]) ? 1 : 0;
      planes[place] = detail::TrianglePlane(triangles[place]);
    });
    // Children come after their parents.
    for (std::size_t n = bvh.nodes.size(); n-- > 0;) {
      BvhNode& node = bvh.nodes[n];
      node.box = BvhBox::nothing();
      if (node.count == 0) {
        node.box.extend(bvh.nodes[n + 1].box);
        node.box.extend(bvh.nodes[static_cast<std::size_t>(node.next)].box);
        continue;
      }
      for (std::int32_t place = node.next; place < node.next + node.count; ++place)
        for (const Vec3& p : triangles[static_cast<std::size_t>(place)]) node.box.extend(p.data());
    }
  }
};

MovingSurface::MovingSurface(const TriMesh& mesh) : impl_(std::make_unique<Impl>(mesh)) {}
MovingSurface::~MovingSurface() = default;
MovingSurface::MovingSurface(MovingSurface&&) noexcept = default;
MovingSurface& MovingSurface::operator=(MovingSurface&&) noexcept = default;

void MovingSurface::move(const std::vector<Vec3>& points) {
  if (points.size() != impl_->points)
    throw InvalidInput("moving surface: " + std::to_string(points.size()) + " points for a surface of " +
                       std::to_string(impl_->points));
  if (!std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); }))
    throw InvalidInput("moving surface: a point is moved to a place that is not finite");
  impl_->move(points);
}

SurfacePoint MovingSurface::closest(const Vec3& query, std::int32_t near) const {
  if (!query.allFinite())
    throw InvalidInput("moving surface: the query point has a coordinate that is not finite");
  detail::Nearest best;
  std::int32_t place = -1;
  if (near >= 0 && static_cast<std::size_t>(near) < impl_->place_of.size()) {
    place = impl_->place_of[static_cast<std::size_t>(near)];
    const auto i = static_cast<std::size_t>(place);
    best = detail::nearest_on_triangle(impl_->triangles[i], impl_->needles[i] != 0, query);
  }
  detail::search_nearest(impl_->bvh, impl_->triangles, impl_->needles, impl_->planes, query, best, place);
  return detail::surface_point(impl_->bvh, impl_->triangles, query, best, place);
}

}  // namespace ostia::geometry
