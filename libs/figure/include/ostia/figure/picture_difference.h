#pragma once
/// \file How different two pictures look to a person.
///
/// S-CIELAB: both pictures are taken apart into an achromatic and two chromatic channels, each channel is
/// blurred as the eye blurs it, and what is left is compared in CIELAB. What is too fine to be seen, as
/// another rounding of a glyph's edge, so counts little; a missing or moved part counts fully. X. Zhang and
/// B. A. Wandell, "A spatial extension of CIELAB for digital color-image reproduction", Journal of the
/// Society for Information Display 5(1) (1997) 61-63, with its table of weights and spreads and the opponent
/// space of A. B. Poirson and B. A. Wandell, J. Opt. Soc. Am. A 10 (1993) 2458-2470. The blur's kernels end
/// half a degree from their middle. Differences are CIE 1976 Delta E*ab, white is D65.

#include "ostia/figure/picture.h"

#include <vector>

namespace ostia::figure {

struct DifferenceOptions {
  /// Of the screen at the reader's distance, in [4, 400]: 40 is 96 pixels an inch at 60 cm.
  double pixels_per_degree = 40.0;
  /// Side of the blocks whose mean is taken, pixels, in [1, 1024].
  int block_px = 16;
  void validate() const;  ///< throws InvalidInput
};

struct PictureDifference {
  int width = 0, height = 0;
  std::vector<float> delta_e{};  ///< of each pixel, rows from the top
  double mean = 0.0;             ///< of all pixels
  /// The largest mean of a block; blocks overlap by one half of their side, and those at the right and lower
  /// edge end there. A difference of 2 is just seen by side with the other picture.
  double worst = 0.0;
  int worst_x = 0, worst_y = 0;  ///< that block's first pixel
};

/// Zero everywhere for equal pictures, symmetric. Pixels with alpha are taken as before black. Throws
/// InvalidInput where the pictures are empty or differ in size, or an option is out of its range.
PictureDifference picture_difference(const Raster& one, const Raster& other,
                                     const DifferenceOptions& options = {});

/// The picture in faint grey, and in red where it differs: full red at a difference of `full`. Throws
/// InvalidInput where the picture has another size than the difference, or `full` is not above 0.
Raster difference_picture(const Raster& picture, const PictureDifference& difference, double full = 20.0);

}  // namespace ostia::figure
