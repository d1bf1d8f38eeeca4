#pragma once
/// \file Closest points on a surface whose points move while its triangles stay.

#include "ostia/geometry/aabb_tree.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ostia::geometry {

/// A bounding-volume hierarchy that is built once; its boxes follow the points. Where the surface is bent far
/// from what it was, queries take longer, but find the same. Holds its own copy of the triangles. Queries are
/// const and safe from many threads, but not while the points move.
class MovingSurface {
 public:
  /// Throws InvalidInput for a surface without triangles, or with points that are not finite.
  explicit MovingSurface(const TriMesh& mesh);
  ~MovingSurface();
  MovingSurface(MovingSurface&&) noexcept;
  MovingSurface& operator=(MovingSurface&&) noexcept;

  /// As many points as the mesh had, finite; else InvalidInput.
  void move(const std::vector<Vec3>& points);
  /// `near` is a triangle that may be close, as that of the last query from about here: it only saves time
  /// (and is kept where others are exactly as close). -1: none is known. Throws InvalidInput for a query that
  /// is not finite.
  SurfacePoint closest(const Vec3& query, std::int32_t near = -1) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::geometry
