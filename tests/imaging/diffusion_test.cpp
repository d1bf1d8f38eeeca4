#include "ostia/imaging/diffusion.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/sampling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace ostia::imaging {
namespace {

constexpr double kNoise = 25.0;
constexpr double kVoxel = 0.4;

FloatVolume made(const std::array<std::int64_t, 3>& size, const Vec3& spacing,
                 const std::function<double(const Vec3&)>& value, double noise) {
  FloatVolume image;
  image.geometry.size = size;
  image.geometry.spacing = spacing;
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  std::mt19937 generator(5);
  std::normal_distribution<double> random(0.0, 1.0);
  for (std::int64_t n = 0; n < image.geometry.voxels(); ++n) {
    const Vec3 index(static_cast<double>(n % size[0]), static_cast<double>(n / size[0] % size[1]),
                     static_cast<double>(n / (size[0] * size[1])));
    image.voxels[static_cast<std::size_t>(n)] =
        static_cast<float>(value(image.geometry.world(index)) + noise * random(generator));
  }
  return image;
}

FloatVolume flat(const Vec3& spacing = Vec3::Constant(kVoxel)) {
  return made(
      {56, 50, 44}, spacing, [](const Vec3&) { return 60.0; }, kNoise);
}

/// Away from the border.
double deviation(const FloatVolume& image) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (std::int64_t k = 10; k + 10 < image.geometry.size[2]; ++k)
    for (std::int64_t j = 10; j + 10 < image.geometry.size[1]; ++j)
      for (std::int64_t i = 10; i + 10 < image.geometry.size[0]; ++i) {
        sum += image(i, j, k);
        squares += static_cast<double>(image(i, j, k)) * image(i, j, k);
        ++count;
      }
  return std::sqrt(squares / count - sum * sum / (count * count));
}

/// By how much linear diffusion with attachment lessens white noise: the mean over all waves.
double linear_factor(const DiffusionOptions& o, const Vec3& spacing) {
  const Vec3 w = spacing.cwiseProduct(spacing).cwiseInverse();
  const double dt = o.step / (2.0 * w.sum()), h = spacing.minCoeff();
  const double beta = o.method == Diffusion::flux ? o.attachment / (h * h) : 0.0;
  constexpr int n = 24;
  double sum = 0.0;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      for (int c = 0; c < n; ++c) {
        const auto wave = [](int m) { return 2.0 - 2.0 * std::cos(M_PI * (m + 0.5) / n); };
        const double rate = w[0] * wave(a) + w[1] * wave(b) + w[2] * wave(c);
        double left = 1.0;
        for (int step = 0; step < o.iterations; ++step) left += dt * (beta * (1.0 - left) - rate * left);
        sum += left * left;
      }
  return std::sqrt(sum / (n * n * n));
}

TEST(Diffused, IsLinearDiffusionWhereNothingIsAnEdge) {
  for (const Vec3& spacing : {Vec3(0.4, 0.4, 0.4), Vec3(0.4, 0.5, 0.9)}) {
    const FloatVolume image = flat(spacing);
    for (const Diffusion method : {Diffusion::flux, Diffusion::gradient})
      for (const int iterations : {1, 5}) {
        DiffusionOptions options;
        options.method = method;
        options.iterations = iterations;
        options.contrast_hu_per_mm = 1e6;
        const double factor = deviation(diffused(image, options)) / deviation(image);
        const double expected = linear_factor(options, spacing);
        EXPECT_NEAR(factor, expected, 0.06 * expected) << iterations;
      }
  }
}

/// A tube of this radius along an oblique line, 350 HU in 50 HU, its wall blurred by 0.35 mm.
struct Pipe {
  double radius;
  Vec3 middle = Vec3(10.0, 10.0, 12.0);
  Vec3 along = Vec3(0.3, 0.45, 1.0).normalized();
  FloatVolume image(double noise) const {
    return made(
        {50, 50, 60}, Vec3::Constant(kVoxel),
        [&](const Vec3& p) {
          const double rho = (p - middle).cross(along).norm();
          return 50.0 + 150.0 * std::erfc((rho - radius) / (std::sqrt(2.0) * 0.35));
        },
        noise);
  }
  /// Mean distance from the axis to where 200 HU are crossed, mm.
  double wall(const FloatVolume& in) const {
    double sum = 0.0;
    int rays = 0;
    const Vec3 u = along.unitOrthogonal(), v = along.cross(u);
    for (double s = -6.0; s <= 6.0; s += 0.4)
      for (int a = 0; a < 24; ++a, ++rays) {
        const Vec3 out = std::cos(a * M_PI / 12.0) * u + std::sin(a * M_PI / 12.0) * v;
        double r = 0.0;
        while (r < 4.0 && sample(in, middle + s * along + r * out) > 200.0) r += 0.01;
        sum += r;
      }
    return sum / rays;
  }
};

class EdgePreserving : public ::testing::TestWithParam<Diffusion> {};

TEST_P(EdgePreserving, LessensNoiseToAThirdAndLeavesTheWallWhereItIs) {
  DiffusionOptions options;
  options.method = GetParam();
  const FloatVolume noise = flat();
  EXPECT_LT(deviation(diffused(noise, options)), 0.34 * deviation(noise));
  for (const double radius : {1.0, 2.0}) {
    const Pipe pipe{radius};
    EXPECT_NEAR(pipe.wall(diffused(pipe.image(kNoise), options)), pipe.wall(pipe.image(0.0)), 0.1 * kVoxel)
        << radius;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, EdgePreserving,
                         ::testing::Values(Diffusion::flux, Diffusion::gradient, Diffusion::curvature));

TEST(Diffused, AGaussianThatLessensNoiseAsMuchMovesTheWall) {
  // What the tests above would say of a filter that knows no edges.
  const FloatVolume noise = flat();
  const double left = deviation(diffused(noise));
  double sigma = 0.1;
  while (deviation(gaussian_blurred(noise, sigma)) > left) sigma += 0.02;
  const Pipe pipe{1.0};
  EXPECT_GT(std::abs(pipe.wall(gaussian_blurred(pipe.image(0.0), sigma)) - pipe.wall(pipe.image(0.0))),
            0.1 * kVoxel);
}

TEST(Diffused, FluxKeepsAThinVesselsContrast) {
  const Pipe pipe{0.6};
  const FloatVolume image = pipe.image(0.0);
  DiffusionOptions options;
  options.contrast_hu_per_mm = 60.0;
  options.iterations = 20;
  const double before = sample(image, pipe.middle);
  EXPECT_GT(sample(diffused(image, options), pipe.middle), 50.0 + 0.7 * (before - 50.0));
  options.contrast_hu_per_mm = 1e6;  // linear
  EXPECT_LT(sample(diffused(image, options), pipe.middle), 50.0 + 0.5 * (before - 50.0));
}

TEST(Diffused, TheContrastChosenFollowsTheNoise) {
  // Central differences of white noise: sd of a component is sd / (sqrt(2) h).
  const double k = diffusion_contrast(flat(), Diffusion::gradient);
  EXPECT_NEAR(k, 3.0 * kNoise / (std::sqrt(2.0) * kVoxel), 0.05 * k);
  EXPECT_LT(diffusion_contrast(flat(), Diffusion::flux), 0.4 * k);  // read on the blurred image
  const FloatVolume silent = made(
      {9, 9, 9}, Vec3::Ones(), [](const Vec3&) { return 7.0; }, 0.0);
  EXPECT_EQ(diffusion_contrast(silent, Diffusion::flux), 1.0);
}

TEST(Diffused, KeepsTheMeanAndWhatIsConstant) {
  FloatVolume image = made(
      {20, 18, 16}, Vec3(0.4, 0.6, 1.0), [](const Vec3& p) { return p.x() > 4.0 ? 300.0 : 0.0; }, kNoise);
  const auto mean = [](const FloatVolume& v) {
    double sum = 0.0;
    for (const float x : v.voxels) sum += x;
    return sum / static_cast<double>(v.voxels.size());
  };
  for (const Diffusion method : {Diffusion::flux, Diffusion::gradient}) {
    DiffusionOptions options;
    options.method = method;
    EXPECT_NEAR(mean(diffused(image, options)), mean(image), 0.01);  // nothing leaves through the border
  }
  std::fill(image.voxels.begin(), image.voxels.end(), 42.0F);
  for (const Diffusion method : {Diffusion::flux, Diffusion::gradient, Diffusion::curvature}) {
    DiffusionOptions options;
    options.method = method;
    EXPECT_THAT(diffused(image, options).voxels, ::testing::Each(42.0F));
  }
}

TEST(Diffused, IsTheSameForAnyNumberOfThreadsAndRoundsACt) {
  const FloatVolume image = flat();
  for (const Diffusion method : {Diffusion::flux, Diffusion::gradient, Diffusion::curvature}) {
    DiffusionOptions options;
    options.method = method;
    options.iterations = 2;
    core::set_max_threads(1);
    const FloatVolume one = diffused(image, options);
    core::set_max_threads(0);
    EXPECT_EQ(one.voxels, diffused(image, options).voxels);
  }
  ImageVolume ct{image.geometry, {}};
  for (const float v : image.voxels) ct.voxels.push_back(static_cast<std::int16_t>(std::lround(v)));
  const FloatVolume whole{ct.geometry, {ct.voxels.begin(), ct.voxels.end()}};
  const FloatVolume expected = diffused(whole);
  const ImageVolume rounded = diffused(ct);
  for (std::size_t n = 0; n < ct.voxels.size(); ++n)
    ASSERT_EQ(rounded.voxels[n], std::lround(expected.voxels[n]));
}

TEST(Diffused, RefusesBadOptionsByNameAndCanBeCancelled) {
  const FloatVolume image = flat();
  const auto refused = [&](const std::function<void(DiffusionOptions&)>& spoil, const std::string& name) {
    DiffusionOptions options;
    spoil(options);
    try {
      diffused(image, options);
      ADD_FAILURE() << name;
    } catch (const InvalidInput& e) {
      EXPECT_THAT(e.what(), ::testing::HasSubstr(name));
    }
  };
  refused([](DiffusionOptions& o) { o.iterations = -1; }, "iterations");
  refused([](DiffusionOptions& o) { o.iterations = 1001; }, "iterations");
  refused([](DiffusionOptions& o) { o.contrast_hu_per_mm = std::nan(""); }, "contrast_hu_per_mm");
  refused([](DiffusionOptions& o) { o.attachment = 1.5; }, "attachment");
  refused([](DiffusionOptions& o) { o.step = 0.0; }, "step");
  FloatVolume bad = image;
  bad.voxels[7] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(diffused(bad), InvalidInput);
  bad.voxels.pop_back();
  EXPECT_THROW(diffused(bad), InvalidInput);
  DiffusionOptions none;
  none.iterations = 0;
  EXPECT_EQ(diffused(image, none).voxels, image.voxels);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(diffused(image, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::imaging
