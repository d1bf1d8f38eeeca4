#pragma once
/// \file How good a carried template is at one phase.

#include "ostia/experiments/motion.h"
#include "ostia/geometry/cage.h"

namespace ostia::experiments {

/// Fills in distance, Dice, errors of points and new intersections of a run. `template_intersections`: of the
/// template itself.
void score(const BeatingHeart& heart, const HeartPhaseModel& phase, const std::vector<geometry::Vec3>& points,
           std::size_t template_intersections, double dice_resolution_mm, MotionRun& run,
           const core::TaskContext& task);

/// Pairs of triangles of a surface that intersect.
std::size_t intersections(const geometry::TriMesh& mesh);

/// Cells that are not proved to be free of inversion.
std::size_t inverted_cells(const geometry::CageGrid& grid, const std::vector<geometry::Vec3>& control_points);

}  // namespace ostia::experiments
