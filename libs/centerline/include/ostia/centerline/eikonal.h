#pragma once
/// \file Arrival times on the inner Voronoi diagram and the paths of steepest descent ([Antiga] eqs. 5 and
/// 6).

#include "ostia/centerline/inner_voronoi.h"
#include "ostia/core/task_context.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace ostia::centerline {

/// T at each point of the diagram; infinite where the front did not come.
struct ArrivalTimes {
  std::vector<double> time;
  std::vector<std::int32_t>
      parent;  ///< the point (or the nearer of two) a point was reached from; -1 at the source
};

/// Solves |grad T| = 1/R from `source` by fast marching on the polygons. A vertex is updated across a polygon
/// from each pair of its accepted corners: polygons are convex, so the chord between the pair lies in it and
/// obtuse triangles need no unfolding. First order in the polygons' size. Stops when all of `targets` are
/// reached (empty: marches everywhere).
ArrivalTimes arrival_times(const InnerVoronoi& diagram, std::int32_t source,
                           const std::vector<std::int32_t>& targets = {},
                           const core::TaskContext& task = core::no_task());

/// A path on the diagram with the inscribed radius along it.
struct DiagramPath {
  std::vector<geometry::Vec3> points;
  std::vector<double> radius;
};

/// The path of steepest descent of T across the polygons, from `target` to the source. T falls strictly along
/// it. Throws GeometryError when the target was not reached.
DiagramPath descend(const InnerVoronoi& diagram, const ArrivalTimes& arrival, std::int32_t target);

}  // namespace ostia::centerline
