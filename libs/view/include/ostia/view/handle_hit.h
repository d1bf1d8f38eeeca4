#pragma once
/// \file A measurement's handle under a hand.

#include <cstddef>
#include <cstdint>

namespace ostia::view {

/// Which handle of which measurement, and how far from it the hand is.
struct HandleHit {
  std::int32_t measurement = 0;
  std::size_t handle = 0;     ///< which of its points, or of its ends along the vessel: proximal, distal
  bool along_vessel = false;  ///< an end of a stenosis, of a volume, or the place of a ring
  double distance_px = 0.0;
};

}  // namespace ostia::view
