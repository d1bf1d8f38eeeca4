#pragma once
/// \file A moving surface, phase by phase, against its reference: with points that correspond or without.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <string>
#include <vector>

namespace ostia::evaluation {

/// A surface a phase, over one cycle: the phase after the last is the first again.
struct SurfaceMotion {
  std::vector<std::string> names;  ///< of the phases, for messages and results
  std::vector<geometry::TriMesh> phases;
};

struct SurfaceMotionOptions {
  double sample_mm = 0.2;      ///< of the distances, > 0
  double resolution_mm = 0.2;  ///< of the overlap (volume_overlap.h), > 0
};

struct SurfacePhaseError {
  std::string name;
  double msd_mm = 0.0, max_sd_mm = 0.0;  ///< exact closest points, both ways, weighted by area
  double dice = 0.0;                     ///< of what the two enclose; NaN where one is open
  double displacement_mm = 0.0, max_displacement_mm = 0.0;  ///< point by point; NaN without correspondence
};

/// How one surface moves over the cycle, by its points; NaN unless all its phases have the same triangles.
struct CycleFigures {
  double path_mm = 0.0;       ///< mean over points of the way they go, closing step included
  double amplitude_mm = 0.0;  ///< largest distance of a point from its place in the first phase
  /// Mean step from the last phase to the first over the largest mean step between others: at most about 1
  /// for a cycle sampled evenly, 0 where the last phase repeats the first, far above 1 for one that is cut.
  double closing_ratio = 0.0;
};

struct SurfaceMotionError {
  std::vector<SurfacePhaseError> phases;
  bool corresponding = false;  ///< all phases of both have the same triangles
  double msd_mm = 0.0, max_sd_mm = 0.0, dice = 0.0, displacement_mm = 0.0;  ///< means, but the maximum
  CycleFigures reference, result;
  double path_difference_mm = 0.0;  ///< result - reference; NaN without either
};

/// Throws InvalidInput for other numbers of phases, other names, fewer than two phases, surfaces without
/// triangles (the phase is named) or with points that are not finite.
SurfaceMotionError compare_surface_motion(const SurfaceMotion& reference, const SurfaceMotion& result,
                                          const SurfaceMotionOptions& options = {},
                                          const core::TaskContext& task = core::no_task());

/// Which comes first by name as people count: "phase2" before "phase10".
bool natural_less(const std::string& a, const std::string& b);

}  // namespace ostia::evaluation
