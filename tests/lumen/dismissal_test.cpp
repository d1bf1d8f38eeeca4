#include "editing/dismissal.h"

#include "edited_walls.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::lumen {
namespace {

using namespace testing;

/// A line at a turning angle along an axis.
std::vector<LinePlace> turning_line(const AxisCurve& axis, double from, double to, double theta,
                                    double turn) {
  std::vector<LinePlace> line;
  for (double s = from; s <= to + 1e-9; s += 0.25)
    line.push_back({s, axis.place(s, theta + turn * (s - from), 1.4) - axis.point(s)});
  return line;
}

// [Wels] 2.3 worked out by hand: the angle between the sample's offset and the line's direction there.
bool goes(const SurfaceSample& sample, const AxisCurve& axis, double theta, double beta_deg) {
  const Vec3 offset = sample.position - axis.point(sample.s_mm);
  const Vec3 r1 = axis.place(sample.s_mm, theta, 1.0) - axis.point(sample.s_mm);
  return std::acos(std::clamp(offset.dot(r1) / offset.norm(), -1.0, 1.0)) <= beta_deg * pi / 180.0;
}

TEST(Dismissal, FollowsTheFormulaForAnyBetaOnABentTube) {
  const LumenModel model = bent_model(24.0, 1.9);
  const VesselLumen& tube = vessel(model, main_vessel);
  const double turn = 0.05;  // radians a mm: the line winds about the vessel
  const TangentFrameBundle bundle(tube.axis, turning_line(*tube.axis, 6.0, 16.0, 0.3, turn));
  std::size_t before = 0;
  for (const double beta : {45.5, 60.3, 75.2, 89.6}) {
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < tube.samples.size(); ++i) {
      const SurfaceSample& sample = tube.samples[i];
      if (sample.origin == SampleOrigin::cap || sample.s_mm < 6.0 || sample.s_mm > 16.0) continue;
      if (goes(sample, *tube.axis, 0.3 + turn * (sample.s_mm - 6.0), beta)) expected.push_back(i);
    }
    const auto found = contradicted(tube.samples, bundle, {.beta_deg = beta});
    EXPECT_EQ(found, expected) << beta;
    EXPECT_GT(found.size(), before);  // a wider angle takes more
    before = found.size();
  }
}

TEST(Dismissal, TheBundleIsARotationOfTheAxisAndTheLine) {
  const LumenModel model = bent_model(20.0, 1.5);
  const AxisCurve& axis = axis_of(model);
  const auto line = turning_line(axis, 4.0, 12.0, -2.9, -0.1);  // across the seam at 180 degrees
  const TangentFrameBundle bundle(vessel(model, main_vessel).axis, line);
  for (double s = 4.0; s <= 12.0; s += 0.37) {
    const auto rotation = bundle.at(s);
    EXPECT_NEAR(rotation.r2.dot(axis.frame(s).tangent), 1.0, 1e-12);
    EXPECT_NEAR(rotation.r1.dot(rotation.r2), 0.0, 1e-12);
    EXPECT_NEAR(rotation.r1.cross(rotation.r2).dot(rotation.r3), 1.0, 1e-12);
    const Vec3 towards = axis.place(s, -2.9 - 0.1 * (s - 4.0), 1.0) - axis.point(s);
    EXPECT_GT(rotation.r1.dot(towards), std::cos(1e-3));
  }
}

TEST(Dismissal, MarginsReachBeyondTheLineAndCapsStayUnlessTheLineRunsPastTheEnd) {
  const LumenModel model = straight_model(20.0, 1.5);
  const VesselLumen& tube = vessel(model, main_vessel);
  const TangentFrameBundle bundle(tube.axis, turning_line(*tube.axis, 12.0, 20.0, 0.0, 0.0));
  const auto kinds = [&](const StrokeReach& reach) {
    std::pair<int, int> count{0, 0};  // wall, cap
    for (const std::size_t i : contradicted(tube.samples, bundle, reach)) {
      EXPECT_GE(tube.samples[i].s_mm, 12.0 - reach.margin_mm);
      ++(tube.samples[i].origin == SampleOrigin::cap ? count.second : count.first);
    }
    return count;
  };
  const auto plain = kinds({.beta_deg = 60.0});
  const auto wider = kinds({.beta_deg = 60.0, .margin_mm = 1.2});
  const auto past = kinds({.beta_deg = 60.0, .end_cap = true});
  EXPECT_EQ(plain.second, 0);
  EXPECT_GT(wider.first, plain.first);
  EXPECT_EQ(past.first, plain.first);
  EXPECT_GT(past.second, 0);
  EXPECT_EQ(kinds({.beta_deg = 60.0, .start_cap = true}).second, 0);  // that is the other end
}

TEST(Dismissal, SectionsTakeWhatLiesWithinHalfOfEpsilonAndTheirAngles) {
  const LumenModel model = bent_model(24.0, 1.7);
  const VesselLumen& tube = vessel(model, main_vessel);
  for (const double eps : {0.8, 1.5, 3.1}) {
    for (const bool partial : {false, true}) {
      const AngularRange range{170.0 / 180.0 * pi, 1.2};  // across the seam
      std::vector<std::size_t> expected;
      for (std::size_t i = 0; i < tube.samples.size(); ++i) {
        const SurfaceSample& sample = tube.samples[i];
        if (sample.origin == SampleOrigin::cap || std::abs(sample.s_mm - 11.3) >= 0.5 * eps) continue;
        const Vec3 offset = sample.position - tube.axis->point(sample.s_mm);
        double theta = geometry::angle_of(tube.axis->frame(sample.s_mm), offset);
        if (theta < 0.0) theta += 2.0 * pi;
        if (partial && (theta < range.from || theta > range.from + range.width)) continue;
        expected.push_back(i);
      }
      const auto found =
          contradicted(tube.samples, *tube.axis, 11.3, eps, partial ? std::optional(range) : std::nullopt);
      EXPECT_EQ(found, expected) << eps << partial;
      EXPECT_FALSE(found.empty() && eps > 1.0);
    }
  }
}

TEST(Dismissal, RefusesALineOnTheAxis) {
  const LumenModel model = straight_model(10.0, 1.5);
  EXPECT_THROW(TangentFrameBundle(vessel(model, main_vessel).axis, {}), InvalidInput);
  EXPECT_THROW(TangentFrameBundle(vessel(model, main_vessel).axis, {{5.0, Vec3(0.0, 0.0, 0.2)}}),
               InvalidInput);
}

}  // namespace
}  // namespace ostia::lumen
