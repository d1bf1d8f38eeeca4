#pragma once
/// \file Facets of a mesh's boundary taken over with points of their own.

#include "ostia/geometry/mixed_mesh.h"

#include <vector>

namespace ostia::solver {

/// Calls `take(corners)` with the three or four points of each facet of a face: triangles, then
/// quadrilaterals.
template <class Take>
void for_facets_of(const geometry::MixedMesh& mesh, std::int32_t face_id, const Take& take) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (mesh.triangle_face_ids[i] == face_id) take(mesh.triangles[i]);
  for (std::size_t i = 0; i < mesh.quads.size(); ++i)
    if (mesh.quad_face_ids[i] == face_id) take(mesh.quads[i]);
}

/// Numbers those of a mesh's points that are asked for, in the order in which they are.
class OwnPoints {
 public:
  /// `points` receives the places.
  OwnPoints(const geometry::MixedMesh& mesh, std::vector<geometry::Vec3>& points)
      : mesh_(mesh), points_(points), places_(mesh.points.size(), -1) {}

  std::int32_t operator()(std::int32_t mesh_point) {
    std::int32_t& place = places_[static_cast<std::size_t>(mesh_point)];
    if (place < 0) {
      place = static_cast<std::int32_t>(taken_.size());
      taken_.push_back(mesh_point);
      points_.push_back(mesh_.points[static_cast<std::size_t>(mesh_point)]);
    }
    return place;
  }
  /// The mesh's number of each.
  const std::vector<std::int32_t>& taken() const { return taken_; }

 private:
  const geometry::MixedMesh& mesh_;
  std::vector<geometry::Vec3>& points_;
  std::vector<std::int32_t> places_, taken_;
};

}  // namespace ostia::solver
