#pragma once
/// \file How good a mesh of tetrahedra and prisms is, and whether a solver may have it.
/// docs/methods/mesh-quality.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/meshing/quality.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace ostia::meshing {

// Names of the members are those of the JSON reports.

/// One kind of element. For quadratic elements angles and ratios are those of the corners.
struct ElementQuality {
  std::size_t count = 0;
  /// Elements whose Jacobian is not shown positive everywhere by its Bernstein bounds.
  std::size_t inverted = 0;
  /// As `scaled_jacobian` and `prism_scaled_jacobian` say of the corners; of a bent element times the lower
  /// bound of its Jacobian over that of its straight version, at most 1.
  double min_scaled_jacobian = 0.0, mean_scaled_jacobian = 0.0;
  /// Least lower bound of the Jacobian over that of the straight version; 1 for linear elements.
  double min_jacobian_ratio = 1.0;
  double min_dihedral_deg = 0.0, max_dihedral_deg = 0.0, mean_min_dihedral_deg = 0.0;
  std::array<std::size_t, 18> min_dihedral_histogram{};  ///< by smallest dihedral angle, bins of 5 degrees
  std::array<std::size_t, 18> max_dihedral_histogram{};  ///< by largest, bins of 10 degrees
  std::array<std::size_t, 20>
      scaled_jacobian_histogram{};  ///< bins of 0.05 from 0; what is below is in the first
  double volume_mm3 = 0.0;
  geometry::Vec3 worst_at = geometry::Vec3::Zero();  ///< centre of the one with the least scaled Jacobian, mm
  geometry::Vec3 sharpest_at = geometry::Vec3::Zero();  ///< of the one with the smallest dihedral angle, mm
};

/// Circumradius over shortest edge of tetrahedra: 0.61 for a regular one.
struct RadiusEdgeQuality {
  double max = 0.0, mean = 0.0;
  std::array<std::size_t, 12> histogram{};  ///< bins of 0.25 from 0.5; the last counts all above 3.25
};

/// What OpenFOAM's `checkMesh` measures, by its own decomposition of faces and cells, on the corners.
struct OpenFoamQuality {
  double max_non_orthogonality_deg = 0.0, mean_non_orthogonality_deg = 0.0;
  std::size_t severely_non_orthogonal = 0;  ///< faces above 70 degrees
  double max_skewness = 0.0;                ///< inner and boundary faces
  double max_aspect_ratio = 0.0;
  double min_volume_ratio = 0.0;  ///< smaller over larger volume of the two cells at a face
  double max_openness = 0.0;      ///< sum of a cell's face areas over that of their magnitudes
  double min_volume_mm3 = 0.0, max_volume_mm3 = 0.0, volume_mm3 = 0.0;
  geometry::Vec3 least_orthogonal_at = geometry::Vec3::Zero();  ///< centre of the face, mm
  geometry::Vec3 most_skewed_at = geometry::Vec3::Zero();
};

/// A named part of the boundary.
struct FaceQuality {
  std::int32_t id = 0;
  std::string name;
  geometry::FaceKind kind = geometry::FaceKind::wall;
  std::size_t triangles = 0, quads = 0;
  double area_mm2 = 0.0;  ///< of the bent facets in a quadratic mesh, by quadrature
  /// Sum of the facets' area vectors over `area_mm2`: of unit length for a flat face, outward.
  geometry::Vec3 mean_normal = geometry::Vec3::Zero();
  geometry::Vec3 centre = geometry::Vec3::Zero();  ///< weighted by area, mm
};

/// Tetrahedra that came of a layer's prisms: flat on purpose, so that what is small or steep in them is the
/// layer's own shape. They are judged by their largest angle; the others as all are.
struct LayerTetrahedra {
  std::size_t count = 0;
  double max_dihedral_deg = 0.0;  ///< of the layers' tetrahedra
  geometry::Vec3 bluntest_at = geometry::Vec3::Zero();
  /// Of all other tetrahedra; infinite where there are none.
  double others_min_dihedral_deg = 0.0, others_min_scaled_jacobian = 0.0;
  geometry::Vec3 others_sharpest_at = geometry::Vec3::Zero(), others_worst_at = geometry::Vec3::Zero();
  /// Of the sides of elements that have no side in common with a layer's.
  double others_max_non_orthogonality_deg = 0.0;
  geometry::Vec3 others_least_orthogonal_at = geometry::Vec3::Zero();
};

struct MixedQuality {
  std::size_t points = 0;
  bool quadratic = false;
  ElementQuality tetrahedra, prisms;
  RadiusEdgeQuality radius_edge;
  OpenFoamQuality openfoam;
  std::size_t inverted() const { return tetrahedra.inverted + prisms.inverted; }
  double volume_mm3() const { return tetrahedra.volume_mm3 + prisms.volume_mm3; }  ///< exact, also when bent
  /// Free sides of elements that the boundary has not, facets that are no free side or look inward, facets
  /// with other second-order nodes than their element, sides that more than two elements share.
  std::size_t boundary_mismatches = 0;
  geometry::Vec3 mismatch_at = geometry::Vec3::Zero();  ///< of one of them, mm
  std::size_t unnamed_facets = 0;                       ///< facets whose id no face has
  std::vector<FaceQuality> faces;                       ///< in the order of the mesh's; empty faces too
  std::optional<LayerTetrahedra> layers;                ///< where it is known which they are (mark_layers)
  double mean_edge_mm = 0.0;                            ///< of the elements' edges, corner to corner
};

/// Measures a mesh of any origin, linear or quadratic. Throws InvalidInput when it cannot be measured: lists
/// of different lengths, indices out of range, coordinates that are not finite. Cancelled.
MixedQuality mixed_quality(const geometry::MixedMesh& mesh, const core::TaskContext& task = core::no_task());

/// Adds what is known of the layers' tetrahedra; `in_layers` has one entry a tetrahedron. Throws InvalidInput
/// for another number of entries and what mixed_quality throws. Cancelled.
void mark_layers(const geometry::MixedMesh& mesh, const std::vector<bool>& in_layers, MixedQuality& quality,
                 const core::TaskContext& task = core::no_task());

/// The scaled Jacobian (ElementQuality::min_scaled_jacobian) of each element, tetrahedra first: for colours.
std::vector<double> element_scaled_jacobians(const geometry::MixedMesh& mesh,
                                             const core::TaskContext& task = core::no_task());

/// Distances of the wall's points, second-order nodes and facet centres from a reference, mm.
struct WallDeviation {
  std::size_t samples = 0;
  double max_mm = 0.0, p95_mm = 0.0, mean_mm = 0.0;
  geometry::Vec3 worst_at = geometry::Vec3::Zero();  ///< on the mesh's wall
};
/// Of all faces of kind `wall`. The centre of a bent triangle is where its map has it. Nothing of the wall:
/// no samples and zeros. Throws InvalidInput for an empty reference and what mixed_quality throws.
WallDeviation wall_deviation(const geometry::MixedMesh& mesh, const geometry::TriMesh& reference,
                             const core::TaskContext& task = core::no_task());
WallDeviation wall_deviation(const geometry::MixedMesh& mesh, const geometry::AabbTree& reference,
                             const core::TaskContext& task = core::no_task());

/// The gate. The defaults are no laxer than those by which OpenFOAM's `checkMesh` says "Mesh OK" (skewness 4,
/// aspect ratio 1000, non-orthogonality below 90 and a remark above 70).
struct MixedBounds {
  double min_dihedral_deg = 5.0;                  ///< of tetrahedra, [0, 70)
  double min_tetrahedron_scaled_jacobian = 0.02;  ///< (-1, 1)
  double min_prism_scaled_jacobian = 0.02;        ///< (-1, 1)
  double max_layer_dihedral_deg = 175.0;          ///< of the layers' tetrahedra, (90, 180)
  double max_non_orthogonality_deg = 70.0;        ///< (0, 90]
  double max_layer_non_orthogonality_deg = 90.0;  ///< where a layer's tetrahedra are, (0, 90]
  double max_skewness = 4.0;                      ///< > 0
  double max_aspect_ratio = 1000.0;               ///< >= 1
  double min_volume_ratio = 0.01;                 ///< [0, 1)
};
void validate(const MixedBounds& bounds);

/// A mesh must have elements, none of them inverted, the boundary its own, every facet with a named face, no
/// face empty, and be within bounds. Reasons name the value, the bound and the place.
QualityVerdict check(const MixedQuality& quality, const MixedBounds& bounds = {});

}  // namespace ostia::meshing
