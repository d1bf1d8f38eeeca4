#pragma once
/// \file The sections of a profile at which its vessel's axis is within the parent's lumen.

#include "ostia/analysis/lumen_profile.h"

#include <cstddef>
#include <optional>

namespace ostia::analysis {

/// Sections between two others: the parent's last, and the vessel's first.
struct Mouth {
  std::size_t before = 0, behind = 0;
  bool holds(std::size_t i) const { return i > before && i < behind; }
};
/// Nothing where the profile does not go over a joint.
std::optional<Mouth> mouth_of(const LumenProfile& profile, double joint_mm, double ostium_mm);

}  // namespace ostia::analysis
