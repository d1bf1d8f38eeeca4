#pragma once
/// \file What of a mask can be coronary arteries.

#include "ostia/coronary/mask_tree.h"

namespace ostia::coronary {

struct MaskParts {
  imaging::MaskVolume lumen;   ///< the labels that are left, on their own box with a margin of background
  std::vector<Vec3> contacts;  ///< where what is left touches what was too thick, mm
  std::int64_t object_voxels = 0;
  double thick_mm3 = 0.0;
  std::vector<std::string> warnings;
};

/// Throws InvalidInput for a mask without object, GeometryError where nothing is left.
MaskParts parts_of_mask(const imaging::MaskVolume& labels, const MaskTreeOptions& options,
                        const core::TaskContext& task);

/// "x,y,z mm (LPS)".
std::string place_in_words(const Vec3& place);

}  // namespace ostia::coronary
