#pragma once
/// \file The plane that cuts a mesh, as the hand sees it in 3D: a frame about it and an arrow across.

#include "ostia/geometry/vec.h"
#include "ostia/view/mesh_shell.h"
#include "ostia/view/tree_scene.h"

#include <vector>

namespace ostia::workstation {

/// Polylines, mm: a rectangle in the plane that reaches as far as a box of these sizes about the cut's point,
/// and an arrow both ways along the normal.
std::vector<std::vector<geometry::Vec3>> cut_handle(const view::MeshCut& cut, const geometry::Vec3& sizes_mm);

/// Whether `display` is so near to one of the lines that it is taken hold of: 8 units.
bool near_lines(const view::TreeScene& scene, const std::vector<std::vector<geometry::Vec3>>& lines,
                const geometry::Vec2& display);

}  // namespace ostia::workstation
