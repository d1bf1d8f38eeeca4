#pragma once
/// \file Tetrahedra inside a closed surface, by TetGen in a child process ([Antiga] 6.2).

#include "ostia/core/child_process.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/quality.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::meshing {

struct TetrahedralizeOptions {
  /// Bound on circumradii inside over the local edge length of the surface ([Antiga]: below 1, e.g. 0.8). At
  /// 0.8 the mean edge comes out at 1.02 of the surface's. Near the wall it is raised to what the surface's
  /// triangles allow. In [0.1, 10].
  double size_factor = 0.8;
  double max_radius_edge_ratio = 1.4;  ///< TetGen's -q: circumradius over shortest edge; in [1.1, 10]
  double min_dihedral_deg = 10.0;      ///< TetGen's -q, second number; in [0, 18]
  int mending_rounds = 8;              ///< rounds of smoothing of the points of bad tetrahedra; in [0, 100]
  double mend_below_deg = 18.0;        ///< tetrahedra with a smaller dihedral angle are worked on; in [0, 60]
  bool check_input = true;             ///< refuse an open or self-intersecting surface before TetGen sees it
  core::ChildLimits limits;            ///< of the child
};
void validate(const TetrahedralizeOptions& options);

struct TetrahedralizeReport {
  VolumeQuality quality;
  double min_dihedral_before_mending_deg = 0.0;
  std::size_t points_moved = 0;  ///< by mending
  std::vector<std::string> warnings;
};
struct TetrahedralizedVolume {
  geometry::VolumeMesh mesh;
  TetrahedralizeReport report;
};

/// Fills a closed, outward surface with tetrahedra. The boundary is the input's triangles, exactly: its
/// points come first, in the input's order, bit for bit, and `boundary` is the input's triangle list with its
/// face ids; points are added in the inside only. The inside's edge length follows the surface's local edge.
/// Throws InvalidInput (options), GeometryError (open or self-intersecting surface, TetGen's refusal with its
/// reason, boundary not kept), ResourceError (out of memory or time), Cancelled.
TetrahedralizedVolume tetrahedralize(const geometry::FacedSurface& surface,
                                     const TetrahedralizeOptions& options = {},
                                     const core::TaskContext& task = core::no_task());

/// The child's half: reads the job of `input`, runs TetGen, writes `output`. Returns the exit code of the
/// child (0, or 3 for a surface that TetGen refuses, 5 for memory, 6 for its internal errors), after a line
/// on stderr. Lives in its own library, ostia_tetgen_worker, which alone links TetGen.
int tetrahedralize_in_worker(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace ostia::meshing
