#include "ostia/experiments/sensitivity.h"

#include "shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

namespace ostia::experiments {
namespace {

TEST(Sensitivity, EveryParameterHasItsDefaultAndNeighboursOnBothSides) {
  std::set<std::string> names;
  const auto check = [&](const auto& parameters) {
    for (const auto& p : parameters) {
      EXPECT_TRUE(names.insert(p.name).second) << p.name;
      ASSERT_LT(p.standard, p.settings.size()) << p.name;
      if (p.choice) continue;
      EXPECT_TRUE(p.settings[p.standard].near) << p.name;
      const auto near =
          std::count_if(p.settings.begin(), p.settings.end(), [](const auto& s) { return s.near; });
      EXPECT_GE(near, 2) << p.name;
    }
  };
  check(segment_parameters());
  check(boundary_parameters());
}

TEST(Sensitivity, DefaultsTriedAreThoseOfTheOptions) {
  const KnownLumen nothing{"", {}, {}, {}, 350.0, 50.0};
  const segmentation::LumenBoundaryOptions standard;
  for (const auto& p : boundary_parameters()) {
    segmentation::LumenBoundaryOptions o;
    p.apply(o, p.settings[p.standard].value, nothing);
    EXPECT_EQ(o.step_mm, standard.step_mm) << p.name;
    EXPECT_EQ(o.around, standard.around) << p.name;
    EXPECT_EQ(o.radial_step_mm, standard.radial_step_mm) << p.name;
    EXPECT_EQ(o.blur_sigma_mm, standard.blur_sigma_mm) << p.name;
    EXPECT_EQ(o.wall_hu, standard.wall_hu) << p.name;
  }
  const segmentation::SegmentOptions level_set;
  for (const auto& p : segment_parameters()) {
    segmentation::SegmentOptions o;
    p.apply(o, p.settings[p.standard].value, nothing);
    EXPECT_EQ(o.level_set.curvature, level_set.level_set.curvature) << p.name;
    EXPECT_EQ(o.level_set.advection, level_set.level_set.advection) << p.name;
    EXPECT_EQ(o.level_set.iterations_max, level_set.level_set.iterations_max) << p.name;
    EXPECT_EQ(o.level_set.rms_tolerance_voxels, level_set.level_set.rms_tolerance_voxels) << p.name;
    EXPECT_EQ(o.fronts.slowest, level_set.fronts.slowest) << p.name;
    EXPECT_EQ(o.fronts.overrun, level_set.fronts.overrun) << p.name;
    EXPECT_EQ(o.fronts.margin_voxels, level_set.fronts.margin_voxels) << p.name;
  }
}

TEST(Sensitivity, OfTheCurvatureWeightOnAStenosedTube) {
  const std::vector<KnownLumen> lumina{stenosed_lumen(1)};
  const SensitivityResult result = run_sensitivity(lumina, {}, "curvature w2");
  ASSERT_EQ(result.level_set.size(), 1u);
  EXPECT_TRUE(result.boundary.empty());
  // 30 mm of a tube of 1.75 mm, throat of half of it: pi r^2 less what the narrowing takes.
  ASSERT_EQ(result.truth.size(), 1u);
  const double full = std::numbers::pi * 1.75 * 1.75 * 30.0;
  EXPECT_GT(result.truth[0].volume_mm3, 0.80 * full);
  EXPECT_LT(result.truth[0].volume_mm3, 1.02 * full);
  EXPECT_NEAR(result.truth[0].least_diameter_mm, 1.75, 0.02);
  EXPECT_EQ(result.truth[0].axis_mm, 0.0);
  const ParameterRun& run = result.level_set[0];
  const LumenFigures& standard = run.settings[run.standard].cases[0];
  EXPECT_NEAR(standard.volume_mm3 / result.truth[0].volume_mm3, 1.0, 0.05);
  EXPECT_LT(standard.axis_mm, 0.1);
  EXPECT_EQ(standard.lost, 0);
  EXPECT_TRUE(run.on_plateau) << run.verdict;
  // Curvature shrinks tubes.
  EXPECT_LT(run.settings.back().cases[0].volume_mm3, run.settings.front().cases[0].volume_mm3);
}

TEST(Sensitivity, FeelsAWrongBlurOnAStenosedTube) {
  const std::vector<KnownLumen> lumina{stenosed_lumen(1)};
  const SensitivityResult result = run_sensitivity(lumina, {}, "blur sigma");
  ASSERT_EQ(result.boundary.size(), 1u);
  const ParameterRun& run = result.boundary[0];
  EXPECT_EQ(run.settings[run.standard].cases[0].lost, 0);
  const double least = run.settings.front().cases[0].volume_mm3,
               most = run.settings.back().cases[0].volume_mm3;
  EXPECT_GT(std::abs(most / least - 1.0), plateau_limit);  // half the blur or far too much is felt
  const std::filesystem::path folder = testing::temporary_folder("sensitivity");
  write_sensitivity_report(folder, result);
  for (const char* file : {"level-set.csv", "boundary.csv", "sensitivity.png", "report.html"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
}

}  // namespace
}  // namespace ostia::experiments
