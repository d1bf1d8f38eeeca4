// The same beside the wall of a real aorta.

#include "itk_peers.h"
#include "shared_data.h"

#include "ostia/imaging/diffusion.h"
#include "ostia/imaging/image_file.h"
#include "ostia/segmentation/vesselness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::filtering::peers {
namespace {

double largest_difference_inside(const FloatVolume& a, const FloatVolume& b, std::int64_t border) {
  double most = 0.0;
  const auto& s = a.geometry.size;
  for (std::int64_t k = border; k < s[2] - border; ++k)
    for (std::int64_t j = border; j < s[1] - border; ++j)
      for (std::int64_t i = border; i < s[0] - border; ++i)
        most = std::max(most, std::abs(static_cast<double>(a(i, j, k)) - b(i, j, k)));
  return most;
}

TEST(SecondOpinionReal, OnTheWallOfAnAorta) {
  OSTIA_REQUIRE_SHARED(path, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  const imaging::ImageVolume whole = imaging::read_image(path).volume;
  imaging::Region region;
  for (std::size_t a = 0; a < 3; ++a) {
    region.lower[a] = whole.geometry.size[a] / 2 - std::min<std::int64_t>(32, whole.geometry.size[a] / 2);
    region.upper[a] = std::min(whole.geometry.size[a], region.lower[a] + 64);
  }
  const imaging::ImageVolume image = imaging::cropped(whole, region);
  const FloatVolume floats{image.geometry, {image.voxels.begin(), image.voxels.end()}};

  imaging::DiffusionOptions diffusion;
  diffusion.contrast_hu_per_mm = 50.0;
  diffusion.step = 0.5;
  const double longest_mm2 = 1.0 / (2.0 * image.geometry.spacing.cwiseInverse().squaredNorm());
  for (const bool curvature : {false, true}) {
    diffusion.method = curvature ? imaging::Diffusion::curvature : imaging::Diffusion::gradient;
    const FloatVolume ours = imaging::diffused(floats, diffusion);
    const FloatVolume itks = itk_diffused(floats, curvature, 5, longest_mm2 * (curvature ? 0.25 : 0.5), 50.0);
    EXPECT_LT(largest_difference_inside(ours, itks, 6), 0.5) << curvature;
  }

  segmentation::VesselnessOptions tubes;
  tubes.method = segmentation::TubeMethod::hessian;
  const double radius = 3.0 * image.geometry.spacing.maxCoeff();
  tubes.radii_mm = {radius};
  tubes.image_blur_mm = 0.0;
  const FloatVolume ours = segmentation::vesselness(image, {}, tubes).response_hu;
  const FloatVolume itks = itk_tubeness(floats, radius / std::sqrt(2.0), tubes.gap_weight);
  const double most = *std::max_element(itks.voxels.begin(), itks.voxels.end());
  EXPECT_LT(largest_difference_inside(ours, itks, 14), 0.08 * most);
}

}  // namespace
}  // namespace ostia::filtering::peers
