#pragma once
/// \file CT numbers about a lumen.

#include "ostia/analysis/lumen_profile.h"
#include "ostia/imaging/volume.h"

#include <cstddef>
#include <vector>

namespace ostia::analysis {

struct RingStatistics {
  std::size_t samples = 0;
  double mean = 0.0, deviation = 0.0, least = 0.0, largest = 0.0;
};

/// Of the image, linear between voxels, at the nodes of a square lattice on the section: those that lie
/// outside the contour, from `inner_mm` to `outer_mm` away from it, and within the image. Every sample stands
/// for the same area. No samples where the image does not reach the ring.
RingStatistics ring_statistics(const MeasuredSection& section, double inner_mm, double outer_mm,
                               const imaging::ImageVolume& image);

/// Of the voxels that an outline encloses on its mean plane (Newell's normal), each with the share of its
/// area that is inside: the plane is asked on a square lattice, the voxel nearest to each node counts, so
/// that the deviation is the voxels' own. No samples where the image does not reach it.
RingStatistics area_statistics(const std::vector<Vec3>& outline, const imaging::ImageVolume& image);

}  // namespace ostia::analysis
