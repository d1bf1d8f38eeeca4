#include "ostia/core/error.h"
#include "ostia/phantom/body.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/phantom/vessel_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

CaseOptions obstructed(const Obstacles& obstacles, std::uint64_t seed = 3) {
  CaseOptions options;
  options.seed = seed;
  options.preset = Preset::small;
  options.obstacles = obstacles;
  return options;
}

CasePlan plan_among(const Obstacles& obstacles) {
  return plan_case(obstructed(obstacles));
}

Body body_among(const CasePlan& plan) {
  return {plan.heart, plan.tree, body_of(plan.options)};
}

double calcified_share(const CoronaryVessel& vessel, const VesselField& field) {
  int calcified = 0, all = 0;
  for (std::size_t i = 0; i < vessel.axis.size(); i += 10)
    for (int k = 0; k < 8; ++k) {
      const double theta = k * M_PI / 4.0, s = vessel.axis.abscissa[i];
      const geometry::Frame& f = vessel.axis.frames[i];
      const double rho = 0.5 * (vessel.lumen.at(s, theta) + vessel.wall.at(s, theta));
      const auto m = field.material(vessel.axis.points[i] +
                                    rho * (std::cos(theta) * f.normal - std::sin(theta) * f.binormal));
      calcified += m && m->label == Label::calcified_plaque ? 1 : 0;
      ++all;
    }
  return static_cast<double>(calcified) / all;
}

bool meets_a_section(const CasePlan& plan, const CoronaryVessel& vessel, double from_mm, double to_mm) {
  return std::ranges::any_of(plan.sections.sections, [&](const AnnotatedSection& one) {
    return one.vessel == vessel.id && one.s_from_mm < to_mm && one.s_to_mm > from_mm;
  });
}

TEST(Obstacles, AreSilentByDefaultAndToldWhereTheyAreNot) {
  EXPECT_THAT(parameters_json(obstructed({})), Not(HasSubstr("obstacles")));
  EXPECT_THAT(parameters_json(obstructed({.lobes = 0.5})), HasSubstr("\"obstacles\":{\"lobes\":0.5}"));
}

TEST(Obstacles, ThinnerArteriesAreThinnerByTheirCalibre) {
  CoronaryOptions healthy{.seed = 5, .disease = 0.0};
  const HeartShape heart = draw_heart(5);
  const CoronaryTree usual = draw_coronaries(heart, healthy);
  healthy.calibre = 0.8;
  const CoronaryTree thin = draw_coronaries(heart, healthy);
  ASSERT_EQ(thin.vessels.size(), usual.vessels.size());
  for (std::size_t v = 0; v < usual.vessels.size(); ++v) {
    EXPECT_EQ(thin.vessels[v].axis.points, usual.vessels[v].axis.points);
    EXPECT_NEAR(thin.vessels[v].healthy_radius_mm[80], 0.8 * usual.vessels[v].healthy_radius_mm[80], 0.02);
  }
  healthy.calibre = 2.0;
  EXPECT_THROW(draw_coronaries(heart, healthy), InvalidInput);
}

TEST(Obstacles, AClosedStretchIsClosedAndWhatLiesBehindIsFilledPoorly) {
  const CasePlan plan = plan_among({.closed = 1.0, .filling = 0.5}), open = plan_among({});
  int closed = 0;
  for (std::size_t v = 0; v < plan.tree.vessels.size(); ++v)
    for (const Occlusion& one : plan.tree.vessels[v].occlusions) {
      const CoronaryVessel& vessel = plan.tree.vessels[v];
      ++closed;
      const double middle = 0.5 * (one.s_from_mm + one.s_to_mm);
      EXPECT_LT(vessel.lumen.max_at(middle), 0.2);
      EXPECT_FALSE(meets_a_section(plan, vessel, one.s_from_mm, one.s_to_mm));
      const Body body = body_among(plan), usual = body_among(open);
      const float blood = body_of(plan.options).hu.blood;
      for (const double s : {one.s_from_mm - 1.0, one.s_to_mm + 1.0}) {
        const Vec3& p = vessel.axis.points[static_cast<std::size_t>(10.0 * s)];
        const float share = (body.at(p).hu - blood) / (usual.at(p).hu - blood);
        EXPECT_NEAR(share, s < middle ? 1.0f : 0.5f, 1e-4f) << s;
      }
    }
  EXPECT_EQ(closed, 1);
}

TEST(Obstacles, LongCalciumLiesBesideTheLumenAndClearOfTheSections) {
  const CasePlan plan = plan_among({.calcified_mm = 60.0}), usual = plan_among({});
  ASSERT_EQ(plan.sections.sections.size(), usual.sections.sections.size());
  const VesselField field(plan.tree), before(usual.tree);
  double length = 0.0, more = 0.0;
  for (std::size_t v = 0; v < plan.tree.vessels.size(); ++v) {
    const CoronaryVessel &vessel = plan.tree.vessels[v], &was = usual.tree.vessels[v];
    for (const Stenosis& one : vessel.stenoses) {
      const bool known = std::ranges::any_of(
          was.stenoses, [&](const Stenosis& old) { return old.s_throat_mm == one.s_throat_mm; });
      if (known) continue;
      length += one.s_to_mm - one.s_from_mm;
      EXPECT_FALSE(meets_a_section(plan, vessel, one.s_from_mm, one.s_to_mm)) << vessel.name;
    }
    more += (calcified_share(vessel, field) - calcified_share(was, before)) * vessel.axis.abscissa.back();
  }
  EXPECT_GT(length, 30.0);
  EXPECT_LT(length, 70.0);
  EXPECT_GT(more, 0.2 * length) << "of the wall, all the way round";
}

/// The least distance between the outer walls and blood that is not theirs, over places beside the arteries.
double nearest_blood(const CasePlan& plan, Label label) {
  const Body body = body_among(plan);
  const VesselField field(plan.tree);
  double least = 2.0;
  for (const CoronaryVessel& vessel : plan.tree.vessels) {
    if (vessel.parent < 0 && vessel.name != "RCA" && vessel.name != "LAD") continue;
    for (std::size_t i = 80; i + 80 < vessel.axis.size(); i += 20)
      for (int k = 0; k < 12; ++k) {
        const double theta = k * M_PI / 6.0;
        const geometry::Frame& f = vessel.axis.frames[i];
        for (const double off : {0.2, 0.5, 0.9, 1.3}) {
          const Vec3 p =
              vessel.axis.points[i] + (vessel.wall.max_at(vessel.axis.abscissa[i]) + off) *
                                          (std::cos(theta) * f.normal + std::sin(theta) * f.binormal);
          if (off < least && body.at(p).label == label)
            least = std::min(least, field.value(Boundary::wall, p, 5.0));
        }
      }
  }
  return least;
}

TEST(Obstacles, VeinsAndLobesTouchTheArteriesAndTakeNothingOfThem) {
  const CasePlan usual = plan_among({}), near = plan_among({.vein_closeness = 1.0, .lobes = 1.0});
  EXPECT_GT(nearest_blood(usual, Label::coronary_vein), 0.75);
  EXPECT_LT(nearest_blood(near, Label::coronary_vein), 0.5);
  EXPECT_LT(nearest_blood(near, Label::left_atrium), 0.75);
  EXPECT_LT(nearest_blood(near, Label::right_atrium), 0.75);
  const Body body = body_among(near), before = body_among(usual);
  for (const CoronaryVessel& vessel : near.tree.vessels)
    for (std::size_t i = 100; i + 20 < vessel.axis.size(); i += 60) {
      const Vec3& p = vessel.axis.points[i];
      EXPECT_EQ(body.at(p).hu, before.at(p).hu) << vessel.name;
    }
}

TEST(Obstacles, OutOfRangeAreRefusedByName) {
  EXPECT_THAT([] { validate(Obstacles{.filling = 0.0}); },
              ThrowsMessage<InvalidInput>(HasSubstr("obstacles: filling is 0")));
  EXPECT_THROW(plan_among({.closed = 9.0}), InvalidInput);
  EXPECT_THROW(plan_among({.contrast_fall = 0.9}), InvalidInput);
}

}  // namespace
}  // namespace ostia::phantom
