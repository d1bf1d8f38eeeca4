#include "ostia/coronary/aorta_mask.h"

#include "coarse_scan.h"
#include "kept_scan.h"

#include "ostia/core/error.h"
#include "ostia/phantom/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace ostia::coronary {
namespace {

struct Counts {
  double both = 0.0, mask = 0.0, truth = 0.0;
  double dice() const { return 2.0 * both / (mask + truth); }
};

TEST(AortaMask, IsTheLabelledLumenOfAPhantomBetweenItsEnds) {
  constexpr double voxel_mm = 1.2;
  phantom::CaseOptions options;
  options.seed = 2;
  options.preset = phantom::Preset::small;
  phantom::CasePlan plan = phantom::plan_case(options);
  ostia::testing::make_coarse(plan.options.scan, voxel_mm);
  const phantom::Scan made = ostia::testing::kept_scan(plan);
  const Aorta aorta = find_aorta(made.image);
  const imaging::MaskVolume mask = aorta_mask(made.image, aorta);
  ASSERT_TRUE(imaging::same_grid(mask.geometry, made.image.geometry));
  const AortaStation &first = aorta.stations.front(), &last = aorta.stations.back();
  Counts counts;
  double chamber = 0.0;
  const imaging::Geometry& grid = mask.geometry;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        const Vec3 at =
            grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        const auto label = static_cast<phantom::Label>(made.labels(i, j, k));
        if (mask(i, j, k) != 0 &&
            (label == phantom::Label::left_ventricle || label == phantom::Label::left_atrium ||
             label == phantom::Label::pulmonary_artery || label == phantom::Label::coronary_lumen))
          chamber += 1.0;
        // The descending aorta and what lies beyond the ends of the axis are not asked for.
        if ((at - first.centre).dot(first.tangent) < 0.0 || (at - last.centre).dot(last.tangent) > 0.0 ||
            at.y() > first.centre.y() + 45.0)
          continue;
        const bool truth = label == phantom::Label::aorta;
        counts.both += truth && mask(i, j, k) != 0 ? 1.0 : 0.0;
        counts.mask += mask(i, j, k) != 0 ? 1.0 : 0.0;
        counts.truth += truth ? 1.0 : 0.0;
      }
  std::printf("Dice %.3f, %.1f %% of it in other vessels and chambers\n", counts.dice(),
              100.0 * chamber / counts.mask);
  EXPECT_GT(counts.truth, 10000.0);
  EXPECT_GT(counts.dice(), 0.95);
  EXPECT_LT(chamber, 0.02 * counts.mask);
}

TEST(AortaMask, RefusesWhatItCannotUse) {
  imaging::ImageVolume image;
  EXPECT_THROW(aorta_mask(image, {}), InvalidInput);
  image.geometry.size = {4, 4, 4};
  image.voxels.assign(64, 0);
  EXPECT_THROW(aorta_mask(image, {}), InvalidInput);
  Aorta aorta;
  aorta.stations.resize(3);
  EXPECT_THROW(aorta_mask(image, aorta, {.wall_hu = 200.0}), InvalidInput);
}

}  // namespace
}  // namespace ostia::coronary
