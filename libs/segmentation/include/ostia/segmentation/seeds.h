#pragma once
/// \file What a person points at.

#include "ostia/geometry/vec.h"

#include <optional>

namespace ostia::segmentation {

using geometry::Vec3;

/// One vessel to segment: its two ends and, where the way is not clear, a point between. World points (LPS,
/// mm) in the lumen.
struct BranchSeeds {
  Vec3 from = Vec3::Zero();
  std::optional<Vec3> through = std::nullopt;
  Vec3 to = Vec3::Zero();
};

}  // namespace ostia::segmentation
