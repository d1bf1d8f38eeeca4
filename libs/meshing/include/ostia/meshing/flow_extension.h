#pragma once
/// \file Tubes that lead the flow into and out of a lumen: from the real section of each end to a circle of
/// equal area ([Antiga] section 5).

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/meshing/clip.h"

#include <map>
#include <string>
#include <vector>

namespace ostia::meshing {

/// Where an extension's axis goes.
enum class ExtensionDirection {
  centerline,  ///< that of the centerline over the last diameter before the end
  section,     ///< normal to the end's section
};

/// What is done where an extension would meet another one or the wall.
enum class ExtensionCollision {
  shorten,  ///< as little as frees it, down to `min_diameters`; else refused
  bend,     ///< bent away, up to 80 degrees; shortened where that does not free it
  refuse,
};

struct FlowExtensionOptions {
  /// Lengths in diameters of the circle that has the section's area. In [0.25, 100].
  double inlet_diameters = 5.0, outlet_diameters = 5.0;
  /// Which ends, `inlet_<vessel>`, `outlet_<vessel>` or the vessel's name for both; empty: all.
  std::vector<std::string> ends;
  /// Share of the length in which the section becomes a circle; 1 with a short length: a round end and no
  /// more. In (0, 1].
  double transition_share = 0.5;
  ExtensionDirection direction = ExtensionDirection::centerline;
  /// Turn of the axis over the length, an arc in one plane. In [0, 180]; the arc's radius must be 1.5 radii
  /// or more.
  double bend_deg = 0.0;
  /// To which side; zero: on towards where the centerline turns already, any side of a straight one.
  geometry::Vec3 bend_towards = geometry::Vec3::Zero();
  /// By name of an end: points (mm) that its axis goes through after the section's centre; the length is then
  /// that of the curve.
  std::map<std::string, std::vector<geometry::Vec3>> axes;
  /// The section's area as seen along the axis, which for an oblique cut is smaller than its own.
  bool area_across_axis = false;
  ExtensionCollision collision = ExtensionCollision::shorten;
  double min_diameters = 1.0;  ///< no extension is shortened below this. In [0.25, 100]
  /// Room kept between two extensions, and to the wall, as a share of the radius each. In [0, 1].
  double clearance = 0.1;
  /// Triangles beside the section are remeshed to even edges where they are not even.
  bool even_seam = true;
};
void validate(const FlowExtensionOptions& options);

/// One extension as it was made.
struct FlowExtension {
  std::string end;                                     ///< `inlet_<vessel>`, `outlet_<vessel>`
  geometry::Vec3 direction = geometry::Vec3::UnitZ();  ///< of its axis where it begins, out of the lumen
  double diameter_mm = 0.0;                            ///< of the circle of equal area
  double length_mm = 0.0, wanted_length_mm = 0.0;
  double transition_mm = 0.0;
  double bend_deg = 0.0;
  double section_area_mm2 = 0.0;  ///< within the end's loop, as it was given
  double end_area_mm2 = 0.0;      ///< within the loop at the far end
  double seam_angle_deg = 0.0;    ///< smallest angle of the triangles with a point on the section
};

struct ExtendedEnds {
  ClippedSurface surface;  ///< loops and planes of extended ends are those at their far ends
  geometry::VesselTree
      tree;  ///< axes cut at the sections and led on to the far ends, with the circles' radii
  std::vector<FlowExtension> extensions;  ///< in the order of the ends
  std::vector<std::string> warnings;      ///< of this step; the surface has those of before, too
};

/// Adds extensions to ends that clip_ends made, for cap_ends to close. The tree is the one that the surface
/// was clipped with, or one of the cut lumen (ends are then found by their place). The far end is flat and
/// round, and as large as the section (both areas are those of their polygons). No extension crosses itself,
/// another one or the wall: those that would are shortened, bent or refused as `collision` says. Throws
/// InvalidInput (options, unknown ends, a surface without border loops at its ends, a tree of another
/// surface), GeometryError naming the end or the two ends that cannot be extended.
ExtendedEnds extend_ends(const ClippedSurface& clipped, const geometry::VesselTree& tree,
                         const FlowExtensionOptions& options = {},
                         const core::TaskContext& task = core::no_task());

/// What the extensions' wall is called as a face of its own.
inline constexpr const char* extension_wall_name = "wall_extensions";

/// The wall's triangles of `surface` and `mesh` (two stages of one model; either may be empty) that lie on
/// extensions, by their centroids, get a face of their own: a wall, its id behind all others. `clipped` is
/// what went into extend_ends, `extended` what came of it, with caps or without. What is left of the lumen's
/// wall, and so its shear stress, has no part of an extension; the line between the two runs along edges of
/// the mesh, up to half of one beside the section (two where the seam was evened). Nothing changes where
/// there is no extension.
void mark_extension_walls(const ClippedSurface& clipped, const geometry::TriMesh& extended,
                          geometry::FacedSurface& surface, geometry::MixedMesh& mesh);

}  // namespace ostia::meshing
