#include "ostia/motion/moving_cage.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

namespace ostia::motion {
namespace {

using geometry::CageMotion;
using geometry::Vec3;

constexpr double whole_turn = 2.0 * std::numbers::pi;

/// An affine motion, which any cage carries exactly inside of it.
Vec3 moved(const Vec3& p, double phase) {
  const double s = 1.0 - 0.1 * std::sin(whole_turn * phase);
  return {s * p.x() + 2.0 * std::cos(whole_turn * phase), p.y() / s, p.z() + 0.2 * p.x() * (1.0 - s)};
}

CageMotion cage_of_affine_motion() {
  CageMotion motion;
  motion.grid = geometry::cage_around({Vec3(-10, -8, -5), Vec3(10, 8, 5)}, 2);
  const std::vector<Vec3> rest = geometry::rest_points(motion.grid);
  for (int k = 0; k < 20; ++k) {
    geometry::CagePhase phase;
    phase.phase = k / 20.0;
    for (const Vec3& p : rest) phase.control_points.push_back(moved(p, phase.phase));
    motion.phases.push_back(std::move(phase));
  }
  return motion;
}

TEST(MovingCage, CarriesPointsAsTheMotionThatItWasMadeFrom) {
  const CageMotion motion = cage_of_affine_motion();
  const MovingCage cage(motion);
  const std::vector<Vec3> points = {Vec3(1, 2, 3), Vec3(-9.5, 7.5, -4.9), Vec3(0, 0, 0)};
  const CarriedPoints carried(motion.grid, points);
  EXPECT_EQ(carried.outside(), 0U);
  for (const auto& one : motion.phases) {  // at the knots exactly
    const auto places = carried.places(cage.at(one.phase));
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_LT((places[i] - moved(points[i], one.phase)).norm(), 1e-12);
  }
  for (const double phase : {0.012, 0.333, 0.98, 1.98}) {  // between them as the spline does
    const auto places = carried.places(cage.at(phase));
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_LT((places[i] - moved(points[i], phase)).norm(), 2e-3);
  }
}

TEST(MovingCage, RatesAreTheDerivativesOfPlaces) {
  const CageMotion motion = cage_of_affine_motion();
  const MovingCage cage(motion);
  const CarriedPoints carried(motion.grid, {Vec3(4, -3, 2)});
  for (const double phase : {0.1, 0.52, 0.99}) {
    const double step = 1e-5;
    const Vec3 difference =
        (carried.places(cage.at(phase + step))[0] - carried.places(cage.at(phase - step))[0]) / (2.0 * step);
    EXPECT_LT((carried.rates(cage.rate(phase))[0] - difference).norm(), 1e-5);
  }
}

TEST(MovingCage, WhatIsOutsideKeepsItsPlaceBesideTheCage) {
  const CageMotion motion = cage_of_affine_motion();
  const Vec3 end = motion.grid.origin + motion.grid.cells * motion.grid.cell_mm;
  const Vec3 border(end.x(), 0.0, 0.0), outside = border + Vec3(3, 0, 0);
  const CarriedPoints carried(motion.grid, {border, outside});
  EXPECT_EQ(carried.outside(), 1U);
  const auto places = carried.places(motion.phases[4].control_points);
  EXPECT_LT((places[1] - places[0] - Vec3(3, 0, 0)).norm(), 1e-12);
  const auto rest = carried.places(geometry::rest_points(motion.grid));
  EXPECT_LT((rest[1] - outside).norm(), 1e-12);
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "not refused";
}

TEST(MovingCage, RefusesAPointThatIsNotANumberByItsNumber) {
  const CageMotion motion = cage_of_affine_motion();
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(refusal([&] {
                CarriedPoints(motion.grid, {Vec3(0, 0, 0), Vec3(0, value, 0)});
              }),
              "point 1 is not a number");
}

TEST(MovingCage, OneRuleJudgesWhatIsOutside) {
  const CageMotion motion = cage_of_affine_motion();
  const Vec3 end = motion.grid.origin + motion.grid.cells * motion.grid.cell_mm;
  const Vec3 inside(0, 0, 0), outside = end + Vec3(0.0, 3.0, 4.0);
  const auto judged = [&](const std::vector<Vec3>& points) {
    return judge_outside(CarriedPoints(motion.grid, points), "the axes");
  };
  EXPECT_EQ(judged({}), "");
  EXPECT_EQ(judged({inside, inside}), "");
  EXPECT_EQ(judged({inside, outside}),
            "50.0 % of the axes lie outside of the motion's cage, up to 5.0 mm; they go as its nearest place "
            "does");
  std::vector<Vec3> many(10000, inside);
  many.push_back(outside);
  EXPECT_EQ(judged(many).substr(0, 6), "0.01 %");  // never none
  EXPECT_EQ(refusal([&] { judged({inside, outside, outside}); }).substr(0, 18), "66.7 % of the axes");
}

TEST(MovingCage, NeedsThreePhases) {
  CageMotion motion = cage_of_affine_motion();
  motion.phases.resize(2);
  EXPECT_THROW(MovingCage{motion}, InvalidInput);
}

}  // namespace
}  // namespace ostia::motion
