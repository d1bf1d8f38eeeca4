#pragma once
/// \file Closest points, rays and distances on a triangle surface.

#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ostia::geometry {

struct SurfacePoint {
  Vec3 point = Vec3::Zero();
  std::int32_t triangle = -1;
  Vec3 barycentric = Vec3::Zero();  ///< weights of the triangle's three corners
  double distance = 0.0;            ///< mm, >= 0
};

struct RayHit {
  double t = 0.0;  ///< distance along the unit direction, mm
  std::int32_t triangle = -1;
  Vec3 point = Vec3::Zero();
};

/// A bounding-volume hierarchy over a mesh, built once and queried often. Holds its own copy of the geometry.
/// Queries are const and safe from many threads. Triangles without area count as the segments or points that
/// they are. An empty mesh, points or queries that are not finite and a direction of zero throw InvalidInput.
class AabbTree {
 public:
  explicit AabbTree(const TriMesh& mesh);
  ~AabbTree();
  AabbTree(AabbTree&&) noexcept;
  AabbTree& operator=(AabbTree&&) noexcept;

  SurfacePoint closest(const Vec3& query) const;
  /// Nothing when farther than `max_distance` mm.
  std::optional<SurfacePoint> closest_within(const Vec3& query, double max_distance) const;
  /// The direction need not be of unit length. A ray through an edge or a corner that it crosses hits one of
  /// the triangles there, never none or two; a triangle seen edge-on is not hit.
  std::optional<RayHit> first_hit(const Vec3& origin, const Vec3& direction) const;
  std::vector<RayHit> all_hits(const Vec3& origin, const Vec3& direction) const;  ///< sorted by t
  /// Generalised winding number (exact sum near, Barill et al. 2018's second-order expansion far, together
  /// within 0.01): robust to needles, small holes and self-intersections. 1 inside a closed outward surface,
  /// 0 outside.
  double winding_number(const Vec3& query) const;
  bool inside(const Vec3& query) const { return winding_number(query) > 0.5; }
  /// Negative inside.
  double signed_distance(const Vec3& query) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Pairs of triangles that intersect or touch beyond the vertices and edges they share, each pair once, lower
/// index first, sorted. Points with equal coordinates count as one vertex, so an unwelded surface is judged
/// as a welded one. Exact predicates. Triangles without area or with points that are not finite are left out:
/// find_faults counts them. `max_pairs` ends the search early with that many (0: all).
std::vector<std::pair<std::int32_t, std::int32_t>> self_intersections(const TriMesh& mesh,
                                                                      std::size_t max_pairs = 0);

/// Of these pairs only those of which at least one triangle is marked (not 0), as where only a part of a
/// surface has changed. Throws InvalidInput where there is not a mark for each triangle.
std::vector<std::pair<std::int32_t, std::int32_t>> self_intersections(const TriMesh& mesh,
                                                                      const std::vector<std::uint8_t>& marks);

}  // namespace ostia::geometry
