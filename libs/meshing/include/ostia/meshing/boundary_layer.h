#pragma once
/// \file Layers of prisms on the wall whose thickness follows the local size ([Antiga] 6.2; Garimella and
/// Shephard 2000; Dyedov et al. 2009). See docs/methods/boundary-layer.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/tetrahedralize.h"

#include <array>
#include <string>
#include <vector>

namespace ostia::meshing {

using PrismCorners = std::array<geometry::Vec3, 6>;  ///< in the order of geometry::Prism

/// Bernstein coefficients of the Jacobian's determinant of a linear prism, mm3: it is of degree 1 in the
/// triangle and 2 between the triangles, so these nine bound it from both sides. All positive: the map is
/// positive everywhere. First the three corners of 0-1-2, then those between, then those of 3-4-5.
std::array<double, 9> prism_jacobian_coefficients(const PrismCorners& p);
/// Volume of the prism with bilinear sides, mm3: the mean of the coefficients over two.
double prism_volume(const PrismCorners& p);
/// Least over the six corners of 2 / sqrt(3) times the determinant of the unit edges there: 1 for a right
/// prism on an equilateral triangle however thin it is, negative when a corner is inverted, 0 when
/// degenerate.
double prism_scaled_jacobian(const PrismCorners& p);

struct BoundaryLayerOptions {
  int layers = 2;           ///< in [1, 20]
  double thickness = 0.25;  ///< of all layers together, over the wall's local edge; in (0, 3]
  double growth = 1.2;      ///< of a layer's thickness over that of the next nearer the wall; in [1, 3]
  double largest_fraction_of_radius = 0.5;  ///< of the largest ball inside that touches the wall; in (0, 0.8]
  double gradation = 0.4;  ///< growth of a limited thickness along the wall, mm per mm; in [0.05, 2]
  double min_scaled_jacobian = 0.1;  ///< of every prism; in [0.01, 0.5]
  double min_angle_deg = 15.0;       ///< of the inner surface's triangles; in [0, 30]
  int max_rounds = 300;              ///< of thinning where something is not yet valid; in [1, 10000]
};
void validate(const BoundaryLayerOptions& options);

/// A place where there was no room for the full thickness: the thinnest point of its surroundings.
struct ThinPlace {
  geometry::Vec3 point = geometry::Vec3::Zero();  ///< on the wall, mm
  double thickness_mm = 0.0, wanted_mm = 0.0;
};

struct BoundaryLayerReport {
  std::size_t prisms = 0;
  std::size_t inverted = 0;  ///< prisms whose Jacobian is not shown positive everywhere: 0
  double full_share = 0.0;   ///< of the wall's area where the layers have the thickness asked for
  double min_scaled_jacobian = 0.0, mean_scaled_jacobian = 0.0;
  double min_inner_angle_deg = 0.0;             ///< of the inner surface, caps included
  std::vector<double> thickness_mm, wanted_mm;  ///< at each wall point, along the marching direction
  std::vector<ThinPlace> thin_places;           ///< at most ten, the relatively thinnest first
  int rounds = 0;                               ///< of thinning that were needed
  std::vector<std::string> warnings;
};

/// Layers of prisms and what is left inside. With n wall points and N layers there are n (N + 1) points: the
/// wall's own, in the surface's order and bit for bit, then layer after layer; point i of layer k is k n + i.
struct BoundaryLayer {
  std::vector<geometry::Vec3> points;
  std::vector<geometry::Prism> prisms;  ///< column after column, each from the wall inward
  geometry::TriMesh wall;               ///< the n wall points and the wall's triangles, outward
  std::vector<std::int32_t> wall_face_ids;
  std::vector<geometry::Quad> quads;  ///< the layers' sides in the caps' planes, outward
  std::vector<std::int32_t> quad_face_ids;
  geometry::FacedSurface inner;  ///< closed, outward: point i < n is point N n + i, then points inside caps
  BoundaryLayerReport report;
};

/// Layers on the walls of a closed, outward surface with flat caps, as `remesh` returns it. The thickness
/// asked for is `thickness` times the local edge (mean edge at a point, averaged twice over its neighbours);
/// the layers' thicknesses are a geometric series with the thinnest at the wall. Where there is no room they
/// get thinner, never fewer. Every prism has min_scaled_jacobian, unless the wall itself folds so sharply
/// that no direction allows it at any thickness (told in a warning), and positive Bernstein coefficients; the
/// inner surface does not cross itself or the wall. Deterministic. Throws InvalidInput (options, face ids, no
/// cap), GeometryError (open, inward or self-intersecting surface, caps not flat, no direction sees all
/// triangles around a point, validity not reached), Cancelled.
BoundaryLayer boundary_layer(const geometry::FacedSurface& surface, const BoundaryLayerOptions& options = {},
                             const core::TaskContext& task = core::no_task());

struct FilledWithLayers {
  geometry::MixedMesh mesh;  ///< the layers' points first, then those inside
  BoundaryLayerReport layers;
  TetrahedralizeReport tetrahedra;
};

/// The layers and tetrahedra inside them as one conforming mesh. Throws what the two steps throw.
FilledWithLayers fill_with_layers(const geometry::FacedSurface& surface,
                                  const BoundaryLayerOptions& options = {},
                                  const TetrahedralizeOptions& inside = {},
                                  const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
