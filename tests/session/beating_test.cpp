#include "ostia/session/beating.h"

#include "case_tools.h"
#include "known_motion.h"

#include "ostia/core/error.h"
#include "ostia/session/workbench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ostia::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// The tube of the case tools, and a motion of the box about it.
struct BeatingTube : ::testing::Test {
  TempFolder folder;
  Workbench bench;
  BeatingTube() { bench.set_session(Session(CaseFile::create(folder / "a.ostia", tube_model()))); }
  geometry::TriMesh wall() { return bench.session().live().wall(0.35); }
  geometry::CageMotion motion(double grown_mm = 3.0) {
    geometry::Box3 box;
    for (const Vec3& p : wall().points) box.extend(p);
    const Vec3 by = Vec3::Constant(grown_mm);
    return known_motion(box.min() - by, box.max() + by);
  }
  std::shared_ptr<const Beating> beating() {
    return Beating::made(motion(), bench.session().file().model(), wall());
  }
};

TEST_F(BeatingTube, WallAndAxesGoAsTheMotionDoes) {
  const auto beats = beating();
  for (const double phase : {0.25, 0.5, 0.05, 1.25}) {
    const auto shown = beats->at(phase);
    EXPECT_NEAR(shown->phase(), phase - std::floor(phase), 1e-12);
    const geometry::TriMesh rest = wall();
    ASSERT_EQ(shown->wall()->points.size(), rest.points.size());
    EXPECT_EQ(shown->wall()->triangles, rest.triangles);
    for (std::size_t i = 0; i < rest.points.size(); i += 37)
      EXPECT_LT((shown->wall()->points[i] - moved(rest.points[i], phase)).norm(), 1e-9);
    const auto own = bench.axis();
    const CarriedAxis& axis = shown->axis(bench.vessel.get());
    for (double s = 0.0; s <= own->length(); s += 1.7) {
      EXPECT_LT((axis.curve()->point(axis.here(s)) - moved(own->point(s), phase)).norm(), 2e-3) << s;
      EXPECT_NEAR(axis.at_template(axis.here(s)), s, 1e-9);
    }
  }
}

TEST_F(BeatingTube, TheFirstNormalGoesAlongSoThatViewsDoNotTurn) {
  const auto beats = beating();
  const Vec3 own = bench.axis()->frame(0.0).normal;
  for (int k = 0; k < 20; ++k) {
    const auto curve = beats->at(k / 20.0)->axis(bench.vessel.get()).curve();
    EXPECT_GT(curve->frame(0.0).normal.dot(own), 0.95) << k;
  }
}

TEST_F(BeatingTube, FeetOfTheWallAreThoseOfTheAxis) {
  const auto beats = beating();
  const std::vector<double>& feet = beats->wall_feet(bench.vessel.get());
  ASSERT_EQ(feet.size(), beats->wall().points.size());
  for (std::size_t i = 0; i < feet.size(); i += 101)
    EXPECT_NEAR(feet[i], bench.axis()->nearest_foot(beats->wall().points[i]).s_mm, 1e-9);
}

TEST_F(BeatingTube, AMotionOfAnotherTreeIsRefusedWithTheWayOut) {
  const geometry::CageMotion elsewhere = known_motion(Vec3(200, 200, 200), Vec3(230, 230, 240));
  try {
    Beating::made(elsewhere, bench.session().file().model(), wall());
    FAIL() << "it was taken";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("100 % of this case's wall lie outside"));
    EXPECT_THAT(error.what(), HasSubstr("choose the motion that was made of this tree"));
  }
  geometry::CageMotion two = motion();
  two.phases.resize(2);
  EXPECT_THROW(Beating::made(two, bench.session().file().model(), wall()), InvalidInput);
  EXPECT_THROW(Beating::made(motion(), nullptr, wall()), InvalidInput);
  EXPECT_THROW(beating()->at(std::nan("")), InvalidInput);
}

TEST_F(BeatingTube, TheCursorStaysAtItsPlaceOfTheVessel) {
  bench.cursor_mm.set(12.0);
  const Vec3 own = bench.place.get();
  int told = 0;
  const auto kept = bench.phase_changed.observe([&] { ++told; });
  const auto beats = beating();
  for (int turn = 0; turn < 50; ++turn)
    for (const double phase : {0.25, 0.4, 0.9}) {
      bench.show_phase(beats->at(phase));
      EXPECT_LT((bench.place.get() - moved(own, phase)).norm(), 2e-3);
      EXPECT_NEAR(bench.own_mm(bench.cursor_mm.get()), 12.0, 1e-6);
      EXPECT_NEAR(bench.cursor_mm.range()->high, bench.axis()->length(), 1e-12);
    }
  EXPECT_EQ(told, 150);
  bench.show_phase(nullptr);
  EXPECT_NEAR(bench.cursor_mm.get(), 12.0, 1e-6);
  EXPECT_LT((bench.place.get() - own).norm(), 1e-6);
  EXPECT_FALSE(bench.other_phase());
}

TEST_F(BeatingTube, APhaseWithoutAnAxisLeavesWhatWasShown) {
  geometry::CageMotion wild = motion();
  for (Vec3& p : wild.phases[5].control_points) p = Vec3(1.0, 2.0, 3.0);  // all in one point
  const auto beats = Beating::made(wild, bench.session().file().model(), wall());
  bench.cursor_mm.set(12.0);
  bench.show_phase(beats->at(0.75));
  EXPECT_ANY_THROW(bench.show_phase(beats->at(0.25)));
  ASSERT_TRUE(bench.other_phase());
  EXPECT_DOUBLE_EQ(bench.other_phase()->phase(), 0.75);
  EXPECT_NO_THROW(bench.axis());
  bench.show_phase(nullptr);
  EXPECT_FALSE(bench.other_phase());
  EXPECT_NEAR(bench.cursor_mm.get(), 12.0, 1e-6);
}

TEST_F(BeatingTube, ASliceThatWasScrolledAwayFromTheVesselStays) {
  const Vec3 away(7.0, 3.0, 5.0);
  bench.place.set(away);
  bench.show_phase(beating()->at(0.25));
  EXPECT_EQ(bench.place.get(), away);
}

TEST_F(BeatingTube, WhatChangesTheCaseIsRefusedAtAnotherPhase) {
  bench.edit(ring(12.0, 1.2));
  const std::string before = lumen::digest(*bench.model());
  bench.show_phase(beating()->at(0.25));
  int refused = 0;
  const auto kept = bench.phase_refused.observe([&] { ++refused; });
  EXPECT_THROW(bench.edit(ring(12.0, 1.2)), InvalidInput);
  EXPECT_THROW(bench.edit_merged(ring(12.0, 1.2)), InvalidInput);
  EXPECT_THROW(bench.undo(), InvalidInput);
  EXPECT_THROW(bench.redo(), InvalidInput);
  EXPECT_THROW(bench.go_to_step(0), InvalidInput);
  EXPECT_THROW(bench.annotate(MeasureDelete{1}), InvalidInput);
  EXPECT_EQ(refused, 6);
  try {
    bench.undo();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("shown at 25 %"));
    EXPECT_THAT(error.what(), HasSubstr("at 75 % only"));
  }
  VesselMark mark;
  mark.vessel = bench.vessel.get();
  mark.visible = false;
  bench.annotate(MarkVessel{mark});  // how it is shown
  EXPECT_EQ(lumen::digest(*bench.model()), before);
  bench.show_phase(nullptr);
  EXPECT_TRUE(bench.undo());
}

TEST_F(BeatingTube, APhaseGoesWithItsModelAndItsCase) {
  const auto beats = beating();
  bench.edit(ring(12.0, 1.2));
  EXPECT_THROW(bench.show_phase(beats->at(0.25)), InvalidInput);
  EXPECT_FALSE(bench.other_phase());
  bench.show_phase(beating()->at(0.25));
  bench.close_case();
  EXPECT_FALSE(bench.other_phase());
  EXPECT_THROW(bench.show_phase(beats->at(0.25)), InvalidInput);
}

TEST_F(BeatingTube, ViewsHaveThePhasesImageWhereThereIsOne) {
  auto own = std::make_shared<imaging::ImageVolume>();
  own->geometry.size = {4, 4, 4};
  own->voxels.assign(64, 100);
  auto other = std::make_shared<imaging::ImageVolume>(*own);
  bench.set_image({own, {}});
  EXPECT_EQ(bench.shown_volume(), own.get());
  bench.show_phase(beating()->at(0.25));
  EXPECT_EQ(bench.shown_volume(), own.get());
  EXPECT_DOUBLE_EQ(bench.image_phase(), own_phase);
  bench.show_phase(beating()->at(0.25), std::make_shared<const PhaseImage>(PhaseImage{other, 0.3}));
  EXPECT_EQ(bench.shown_volume(), other.get());
  EXPECT_DOUBLE_EQ(bench.image_phase(), 0.3);
  bench.show_phase(nullptr);
  EXPECT_EQ(bench.shown_volume(), own.get());
}

TEST(Phases, AreNamedAndHeldAgainstEachOtherAroundTheCycle) {
  EXPECT_EQ(percent_of_cycle(0.35), "35 %");
  EXPECT_EQ(percent_of_cycle(0.375), "37.5 %");
  EXPECT_EQ(percent_of_cycle(0.0), "0 %");
  EXPECT_NEAR(phase_distance(0.95, 0.05), 0.1, 1e-12);
  EXPECT_NEAR(phase_distance(0.05, 0.95), 0.1, 1e-12);
  EXPECT_NEAR(phase_distance(0.25, 0.75), 0.5, 1e-12);
  EXPECT_NEAR(phase_distance(0.3, 1.3), 0.0, 1e-12);
}

}  // namespace
}  // namespace ostia::session
