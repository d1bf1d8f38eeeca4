#pragma once
/// \file Surfaces that the tests of boundary layers grow on.

#include "cutting/cap_filling.h"
#include "test_surfaces.h"

#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace ostia::meshing {

/// A shape clipped, capped and remeshed at `edge_ratio` of the distance to the axis.
inline geometry::FacedSurface remeshed(const geometry::AnalyticShape& shape, double spacing_mm,
                                       double edge_ratio = 0.4) {
  const geometry::FacedSurface input = capped(shape, spacing_mm, false);
  SizingOptions sizing;
  sizing.edge_ratio = edge_ratio;
  return remesh(input, target_edge_lengths(input.mesh, TubeFunction(tree_of(shape)), sizing)).surface;
}

/// A regular tube along z from 0: rings of `around` points, `step` apart, each rectangle cut by the same
/// diagonal, with a cap at both ends.
inline geometry::FacedSurface structured_tube(std::int32_t around, double radius, double step,
                                              std::int32_t rings) {
  geometry::FacedSurface surface;
  for (std::int32_t j = 0; j <= rings; ++j)
    for (std::int32_t i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / around;
      surface.mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), j * step);
    }
  for (std::int32_t j = 0; j < rings; ++j)
    for (std::int32_t i = 0; i < around; ++i) {
      const std::int32_t a = j * around + i, b = j * around + (i + 1) % around;
      surface.mesh.triangles.push_back({a, b, b + around});
      surface.mesh.triangles.push_back({a, b + around, a + around});
    }
  surface.face_ids.assign(surface.mesh.triangles.size(), 1);
  surface.faces = {{1, "wall", geometry::FaceKind::wall},
                   {2, "inlet_tube", geometry::FaceKind::inlet},
                   {3, "outlet_tube", geometry::FaceKind::outlet}};
  std::vector<std::int32_t> bottom, top;  // in the order of the wall's winding
  for (std::int32_t i = 0; i < around; ++i)
    bottom.push_back(i), top.push_back(rings * around + around - 1 - i);
  fill_cap(surface, bottom, 1.0, surface.faces[1]);
  fill_cap(surface, top, 1.0, surface.faces[2]);
  return surface;
}

}  // namespace ostia::meshing
