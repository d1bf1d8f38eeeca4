#pragma once
/// \file Catmull and Clark's subdivision (1978) with the points kept on the vessels.

#include "base_mesh.h"

namespace ostia::reconstruction {

/// One level: quadrilateral i becomes 4 i to 4 i + 3; points keep their indices. The edges of open ends are
/// creases. What touches a flat joint is from level 1 on divided along the diagonals of triangles_of, so that
/// its triangles cover the same places, and no longer moved.
QuadMesh subdivided(const QuadMesh& mesh);

/// Brings every point onto its vessel or joint, radii `scale` times as large: what an approximating scheme
/// takes away is given back.
void place(QuadMesh& mesh, const std::vector<Tube>& tubes, const std::vector<Joint>& joints, double scale);

}  // namespace ostia::reconstruction
