#pragma once
/// \file Surfaces that the tests of this library share.

#include "shape_tree.h"

#include "ostia/geometry/analytic_shapes.h"
#include "ostia/meshing/caps.h"
#include "ostia/meshing/clip.h"

namespace ostia::meshing {

/// The outward surface of a unit tetrahedron's corners scaled to `edge`.
inline geometry::TriMesh tetrahedron_surface(double edge) {
  const double s = edge / std::sqrt(8.0);
  return {{{s, s, s}, {-s, -s, s}, {-s, s, -s}, {s, -s, -s}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// A flat n by n grid of unit squares, each of two triangles.
inline geometry::TriMesh grid_surface(std::int32_t n) {
  geometry::TriMesh mesh;
  for (std::int32_t j = 0; j <= n; ++j)
    for (std::int32_t i = 0; i <= n; ++i) mesh.points.emplace_back(i, j, 0.0);
  for (std::int32_t j = 0; j < n; ++j)
    for (std::int32_t i = 0; i < n; ++i) {
      const std::int32_t v = j * (n + 1) + i;
      mesh.triangles.push_back({v, v + 1, v + n + 2});
      mesh.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  return mesh;
}

/// A straight tube along z from 0, radius 1.5 mm, with both ends capped.
inline geometry::FacedSurface capped_tube(double length_mm = 12.0) {
  const auto shape = geometry::straight_tube(length_mm, 1.5);
  return cap_ends(clip_ends(geometry::surface_of(shape, 0.25, true), tree_of(shape)));
}

inline geometry::FacedSurface capped(const geometry::AnalyticShape& shape, double spacing_mm, bool raw) {
  const geometry::TriMesh surface = raw ? geometry::raw_surface_of(shape, spacing_mm, false)
                                        : geometry::surface_of(shape, spacing_mm, false);
  return cap_ends(clip_ends(surface, tree_of(shape)));
}

}  // namespace ostia::meshing
