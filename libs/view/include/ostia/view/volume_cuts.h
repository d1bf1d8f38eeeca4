#pragma once
/// \file What a person takes away of the volume in 3D: by scissors and by a box.

#include "ostia/core/task_context.h"
#include "ostia/geometry/vec.h"
#include "ostia/imaging/volume.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace ostia::view {

using geometry::Vec2;
using geometry::Vec3;

/// A line drawn in a picture of parallel rays: a prism through all of the volume.
struct VolumeCut {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitZ();  ///< unit, orthogonal: the picture's axes, LPS
  std::vector<Vec2> outline_mm;  ///< (place . right, place . up) of its corners; the last joins the first
  bool keep_inside = false;      ///< takes away what lies outside of it, not what lies inside
};
/// Throws InvalidInput for fewer than three corners, corners that are not finite, or axes that are not
/// orthonormal to 1e-6.
void validate(const VolumeCut& cut);

/// Sets 0 in the mask for the voxels whose centres the cut takes away. What lies inside follows from the
/// number of times the outline is crossed (even: outside), so where the line crosses itself nothing is left
/// to chance. Exact to rounding; a million voxels in some milliseconds. Throws InvalidInput, Cancelled.
void cut_away(imaging::MaskVolume& mask, const VolumeCut& cut,
              const core::TaskContext& task = core::no_task());

/// Shares of the image's extent along the patient's axes: x from right to left, y from front to back, z from
/// feet to head. Of an oblique image its own axes, each as the patient's nearest one.
struct VolumeCrop {
  std::array<double, 3> low{0.0, 0.0, 0.0}, high{1.0, 1.0, 1.0};
  bool whole() const { return *this == VolumeCrop{}; }
  bool operator==(const VolumeCrop&) const = default;
};
void validate(const VolumeCrop& crop);  ///< throws InvalidInput unless 0 <= low < high <= 1
/// Of each of the image's axes the patient's axis that it is taken for: 0, 1, 2 for x, y, z, each once.
std::array<Eigen::Index, 3> patient_axes(const imaging::Geometry& grid);
/// The same in the image's axes i, j, k: as numbers of voxels, (0, size - 1) for the whole.
struct IndexBox {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
};
IndexBox index_box(const VolumeCrop& crop, const imaging::Geometry& grid);

/// The image with air where the mask is 0 and over a voxel beside it, softly, so that a cut has a smooth
/// surface. Throws InvalidInput for another grid.
imaging::ImageVolume with_mask(const imaging::ImageVolume& image, const imaging::MaskVolume& mask);

}  // namespace ostia::view
