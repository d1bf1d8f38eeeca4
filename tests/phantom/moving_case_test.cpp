#include "ostia/phantom/moving_case.h"

#include "simple_scene.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

using geometry::Box3;
using ::testing::ElementsAre;

CaseOptions tiny_case(std::uint64_t seed = 1) {
  CaseOptions options;
  options.seed = seed;
  options.preset = Preset::tiny;
  options.scan.supersampling = 2;
  return options;
}

TEST(MovingCase, PhasesAreAtEqualDistancesFromTheRPeakOn) {
  EXPECT_THAT(phase_percents(4), ElementsAre(0.0, 25.0, 50.0, 75.0));
  EXPECT_EQ(phase_percents(20)[15], template_percent);
  EXPECT_EQ(phase_name(0.0), "phase-00");
  EXPECT_EQ(phase_name(phase_percents(20)[7]), "phase-35");
  EXPECT_EQ(phase_name(phase_percents(100)[29]), "phase-29");
  for (const int bad : {0, -1, 101}) EXPECT_THROW(phase_percents(bad), InvalidInput);
}

TEST(MovingCase, AMovedBallIsWhereItsCentreWentAndKeepsItsVolumeTimesTheJacobian) {
  const HeartShape heart = draw_heart(2);
  const BeatPhase phase = draw_heartbeat(heart, 2).phase(30.0);
  const Vec3 centre = heart.epicardium(2.0, 0.3);
  constexpr double radius = 3.0;
  const testing::FunctionScene ball = testing::ball_scene(centre, radius);
  const MovedScene scene(ball, phase);
  const Vec3 there = phase.at(centre);
  ASSERT_GT((there - centre).norm(), 4.0);
  const Box3 box(there - Vec3::Constant(6.0), there + Vec3::Constant(6.0));
  const auto part = scene.part(box);
  double volume = 0.0;
  constexpr double step = 0.1;
  for (double x = -6.0; x < 6.0; x += step)
    for (double y = -6.0; y < 6.0; y += step)
      for (double z = -6.0; z < 6.0; z += step)
        if (part->at(there + Vec3(x, y, z)).label == Label::coronary_lumen) volume += step * step * step;
  EXPECT_EQ(part->at(there).label, Label::coronary_lumen);
  const double expected = 4.0 / 3.0 * M_PI * std::pow(radius, 3.0) * phase.jacobian(centre);
  EXPECT_NEAR(volume, expected, 0.03 * expected);
}

TEST(MovingCase, WhatIsMetDoesNotDependOnTheBox) {
  const CasePlan plan = plan_case(tiny_case());
  const Body body(plan.heart, plan.tree, body_of(plan.options));
  const MovedScene scene(body, heartbeat_of(plan).phase(20.0));
  const Vec3 middle = plan.options.scan.grid.world(Vec3(48, 48, 40));
  const auto small = scene.part(Box3(middle - Vec3::Constant(2.3), middle + Vec3::Constant(2.1)));
  const auto large = scene.part(Box3(middle - Vec3::Constant(8.7), middle + Vec3::Constant(5.4)));
  for (double x = -2.0; x <= 2.0; x += 0.4) {
    for (double y = -2.0; y <= 2.0; y += 0.4) {
      const Vec3 p = middle + Vec3(x, y, 0.3 * x);
      EXPECT_EQ(small->at(p).label, large->at(p).label);
      EXPECT_EQ(small->at(p).hu, large->at(p).hu);
    }
  }
}

TEST(MovingCase, TheInterpolatedMapBackIsTrueToThreeHundredthsOfAMillimetre) {
  // A scene whose CT number is a coordinate shows where a place came from.
  const HeartShape heart = draw_heart(5);
  const BeatPhase phase = draw_heartbeat(heart, 5).phase(36.0);
  double off = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const testing::FunctionScene ruler([axis](const Vec3& p) {
      return Material{Label::fat, static_cast<float>(p[axis])};
    });
    const MovedScene scene(ruler, phase);
    for (double x = -60.0; x < 80.0; x += 20.0) {
      for (double y = -60.0; y < 60.0; y += 20.0) {
        const auto part = scene.part(Box3(Vec3(x, y, -80.0), Vec3(x + 4.0, y + 4.0, 80.0)));
        for (double z = -80.0; z < 80.0; z += 1.7) {
          const Vec3 p(x + 1.6, y + 2.5, z);
          off = std::max(off, std::abs(static_cast<double>(part->at(p).hu) - phase.template_of(p)[axis]));
        }
      }
    }
  }
  EXPECT_LT(off, 0.03);
  EXPECT_GT(off, 1e-5) << "the ruler is not asked";
}

/// The label that the image gives a place; nothing outside.
std::optional<Label> label_at(const Scan& scan, const Vec3& p) {
  const imaging::Geometry& grid = scan.labels.geometry;
  const Vec3 index = grid.index(p);
  std::array<std::int64_t, 3> at{};
  for (std::size_t a = 0; a < 3; ++a) {
    at[a] = std::lround(index[static_cast<Eigen::Index>(a)]);
    if (at[a] < 0 || at[a] >= grid.size[a]) return std::nullopt;
  }
  return static_cast<Label>(scan.labels.voxels[static_cast<std::size_t>(grid.offset(at[0], at[1], at[2]))]);
}

/// Share of the axes' places that the image shows as lumen.
double share_in_lumen(const CasePlan& plan, const Scan& scan, const BeatPhase& phase) {
  double inside = 0.0, all = 0.0;
  for (const CoronaryVessel& vessel : plan.tree.vessels) {
    for (std::size_t i = 0; i < vessel.axis.size(); i += 3) {
      if (vessel.axis.radius[i] < 1.0) continue;
      const auto label = label_at(scan, phase.at(vessel.axis.points[i]));
      if (!label) continue;
      all += 1.0;
      if (*label == Label::coronary_lumen || *label == Label::aorta) inside += 1.0;
    }
  }
  EXPECT_GT(all, 100.0);
  return inside / all;
}

TEST(MovingCase, TheImageOfAPhaseShowsTheLumenWhereItsAxisIsThen) {
  const CasePlan plan = plan_case(tiny_case());
  const Body body(plan.heart, plan.tree, body_of(plan.options));
  const BeatPhase phase = heartbeat_of(plan).phase(35.0), still;
  const Scan scan = scan_phase(plan, body, phase);
  EXPECT_GT(share_in_lumen(plan, scan, phase), 0.97);
  EXPECT_LT(share_in_lumen(plan, scan, still), 0.4);
}

TEST(MovingCase, TheTemplatesPhaseShowsTheStillHeartUnderAnotherNoise) {
  const CasePlan plan = plan_case(tiny_case());
  const Body body(plan.heart, plan.tree, body_of(plan.options));
  const Scan still = scan_case(plan), phase = scan_phase(plan, body, heartbeat_of(plan).phase(75.0));
  std::size_t other = 0;
  double difference = 0.0, square = 0.0;
  const double n = static_cast<double>(still.image.voxels.size());
  for (std::size_t i = 0; i < still.labels.voxels.size(); ++i) {
    if (still.labels.voxels[i] != phase.labels.voxels[i]) ++other;
    const double d = still.image.voxels[i] - phase.image.voxels[i];
    difference += d / n;
    square += d * d / n;
  }
  EXPECT_LT(static_cast<double>(other), 1e-4 * n);
  EXPECT_NEAR(difference, 0.0, 0.5);
  // Two independent noises of the asked deviation.
  EXPECT_NEAR(std::sqrt(square), std::sqrt(2.0) * plan.options.scan.noise_hu, 2.0);
}

TEST(MovingCase, AxesContoursAndReferenceLinesGoWithTheMap) {
  CaseOptions options = tiny_case(3);
  options.preset = Preset::small;
  const CasePlan plan = plan_case(options);
  const BeatPhase phase = heartbeat_of(plan).phase(25.0);
  const geometry::VesselTree tree = vessel_tree(plan.tree), there = moved(tree, phase);
  EXPECT_EQ(geometry::find_fault(there), std::nullopt);
  ASSERT_EQ(there.segments.size(), tree.segments.size());
  for (std::size_t s = 0; s < tree.segments.size(); ++s)
    for (std::size_t i = 0; i < tree.segments[s].axis.size(); i += 50)
      EXPECT_EQ(there.segments[s].axis.points[i], phase.at(tree.segments[s].axis.points[i]));
  const geometry::ContourSet contours =
      annotate(plan.tree, plan.sections.sections, plan.options.contours, plan.options.observers);
  const geometry::ContourSet now = moved(contours, phase);
  ASSERT_FALSE(now.sections.empty());
  for (std::size_t s = 0; s < now.sections.size(); ++s) {
    EXPECT_EQ(geometry::find_fault(now.sections[s]), std::nullopt) << now.sections[s].section;
    EXPECT_EQ(now.sections[s].contours[3].points[5], phase.at(contours.sections[s].contours[3].points[5]));
  }
  const ChallengeVessel& rca = plan.challenge.vessels.front();
  const ChallengeVessel moved_rca = moved(rca, phase);
  EXPECT_EQ(moved_rca.reference.points[77], phase.at(rca.reference.points[77]));
  EXPECT_EQ(moved_rca.point_a, phase.at(rca.point_a));
  EXPECT_EQ(moved_rca.observers[1].back(), phase.at(rca.observers[1].back()));
}

TEST(MovingCase, RadiiGrowAsTheCrossSectionDoes) {
  const HeartShape heart = draw_heart(1);
  const BeatPhase phase = draw_heartbeat(heart, 1).phase(36.0);
  const Vec3 centre = heart.epicardium(2.1, 0.3), tangent = heart.long_axis;
  // A small disc across the tangent, moved and seen along the moved tangent.
  geometry::Contour disc;
  constexpr double radius = 0.2;
  const Vec3 a = tangent.unitOrthogonal(), b = tangent.cross(a);
  for (int k = 0; k < 64; ++k) {
    const double t = 2.0 * M_PI * k / 64.0;
    disc.points.push_back(phase.at(centre + radius * (std::cos(t) * a + std::sin(t) * b)));
  }
  const Vec3 ahead = (phase.at(centre + 0.01 * tangent) - phase.at(centre - 0.01 * tangent)).normalized();
  const double area = geometry::contour_area(disc) * std::abs(geometry::contour_normal(disc).dot(ahead));
  const double growth = std::sqrt(area / (32.0 * std::sin(2.0 * M_PI / 64.0))) / radius;
  EXPECT_NEAR(phase.growth_across(centre, tangent), growth, 1e-3);
  EXPECT_EQ(BeatPhase().growth_across(centre, tangent), 1.0);
}

}  // namespace
}  // namespace ostia::phantom
