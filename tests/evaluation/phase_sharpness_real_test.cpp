// A real gated scan, smeared by known ways along x or y as a heart that moves while the scanner looks.
#include "shared_data.h"

#include "ostia/evaluation/phase_sharpness.h"
#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ostia::evaluation {
namespace {

imaging::ImageVolume smeared(const imaging::ImageVolume& image, std::int64_t along_i, std::int64_t along_j) {
  imaging::ImageVolume out = image;
  const auto& size = image.geometry.size;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i) {
        std::int64_t sum = 0;
        for (std::int64_t n = 0; n < along_i; ++n)
          for (std::int64_t m = 0; m < along_j; ++m)
            sum += image(std::clamp<std::int64_t>(i + n - along_i / 2, 0, size[0] - 1),
                         std::clamp<std::int64_t>(j + m - along_j / 2, 0, size[1] - 1), k);
        out(i, j, k) = static_cast<std::int16_t>(sum / (along_i * along_j));
      }
  return out;
}

TEST(RealSharpness, ARealScanIsSharperTheLessItIsSmeared) {
  OSTIA_REQUIRE_SHARED(path, "cta/coronary-cta-slab/slab.nrrd");
  const auto image = imaging::read_image(path).volume;
  const auto blood = blood_level_hu(image);
  ASSERT_TRUE(blood) << "the aorta and the pulmonary artery are full of contrast";
  SharpnessOptions options;
  options.high_hu = *blood;
  std::vector<std::optional<EdgeSharpness>> phases;
  for (const std::int64_t way : {9, 5, 1, 3, 7})
    phases.emplace_back(edge_sharpness(smeared(image, way, 1), {}, options));
  phases.emplace_back(edge_sharpness(smeared(image, 1, 5), {}, options));
  const BestPhase found = best_phase(phases);
  ASSERT_EQ(found.best, 2u);
  for (const std::size_t n : {3u, 1u, 4u, 0u, 5u}) {
    EXPECT_EQ(found.left_out[n], LeftOut::none) << n;
    RecordProperty("share_" + std::to_string(n), std::to_string(found.share[n]));
    std::printf("smeared, number %zu: sharpness %.3f of the scan's own\n", n, found.share[n]);
  }
  EXPECT_GT(found.share[2], found.share[3]);
  EXPECT_GT(found.share[3], found.share[1]);
  EXPECT_GT(found.share[1], found.share[4]);
  EXPECT_GT(found.share[4], found.share[0]);
  EXPECT_LT(found.share[5], 0.97) << "along y, too";
}

}  // namespace
}  // namespace ostia::evaluation
