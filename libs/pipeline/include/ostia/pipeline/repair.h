#pragma once
/// \file A faulty surface made fit for centerlines and meshing, as far as that needs no guess.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <string>
#include <vector>

namespace ostia::pipeline {

struct Repaired {
  geometry::TriMesh mesh;
  std::vector<std::string>
      done;          ///< "3 triangles with points that are not finite dropped", in the order of work
  std::string left;  ///< faults that remain, "none" when there are none; open ends are no fault
};

/// Drops triangles with points that are not finite, degenerate and duplicate ones, flaps on non-manifold
/// edges and all parts but the one of largest area; joins equal points; turns the surface outward; cuts
/// self-intersecting places out and closes the holes that this leaves. Open ends stay open. Throws
/// GeometryError when nothing is left.
Repaired repaired(const geometry::TriMesh& mesh, const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
