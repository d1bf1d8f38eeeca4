#include "ostia/phantom/heartbeat.h"

#include "ostia/core/error.h"
#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/vessel_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <vector>

namespace ostia::phantom {
namespace {

constexpr std::uint64_t seeds = 8;

Heartbeat beat_of(std::uint64_t seed) {
  return draw_heartbeat(draw_heart(seed), seed);
}

/// Over the heart, the great vessels and the bones about them.
std::vector<Vec3> chest(double step_mm) {
  std::vector<Vec3> out;
  for (double x = -120.0; x <= 120.0; x += step_mm)
    for (double y = -95.0; y <= 110.0; y += step_mm)
      for (double z = -120.0; z <= 130.0; z += step_mm) out.emplace_back(x, y, z);
  return out;
}

TEST(Heartbeat, AtTheTemplatesPhaseNothingMovesByABit) {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    for (const double percent : {75.0, 175.0, -25.0}) {
      const BeatPhase phase = beat_of(seed).phase(percent);
      EXPECT_TRUE(phase.still());
      for (const Vec3& p : chest(40.0)) {
        EXPECT_EQ(phase.at(p), p);
        EXPECT_EQ(phase.template_of(p), p);
        EXPECT_EQ(phase.jacobian(p), 1.0);
      }
    }
  }
  EXPECT_FALSE(beat_of(1).phase(35.0).still());
}

TEST(Heartbeat, IsPeriodic) {
  const Heartbeat beat = beat_of(3);
  for (const double percent : {0.0, 3.0, 20.0, 36.0, 50.0, 69.9, 70.0, 83.0, 99.0})
    for (const Vec3& p : chest(60.0))
      EXPECT_LT((beat.at(p, percent) - beat.at(p, percent + 100.0)).norm(), 1e-10);
}

/// The largest jump of the second derivative between places `step` apart.
double largest_jump(const std::function<double(double)>& f, double from, double to, double step) {
  double jump = 0.0, before = 0.0;
  bool first = true;
  for (double x = from; x <= to; x += step) {
    const double second = (f(x + step) - 2.0 * f(x) + f(x - step)) / (step * step);
    if (!first) jump = std::max(jump, std::abs(second - before));
    before = second;
    first = false;
  }
  return jump;
}

TEST(Heartbeat, IsTwiceContinuouslyDifferentiableInTime) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const BeatAmplitudes a = draw_beat(seed);
    const auto descent = [&](double t) { return beat_state(a, t).descent; };
    const auto contraction = [&](double t) { return beat_state(a, t).contraction; };
    const auto twist = [&](double t) { return beat_state(a, t).twist; };
    // A step of parabolas over systole, whose second derivative jumps, shows 0.0014.
    EXPECT_LT(largest_jump(descent, -10.0, 110.0, 0.01), 3e-4);
    EXPECT_LT(largest_jump(contraction, -10.0, 110.0, 0.01), 3e-4);
    EXPECT_LT(largest_jump(twist, -10.0, 110.0, 0.01), 3e-4);
  }
  // The measure sees a jump: a parabola that ends in a constant.
  EXPECT_GT(largest_jump([](double t) { return t < 0.0 ? t * t / 800.0 : 0.0; }, -1.0, 1.0, 0.01), 1e-3);
}

TEST(Heartbeat, TheMapIsSmoothInSpace) {
  const BeatPhase phase = beat_of(2).phase(35.0);
  for (const Vec3& through : {Vec3(0, 0, 0), Vec3(20, -20, -10), Vec3(-30, -20, 5)}) {
    for (const Vec3& along : {Vec3(1, 0.2, 0.1), Vec3(-0.1, 1, 0.3), Vec3(0.2, -0.4, 1)}) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto f = [&](double s) { return phase.at(through + s * along)[axis]; };
        // A window of parabolas, 40 mm wide, would show 0.02 where 15 mm fade.
        EXPECT_LT(largest_jump(f, -120.0, 120.0, 0.02), 5e-3);
      }
    }
  }
}

TEST(Heartbeat, GoesBackToTheTemplate) {
  double off = 0.0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Heartbeat beat = beat_of(seed);
    for (const double percent : {0.0, 15.0, 37.0, 55.0, 92.0}) {
      const BeatPhase phase = beat.phase(percent);
      for (const Vec3& p : chest(16.0)) {
        off = std::max(off, (phase.template_of(phase.at(p)) - p).norm());
        off = std::max(off, (phase.at(phase.template_of(p)) - p).norm());
      }
    }
  }
  EXPECT_LT(off, 1e-9);
}

TEST(Heartbeat, NeverFoldsSpace) {
  double least = 1.0, most = 1.0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Heartbeat beat = beat_of(seed);
    for (const double percent : {0.0, 20.0, 37.0, 50.0, 97.0}) {
      const BeatPhase phase = beat.phase(percent);
      for (const Vec3& p : chest(8.0)) {
        const double j = phase.jacobian(p);
        least = std::min(least, j);
        most = std::max(most, j);
      }
    }
  }
  EXPECT_GT(least, 0.3);
  EXPECT_LT(most, 2.0);
  // The determinant that was looked at is that of the map.
  const BeatPhase phase = beat_of(1).phase(30.0);
  for (const Vec3& p : chest(30.0)) EXPECT_NEAR(phase.jacobian(p), phase.gradient(p).determinant(), 2e-5);
}

TEST(Heartbeat, TheLargestAmplitudesThatAreAllowedDoNotFoldSpaceEither) {
  BeatAmplitudes a;
  a.left_excursion_mm = 20.0;
  a.right_excursion_mm = 28.0;
  a.epicardial_contraction = 0.2;
  a.endocardial_contraction = 0.5;
  a.base_rotation_deg = -20.0;
  a.apex_rotation_deg = 30.0;
  for (const Vec3& shift : {Vec3(8, 0, 0), Vec3(0, -8, 0), Vec3(0, 0, -8)}) {
    a.shift_mm = shift;
    for (const double share : {0.0, 0.4}) {
      a.atrial_share = share;
      const Heartbeat beat(draw_heart(7), a);
      for (const double percent : {36.0, 97.0})
        for (const Vec3& p : chest(8.0)) ASSERT_GT(beat.phase(percent).jacobian(p), 0.0) << p.transpose();
    }
  }
}

TEST(Heartbeat, SpineAndRibsStayWhereTheyAre) {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const BeatPhase phase = beat_of(seed).phase(36.0);
    for (double z = -120.0; z <= 120.0; z += 5.0) {
      for (double angle = 0.0; angle < 6.28; angle += 0.05) {
        const Vec3 rib(-8.0 + 126.0 * std::cos(angle), 16.0 + 93.0 * std::sin(angle), z);
        EXPECT_LT((phase.at(rib) - rib).norm(), 3.0) << rib.transpose();
      }
      const Vec3 spine(-8.0, 76.0, z);
      EXPECT_LT((phase.at(spine) - spine).norm(), 0.3) << spine.transpose();
    }
    const Vec3 far(0.0, 0.0, 400.0);
    EXPECT_LT((phase.at(far) - far).norm(), 1e-9);
  }
}

/// Between the two places of a point that are farthest apart.
double peak_to_peak(const Heartbeat& beat, const Vec3& p) {
  std::vector<Vec3> places;
  for (int k = 0; k < 50; ++k) places.push_back(beat.at(p, 2.0 * k));
  double most = 0.0;
  for (const Vec3& a : places)
    for (const Vec3& b : places) most = std::max(most, (a - b).norm());
  return most;
}

TEST(Heartbeat, TheHeartMovesAsPublished) {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const HeartShape heart = draw_heart(seed);
    const Heartbeat beat = draw_heartbeat(heart, seed);
    // The aortic valve's plane: 11.6 mm, deviation 2.9 (Plonek et al. 2018).
    EXPECT_NEAR(peak_to_peak(beat, heart.root.annulus), 11.6, 2.0 * 2.9) << seed;
    // Shortening of the left ventricle along its axis.
    const BeatPhase full = beat.phase(98.0), empty = beat.phase(37.0);
    const Vec3 lateral = heart.epicardium(std::numbers::pi, 0.02), apex = heart.epicardium(0.0, 1.0);
    const auto length = [&](const BeatPhase& phase) {
      return (phase.at(apex) - phase.at(lateral)).dot(heart.long_axis);
    };
    EXPECT_NEAR(1.0 - length(empty) / length(full), 0.14, 0.05) << seed;
    // Rotations: apex 9.57 (3.33), base -3.75 (1.98) degrees (MAGYAR-Healthy study 2020).
    const auto rotation = [&](double depth) {
      const Vec3 axis = heart.base + depth * heart.length_mm * heart.long_axis -
                        0.22 * heart.half_width_right_mm * heart.right;
      const Vec3 arm = 8.0 * heart.up;
      const Vec3 now = empty.at(axis + arm) - empty.at(axis - arm);
      const Vec3 side = heart.long_axis.cross(heart.up);
      return std::atan2(now.dot(side), now.dot(heart.up)) * 180.0 / std::numbers::pi;
    };
    EXPECT_NEAR(rotation(0.9), 9.57, 2.0 * 3.33) << seed;
    EXPECT_NEAR(rotation(0.02), -3.75, 2.0 * 1.98) << seed;
    EXPECT_GT(rotation(0.9) - rotation(0.02), 8.0) << seed;
  }
}

TEST(Heartbeat, TheArteriesMoveAsPublished) {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const HeartShape heart = draw_heart(seed);
    const CoronaryTree tree = draw_coronaries(heart, {.seed = seed});
    std::map<std::string, VesselMotion> of;
    for (const VesselMotion& one : vessel_motion(tree, draw_heartbeat(heart, seed))) of[one.vessel] = one;
    ASSERT_EQ(of.size(), 4u) << seed;
    // Of the order of 10 mm on the left and 20 mm on the right.
    EXPECT_NEAR(of["RCA"].largest_displacement_mm, 20.0, 4.0) << seed;
    EXPECT_NEAR(of["LAD"].largest_displacement_mm, 13.0, 3.5) << seed;
    EXPECT_NEAR(of["LAD"].displacement_mm, 7.5, 2.0) << seed;
    EXPECT_NEAR(of["LCX"].displacement_mm, 12.5, 3.5) << seed;
    for (const auto& [name, motion] : of) {
      // Mao et al. 2000: 22.4 to 108.6 mm/s.
      EXPECT_GT(motion.speed_mm_per_s, 22.4) << seed << name;
      EXPECT_LT(motion.speed_mm_per_s, 108.6) << seed << name;
      EXPECT_GE(motion.largest_speed_mm_per_s, motion.speed_mm_per_s);
      if (name != "RCA") {
        EXPECT_LT(motion.speed_mm_per_s, of["RCA"].speed_mm_per_s) << seed << name;
        EXPECT_GE(motion.speed_mm_per_s, of["LAD"].speed_mm_per_s) << seed << name;
      }
    }
  }
}

TEST(Heartbeat, RestsInMidDiastoleAndAtEndSystole) {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const HeartShape heart = draw_heart(seed);
    const Heartbeat beat = draw_heartbeat(heart, seed);
    const std::vector<Vec3> points = axis_points(draw_coronaries(heart, {.seed = seed}));
    const auto farthest = [&](double from, double to, double still) {
      double most = 0.0;
      const std::vector<Vec3> reference = moved(points, beat.phase(still));
      for (double percent = from; percent <= to; percent += 1.0) {
        const std::vector<Vec3> now = moved(points, beat.phase(percent));
        for (std::size_t i = 0; i < now.size(); ++i) most = std::max(most, (now[i] - reference[i]).norm());
      }
      return most;
    };
    EXPECT_LT(farthest(70.0, 80.0, 75.0), 1.0) << seed;
    EXPECT_GT(farthest(70.0, 80.0, 75.0), 0.05) << "slow filling goes on";
    EXPECT_LT(farthest(35.0, 40.0, 37.5), 1.0) << seed;
    EXPECT_GT(farthest(15.0, 35.0, 75.0), 8.0) << seed;
  }
}

TEST(Heartbeat, HeartsDifferAndSeedsRepeat) {
  const Vec3 p(20.0, -20.0, -20.0);
  EXPECT_EQ(beat_of(4).at(p, 30.0), beat_of(4).at(p, 30.0));
  EXPECT_NE(draw_beat(4).left_excursion_mm, draw_beat(5).left_excursion_mm);
  EXPECT_NE(draw_beat(4).heart_rate_per_min, draw_beat(5).heart_rate_per_min);
}

TEST(Heartbeat, AMovedSurfaceHasItsTrianglesAndEveryVertexWhereTheMapSays) {
  const BeatPhase phase = beat_of(1).phase(22.0);
  const geometry::TriMesh mesh{{{0, 0, 0}, {30, 0, 0}, {0, -30, 5}, {10, 5, -40}}, {{0, 1, 2}, {0, 2, 3}}};
  const geometry::TriMesh there = moved(mesh, phase);
  EXPECT_EQ(there.triangles, mesh.triangles);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) EXPECT_EQ(there.points[i], phase.at(mesh.points[i]));
}

TEST(Heartbeat, AmplitudesOutOfRangeAreRefused) {
  const auto refused = [](const std::function<void(BeatAmplitudes&)>& spoil) {
    BeatAmplitudes a;
    spoil(a);
    EXPECT_THROW(Heartbeat(draw_heart(1), a), InvalidInput);
  };
  refused([](BeatAmplitudes& a) { a.left_excursion_mm = 40.0; });
  refused([](BeatAmplitudes& a) { a.right_excursion_mm = std::nan(""); });
  refused([](BeatAmplitudes& a) { a.heart_rate_per_min = 0.0; });
  refused([](BeatAmplitudes& a) { a.epicardial_contraction = 0.3; });
  refused([](BeatAmplitudes& a) { a.endocardial_contraction = 0.01; });
  refused([](BeatAmplitudes& a) { a.apex_rotation_deg = 90.0; });
  refused([](BeatAmplitudes& a) { a.shift_mm = Vec3(0, 20, 0); });
  refused([](BeatAmplitudes& a) { a.end_systole_percent = 60.0; });
}

}  // namespace
}  // namespace ostia::phantom
