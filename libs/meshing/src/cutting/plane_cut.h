#pragma once
/// \file One plane through one branch of a surface.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/clip.h"

#include <string>

namespace ostia::meshing {

/// The surface without what lies beyond the plane on the branch around `plane.origin`. The plane may be
/// shifted by less than a hundredth of the radius, away from vertices. `end` is where the axis ends. Throws
/// GeometryError starting with `name`.
geometry::TriMesh cut_branch(const geometry::TriMesh& surface, EndPlane& plane, const geometry::Vec3& end,
                             const ClipOptions& options, const std::string& name);

}  // namespace ostia::meshing
