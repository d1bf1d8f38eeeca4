// Profiles of solved walls whose sections are known.

#include "walls.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/lumen/live_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

using testing::bump;
using testing::circle_from;
using testing::pi;
using testing::Solved;

bool same(const SectionMeasures& a, const SectionMeasures& b) {
  return a.s_mm == b.s_mm && a.found == b.found && a.area_mm2 == b.area_mm2 &&
         a.perimeter_mm == b.perimeter_mm && a.diameter_mm == b.diameter_mm &&
         a.least_diameter_mm == b.least_diameter_mm && a.largest_diameter_mm == b.largest_diameter_mm &&
         a.centroid == b.centroid && a.normal == b.normal && a.open == b.open;
}
bool same(const LumenProfile& a, const LumenProfile& b) {
  return a.sections.size() == b.sections.size() &&
         std::equal(a.sections.begin(), a.sections.end(), b.sections.begin(),
                    [](const auto& x, const auto& y) { return same(x, y); });
}

TEST(LumenProfile, OfATaperedTube) {
  const auto radius = [](double s) { return 2.0 - 0.02 * s; };
  const Solved vessel =
      testing::straight(40.0, [&](double s, double) { return radius(s); }, {.spacing_mm = 0.6});
  const LumenProfile profile = vessel.profile({.step_mm = 0.7});
  EXPECT_EQ(profile.vessel, vessel.first());
  EXPECT_NEAR(profile.length_mm, 40.0, 1e-9);
  ASSERT_EQ(profile.sections.size(), 59u);  // 58 steps of 0.69 mm
  EXPECT_EQ(profile.sections.front().s_mm, 0.0);
  EXPECT_EQ(profile.sections.back().s_mm, profile.length_mm);
  for (const SectionMeasures& section : profile.sections) {
    ASSERT_TRUE(section.found) << section.s_mm;
    const double r = radius(section.s_mm);
    const bool end = section.s_mm < 1.0 || section.s_mm > 39.0;
    const double tolerance = end ? 0.06 : 0.015;  // the wall interpolates samples
    EXPECT_NEAR(section.diameter_mm, 2.0 * r, tolerance) << section.s_mm;
    EXPECT_NEAR(section.area_mm2, 0.25 * pi * section.diameter_mm * section.diameter_mm, 1e-9);
    EXPECT_NEAR(section.perimeter_mm, 2.0 * pi * r, pi * tolerance);
    EXPECT_NEAR(section.least_diameter_mm, 2.0 * r, 2.0 * tolerance);
    EXPECT_NEAR(section.largest_diameter_mm, 2.0 * r, 2.0 * tolerance);
    EXPECT_LE(section.least_diameter_mm, section.largest_diameter_mm);
    EXPECT_NEAR((section.centroid - section.s_mm * Vec3::UnitZ()).norm(), 0.0, 0.02);
    EXPECT_NEAR((section.normal - Vec3::UnitZ()).norm(), 0.0, 1e-9);
  }
  const double exact =
      pi / 3.0 * 10.0 * (std::pow(radius(15), 2) + radius(15) * radius(25) + std::pow(radius(25), 2));
  EXPECT_NEAR(volume_mm3(profile, 15.0, 25.0), exact, 0.005 * exact);
}

TEST(LumenProfile, OfAnOvalWallHasItsWidths) {
  const Solved vessel = testing::straight(30.0, [](double, double theta) {
    return 2.0 * 1.2 / std::hypot(1.2 * std::cos(theta - 0.5), 2.0 * std::sin(theta - 0.5));
  });
  const SectionMeasures middle = at(vessel.profile(), 15.0);
  EXPECT_NEAR(middle.least_diameter_mm, 2.4, 0.03);
  EXPECT_NEAR(middle.largest_diameter_mm, 4.0, 0.03);
  EXPECT_NEAR(middle.area_mm2, pi * 2.4, 0.02 * pi * 2.4);
}

TEST(LumenProfile, VolumeOfABentTubeFollowsItsMiddle) {
  // The axis runs 0.8 mm off the middle of a tube on a helix: the area's way is longer or shorter than the
  // axis.
  const geometry::Centerline line = geometry::helix_tube(8.0, 10.0, 1.0, 1.5).tubes.front().axis;
  const Solved vessel(lumen::model_of_walls(
      lumen::testing::tree_of(line), {[](double, double theta) { return circle_from(1.5, 0.8, theta); }},
      {.spacing_mm = 0.6}));
  const LumenProfile profile = vessel.profile();
  const geometry::AxisCurve& axis = *vessel.model.vessels.front()->axis;
  double way = 0.0;  // integral of 1 - curvature . offset
  const double a = 5.0, b = axis.length() - 5.0;
  for (int i = 0; i < 2000; ++i) {
    const double s = a + (b - a) * (i + 0.5) / 2000;
    way += (b - a) / 2000 * (1.0 - axis.curvature_vector(s).dot(axis.place(s, 0.0, 0.8) - axis.point(s)));
  }
  EXPECT_GT(std::abs(way - (b - a)), 0.02 * (b - a));  // what the axis' length alone would be off by
  EXPECT_NEAR(volume_mm3(profile, a, b), pi * 2.25 * way, 0.006 * pi * 2.25 * way);
}

TEST(LumenProfile, ABranchDoesNotWidenItsVessel) {
  const geometry::AnalyticShape shape = geometry::coronary_like_tree();
  const Solved tree(lumen::model_of_tubes(lumen::testing::tree_of(shape)));
  const auto& axis_of = [&](std::int32_t id) -> const geometry::AxisCurve& {
    return *lumen::vessel(tree.model, id).axis;
  };
  for (const geometry::Vessel& vessel : tree.model.tree.vessels) {
    const LumenProfile profile = lumen_profile(tree.model, tree.surface_of(), vessel.id);
    for (const SectionMeasures& section : profile.sections) {
      ASSERT_TRUE(section.found) << vessel.name << " at " << section.s_mm;
      const std::int32_t owner = lumen::owner_at(tree.model.tree, vessel.id, section.s_mm);
      EXPECT_NEAR(section.diameter_mm, 2.0 * axis_of(owner).radius(section.s_mm), 0.08)
          << vessel.name << " at " << section.s_mm;
    }
  }
}

TEST(LumenProfile, SharedWaysHaveTheSameMeasures) {
  const Solved tree(lumen::model_of_tubes(lumen::testing::tree_of(geometry::coronary_like_tree())));
  const auto& vessels = tree.model.tree.vessels;
  const double shared = lumen::own_from_mm(tree.model.tree, vessels.back().id);
  ASSERT_GT(shared, 10.0);
  const MeasuredSection a = measured_section(tree.model, tree.surface_of(), vessels.front().id, 0.5 * shared);
  const MeasuredSection b = measured_section(tree.model, tree.surface_of(), vessels.back().id, 0.5 * shared);
  EXPECT_NEAR(a.measures.area_mm2, b.measures.area_mm2, 1e-3 * a.measures.area_mm2);
}

TEST(LumenProfile, AfterAnEditEqualsOneMadeAnew) {
  const auto model = std::make_shared<const lumen::LumenModel>(
      lumen::model_of_tubes(lumen::testing::straight_vessel(60.0, 1.5)));
  lumen::LiveModel live(model);
  const SurfaceOfVessel surface_of = [&](std::int32_t vessel) { return live.surface(vessel); };
  const std::int32_t id = model->tree.vessels.front().id;
  LumenProfile profile = lumen_profile(live.model(), surface_of, id);
  const LumenProfile before = profile;
  const lumen::EditOutcome outcome = lumen::apply(
      live.model(),
      lumen::WallDrag{.vessel = id, .from = Vec3(1.5, 0, 30), .to = Vec3(0.7, 0, 30), .reach_mm = 3.0});
  const lumen::LiveChange change = live.follow(outcome);
  ASSERT_EQ(change.vessels.size(), 1u);
  update_profile(profile, live.model(), surface_of, change.vessels[0].from_mm, change.vessels[0].to_mm);
  const LumenProfile anew = lumen_profile(live.model(), surface_of, id);
  double largest = 0.0, narrowed = 0.0;
  for (std::size_t i = 0; i < anew.sections.size(); ++i) {
    largest = std::max(largest, std::abs(anew.sections[i].diameter_mm - profile.sections[i].diameter_mm));
    narrowed = std::max(narrowed, before.sections[i].diameter_mm - profile.sections[i].diameter_mm);
  }
  EXPECT_LT(largest, 1e-5);
  EXPECT_GT(narrowed, 0.15);
}

TEST(LumenProfile, OnlyTheStretchAskedForIsMeasuredAgain) {
  const Solved wide = testing::straight(40.0, [](double, double) { return 1.5; });
  const Solved thin = testing::straight(40.0, [](double, double) { return 1.2; });
  LumenProfile profile = wide.profile();
  update_profile(profile, thin.model, thin.surface_of(), 10.0, 20.0);
  for (const SectionMeasures& section : profile.sections) {
    const bool again = section.s_mm > 9.4 && section.s_mm < 20.6;
    EXPECT_NEAR(section.diameter_mm, again ? 2.4 : 3.0, 0.06) << section.s_mm;
  }
}

TEST(LumenProfile, AStretchThatIsShutIsNotFound) {
  // The wall of a vessel of which samples are known up to 15 mm and from 25 mm on, closed by caps.
  const auto wall = [](double, double) { return 1.2; };
  lumen::LumenModel model = lumen::model_of_walls(lumen::testing::straight_vessel(40.0, 1.2), {wall});
  lumen::VesselLumen lumen = *model.vessels.front();
  lumen.samples = lumen::samples_of(*lumen.axis, wall, 0.0, 15.0, 1);
  for (const auto& sample : lumen::samples_of(*lumen.axis, wall, 25.0, 40.0, 100000))
    lumen.samples.push_back(sample);
  model.vessels.front() = std::make_shared<const lumen::VesselLumen>(lumen);
  const Solved vessel(std::move(model));
  const LumenProfile profile = vessel.profile();
  for (const SectionMeasures& section : profile.sections) {
    if (section.s_mm < 15.0 || section.s_mm > 25.0) {
      EXPECT_TRUE(section.found) << section.s_mm;
    } else if (section.s_mm > 16.6 && section.s_mm < 23.4) {
      EXPECT_FALSE(section.found) << section.s_mm;
      EXPECT_FALSE(section.open);
      EXPECT_EQ(section.area_mm2, 0.0);
    }
  }
  EXPECT_FALSE(at(profile, 20.2).found);
  EXPECT_THROW(volume_mm3(profile, 10.0, 30.0), InvalidInput);
  EXPECT_GT(volume_mm3(profile, 5.0, 10.0), 0.0);
  const MeasuredSection none = measured_section(vessel.model, vessel.surface_of(), vessel.first(), 20.0);
  EXPECT_FALSE(none.measures.found);
  EXPECT_TRUE(none.contour.empty());
}

TEST(LumenProfile, DoesNotDependOnThreadsOrRaysMuch) {
  const Solved vessel = testing::straight(30.0, [](double s, double theta) {
    return circle_from(1.4 - 0.8 * bump(s, 15.0, 12.0), 0.3 - 0.2 * bump(s, 15.0, 12.0), theta);
  });
  core::set_max_threads(1);
  const LumenProfile alone = vessel.profile();
  core::set_max_threads(2);
  const LumenProfile both = vessel.profile();
  core::set_max_threads(0);
  EXPECT_TRUE(same(alone, both));
  const LumenProfile few = vessel.profile({.around = 16}), many = vessel.profile({.around = 256});
  for (std::size_t i = 0; i < few.sections.size(); ++i) {
    EXPECT_NEAR(few.sections[i].diameter_mm, many.sections[i].diameter_mm, 2e-3);
    EXPECT_NEAR(alone.sections[i].diameter_mm, many.sections[i].diameter_mm, 1e-4);
  }
}

TEST(LumenProfile, IsLinearBetweenSections) {
  const LumenProfile profile =
      testing::profile_of(10.0, 1.0, [](double s) { return s < 5.5 ? 4.0 - 0.2 * s : 0.0; });
  EXPECT_NEAR(at(profile, 2.25).diameter_mm, 3.55, 1e-12);
  EXPECT_NEAR(at(profile, 2.25).s_mm, 2.25, 1e-12);
  EXPECT_TRUE(at(profile, 5.0).found);
  EXPECT_FALSE(at(profile, 5.5).found);
  EXPECT_EQ(at(profile, -1.0).s_mm, 0.0);
  EXPECT_EQ(at(profile, 11.0).s_mm, 10.0);
  EXPECT_THROW(at(LumenProfile{}, 1.0), InvalidInput);
}

TEST(LumenProfile, RefusesWhatItCannotMeasure) {
  const Solved vessel = testing::straight(20.0, [](double, double) { return 1.5; });
  const auto surface_of = vessel.surface_of();
  const std::int32_t id = vessel.first();
  EXPECT_THROW(lumen_profile(vessel.model, surface_of, id, {.step_mm = 0.01}), InvalidInput);
  EXPECT_THROW(lumen_profile(vessel.model, surface_of, id, {.step_mm = std::nan("")}), InvalidInput);
  EXPECT_THROW(lumen_profile(vessel.model, surface_of, id, {.around = 8}), InvalidInput);
  EXPECT_THROW(lumen_profile(vessel.model, surface_of, 77), InvalidInput);
  EXPECT_THROW(lumen_profile(vessel.model, {}, id), InvalidInput);
  EXPECT_THROW(lumen_profile(
                   vessel.model, [](std::int32_t) { return nullptr; }, id),
               InvalidInput);
  EXPECT_THROW(measured_section(vessel.model, surface_of, id, 20.5), InvalidInput);
  EXPECT_THROW(measured_section(vessel.model, surface_of, id, std::nan("")), InvalidInput);
  LumenProfile profile = vessel.profile();
  EXPECT_THROW(volume_mm3(profile, 5.0, 21.0), InvalidInput);
  EXPECT_THROW(volume_mm3(profile, 5.0, 4.0), InvalidInput);
  EXPECT_THROW(update_profile(profile, vessel.model, surface_of, 5.0, 4.0), InvalidInput);
  const Solved other = testing::straight(25.0, [](double, double) { return 1.5; });
  const LumenProfile kept = profile;
  EXPECT_THROW(update_profile(profile, other.model, other.surface_of(), 5.0, 8.0), InvalidInput);
  EXPECT_TRUE(same(profile, kept));
}

TEST(LumenProfile, CanBeCancelled) {
  const Solved vessel = testing::straight(20.0, [](double, double) { return 1.5; });
  const core::TaskContext task;
  lumen_profile(vessel.model, vessel.surface_of(), vessel.first(), {}, task);
  EXPECT_DOUBLE_EQ(task.progress(), 1.0);
  task.cancel();
  EXPECT_THROW(lumen_profile(vessel.model, vessel.surface_of(), vessel.first(), {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::analysis
