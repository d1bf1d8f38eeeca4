#pragma once
/// \file The options of meshing, which the rooms meshing and pipeline take.

#include "options.h"

#include "ostia/meshing/boundary_layer.h"
#include "ostia/meshing/clip.h"
#include "ostia/meshing/flow_extension.h"
#include "ostia/meshing/mixed_quality.h"
#include "ostia/meshing/quality.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/shape_kept.h"
#include "ostia/meshing/sizing.h"
#include "ostia/meshing/tetrahedralize.h"

namespace ostia::python {

using meshing::BoundaryLayerOptions;
using meshing::ClipOptions;
using meshing::ExtensionCollision;
using meshing::ExtensionDirection;
using meshing::FlowExtensionOptions;
using meshing::Mesher;
using meshing::MixedBounds;
using meshing::PlacedPlane;
using meshing::QualityBounds;
using meshing::RemeshOptions;
using meshing::ShapeBounds;
using meshing::SizeArray;
using meshing::SizeField;
using meshing::SizeFocus;
using meshing::SizeMeasure;
using meshing::SizingOptions;
using meshing::TetrahedralizeOptions;

template <>
struct WordsOf<Mesher> {
  static constexpr std::pair<const char*, Mesher> words[] = {
      {"automatic", Mesher::automatic}, {"tetgen", Mesher::tetgen}, {"mesh3", Mesher::mesh3}};
};
template <>
struct WordsOf<SizeMeasure> {
  static constexpr std::pair<const char*, SizeMeasure> words[] = {{"distance", SizeMeasure::distance},
                                                                  {"radius", SizeMeasure::radius}};
};
template <>
struct WordsOf<ExtensionDirection> {
  static constexpr std::pair<const char*, ExtensionDirection> words[] = {
      {"centerline", ExtensionDirection::centerline}, {"section", ExtensionDirection::section}};
};
template <>
struct WordsOf<ExtensionCollision> {
  static constexpr std::pair<const char*, ExtensionCollision> words[] = {
      {"shorten", ExtensionCollision::shorten},
      {"bend", ExtensionCollision::bend},
      {"refuse", ExtensionCollision::refuse}};
};

// Caps are those that a reader took off, and limits those of the worker.
OSTIA_OPTIONS(SizeFocus, (place, reach_mm, share), ())
OSTIA_OPTIONS(SizeArray, (surface, edge_mm), ())
OSTIA_OPTIONS(SizeField, (points, edge_mm, gradation), ())
OSTIA_OPTIONS(PlacedPlane, (end, origin, normal), ())
OSTIA_OPTIONS(SizingOptions,
              (edge_ratio, measure, most_distance_radii, curvature_ratio, curvature_reach, foci, throat_share,
               array, field, gradation, min_edge_mm, max_edge_mm),
              ())
OSTIA_OPTIONS(RemeshOptions, (iterations, mending_rounds, mend_below_angle_deg, max_cap_deviation), ())
OSTIA_OPTIONS(TetrahedralizeOptions,
              (mesher, size_factor, field, max_radius_edge_ratio, min_dihedral_deg, mending_rounds,
               mend_below_deg, most_growth, check_input),
              (limits, mesh3_limits))
OSTIA_OPTIONS(BoundaryLayerOptions,
              (layers, thickness, growth, largest_fraction_of_radius, gradation, min_scaled_jacobian,
               min_angle_deg, max_rounds),
              ())
OSTIA_OPTIONS(ClipOptions,
              (inset_radii, move_inside_radii, sliver_fraction, reach_radii, flat_tolerance,
               flat_max_angle_deg, ends_as_they_are, planes),
              (given))
OSTIA_OPTIONS(FlowExtensionOptions,
              (inlet_diameters, outlet_diameters, ends, transition_share, direction, bend_deg, bend_towards,
               area_across_axis, collision, min_diameters, clearance, even_seam),
              (axes))
OSTIA_OPTIONS(QualityBounds, (min_angle_deg, max_frobenius_aspect), ())
OSTIA_OPTIONS(MixedBounds,
              (min_dihedral_deg, min_tetrahedron_scaled_jacobian, min_prism_scaled_jacobian,
               max_layer_dihedral_deg, max_non_orthogonality_deg, max_layer_non_orthogonality_deg,
               max_skewness, max_aspect_ratio, min_volume_ratio),
              ())
OSTIA_OPTIONS(ShapeBounds, (max_volume_change, max_p999_share), ())

}  // namespace ostia::python
