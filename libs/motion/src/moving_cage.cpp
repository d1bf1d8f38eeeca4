#include "ostia/motion/moving_cage.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"

#include <algorithm>

namespace ostia::motion {
namespace {

using geometry::Vec3;

constexpr double most_outside = 0.5;  // of all points: above it they belong to another cage

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
    if (!points[i].allFinite()) throw InvalidInput("point " + std::to_string(i) + " is not a number");
    points_[i] = geometry::cage_point(grid_, points[i]);
    beyond_[i] = points[i] - points[i].cwiseMax(grid.origin).cwiseMin(end);
    if (!beyond_[i].isZero()) ++outside_;
  }
}

double CarriedPoints::farthest_outside_mm() const {
  double farthest = 0.0;
  for (const Vec3& off : beyond_) farthest = std::max(farthest, off.norm());
  return farthest;
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

std::string judge_outside(const CarriedPoints& points, const std::string& what) {
  if (points.outside() == 0) return {};
  const double share = static_cast<double>(points.outside()) / static_cast<double>(points.size());
  const double percents = 100.0 * share;
  const std::string told =
      (share < 0.001 ? core::significant_text(percents, 1) : core::fixed_text(percents, 1)) + " % of " +
      what + " lie outside of the motion's cage, up to " + core::mm_text(points.farthest_outside_mm(), 1);
  if (share > most_outside)
    throw InvalidInput(told + ": they must be of the same heart at the template's phase, in LPS and mm");
  return told + "; they go as its nearest place does";
}

}  // namespace ostia::motion
