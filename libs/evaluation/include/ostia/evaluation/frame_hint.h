#pragma once
/// \file Why a result does not lie where its reference lies: other units, other axes.

#include "ostia/geometry/vec.h"

#include <string>
#include <vector>

namespace ostia::evaluation {

/// "the result is 10 times smaller: its unit seems to be the centimetre", "it fits once x and y change sign:
/// it seems to be RAS, not LPS"; empty where the two lie about the same place, or nothing simple explains why
/// not. Judged by the boxes around the points. Throws InvalidInput for points that are not finite.
std::string hint_of_other_frame(const std::vector<geometry::Vec3>& reference,
                                const std::vector<geometry::Vec3>& result);

}  // namespace ostia::evaluation
