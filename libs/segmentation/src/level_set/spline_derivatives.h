#pragma once
/// \file Derivatives of an image between its voxels.

#include "ostia/imaging/volume.h"

#include <cstdint>

namespace ostia::segmentation::detail {

using geometry::Vec3;

/// A value, its first and its second derivatives along the image's axes.
struct Derivatives {
  double value = 0.0;
  Vec3 first = Vec3::Zero();
  Vec3 pure = Vec3::Zero();   ///< xx, yy, zz
  Vec3 mixed = Vec3::Zero();  ///< yz, xz, xy

  /// The matrix of second derivatives times v.
  Vec3 times(const Vec3& v) const {
    return {pure[0] * v[0] + mixed[2] * v[1] + mixed[1] * v[2],
            mixed[2] * v[0] + pure[1] * v[1] + mixed[0] * v[2],
            mixed[1] * v[0] + mixed[0] * v[1] + pure[2] * v[2]};
  }
};

/// Those of the cubic B-spline that has the voxels as coefficients, per mm; `index` in voxels of the image.
/// Intensities above `brightest` count as that, voxels beyond the border as those of the border.
Derivatives derivatives_mm(const imaging::ImageVolume& image, const Vec3& index, std::int16_t brightest);

}  // namespace ostia::segmentation::detail
