#pragma once
/// \file Bad tetrahedra made better by moving points and by changing connectivity (Freitag and Ollivier-Gooch
/// 1997; Klingner and Shewchuk 2007). See docs/methods/tetrahedra.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/tetrahedralize.h"

namespace ostia::meshing {

struct MendingOptions {
  double goal_deg = 22.0;        ///< tetrahedra with a smaller dihedral angle are worked on
  int rounds = 8;                ///< through what is left below the goal
  double most_growth = 0.02;     ///< points are added up to this share more tetrahedra
  double orthogonal_deg = 60.0;  ///< then faces farther than this from orthogonal are worked on
};

/// Works on the worst first, until none is below the goal or nothing helps. A change is made only where it
/// raises the least quality (tetrahedra_quality.h) of the tetrahedra it touches, so the mesh's least never
/// falls. Then faces whose normal is far from the line between the centres on both sides are opened, which
/// costs no tetrahedron more than a quarter of the goal. The boundary stays bit for bit; points that belong
/// to it keep their numbers when they come first. Deterministic. Throws Cancelled.
MendingReport mend_tetrahedra(geometry::VolumeMesh& mesh, const MendingOptions& options,
                              const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
