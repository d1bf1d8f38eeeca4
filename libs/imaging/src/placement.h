#pragma once
/// \file From a file's axes to right-handed orthonormal ones. Private to the room.

#include "ostia/imaging/volume.h"

#include <array>
#include <string>
#include <vector>

namespace ostia::imaging {

/// How an image stored on a grid with any three axes comes to lie on a right-handed orthonormal one.
struct Placement {
  Geometry geometry;               ///< of the image as it is handed out
  bool slices_reversed = false;    ///< the stored axes were left-handed: the last slice comes first
  bool sheared = false;            ///< voxels have to be interpolated:
  Mat3 linear = Mat3::Identity();  ///< stored index (after reversal) = linear * index + offset
  Vec3 offset = Vec3::Zero();
  std::vector<std::string> warnings;
};

/// Axes that are within 0.1 degree of orthogonal, and move no voxel by more than a tenth of the spacing, are
/// made orthonormal about the image's centre. Axes beyond that are sheared: the grid keeps the first axis,
/// the plane of the first two and the planes' distance. Throws InvalidInput, its text beginning with `what`
/// ("FILE: FIELD"), for axes that are not finite or (nearly) in one plane.
Placement place(const std::array<std::int64_t, 3>& size, const Mat3& step, const Vec3& origin,
                const std::string& what);

}  // namespace ostia::imaging
