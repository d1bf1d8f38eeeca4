#pragma once
/// \file How noisy an image is, without a reference and without a person.

#include "ostia/imaging/volume.h"

#include <optional>

namespace ostia::imaging {

struct NoiseOptions {
  double square_mm = 6.0;  ///< side of the squares that are looked at, [2, 50]
  /// Mean of a square that counts: fat, soft tissue and blood, neither lung nor bone.
  double from_hu = -200.0, to_hu = 600.0;
};

/// The global noise level (Christianson et al. 2015, AJR 205:W93): the commonest standard deviation of small
/// squares within slices, each less its plane; edges make some deviations larger, and do not move the
/// commonest. Squares lie side by side within the box (world, mm; the whole image where it is empty), at most
/// some 20,000. Nothing where fewer than 20 squares are tissue. Deterministic. Throws InvalidInput for
/// options out of range.
std::optional<double> noise_level_hu(const ImageVolume& image, const geometry::Box3& within = {},
                                     const NoiseOptions& options = {});

}  // namespace ostia::imaging
