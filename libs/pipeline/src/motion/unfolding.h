#pragma once
/// \file Walls that cross themselves because they are rough, made smooth.

#include "intake/crossings.h"

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstddef>
#include <string>

namespace ostia::pipeline {

/// What smoothing has done.
struct Unfolded {
  std::size_t crossings = 0;  ///< pairs of triangles that crossed and do no more
  bool everywhere = false;    ///< the wall was rough all over, and all of it was smoothed
  double mean_mm = 0.0;       ///< by which points moved that may have
  double most_mm = 0.0;
  geometry::Vec3 where = geometry::Vec3::Zero();  ///< the one that moved most

  std::string text() const;  ///< "moved by 0.03 mm in the mean, 0.21 mm at most, at (1.0, 2.0, 3.0) mm"
};

/// Where triangles of one part cross, the wall about them is smoothed in its volume
/// (geometry::smoothed_in_volume), more and wider as long as some cross; where that concerns a fifth of the
/// points, all of it is, with its open rims. Places that stay crossed (a vessel that runs through itself)
/// become what they were; in a wall that is rough all over they stay smooth where most others are gone.
/// Triangles and points keep their numbers. `known` are the mesh's crossings where the caller has them; what
/// has moved has none afterwards. Throws Cancelled.
Unfolded unfold(geometry::TriMesh& mesh, KnownCrossings& known, const core::TaskContext& task);

}  // namespace ostia::pipeline
