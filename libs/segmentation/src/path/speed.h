#pragma once
/// \file How fast a front runs where: intensity and tube-likeness, worked out in the voxels that are asked
/// for.

#include "block_grid.h"

#include "ostia/imaging/volume.h"
#include "ostia/segmentation/seeds.h"

#include <limits>

namespace ostia::segmentation::detail {

/// What counts as lumen.
struct LumenLevels {
  double lumen_hu = 0.0;       ///< from here up, all of the contrast is there
  double background_hu = 0.0;  ///< contrast 0
  double calcium_hu = 0.0;     ///< from here on, the contrast falls again: denser than blood
  /// In the image itself: by noise alone hardly any voxel of the lumen is as bright.
  double calcium_voxel_hu = std::numeric_limits<double>::infinity();
  double calcium_margin_hu = 0.0;  ///< by how much that is above `lumen_hu`, where both were taken

  /// 0 background, 1 lumen, falling again above `calcium_hu`.
  double contrast(double hu) const;
};

/// Lightly smoothed intensities and tube-likeness, kept once known. Not for several threads.
class TubeSpeed {
 public:
  TubeSpeed(const imaging::ImageVolume& image, const LumenLevels& levels, double slowest);

  /// Binomial 3 x 3 x 3 mean of the intensity, HU; the border's values beyond the image.
  float smooth(const Voxel& v);
  /// The same between voxels (trilinear), clamped to the image.
  double smooth(const Vec3& world_mm);
  /// Contrast times tube-likeness, [0, 1].
  float quality(const Voxel& v);
  /// slowest + (1 - slowest) quality^2.
  float speed(const Voxel& v);

  const LumenLevels& levels() const { return levels_; }
  const imaging::ImageVolume& image() const { return image_; }

 private:
  double tube(const Voxel& v);
  float smooth_clamped(Voxel v);

  const imaging::ImageVolume& image_;
  LumenLevels levels_;
  double slowest_;
  std::array<std::array<std::int32_t, 3>, 3> steps_{};  // of each scale, in voxels
  BlockGrid<float> smooth_, quality_;
};

}  // namespace ostia::segmentation::detail
