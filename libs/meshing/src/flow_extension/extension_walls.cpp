#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/faces.h"
#include "ostia/meshing/flow_extension.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

/// Of an edge of the triangle: nearer to the lumen it is the lumen's, though its seam may have been evened.
constexpr double same_share = 0.05;

Vec3 centroid_of(const std::vector<Vec3>& points, const geometry::Triangle& triangle) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t v : triangle) sum += points[static_cast<std::size_t>(v)];
  return sum / 3.0;
}

/// Tells places on the lumen's wall from those on extensions, by the nearest triangle of the extended
/// surface.
class ExtensionSides {
 public:
  ExtensionSides(const geometry::TriMesh& lumen, const geometry::TriMesh& extended) : surface_(extended) {
    const geometry::AabbTree before(lumen);
    for (const geometry::Triangle& t : extended.triangles) {
      const auto p = [&](std::size_t i) { return extended.points[static_cast<std::size_t>(t[i])]; };
      const double edge = std::max({(p(1) - p(0)).norm(), (p(2) - p(1)).norm(), (p(0) - p(2)).norm()});
      beyond_.push_back(!before.closest_within(centroid_of(extended.points, t), same_share * edge));
    }
  }
  bool any() const { return std::ranges::find(beyond_, true) != beyond_.end(); }
  bool on_extension(const Vec3& place) const {
    return beyond_[static_cast<std::size_t>(surface_.closest(place).triangle)];
  }

 private:
  geometry::AabbTree surface_;
  std::vector<bool> beyond_;
};

void mark(const ExtensionSides& sides, const std::vector<Vec3>& points,
          const std::vector<geometry::Triangle>& triangles, std::vector<geometry::Face>& faces,
          std::vector<std::int32_t>& ids) {
  if (faces.empty()) return;
  const geometry::FacesByKind kinds(faces);
  const std::int32_t own = 1 + std::ranges::max_element(faces, {}, &geometry::Face::id)->id;
  bool any = false;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!kinds.wall(ids[i]) || !sides.on_extension(centroid_of(points, triangles[i]))) continue;
    ids[i] = own;
    any = true;
  }
  if (any) faces.push_back({own, extension_wall_name, geometry::FaceKind::wall});
}

}  // namespace

void mark_extension_walls(const ClippedSurface& clipped, const geometry::TriMesh& extended,
                          geometry::FacedSurface& surface, geometry::MixedMesh& mesh) {
  const ExtensionSides sides(clipped.mesh, extended);
  if (!sides.any()) return;
  mark(sides, surface.mesh.points, surface.mesh.triangles, surface.faces, surface.face_ids);
  mark(sides, mesh.points, mesh.triangles, mesh.faces, mesh.triangle_face_ids);
}

}  // namespace ostia::meshing
