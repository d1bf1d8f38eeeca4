#pragma once
/// \file The sections of a profile at which its vessel's way is within the lumen of the vessel that it
/// leaves.

#include "ostia/analysis/stenosis.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace ostia::analysis {

/// Sections between two others: the parent's last, and the next vessel's first.
struct Mouth {
  std::size_t before = 0, behind = 0;
  bool holds(std::size_t i) const { return i > before && i < behind; }
};
/// Nothing where the profile does not go over the joint.
std::optional<Mouth> mouth_of(const LumenProfile& profile, const WayJoint& joint);
/// Of all that there are, from proximal to distal.
std::vector<Mouth> mouths_of(const LumenProfile& profile, const std::vector<WayJoint>& joints);

/// Joints whose lumina meet, as one: from the first one's joint to the last one's ostium.
struct JointGroup {
  double first_joint_mm = 0.0, last_joint_mm = 0.0, ostium_mm = 0.0;
};
/// From proximal to distal. Joints before the axis' beginning are left out.
std::vector<JointGroup> joint_groups(std::vector<WayJoint> joints);

}  // namespace ostia::analysis
