#pragma once
/// \file Exact lines where a wall meets a curved or flat view.

#include "ostia/lumen/scalar_field.h"

#include <functional>
#include <vector>

namespace ostia::lumen {

using geometry::Vec2;

/// A row of a view that is a straight line in space: world({x, row}) = start + x * along.
struct ViewRow {
  Vec3 start = Vec3::Zero();
  Vec3 along = Vec3::Zero();  ///< mm per pixel
};

/// A view: picture coordinates in pixels ((0, 0) is the first pixel's outer corner) to world places, one to
/// one. views.h makes them of the planes and curved reformations of `reformat`.
struct ViewSurface {
  int width = 0, height = 0;                          ///< pixels
  double pixel_mm = 0.0;                              ///< > 0
  std::function<Vec3(const Vec2& picture_px)> world;  ///< also a pixel beyond the border; from many threads
  /// Where rows are straight, each row at once: faster, and used in place of `world`.
  std::function<ViewRow(double row_px)> row{};
};

/// A connected piece of the zero set on a view. Closed lines end with their first point; open ones end at the
/// picture's border. The lumen (f < 0) lies to the left of the way as seen in the picture, whose x runs to
/// the right and whose y runs down: a closed line around a lumen runs counter-clockwise as seen.
struct ContourLine {
  std::vector<Vec2> picture_px;
  std::vector<Vec3> world;  ///< the same points; |f| <= 1e-6 there
  bool closed() const { return picture_px.size() > 2 && picture_px.front() == picture_px.back(); }
};

struct ContourLineOptions {
  double step_px = 2.0;     ///< size of the cells that lines are followed through, [0.5, 16]
  double largest_mm = 0.5;  ///< cells are no larger than this on the view, so that a thin lumen is not missed
  double bend_px = 0.02;    ///< a chord that is farther from the wall gets a point between, (0, 1]
};
void validate(const ContourLineOptions& options);  ///< throws InvalidInput
void validate(const ViewSurface& view);            ///< throws InvalidInput

/// All contour lines that are reached from the seeds (picture coordinates; say, the axis at each row): from
/// each seed f is followed to the right, left, up and down until it changes its sign, and the line found
/// there is followed through cells with shared edges, so that lines have no gaps. Lumens thinner than a cell
/// are found at seeds inside them and where a line leads to them. Open lines come first, then closed ones,
/// each from the top of the picture down. Throws InvalidInput for no seed within the picture, bad options, a
/// view without pixels, or a field that is not finite.
std::vector<ContourLine> contour_lines(const ScalarField& field, const ViewSurface& view,
                                       const std::vector<Vec2>& seeds_px,
                                       const ContourLineOptions& options = {});

}  // namespace ostia::lumen
