#pragma once
/// \file Will it mesh? What would fail or come out poor, and where, before anything is meshed.
/// See docs/methods/mesh-quality.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/meshing/boundary_layer.h"
#include "ostia/meshing/sizing.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::meshing {

enum class TroubleKind {
  units,               ///< the numbers look like metres or centimetres
  not_finite,          ///< points without a place
  open_edges,          ///< a hole that is no flat end
  non_manifold,        ///< edges of more than two triangles
  turned_triangles,    ///< neighbours that look to opposite sides
  inward,              ///< a piece whose normals look inward
  self_intersections,  ///< triangles that cross
  touching_walls,      ///< two vessels closer than an edge, outside
  narrow_lumen,        ///< fewer edges across than asked for
  edge_size,           ///< sizes of 0, or an edge larger than the vessel
  small_end,           ///< an inlet or outlet smaller than an element
  sharp_fold,          ///< no direction sees both sides: layers cannot grow
  no_room_for_layers,  ///< layers would have less than half of their thickness
};
/// As in JSON reports: `units`, `open_edges`, ...
std::string_view name_of(TroubleKind kind);

/// What a program can do about it when the user agrees.
enum class OfferedRepair {
  none,            ///< a person must look; the sentence says at what
  convert_units,   ///< read again in the unit of `ForecastPlace::factor`
  fill_holes,      ///< geometry::fill_holes
  repair_surface,  ///< geometry::welded, duplicates and the triangles at fault taken out, holes filled
  orient,          ///< geometry::oriented
  smaller_edges,   ///< mesh with `ForecastPlace::factor` times the edge length
  smooth,          ///< geometry's Taubin smoothing of the place
  thinner_layers,  ///< thickness times `ForecastPlace::factor`
  drop_layers,     ///< mesh without layers
};
std::string_view name_of(OfferedRepair repair);

struct ForecastPlace {
  TroubleKind kind = TroubleKind::open_edges;
  bool fails = true;                              ///< meshing would fail; else it would come out poor
  geometry::Vec3 point = geometry::Vec3::Zero();  ///< where it is worst, mm
  double extent_mm = 0.0;                         ///< radius about the point that holds the place
  std::size_t count = 0;                          ///< edges, pairs of triangles, points: as the sentence says
  std::string sentence;                           ///< "two vessels come as close as 0.05 mm near (...) mm"
  OfferedRepair repair = OfferedRepair::none;
  std::string repair_sentence;          ///< the way out, as a user reads it
  double factor = 1.0;                  ///< of the repair, where it has one
  std::vector<std::int32_t> triangles;  ///< of the surface: to be shown in colour; may be empty
};

struct ForecastOptions {
  /// Target edge length at each point, mm. Empty: from `tree` and `sizing` where there is a tree, else the
  /// surface's own local edges.
  std::vector<double> edge_lengths_mm;
  const geometry::VesselTree* tree = nullptr;  ///< may be null; must outlive the call only
  SizingOptions sizing;                        ///< with the tree
  std::optional<BoundaryLayerOptions> layers;  ///< none: nothing is said of layers
  double min_edges_across = 3.0;               ///< narrower lumens are told; in [0, 20]
  /// Open flat ends, cut across the vessel, are what is capped: no trouble.
  bool open_ends = true;
  std::size_t max_places = 10;  ///< of each kind, the worst first; at least 1
};
void validate(const ForecastOptions& options);

struct MeshForecast {
  std::vector<ForecastPlace> places;  ///< those that fail first, by kind
  bool fails() const;                 ///< some place would
  std::string summary() const;        ///< "nothing found", or the sentences joined by "; "
};

/// Looks for the places on a surface that is closed or open, with faces or without (all of it is wall then).
/// Takes well below a second for 100,000 triangles. Never throws for what it is there to find; throws
/// InvalidInput for options and for lists that do not belong together (as many edge lengths as points, as
/// many face ids as triangles, indices out of range). Cancelled.
MeshForecast mesh_forecast(const geometry::FacedSurface& surface, const ForecastOptions& options = {},
                           const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
