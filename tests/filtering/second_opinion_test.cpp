// Our diffusion, vesselness, fast marching and level set beside ITK's filters on the same image.

#include "fronts/fast_marching.h"
#include "itk_peers.h"
#include "tube_scene.h"

#include "ostia/imaging/diffusion.h"
#include "ostia/imaging/sampling.h"
#include "ostia/segmentation/level_set.h"
#include "ostia/segmentation/vesselness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::filtering::peers {
namespace {

using segmentation::detail::FrontStop;
using segmentation::detail::FrontTimes;
using segmentation::detail::SpeedModel;
using segmentation::detail::Voxel;

const TubeScene& scene() {
  static const TubeScene one({48, 48, 64}, 2.0, 25.0);
  return one;
}

template <class Visit>
void for_inner_voxels(const imaging::Geometry& grid, std::int64_t border, const Visit& visit) {
  for (std::int64_t k = border; k < grid.size[2] - border; ++k)
    for (std::int64_t j = border; j < grid.size[1] - border; ++j)
      for (std::int64_t i = border; i < grid.size[0] - border; ++i) visit(i, j, k);
}

double largest_difference(const FloatVolume& a, const FloatVolume& b, std::int64_t border) {
  double most = 0.0;
  for_inner_voxels(a.geometry, border, [&](auto i, auto j, auto k) {
    most = std::max(most, std::abs(static_cast<double>(a(i, j, k)) - b(i, j, k)));
  });
  return most;
}

class Diffusions : public ::testing::TestWithParam<imaging::Diffusion> {};
INSTANTIATE_TEST_SUITE_P(SecondOpinion, Diffusions,
                         ::testing::Values(imaging::Diffusion::gradient, imaging::Diffusion::curvature),
                         [](const auto& p) {
                           return p.param == imaging::Diffusion::gradient ? "gradient" : "curvature";
                         });

TEST_P(Diffusions, AreItksToATenthOfAHounsfieldUnit) {
  const bool curvature = GetParam() == imaging::Diffusion::curvature;
  imaging::DiffusionOptions options;
  options.method = GetParam();
  options.iterations = 5;
  options.contrast_hu_per_mm = 150.0;
  options.step = 0.5;
  const double longest_mm2 = 0.16 / 6.0, step_mm2 = longest_mm2 * options.step * (curvature ? 0.5 : 1.0);
  const FloatVolume ours = imaging::diffused(scene().floats, options);
  const FloatVolume itks = itk_diffused(scene().floats, curvature, 5, step_mm2, 150.0);
  EXPECT_GT(largest_difference(ours, scene().floats, 6), 30.0) << "nothing was diffused";
  EXPECT_LT(largest_difference(ours, itks, 6), 0.1);
}

TEST(SecondOpinion, TubenessIsThatOfItksHessianToAPercent) {
  segmentation::VesselnessOptions options;
  options.method = segmentation::TubeMethod::hessian;
  options.radii_mm = {2.0};
  options.image_blur_mm = 0.0;
  const auto ours = segmentation::vesselness(scene().image, {}, options).response_hu;
  const FloatVolume itks = itk_tubeness(scene().floats, 2.0 / std::sqrt(2.0), options.gap_weight);
  const double most = *std::max_element(itks.voxels.begin(), itks.voxels.end());
  EXPECT_GT(most, 200.0);
  EXPECT_LT(largest_difference(ours, itks, 14), 0.01 * most);
}

TEST(SecondOpinion, ArrivalTimesAreItksWithinItsOwnError) {
  imaging::ImageVolume image = scene().image;
  for (std::int16_t& hu : image.voxels) hu = 300;
  const SpeedModel speed{{100.0, 500.0}, 300.0, 0.5};
  FrontStop stop;
  stop.all_voxels = true;
  const Vec3 source = image.geometry.world(Vec3(24, 24, 32));
  const FrontTimes ours = segmentation::detail::march(image, {source}, speed, stop, core::no_task());
  const FloatVolume ones{image.geometry, std::vector<float>(image.voxels.size(), 1.0F)};
  const FloatVolume itks = itk_marched(ones, {{24, 24, 32}}, {0.0});
  double our_error = 0.0, itks_error = 0.0, apart = 0.0;
  for_inner_voxels(image.geometry, 0, [&](auto i, auto j, auto k) {
    const Voxel v{static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), static_cast<std::int32_t>(k)};
    const double exact =
        (image.geometry.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k))) -
         source)
            .norm();
    if (exact < 4.0) return;
    our_error = std::max(our_error, std::abs(ours.times.get(v) - exact) / exact);
    itks_error = std::max(itks_error, std::abs(itks(i, j, k) - exact) / exact);
    apart = std::max(apart, std::abs(static_cast<double>(ours.times.get(v)) - itks(i, j, k)) / exact);
  });
  EXPECT_LT(our_error, 0.6 * itks_error);
  EXPECT_LT(apart, our_error + itks_error + 1e-6);
  EXPECT_LT(apart, 0.13);
}

TEST(SecondOpinion, ArrivalTimesAlongAVesselAreItks) {
  const TubeScene tube({40, 40, 64}, 2.0, 0.0);
  const SpeedModel speed{{150.0, 500.0}, 350.0, 0.5};
  FloatVolume speeds{tube.image.geometry, {}};
  for (const std::int16_t hu : tube.image.voxels) speeds.voxels.push_back(std::max(speed(hu), 1e-4F));
  FrontStop stop;
  stop.targets = {segmentation::detail::nearest_voxel(tube.image.geometry, tube.tube.to)};
  const Voxel seed = segmentation::detail::nearest_voxel(tube.image.geometry, tube.tube.from);
  const Vec3 source = tube.image.geometry.world(Vec3(seed[0], seed[1], seed[2]));
  const FrontTimes ours = segmentation::detail::march(tube.image, {source}, speed, stop, core::no_task());
  const FloatVolume itks = itk_marched(speeds, {{seed[0], seed[1], seed[2]}}, {0.0}, 1.5 * ours.target_time);
  double apart = 0.0;
  int compared = 0;
  for (double along = 4.0; along < (tube.tube.to - tube.tube.from).norm(); along += 0.4) {
    const Vec3 at = tube.tube.from + along * (tube.tube.to - tube.tube.from).normalized();
    const Voxel v = segmentation::detail::nearest_voxel(tube.image.geometry, at);
    const double t = ours.times.get(v);
    if (!std::isfinite(t)) continue;
    apart = std::max(apart, std::abs(t - itks(v[0], v[1], v[2])) / t);
    ++compared;
  }
  EXPECT_GT(compared, 30);
  EXPECT_LT(apart, 0.08);
}

TEST(SecondOpinion, LevelSetsEndOnOneWall) {
  const TubeScene tube({32, 32, 40}, 2.0, 10.0);
  const FloatVolume edges = tube.edges(100.0), start = tube.about_axis(1.2);
  segmentation::LevelSetOptions options;
  options.inflation = 0.1;
  options.curvature = 0.0;
  options.advection = 1.0;
  const auto ours = segmentation::level_set(start, negated(edges), edges, options);
  int iterations = 0;
  const FloatVolume itks = itk_geodesic(start, edges, 0.1, 1.0, 400, 0.002, iterations);
  const auto value = [](const FloatVolume& v, const Vec3& at) { return imaging::sample(v, at); };
  const double our_radius = surface_radius_mm(ours.level_set, tube.tube, value);
  const double itks_radius = surface_radius_mm(itks, tube.tube, value);
  EXPECT_GT(iterations, 10);
  EXPECT_NEAR(our_radius, 2.0, 0.1);
  EXPECT_NEAR(itks_radius, our_radius, 0.1);
}

}  // namespace
}  // namespace ostia::filtering::peers
