#pragma once
/// \file A tube's harmonic function, and it stretched to lengths.

#include "ostia/geometry/tri_mesh.h"

#include <vector>

namespace ostia::analysis {

struct HarmonicMap {
  std::vector<double> harmonic;      ///< one a point, 0 at the first border, 1 at the last
  std::vector<double> stretched_mm;  ///< the mean of `metric` on the level line, linear between levels
};

/// Laplace's equation on the surface by linear elements (cotangent weights). The first border is the one of
/// lower `metric` on average (one value a point). Empty unless the surface has two borders and is in one
/// piece.
HarmonicMap harmonic_map(const geometry::TriMesh& tube, const std::vector<double>& metric);

}  // namespace ostia::analysis
