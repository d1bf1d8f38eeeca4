// Phases in files, of which it is known how much each is smeared, one of them bad.
#include "ostia/session/phase_choice.h"

#include "case_tools.h"
#include "known_motion.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/workbench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::session {
namespace {

using namespace testing;
using evaluation::LeftOut;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// The known motion's tube (along z about the origin), which keeps its calibre here, smeared across by a way
/// that grows from a rest at 45 %.
constexpr double rest_phase = 0.45;
imaging::ImageVolume beating_tube(double phase, bool moves) {
  imaging::ImageVolume image;
  image.geometry.size = {60, 60, 90};
  image.geometry.spacing = {0.5, 0.5, 0.5};
  image.geometry.origin = {-13.0, -15.0, -3.0};
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  const double smear = 6.0 * phase_distance(phase, rest_phase);
  const double c = moves ? contraction(phase) : 0.0;
  // Every slice is the first: nothing changes along the tube.
  constexpr std::int64_t side = 60;
  for (std::int64_t j = 0; j < side; ++j)
    for (std::int64_t i = 0; i < side; ++i) {
      const Vec3 at = image.geometry.world({static_cast<double>(i), static_cast<double>(j), 0.0});
      double sum = 0.0;
      for (int n = -3; n <= 3; ++n) {
        const double x = at.x() - shift_mm * c - smear * n / 6.0;
        sum += 0.5 * std::erfc((std::hypot(x, at.y()) - 1.5) / 0.6);
      }
      image(i, j, 0) = static_cast<std::int16_t>(std::lround(-90.0 + 480.0 * sum / 7.0));
    }
  for (std::ptrdiff_t k = 1; k < 90; ++k)
    std::copy_n(image.voxels.begin(), side * side, image.voxels.begin() + k * side * side);
  return image;
}

struct BeatingPhases : ::testing::Test {
  TempFolder folder;
  Workbench bench;
  PhaseChoiceWork work;
  BeatingPhases() { bench.set_session(Session(CaseFile::create(folder / "a.ostia", tube_model()))); }
  void write(bool moves) {
    std::vector<PhaseSource> sources;
    for (int percent = 5; percent < 100; percent += 10) {
      const fs::path file = folder / ("phase_" + std::to_string(percent) + ".nrrd");
      imaging::write_image(file, beating_tube(percent / 100.0, moves));
      sources.push_back({percent / 100.0, file, {}});
    }
    work.stack = stack_of_files(sources, sources[7].file);  // 75 % is on the table
    work.compared = cine_of(work.stack);
    work.held.resize(sources.size());
    ASSERT_EQ(work.compared.size(), 10u);
  }
};

TEST_F(BeatingPhases, WithoutAxesTheHeartsEdgesTell) {
  write(true);
  const PhaseChoice found = work.chosen();
  EXPECT_EQ(found.places, SharpnessPlaces::heart);
  EXPECT_EQ(found.best.best, 4u) << "45 %";
}

TEST_F(BeatingPhases, AlongTheSameAxes) {
  write(true);
  work.axes_mm = axis_points(*bench.model());
  EXPECT_GT(work.axes_mm.size(), 20u);
  const PhaseChoice found = work.chosen();
  EXPECT_EQ(found.places, SharpnessPlaces::same_axes);
  EXPECT_EQ(found.best.best, 4u);
  EXPECT_LT(found.best.share[9], 0.85) << "half a cycle away";
}

TEST_F(BeatingPhases, AlongAxesThatTheMotionCarries) {
  write(true);
  work.axes_mm = axis_points(*bench.model());
  work.beating = Beating::made(known_motion({-9.0, -9.0, -4.0}, {9.0, 9.0, 44.0}),
                               bench.session().file().model(), bench.session().live().wall(0.35));
  const auto own = axis_points(*work.beating, own_phase), away = axis_points(*work.beating, 0.25);
  ASSERT_EQ(own.size(), away.size());
  for (std::size_t n = 0; n < own.size(); ++n) EXPECT_LT((away[n] - moved(own[n], 0.25)).norm(), 0.05);
  const PhaseChoice found = work.chosen();
  EXPECT_EQ(found.places, SharpnessPlaces::carried_axes);
  EXPECT_EQ(found.best.best, 4u);
}

TEST_F(BeatingPhases, ABadPhaseIsNamedAndTheOthersAreCompared) {
  write(false);
  const std::string whole = core::read_file(work.stack.entries[4].source.file, 1U << 28);
  core::write_file(work.stack.entries[4].source.file, whole.substr(0, whole.size() / 2));
  const PhaseChoice found = work.chosen();
  EXPECT_THAT(found.faults[4], HasSubstr("phase_45.nrrd"));
  EXPECT_EQ(found.best.left_out[4], LeftOut::not_measured);
  EXPECT_EQ(found.faults[3], "");
  EXPECT_TRUE(found.best.best == 3u || found.best.best == 5u) << "the next best";
}

TEST_F(BeatingPhases, WhatIsHeldIsNotReadAndItCanBeCancelled) {
  write(false);
  for (std::size_t n = 0; n < 10; ++n)
    work.held[n] = std::make_shared<const imaging::ImageVolume>(
        imaging::read_image(work.stack.entries[n].source.file).volume);
  for (const StackEntry& one : work.stack.entries) fs::remove(one.source.file);
  EXPECT_EQ(work.chosen().best.best, 4u);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(work.chosen(task), Cancelled);
}

}  // namespace
}  // namespace ostia::session
