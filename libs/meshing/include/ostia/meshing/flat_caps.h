#pragma once
/// \file Lumens that other programs have closed by flat caps, opened again where they were closed.
/// See docs/methods/foreign-surfaces.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::meshing {

struct FlatCapOptions {
  /// Deviation from the cap's plane over its radius, (0, 0.5]. VMTK's capper raises the middle of a cap by
  /// 0.1.
  double flat_tolerance = 0.13;
  double least_rim_deg = 50.0;    ///< between cap and wall, in the mean along the rim, [10, 90]
  double least_roundness = 0.45;  ///< 4 pi area / rim length squared: 1 for a circle, (0, 1]
  bool by_shape = true;           ///< where labels say nothing, too
};
void validate(const FlatCapOptions& options);

/// An end of a vessel as the surface itself has it: a cap that was taken off, or an open loop.
struct GivenEnd {
  std::string name;                                 ///< as the file has it, fit for a file name; empty: none
  std::optional<geometry::FaceKind> kind;           ///< inlet or outlet, where the name says so
  geometry::Vec3 centre = geometry::Vec3::Zero();   ///< of its rim, mm
  geometry::Vec3 normal = geometry::Vec3::UnitZ();  ///< unit, out of the lumen
  double radius_mm = 0.0;                           ///< of a circle as large as the cap
};

/// A label that is neither the wall's nor that of a cap that was taken off.
struct LabelNotTaken {
  GivenEnd end;              ///< its middle and width; called as the label is
  bool like_an_end = false;  ///< it stands off the wall as an end does; else it may be a patch of the wall
};

struct OpenedCaps {
  geometry::TriMesh wall;      ///< the surface without its caps
  std::vector<GivenEnd> ends;  ///< one a cap that was taken off, in the order of their lowest triangles
  std::vector<LabelNotTaken> not_taken;  ///< labels within one rim that no end came of
};

/// Takes flat caps off a closed part of a surface. Caps are known by labels (`face_ids`, whatever their
/// numbers: a label within one rim whose triangles lie in one plane, or are domed or shaken by less than 0.6
/// of its radius where the lumen behind is as wide), or, where the surface has no labels or none of them is
/// flat, by shape: a flat region with one sharp rim, about round, about as wide as the lumen behind it. The
/// surface must be manifold and outward; parts that have no caps stay as they are. Throws InvalidInput
/// (options; as many face ids as triangles, or none), Cancelled.
OpenedCaps without_flat_caps(const geometry::FacedSurface& surface, const FlatCapOptions& options = {},
                             const core::TaskContext& task = core::no_task());

/// A lumen and the outside of its wall, apart.
struct OpenedRings {
  geometry::TriMesh walls;     ///< the surface without the rings
  std::vector<GivenEnd> ends;  ///< the lumen's: one a ring, its inner rim
};

/// Takes off flat rings with two sharp rims, by which a thick wall made by a CAD program joins the lumen to
/// its outside at each end; an end is called as the ring's label. The surface must be closed, manifold and
/// outward. Options and throws as without_flat_caps.
OpenedRings without_flat_rings(const geometry::FacedSurface& surface, const FlatCapOptions& options = {},
                               const core::TaskContext& task = core::no_task());

/// The open loop of a surface as an end: mean plane and outward normal of its border, which is given in the
/// order of geometry::boundary_loops.
GivenEnd end_at_loop(const geometry::TriMesh& mesh, const std::vector<std::int32_t>& loop);

/// Half the width of the lumen `depth_radii` of an end's radii behind it, in the end's plane: the median over
/// rays; 0 where most of them leave the surface, which `closed` holds with all its ends closed.
double lumen_width_behind(const geometry::AabbTree& closed, const GivenEnd& end, double depth_radii = 0.5);

/// Whether an opening is a hole in the wall and no end: much narrower than the lumen behind it.
bool is_hole_in_wall(const geometry::AabbTree& closed, const GivenEnd& opening);

/// "inlet_aorta" is the inlet "aorta", "cap_LAD" and "LAD.vtp" are "LAD"; characters that no file name
/// should have become "_".
GivenEnd end_named(const std::string& name);

}  // namespace ostia::meshing
