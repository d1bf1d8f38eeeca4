#include "names/vessel_way.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <string>

namespace ostia::analysis {

const geometry::Vessel& path_of(const geometry::VesselTree& tree, std::int32_t vessel) {
  const auto found = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                  [&](const geometry::Vessel& v) { return v.id == vessel; });
  if (found == tree.vessels.end())
    throw InvalidInput("vessel " + std::to_string(vessel) + " is not in the model's tree");
  return *found;
}

const geometry::Vessel& owner_of_segment(const geometry::VesselTree& tree, std::int32_t segment) {
  const auto through = [&](const geometry::Vessel& v) {
    return std::find(v.segments.begin(), v.segments.end(), segment) != v.segments.end();
  };
  const auto found = std::find_if(tree.vessels.begin(), tree.vessels.end(), through);
  if (found == tree.vessels.end())
    throw InvalidInput("segment " + std::to_string(segment) + " belongs to no vessel of the model");
  return *found;
}

std::vector<Leaving> leaving_branches(const lumen::LumenModel& model, std::int32_t vessel) {
  const geometry::AxisCurve& axis = *lumen::vessel(model, vessel).axis;
  const geometry::Vessel& path = path_of(model.tree, vessel);
  std::vector<Leaving> leaving;
  double way = 0.0;  // along the axis' points: near enough to say which foot is meant
  for (std::size_t i = 0; i + 1 < path.segments.size(); ++i) {
    const geometry::TreeSegment& segment = geometry::segment(model.tree, path.segments[i]);
    for (std::size_t k = 1; k < segment.axis.size(); ++k)
      way += (segment.axis.points[k] - segment.axis.points[k - 1]).norm();
    const double guess = std::min(way, axis.length());
    const auto foot = axis.foot_near(segment.axis.points.back(), guess, 2.0 + 0.01 * guess);
    for (const geometry::TreeSegment& other : model.tree.segments) {
      if (other.from == segment.to && other.id != path.segments[i + 1])
        leaving.push_back({foot ? foot->s_mm : guess, other.id, i + 1});
    }
  }
  return leaving;
}

}  // namespace ostia::analysis
