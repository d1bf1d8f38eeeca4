#pragma once
// Where a surface of triangles meets a 2D view: the lumen's lines at another phase of the heart, where there
// is a carried wall and no field.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/lumen/contour_lines.h"

#include <functional>
#include <optional>
#include <vector>

namespace ostia::view {

using geometry::Vec2;

/// A corner as a view has it: where it appears, and how far out of the view it lies (signed).
struct SeenCorner {
  Vec2 px = Vec2::Zero();
  double out_mm = 0.0;
};

/// The lines on which the surface crosses a view, straight over each triangle; closed ones end with their
/// first point. `out_mm`: of each point of the surface about how far out of the view it lies, to find the
/// triangles that cross it; NaN where it is not to be seen. `seen` is asked only for the corners of triangles
/// that come as near as `slack_mm` to the view, once each; a triangle with a corner that it does not know is
/// left out, and so is one wider than `widest_px` in the picture (torn apart by the view). Deterministic.
std::vector<lumen::ContourLine> wall_cut(
    const geometry::TriMesh& wall, const std::vector<double>& out_mm, double slack_mm, double widest_px,
    const std::function<std::optional<SeenCorner>(std::size_t point)>& seen);

}  // namespace ostia::view
