#pragma once
/// \file Smooth closed surfaces of quadrilaterals around networks of vessels. See
/// docs/methods/reconstruction.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_graph.h"
#include "ostia/reconstruction/elliptic_sections.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::reconstruction {

struct ReconstructionOptions {
  int level = 1;         ///< subdivisions: each makes four quadrilaterals of one; in [0, 3]
  int sides = 8;         ///< of a cross-section at level 0; even, in [4, 32]
  double spacing = 1.2;  ///< alpha of [Luboz] eq. 2: half the distance of sections, in radii; in [0.1, 10]
  double bending = 4.0;  ///< beta of eq. 2, for curvature times radius: closer in bends; in [0, 100]
  double lambda = 0.5;   ///< weight of angles against radii where the trunk is chosen; in [0, 1]
  double blend = 0.3;    ///< rounding of the crotches, in radii of the thinner vessel; in [0, 1]
  int untangling = 40;   ///< rounds in which vessels that overlap are narrowed; 0: none; at most 200
};
/// Throws InvalidInput that names the field and its bounds.
void validate(const ReconstructionOptions& options);

/// A place where the network's own tubes overlap beside their forks, and so had to give way.
struct Narrowing {
  std::int32_t branch = 0;     ///< index into geometry::branches()
  double radius_factor = 1.0;  ///< the least along the branch, in (0, 1)
};

struct ReconstructedSurface {
  int sides = 0, level = 0;  ///< as in the options
  std::vector<geometry::Vec3> points;
  /// Counter-clockwise seen from outside; the whole surface. Each 4^level in a row are one of level 0; those
  /// of a branch's wall follow each other ring by ring, from its proximal end on.
  std::vector<geometry::Quad> quads;
  std::vector<std::int32_t> branch_of_quad;  ///< index into geometry::branches()
  /// The same points, two triangles a quadrilateral in their order; faces `wall`, `inlet_<n>`, `outlet_<n>`.
  geometry::FacedSurface surface;
  /// Where the axis of each branch begins and ends: at a fork its centre.
  std::vector<std::array<geometry::Vec3, 2>> axis_ends;
  std::vector<Narrowing> narrowed;  ///< by branch
  /// Branches whose axes were moved or stretched, since forks stood too close or vessels left side by side.
  std::vector<std::int32_t> moved;
  std::size_t self_intersections = 0;  ///< pairs left after the last round of untangling
};

/// The surface of a directed graph ([Luboz] 2.2): loops, several roots and parents, and points with one
/// parent and one child are all allowed. Sections are circles placed by eq. 2; joints are shared rings about
/// two or four poles; Catmull-Clark subdivision with the points brought onto the vessels after each level, so
/// that radii are kept. Closed where untangling succeeds (`self_intersections` is 0). Throws InvalidInput for
/// options, for a graph that is not sound, and for one that is empty; Cancelled.
ReconstructedSurface reconstruct_surface(const geometry::VesselGraph& graph,
                                         const ReconstructionOptions& options = {},
                                         const core::TaskContext& task = core::no_task());
/// The same with sections that are ellipses of the radii's areas. They become circles over the last two radii
/// before the ring of a fork, so that joints stay as they are; circles make the same surface as without.
ReconstructedSurface reconstruct_surface(const geometry::VesselGraph& graph, const EllipticSections& sections,
                                         const ReconstructionOptions& options = {},
                                         const core::TaskContext& task = core::no_task());

/// The continuation of a vessel at a fork ([Luboz] 2.2): of the candidates' directions out of the fork
/// (unit) and mean radii, the one with the least lambda * angle / pi + (1 - lambda) * |r - r_0| / r_0 to the
/// branch that arrives along `arriving` (unit, into the fork) with the mean radius `radius`. -1 for none.
std::int32_t trunk_of(const geometry::Vec3& arriving, double radius,
                      const std::vector<geometry::Vec3>& directions, const std::vector<double>& radii,
                      double lambda);

/// Abscissas of the sections of a vessel whose radius and curvature (1/mm) are known at ascending abscissas:
/// x_(i+1) - x_i = a (w_(i+1) + w_i), w = r / (1 + bending * r * kappa), as [Luboz] eq. 2 with the curvature
/// taken relative to the radius. Both ends are kept; at least `least` pieces; a is `spacing` or as near to it
/// as a whole number of pieces allows.
std::vector<double> section_abscissas(const std::vector<double>& abscissas, const std::vector<double>& radii,
                                      const std::vector<double>& curvatures, double spacing, double bending,
                                      int least = 1);

}  // namespace ostia::reconstruction
