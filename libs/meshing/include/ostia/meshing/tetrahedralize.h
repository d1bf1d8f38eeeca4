#pragma once
/// \file Tetrahedra inside a closed surface, by a mesher in a child process ([Antiga] 6.2).

#include "ostia/core/child_process.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/quality.h"
#include "ostia/meshing/size_field.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace ostia::meshing {

enum class Mesher {
  automatic,  ///< TetGen, and Mesh_3 where it fails
  tetgen,     ///< keeps the surface's triangles
  mesh3,      ///< CGAL Mesh_3: meshes the surface anew, curves between faces kept
};

struct TetrahedralizeOptions {
  Mesher mesher = Mesher::automatic;
  /// Bound on circumradii inside over the local edge length of the surface ([Antiga]: below 1, e.g. 0.8). At
  /// 0.8 the mean edge comes out at 1.02 of the surface's. Near the wall it is raised to what the surface's
  /// triangles allow. In [0.1, 10].
  double size_factor = 0.8;
  /// Edge lengths inside, for the mesher in place of the surface's; near the surface they give way to those
  /// of its triangles. `remesh` the surface with the same field first (SizingOptions::field).
  std::shared_ptr<const SizeField> field;
  double max_radius_edge_ratio = 1.4;  ///< TetGen's -q: circumradius over shortest edge; in [1.1, 10]
  double min_dihedral_deg = 10.0;      ///< TetGen's -q, second number; in [0, 18]
  int mending_rounds = 8;              ///< through the tetrahedra that are still bad; in [0, 100], 0: none
  double mend_below_deg = 22.0;        ///< tetrahedra with a smaller dihedral angle are worked on; in [0, 60]
  double most_growth = 0.02;           ///< points are added up to this share more tetrahedra; in [0, 1]
  bool check_input = true;             ///< refuse an open or self-intersecting surface before TetGen sees it
  core::ChildLimits limits;            ///< of TetGen's process
  core::ChildLimits mesh3_limits;      ///< of Mesh_3's process
};
void validate(const TetrahedralizeOptions& options);

/// What was done to bad tetrahedra.
struct MendingReport {
  std::size_t points_moved = 0;  ///< a point counts each time
  std::size_t flips = 0;         ///< edges and faces removed
  std::size_t points_removed = 0, points_added = 0;
  std::size_t tetrahedra_before = 0;
  std::size_t below_goal =
      0;  ///< tetrahedra left, those with a large angle that counts as a small one included
  /// Of these, those whose smallest dihedral angle is the surface's own, between two of its triangles:
  /// nothing inside can make it larger.
  std::size_t held_by_surface = 0;
  double least_held_deg = 180.0;                       ///< 180 when there are none
  geometry::Vec3 held_place = geometry::Vec3::Zero();  ///< centre of the one with this angle, mm
};

struct TetrahedralizeReport {
  VolumeQuality quality;
  double min_dihedral_before_mending_deg = 0.0;
  MendingReport mending;
  std::size_t below_10_deg = 0, below_12_deg = 0;      ///< tetrahedra by their smallest dihedral angle
  double mesher_seconds = 0.0, mending_seconds = 0.0;  ///< of the clock
  Mesher made_by = Mesher::tetgen;
  /// The boundary is not the input's. Then the largest distance found between the two, from corners, middles
  /// of edges and centroids of the new triangles and from the points of the old, mm.
  bool surface_meshed_anew = false;
  double surface_deviation_mm = 0.0;
  std::vector<std::string> warnings;
};
struct TetrahedralizedVolume {
  geometry::VolumeMesh mesh;
  TetrahedralizeReport report;
};

/// Fills a closed, outward surface with tetrahedra. Made by TetGen, the boundary is the input's triangles,
/// exactly: its points come first, in the input's order, bit for bit, and `boundary` is the input's triangle
/// list with its face ids; points are added in the inside only. Made by Mesh_3, the boundary is a new one
/// with the same face ids, its points first, and a warning tells how far it deviates. The inside's edge
/// length follows the surface's local edge. Bad tetrahedra are mended then. Deterministic. Throws
/// InvalidInput (options), GeometryError (open or self-intersecting surface, a mesher's refusal with its
/// reason, boundary not kept), ResourceError (out of memory or time), Cancelled.
TetrahedralizedVolume tetrahedralize(const geometry::FacedSurface& surface,
                                     const TetrahedralizeOptions& options = {},
                                     const core::TaskContext& task = core::no_task());

/// The child's half: reads the job of `input`, runs its mesher, writes `output`. Returns the exit code of the
/// child (0, or 3 for a surface that the mesher refuses, 5 for memory, 6 for its internal errors), after a
/// line on stderr. Lives in its own library, ostia_tetgen_worker, which alone links TetGen.
int tetrahedralize_in_worker(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace ostia::meshing
