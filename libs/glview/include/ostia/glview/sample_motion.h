#pragma once
/// \file A beating tree whose motion is known, to try the viewer with, and for tests and benchmarks.

#include "ostia/geometry/cage_motion.h"
#include "ostia/geometry/tri_mesh.h"

namespace ostia::glview {

struct SampleHeart {
  geometry::TriMesh surface;  ///< at 75 % of the cycle; open at its ends
  geometry::CageMotion motion;
};

/// The tree of geometry::coronary_like_tree (about 10,600 points) in a cage of depth 4 (4,913 control points)
/// at 20 phases: shortening by 15 %, thinning by 12 %, twist and shift, greatest at 38 % of the cycle, nearly
/// still at 75 %, and a small move before the R peak where the atria contract. `spacing_mm`: of the surface's
/// triangles; `depth` of the cage.
SampleHeart sample_heart(double spacing_mm = 0.42, int depth = 4);

/// How far the sample heart is contracted at a phase: 0 at 75 %, 1 at about 38 %.
double sample_contraction(double phase);
/// Where it carries a point.
geometry::Vec3 sample_place(const geometry::Vec3& point, double phase);

}  // namespace ostia::glview
