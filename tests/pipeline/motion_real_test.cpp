// A real heart over its beat: every second phase is enough to know the others.

#include "shared_data.h"

#include "ostia/evaluation/surface_motion.h"
#include "ostia/io/surface_fields.h"
#include "ostia/motion/moving_cage.h"
#include "ostia/pipeline/motion_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace ostia::pipeline {
namespace {

namespace fs = std::filesystem;

std::vector<PhaseSurface> epicardium(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().filename().string().find("EPICARDIAL") != std::string::npos)
      files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<PhaseSurface> phases;
  for (std::size_t k = 0; k < files.size(); ++k)
    phases.push_back({static_cast<double>(k) / static_cast<double>(files.size()),
                      files[k].filename().string(), io::read_surface_with_fields(files[k]).mesh});
  return phases;
}

TEST(MotionReal, EpicardiumWithEverySecondPhaseLeftOut) {
  OSTIA_REQUIRE_SHARED(zip, "motion4d/biv-me-patient1/vtk-25phases.zip");
  const std::vector<PhaseSurface> all = epicardium(testing::unpacked(zip));
  ASSERT_EQ(all.size(), 25U);
  std::vector<PhaseSurface> kept;
  for (std::size_t k = 0; k < all.size(); k += 2) kept.push_back(all[k]);
  const MotionFit fit = fit_motion(kept);
  ASSERT_EQ(fit.phases.size(), 13U) << "what was left out is no gap";
  for (const PhaseFit& one : fit.phases) {
    EXPECT_NE(one.origin, geometry::PhaseOrigin::bridged) << one.phase << ": " << one.why;
    EXPECT_GT(one.report.least_jacobian, 0.0) << one.phase;
    EXPECT_LE(one.report.self_intersections, one.report.source_self_intersections) << one.phase;
  }
  const motion::MovingCage cage(fit.motion);
  const motion::CarriedPoints carried(cage.grid(), fit.template_shape.points);
  evaluation::SurfaceMotion reference, result;
  for (const PhaseSurface& one : all) {
    reference.names.push_back(one.name);
    reference.phases.push_back(one.surface);
    result.phases.push_back({carried.places(cage.at(one.phase)), fit.template_shape.triangles});
  }
  result.names = reference.names;
  const auto error =
      evaluation::compare_surface_motion(reference, result, {.sample_mm = 2.0, .resolution_mm = 2.0});
  double of_kept = 0.0, of_left_out = 0.0;
  for (std::size_t k = 0; k < all.size(); ++k)
    (k % 2 == 0 ? of_kept : of_left_out) += error.phases[k].msd_mm / (k % 2 == 0 ? 13.0 : 12.0);
  std::printf("mean surface distance %.3f mm on kept phases, %.3f mm on those left out\n", of_kept,
              of_left_out);
  EXPECT_LE(of_kept, 0.3);
  EXPECT_LE(of_left_out, 0.6);
}

}  // namespace
}  // namespace ostia::pipeline
