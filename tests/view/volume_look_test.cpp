#include "ostia/view/volume_look.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::view {
namespace {

constexpr VolumePreset presets_of_volume[] = {VolumePreset::coronary, VolumePreset::vessels,
                                              VolumePreset::soft_tissue, VolumePreset::bone};

TEST(VolumeLooks, LungIsNeverSeenAndCalciumAlways) {
  for (const VolumePreset preset : presets_of_volume) {
    const VolumeTransfer transfer = transfer_of({preset});
    EXPECT_EQ(opacity_at(transfer, -700.0), 0.0);
    EXPECT_GT(opacity_at(transfer, 1000.0), 0.8);
    double before = -1.0;
    for (double hu = -1000.0; hu < 2000.0; hu += 10.0) {
      EXPECT_GE(opacity_at(transfer, hu), before) << "what is denser is no fainter, at " << hu << " HU";
      before = opacity_at(transfer, hu);
      EXPECT_LE(before, 1.0);
    }
  }
}

TEST(VolumeLooks, ShowWhatTheyAreNamedAfter) {
  const double muscle = 100.0, contrast = 400.0;
  EXPECT_LT(opacity_at(transfer_of({VolumePreset::vessels}), muscle), 0.02);
  EXPECT_GT(opacity_at(transfer_of({VolumePreset::coronary}), muscle), 0.1);
  EXPECT_GT(opacity_at(transfer_of({VolumePreset::soft_tissue}), muscle), 0.4);
  EXPECT_EQ(opacity_at(transfer_of({VolumePreset::bone}), muscle), 0.0);
  for (const VolumePreset preset : presets_of_volume)
    EXPECT_GT(opacity_at(transfer_of({preset}), contrast), 0.25);
}

TEST(VolumeLooks, AShiftMovesAndAStretchWidensAboutTheMiddle) {
  for (const VolumePreset preset : presets_of_volume) {
    const VolumeTransfer plain = transfer_of({preset}), moved = transfer_of({preset, 85.0, 1.0}),
                         wide = transfer_of({preset, 0.0, 2.0});
    for (double hu = -300.0; hu < 1500.0; hu += 7.0)
      EXPECT_NEAR(opacity_at(moved, hu + 85.0), opacity_at(plain, hu), 1e-9);
    EXPECT_NEAR(wide.opacities.back().hu - wide.opacities.front().hu,
                2.0 * (plain.opacities.back().hu - plain.opacities.front().hu), 1e-9);
    EXPECT_NEAR(wide.colors.back().hu - wide.colors.front().hu,
                2.0 * (plain.colors.back().hu - plain.colors.front().hu), 1e-9);
  }
  EXPECT_THROW(transfer_of({VolumePreset::bone, 2001.0, 1.0}), InvalidInput);
  EXPECT_THROW(transfer_of({VolumePreset::bone, 0.0, 0.1}), InvalidInput);
}

TEST(VolumeLooks, AHistogramCountsEachVoxelInItsRangeOnce) {
  imaging::ImageVolume image;
  image.geometry.size = {3, 2, 1};
  image.voxels = {-200, -1, 0, 99, 100, 299};
  EXPECT_EQ(histogram(image, 0.0, 300.0, 3), (std::vector<std::int64_t>{2, 1, 1}));
  EXPECT_THROW(histogram(image, 0.0, 0.0, 3), InvalidInput);
  EXPECT_THROW(histogram(image, 0.0, 1.0, 0), InvalidInput);
}

}  // namespace
}  // namespace ostia::view
