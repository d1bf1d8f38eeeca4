#include "evaluate/covered_region.h"

#include "ostia/core/error.h"
#include "ostia/geometry/kd_tree.h"

#include <map>
#include <memory>
#include <vector>

namespace ostia::app {
namespace {

constexpr double reach_radii = 1.75;
constexpr double step_mm = 0.1;

struct Axes {
  std::vector<geometry::Vec3> points;
  std::vector<double> radius;
  std::vector<bool> counts;  // false near a free end
};

Axes points_of(const geometry::VesselTree& tree) {
  std::map<std::int32_t, int> uses;
  for (const auto& segment : tree.segments) {
    ++uses[segment.from];
    ++uses[segment.to];
  }
  Axes axes;
  for (const auto& segment : tree.segments) {
    const geometry::Centerline line = geometry::resample(segment.axis, step_mm);
    for (std::size_t i = 0; i < line.size(); ++i) {
      const double from_start = line.abscissa[i], to_end = line.abscissa.back() - line.abscissa[i];
      const bool near_end = (uses[segment.from] == 1 && from_start < line.radius.front()) ||
                            (uses[segment.to] == 1 && to_end < line.radius.back());
      axes.points.push_back(line.points[i]);
      axes.radius.push_back(line.radius[i]);
      axes.counts.push_back(!near_end);
    }
  }
  return axes;
}

}  // namespace

std::function<bool(const geometry::Vec3&)> covered_region(const geometry::VesselTree& tree) {
  if (tree.segments.empty()) throw InvalidInput("there are no axes to tell which vessels the result covers");
  const auto axes = std::make_shared<const Axes>(points_of(tree));
  const auto nearest = std::make_shared<const geometry::KdTree>(axes->points);
  return [axes, nearest](const geometry::Vec3& p) {
    const auto i = static_cast<std::size_t>(nearest->nearest(p));
    return axes->counts[i] && (axes->points[i] - p).norm() <= reach_radii * axes->radius[i];
  };
}

}  // namespace ostia::app
