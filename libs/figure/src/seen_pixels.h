#pragma once
/// \file Where in a picture a scene can be seen at all.

#include "ostia/figure/scene.h"

#include <cstdint>
#include <vector>

namespace ostia::figure {

/// One a pixel, row by row: 0 where no ray through the pixel meets the scene; of a few others it may be 1,
/// too. `view` is one of whole pixels.
std::vector<std::uint8_t> seen_pixels(const Scene& scene, const View& view);

}  // namespace ostia::figure
