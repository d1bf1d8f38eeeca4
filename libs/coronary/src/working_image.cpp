#include "working_image.h"

#include "ostia/imaging/reduced_volume.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ostia::coronary {

imaging::ImageVolume working_image(const imaging::ImageVolume& image, double spacing_mm,
                                   const core::TaskContext& task) {
  const imaging::Geometry& grid = image.geometry;
  const double voxels =
      static_cast<double>(grid.voxels()) * grid.spacing.prod() / (spacing_mm * spacing_mm * spacing_mm);
  imaging::ReducedVolumeOptions options;
  options.most_voxels = std::max<std::int64_t>(8, static_cast<std::int64_t>(std::ceil(voxels)));
  return imaging::reduced_volume(image, options, task);
}

}  // namespace ostia::coronary
