#include "shared_data.h"

#include "ostia/evaluation/image_quality.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>

namespace ostia::evaluation {
namespace {

imaging::MaskVolume between(const imaging::ImageVolume& image, double sigma_mm, float low, float high) {
  imaging::FloatVolume values{image.geometry, std::vector<float>(image.voxels.begin(), image.voxels.end())};
  values = imaging::gaussian_blurred(values, sigma_mm);
  imaging::MaskVolume mask{image.geometry, {}};
  for (const float v : values.voxels) mask.voxels.push_back(v > low && v < high);
  return mask;
}

TEST(ImageQualityReal, TheChestCtaHasTheNoiseAndSharpnessOfASoftKernel) {
  OSTIA_REQUIRE_SHARED(path, "cta/rider-pilot-chest-pe-cta/heart-crop.nrrd");
  const imaging::ImageVolume image = imaging::read_image(path).volume;
  const auto regions = noise_regions(between(image, 2.0, 180.0f, 320.0f), 20);
  ASSERT_GT(regions.size(), 100u);
  const NoisePower noise = noise_power(image, regions, 20);
  EXPECT_NEAR(noise.deviation_hu, 29.7, 2.0);
  EXPECT_NEAR(noise.mean_per_mm, 0.18, 0.03);
  EdgeOptions options;
  options.direction = EdgeDirection::in_plane;
  options.half_length_mm = 3.0;
  const EdgeWidths edges = edge_widths(image, between(image, 0.7, 90.0f, 1e6f), options, 1000);
  ASSERT_GT(edges.fwhm_mm.size(), 100u);
  EXPECT_GT(edges.p25_mm, 0.9);
  EXPECT_LT(edges.p25_mm, 1.9);
}

}  // namespace
}  // namespace ostia::evaluation
