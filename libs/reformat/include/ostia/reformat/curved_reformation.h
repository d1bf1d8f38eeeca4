#pragma once
/// \file Curved planar reformations: an image along a vessel's axis (Kanitsar et al. 2002).

#include "ostia/core/task_context.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/imaging/sampling.h"
#include "ostia/reformat/plane.h"
#include "ostia/reformat/slab.h"

#include <memory>
#include <optional>
#include <vector>

namespace ostia::reformat {

enum class CurvedMode {
  straightened,  ///< row = abscissa; column = distance from the axis along radial_direction(frame(s), theta)
  stretched,  ///< row = length of the axis projected across a fixed direction; column = distance along that
              ///< direction from the middle of the axis' extent along it: isometric
};

struct CurvedOptions {
  CurvedMode mode = CurvedMode::straightened;
  double theta_deg = 0.0;  ///< the twin is at + 90; straightened: of the frames; stretched: about the axis'
                           ///< chord (its first tangent where the ends meet), from geometry::initial_normal
  double pixel_mm = 0.25;  ///< > 0, square pixels
  int width = 512, height = 512;  ///< pixels, 1 to 32,767
  double s_start_mm =
      0.0;  ///< abscissa of the first row's outer edge (stretched: of the point of the axis there)
  Slab slab = Slab::none;
  double slab_mm = 0.0;  ///< thickness across the view, half on either side; > 0 with a slab, at most 100
};
void validate(const CurvedOptions& options);

/// The map of a curved view, both ways. Immutable; asked from many threads.
class CurvedReformation {
 public:
  /// Throws InvalidInput for bad options or no axis.
  CurvedReformation(std::shared_ptr<const geometry::AxisCurve> axis, const CurvedOptions& options);
  const CurvedOptions& options() const { return options_; }
  const geometry::AxisCurve& axis() const { return *axis_; }
  CurvedReformation twin() const;                     ///< the same view at theta + 90 degrees
  CurvedReformation rotated(double theta_deg) const;  ///< the same view at another angle

  /// The place of a point of the picture, (0, 0) being the first pixel's outer corner; beyond the axis' ends
  /// the view runs on straight along the end's tangent (stretched: its part across the fixed direction).
  Vec3 world(const Vec2& picture_px) const;
  /// Each row is a straight line: world({x, row}) = start + x * pixel_mm * along. `across` is the view's
  /// unit normal, towards theta + 90: the direction of slabs and of ViewPoint::out_mm.
  struct Row {
    Vec3 start, along, across;
  };
  Row row(double row_px) const;

  /// Where a place appears, and how far out of the view it lies (signed, towards theta + 90). In bends, and
  /// where the view crosses itself, a place has several feet. With `near_s_mm` the one nearest to that
  /// abscissa is chosen, so that what was drawn at a row goes back to it. Without, of the feet in whose rows
  /// the place lies on the view (to 1e-6 mm) the nearest; of others the one with the least |out_mm|. A place
  /// beyond an end has its foot on the straight continuation: s_mm is then negative or above the length.
  /// Nothing for a place that is not finite.
  struct ViewPoint {
    Vec2 picture_px = Vec2::Zero();
    double s_mm = 0.0, out_mm = 0.0;
  };
  std::optional<ViewPoint> project(const Vec3& place, std::optional<double> near_s_mm = {}) const;

  /// The axis at the centres of the rows that lie between its ends (picture coordinates): where lines of the
  /// lumen are looked for.
  std::vector<Vec2> axis_px() const;
  /// Monotone. Stretched: where the axis runs along the fixed direction the rows stall, and the abscissa
  /// jumps over that stretch, all of which one row shows.
  double abscissa_at_row(double row_px) const;
  double row_at_abscissa(double s_mm) const;

 private:
  struct Guide;
  CurvedReformation(std::shared_ptr<const geometry::AxisCurve> axis, std::shared_ptr<const Guide> guide,
                    const CurvedOptions& options);
  std::shared_ptr<const geometry::AxisCurve> axis_;
  CurvedOptions options_;
  std::shared_ptr<const Guide> guide_;
  double start_ = 0.0;  // the guide's coordinate at the first row's outer edge
};

/// Values at the centres of the pixels, rows from the top; NaN outside the image.
struct CurvedImage {
  int width = 0, height = 0;
  std::vector<float> values;
  float operator()(int column, int row) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)];
  }
};
/// The image along a view. Slabs are the mean or maximum over the middles of equal layers no thicker than
/// half the image's finest spacing; layers outside the image do not count. Throws InvalidInput for an image
/// without voxels, Cancelled.
CurvedImage reformatted(const imaging::ImageVolume& image, const CurvedReformation& view,
                        imaging::Interpolation how = imaging::Interpolation::trilinear,
                        const core::TaskContext& task = core::no_task());
CurvedImage reformatted(const imaging::FloatVolume& image, const CurvedReformation& view,
                        imaging::Interpolation how = imaging::Interpolation::trilinear,
                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::reformat
