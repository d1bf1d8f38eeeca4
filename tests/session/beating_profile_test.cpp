#include "ostia/session/beating_profile.h"

#include "case_tools.h"
#include "known_motion.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::session {
namespace {

using namespace testing;

const auto known = [](const Vec3& p, double phase) { return moved(p, phase); };

struct Profiled : ::testing::Test {
  TempFolder folder;
  Workbench bench;
  void open(lumen::LumenModel model) {
    bench.set_session(Session(CaseFile::create(folder / "a.ostia", std::move(model))));
  }
  template <class Places>
  BeatingProfile profile(const Places& places, std::int32_t vessel, std::size_t phases = 20) {
    geometry::TriMesh wall = bench.session().live().wall(0.35);
    geometry::Box3 box;
    for (const Vec3& p : wall.points) box.extend(p);
    const Vec3 by = Vec3::Constant(3.0);
    const auto beating = Beating::made(motion_of(box.min() - by, box.max() + by, places),
                                       bench.session().file().model(), std::move(wall));
    return beating_profile(lumen_rings(ring_work(bench.session(), vessel)), *beating, phases);
  }
};

TEST_F(Profiled, ATubeThatBecomesThinnerHasTheAreaOfItsScale) {
  open(tube_model());
  const BeatingProfile made = profile(known, tube_vessel);
  ASSERT_EQ(made.phases.size(), 20U);
  for (std::size_t k = 0; k < made.phases.size(); ++k) {
    const double scale = 1.0 - thinning * contraction(made.phases[k]);
    for (std::size_t i = 2; i + 2 < made.s_mm.size(); ++i) {
      EXPECT_NEAR(made.diameter_mm(k, i), 2.0 * 1.5 * scale, 0.02) << made.phases[k] << " " << made.s_mm[i];
      EXPECT_NEAR(made.diameter_mm(k, i) / made.diameter_mm(15, i), scale, 1e-6) << "against 75 %";
    }
  }
}

TEST_F(Profiled, ATubeThatIsShearedHasItsAreaAcrossItsOwnAxis) {
  open(tube_model());
  const auto sheared = [](const Vec3& p, double phase) {
    return Vec3(p.x() + 0.5 * contraction(phase) * p.z(), p.y(), p.z());
  };
  const BeatingProfile made = profile(sheared, tube_vessel);
  const double leaning = 1.0 / std::sqrt(1.0 + 0.25);  // half a cycle from the template's phase
  for (std::size_t i = 2; i + 2 < made.s_mm.size(); ++i)
    EXPECT_NEAR(made.area_mm2[5][i] / made.area_mm2[15][i], leaning, 1e-6);
}

TEST_F(Profiled, ABranchThatGrowsEvenlyGrowsEverywhere) {
  open(y_model());
  const auto grown = [](const Vec3& p, double phase) { return Vec3((1.0 + 0.1 * contraction(phase)) * p); };
  for (const auto& vessel : bench.model()->vessels) {
    const BeatingProfile made = profile(grown, vessel->vessel, 4);
    std::size_t found = 0;
    for (std::size_t i = 0; i < made.s_mm.size(); ++i) {
      if (std::isnan(made.area_mm2[1][i])) continue;
      ++found;
      EXPECT_NEAR(made.area_mm2[1][i] / made.area_mm2[3][i], 1.21, 1e-6) << made.s_mm[i];
    }
    EXPECT_GT(found, made.s_mm.size() / 2);
  }
}

TEST_F(Profiled, WhatCannotBeMeasuredIsRefused) {
  open(tube_model());
  EXPECT_THROW(ring_work(bench.session(), 99), InvalidInput);
  EXPECT_THROW(profile(known, tube_vessel, 2), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(lumen_rings(ring_work(bench.session(), tube_vessel), task), Cancelled);
}

}  // namespace
}  // namespace ostia::session
