#pragma once
/// \file Images made ready to be compared: cropped, coarse, smooth, between 0 and 1.

#include "fitting.h"

#include "ostia/geometry/kd_tree.h"

#include <memory>

namespace ostia::registration {

/// The values that become 0 and 1.
struct Window {
  double low = -250.0, high = 650.0;
};

/// The part of the fixed scan that is compared.
class Region {
 public:
  /// About the vessels; all of the scan without any. Throws InvalidInput where the vessels are not in it.
  Region(const imaging::Geometry& fixed, const Guidance& guidance, double region_mm);
  const geometry::Box3& box() const { return box_; }  ///< with a margin
  const Vec3& centre() const { return centre_; }
  double reach_mm() const { return reach_; }  ///< root mean square distance from the centre
  /// Voxels of an image over the box that are in the region and that `map` takes into the moving scan: about
  /// `count`, half of them close to the vessels, evenly strewn and always the same. `overlap` becomes the
  /// share of the region that is taken there.
  std::vector<std::int64_t> samples(const imaging::Geometry& image, const imaging::Geometry& moving,
                                    const LinearMap& map, std::int64_t count,
                                    double* overlap = nullptr) const;

 private:
  imaging::Geometry fixed_;
  geometry::Box3 box_;
  Vec3 centre_ = Vec3::Zero();
  double reach_ = 50.0, region_mm_ = 25.0;
  std::shared_ptr<const geometry::KdTree> vessels_;
};

/// What the scan's values become 0 and 1 at. Throws InvalidInput, naming the scan, for an image whose values
/// are all the same, or that has no Hounsfield units where these are promised.
Window window_of(const imaging::ImageVolume& scan, bool hounsfield, const char* name);

/// The scan in the box (all of it without one) with voxels of about `voxel_mm`, its axes those of the world:
/// the interpolator that is used forgets an image's axes where it gives value and derivative at once.
imaging::ImageVolume reduced(const imaging::ImageVolume& scan, const geometry::Box3* box, double voxel_mm,
                             const core::TaskContext& task);
/// The same, windowed and smoothed.
imaging::FloatVolume coarse(const imaging::ImageVolume& scan, const geometry::Box3* box, double voxel_mm,
                            const Window& window, const core::TaskContext& task);
/// The moving scan as `map` lays it on the grid of the fixed one; 0 where it shows nothing.
imaging::FloatVolume laid_on(const imaging::Geometry& grid, const imaging::ImageVolume& moving,
                             const LinearMap& map, double voxel_mm, const Window& window,
                             const core::TaskContext& task);

}  // namespace ostia::registration
