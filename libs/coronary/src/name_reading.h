#pragma once
/// \file The main vessels of a tree as a heart has them that lies in one of eight ways.

#include "naming_sides.h"

#include "ostia/coronary/labels.h"

#include <optional>
#include <vector>

namespace ostia::coronary {

/// A tree read as if its image's axes ran in a certain way.
struct NameReading {
  Vec3 signs = Vec3::Ones();    ///< by which places are multiplied, LPS
  std::vector<TreePath> paths;  ///< multiplied, with places in `frame`
  HeartFrame frame;
  SidedNames sided;
  double log_likelihood = 0.0;  ///< of courses and ostia, up to a constant
  double probability = 0.0;     ///< among all eight
};

/// The axis is that of the ring that the main vessels make, or the given one, which lies as the paths do.
NameReading read_as(const std::vector<TreePath>& paths, const Vec3& signs,
                    const std::optional<Vec3>& long_axis);

/// The likeliest of the eight ways in which three axes may run; as given, with 9 in 10 before any look.
NameReading likeliest_reading(const std::vector<TreePath>& paths, const std::optional<Vec3>& long_axis);

bool as_given(const NameReading& reading);
/// "mirrored left to right", "turned head to foot and left to right", ...
std::string word(const NameReading& reading);

}  // namespace ostia::coronary
