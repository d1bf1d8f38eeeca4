#pragma once
/// \file Parts of a surface that are no vessels.

#include "ostia/geometry/tri_mesh.h"

#include <cstddef>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// What was left out.
struct Specks {
  std::size_t specks = 0, bubbles = 0;
  double longest_mm = 0.0;
  geometry::Vec3 where = geometry::Vec3::Zero();  ///< the longest one's middle
  std::size_t count() const { return specks + bubbles; }
  std::string text() const;  ///< "20 loose specks ... left out, the largest 0.9 mm long at (1, 2, 3) mm"
};

/// Leaves out parts with less than 1 % of the largest part's area and either 6 % of its extent or a dozen
/// triangles, and closed parts within others.
Specks drop_specks(std::vector<geometry::TriMesh>& parts);

/// Side by side.
geometry::TriMesh joined(const std::vector<geometry::TriMesh>& parts);

}  // namespace ostia::pipeline
