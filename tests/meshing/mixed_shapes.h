#pragma once
/// \file Meshes that the tests of quality and of quadratic elements share.

#include "boundary_layer_shapes.h"

#include "ostia/meshing/boundary_layer.h"
#include "ostia/meshing/tetrahedralize.h"

#include <cmath>
#include <numbers>

namespace ostia::meshing {

/// A tube of radius 1.5 mm as a regular surface, filled: with layers, or with tetrahedra alone for 0.
inline geometry::MixedMesh filled_tube(std::int32_t around, int layers, double thickness,
                                       double length_mm = 3.0) {
  const double radius = 1.5, step = 2.0 * std::numbers::pi * radius / around;
  const auto rings = static_cast<std::int32_t>(std::lround(length_mm / step));
  const geometry::FacedSurface surface = structured_tube(around, radius, length_mm / rings, rings);
  if (layers == 0) return geometry::mixed(tetrahedralize(surface).mesh);
  BoundaryLayerOptions options;
  options.layers = layers;
  options.thickness = thickness;
  return fill_with_layers(surface, options).mesh;
}

/// The wall of the same tube so fine that it is the cylinder to 1e-9 of its radius: long strips.
inline geometry::TriMesh cylinder_reference(double radius, double length_mm, std::int32_t around = 80000) {
  geometry::TriMesh mesh;
  for (std::int32_t j = 0; j < 2; ++j)
    for (std::int32_t i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / around;
      mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), j * length_mm);
    }
  for (std::int32_t i = 0; i < around; ++i) {
    const std::int32_t b = (i + 1) % around;
    mesh.triangles.push_back({i, b, b + around});
    mesh.triangles.push_back({i, b + around, i + around});
  }
  return mesh;
}

}  // namespace ostia::meshing
