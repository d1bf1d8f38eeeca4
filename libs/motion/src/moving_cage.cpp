#include "ostia/motion/moving_cage.h"

#include "ostia/core/parallel.h"

namespace ostia::motion {
namespace {

using geometry::Vec3;

CyclicSpline spline_of(const geometry::CageMotion& motion) {
  geometry::validate(motion);
  std::vector<double> phases;
  std::vector<std::vector<Vec3>> places;
  for (const geometry::CagePhase& one : motion.phases) {
    phases.push_back(one.phase);
    places.push_back(one.control_points);
  }
  return CyclicSpline(std::move(phases), std::move(places));
}

}  // namespace

MovingCage::MovingCage(const geometry::CageMotion& motion)
    : grid_(motion.grid), template_phase_(motion.template_phase), spline_(spline_of(motion)) {}

CarriedPoints::CarriedPoints(const geometry::CageGrid& grid, const std::vector<Vec3>& points)
    : grid_(grid), points_(points.size()), beyond_(points.size()) {
  const Vec3 end = grid.origin + grid.cells * grid.cell_mm;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points_[i] = geometry::cage_point(grid_, points[i]);
    beyond_[i] = points[i] - points[i].cwiseMax(grid.origin).cwiseMin(end);
    if (!beyond_[i].isZero()) ++outside_;
  }
}

std::vector<Vec3> CarriedPoints::rates(const std::vector<Vec3>& control_rates) const {
  std::vector<Vec3> rates(points_.size());
  core::parallel_for(points_.size(), 4096,
                     [&](std::size_t i) { rates[i] = geometry::carried(grid_, points_[i], control_rates); });
  return rates;
}

std::vector<Vec3> CarriedPoints::places(const std::vector<Vec3>& control_points) const {
  std::vector<Vec3> places = rates(control_points);
  for (std::size_t i = 0; i < places.size(); ++i) places[i] += beyond_[i];
  return places;
}

}  // namespace ostia::motion
