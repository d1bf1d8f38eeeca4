#pragma once
/// \file The wall of a template found again in another image, by the intensities along its normals.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::pipeline {

/// Values along the normals of a surface, from inside to outside, row by row.
struct WallProfiles {
  std::vector<float> values;
};

/// Of the template in its own image.
WallProfiles wall_profiles(const geometry::TriMesh& shape, const imaging::FloatVolume& image);

struct FoundWall {
  std::vector<geometry::Vec3> points;
  double mean_shift_mm = 0.0;
};
/// Each point moved along the normal, by 1 mm at most, to where the profile is most like the template's;
/// where that is not clear it goes with its neighbours.
FoundWall found_wall(const geometry::TriMesh& carried, const WallProfiles& wanted,
                     const imaging::FloatVolume& image);

/// How much brighter the template's inside is than what lies outside of it, median, HU.
double wall_contrast(const WallProfiles& profiles);

}  // namespace ostia::pipeline
