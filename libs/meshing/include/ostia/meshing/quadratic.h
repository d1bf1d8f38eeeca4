#pragma once
/// \file Elements of second order whose Jacobian is positive everywhere (Johnen, Remacle and Geuzaine 2013).
/// See docs/methods/quadratic-elements.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"

#include <array>
#include <string>
#include <vector>

namespace ostia::meshing {

/// Nodes in the orders of geometry::MixedMesh: corners, then tetrahedron_nodes or prism_nodes.
using TetrahedronNodes = std::array<geometry::Vec3, 10>;
using PrismNodes = std::array<geometry::Vec3, 18>;

TetrahedronNodes tetrahedron_nodes(const geometry::MixedMesh& mesh, std::size_t tetrahedron);
PrismNodes prism_nodes(const geometry::MixedMesh& mesh, std::size_t prism);
/// Nodes in the middle of straight edges; of a prism's quadrilaterals at the mean of their corners.
TetrahedronNodes straight(const std::array<geometry::Vec3, 4>& corners);
PrismNodes straight(const std::array<geometry::Vec3, 6>& corners);

/// Determinant of the map's derivative, mm3: six times the volume of a straight tetrahedron. (u, v, w) are
/// the weights of corners 1, 2, 3; of a prism u, v those within the triangle and w in [0, 1] from 0-1-2 to
/// 3-4-5.
double jacobian(const TetrahedronNodes& nodes, const geometry::Vec3& uvw);
double jacobian(const PrismNodes& nodes, const geometry::Vec3& uvw);
geometry::Vec3 position(const TetrahedronNodes& nodes, const geometry::Vec3& uvw);
geometry::Vec3 position(const PrismNodes& nodes, const geometry::Vec3& uvw);

/// Bernstein coefficients of the Jacobian, mm3. Of a tetrahedron it is of degree 3: 20 of them. Of a prism of
/// degree 4 across the triangle and 5 along: 15 x 6, the triangle's together for each of the six. Their mean
/// over 6 (tetrahedron) or 2 (prism) is the volume, exactly.
std::array<double, 20> jacobian_coefficients(const TetrahedronNodes& nodes);
std::array<double, 90> jacobian_coefficients(const PrismNodes& nodes);
double volume(const TetrahedronNodes& nodes);
double volume(const PrismNodes& nodes);

/// The Jacobian lies in [lower, upper] everywhere, and takes the values `least` and `greatest` somewhere.
struct JacobianBounds {
  double lower = 0.0, least = 0.0, greatest = 0.0, upper = 0.0;
};
/// By adaptive subdivision: least - lower and upper - greatest are at most `tolerance` times the mean of the
/// coefficients' magnitudes, unless 2000 parts do not do (the bounds hold all the same).
JacobianBounds jacobian_bounds(const TetrahedronNodes& nodes, double tolerance = 1e-3);
JacobianBounds jacobian_bounds(const PrismNodes& nodes, double tolerance = 1e-3);
/// The lower bound alone, with the same meaning of `tolerance`: faster.
double jacobian_lower_bound(const TetrahedronNodes& nodes, double tolerance = 1e-2);
double jacobian_lower_bound(const PrismNodes& nodes, double tolerance = 1e-2);

struct QuadraticOptions {
  /// Of every element: lower bound of the Jacobian over that of its straight version. In [0.01, 0.9].
  double min_jacobian_ratio = 0.2;
  /// A node of the wall that would move farther than this times its edge stays straight: what is found there
  /// is another wall. In (0, 1].
  double max_displacement = 0.35;
  /// The displacement of the wall decays over the layers' thickness, or over this times itself where layers
  /// are thinner. In [1.5, 20].
  double decay_length = 4.0;
  int max_rounds = 12;  ///< of moving back; in [1, 100]. Then what is still at fault becomes straight.
};
void validate(const QuadraticOptions& options);

/// A node of the wall that is not on the reference.
struct MovedBackNode {
  geometry::Vec3 point = geometry::Vec3::Zero();  ///< mm
  double share = 0.0;        ///< of the way from the straight edge to the reference, [0, 1)
  double distance_mm = 0.0;  ///< from the reference
};

struct QuadraticReport {
  std::size_t wall_nodes = 0;     ///< in the middle of the wall's edges
  std::size_t on_reference = 0;   ///< of these: on the reference
  std::size_t moved_back = 0;     ///< moved back, some of the way to the straight edge or all of it
  std::size_t not_projected = 0;  ///< no foot on the reference near enough, or one on another wall: straight
  double max_distance_mm = 0.0;   ///< of the wall's nodes from the reference
  double mean_distance_mm = 0.0;
  double max_displacement_mm = 0.0;   ///< of the wall's nodes from the straight edges
  std::vector<MovedBackNode> places;  ///< at most twenty, the farthest from the reference first
  std::size_t inverted = 0;           ///< elements not shown positive: those that are so when straight
  double min_jacobian_ratio = 1.0;    ///< over all elements
  int rounds = 0;                     ///< of moving back that were needed
  double volume_mm3 = 0.0, straight_volume_mm3 = 0.0;
  std::vector<std::string> warnings;
};

struct QuadraticMesh {
  geometry::MixedMesh mesh;
  QuadraticReport report;
};

/// A linear mesh with 10-node tetrahedra and 18-node prisms. The points stay, bit for bit; nodes of the
/// second order come after them. Those in the middle of the wall's edges (faces of kind `wall`) lie on the
/// reference surface, which is the wall alone, without caps; those on a ring between wall and cap besides in
/// the cap's plane. Caps and the inside stay straight, but that layers of prisms follow the wall, ever less
/// with depth. Where an element's Jacobian is not positive enough the nodes of the wall that it depends on
/// are moved back towards the straight edge until it is, and the report tells; a hard place is never an
/// error. The same for any number of threads. Throws InvalidInput (options, a mesh that is quadratic already,
/// indices out of range, facets that are no element's side, an empty reference), Cancelled.
QuadraticMesh make_quadratic(const geometry::MixedMesh& linear, const geometry::TriMesh& reference_wall,
                             const QuadraticOptions& options = {},
                             const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
