#pragma once
/// \file A C-arm's angles as they are written and said.

#include "ostia/geometry/carm_angles.h"

#include <string>
#include <string_view>

namespace ostia::geometry {

/// "LAO30CRA20", "RAO 30 CAU 25", "AP", "LAT" (LAO 90), in any case. Throws UsageError that says what can be
/// written; angles are to be within 180 and 90 degrees.
CarmAngles carm_angles(std::string_view text);
/// "LAO 30 CRA 20", "AP", whole degrees.
std::string text_of(const CarmAngles& angles);

}  // namespace ostia::geometry
