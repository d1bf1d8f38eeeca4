#pragma once
/// \file A transformation as text.

#include "ostia/registration/transform.h"

#include <string>
#include <string_view>

namespace ostia::registration {

/// One JSON object, numbers to the last bit: "linear" (three rows), "offset_mm" and, where there is one,
/// "spline" with "size", "spacing_mm", "origin_mm", "direction" (three rows) and "shifts_mm" (x y z of each
/// node, x fastest).
std::string to_json(const Transform& transform);
/// Throws InvalidInput, naming the field, for text that is not such an object.
Transform transform_of_json(std::string_view text);

}  // namespace ostia::registration
