// Filters of ITK on images whose result is known beforehand.

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/filtering/filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <thread>

namespace ostia::filtering {
namespace {

using imaging::FloatVolume;
using imaging::MaskVolume;
using imaging::Vec3;
using ::testing::HasSubstr;

const Vec3 filter_spacing(0.5, 0.5, 0.75);

FloatVolume filled(const std::array<std::int64_t, 3>& size, const std::function<double(const Vec3&)>& value,
                   const Vec3& spacing = filter_spacing) {
  FloatVolume image;
  image.geometry.size = size;
  image.geometry.spacing = spacing;
  image.geometry.origin = Vec3(-3.0, 12.0, 40.0);
  image.geometry.direction << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i)
        image.voxels.push_back(static_cast<float>(value(spacing.cwiseProduct(
            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k))))));
  return image;
}

/// Of the voxels of `filled`.
Vec3 middle_of(const FloatVolume& image) {
  const auto& s = image.geometry.size;
  return image.geometry.spacing.cwiseProduct(
      Vec3(static_cast<double>(s[0] / 2), static_cast<double>(s[1] / 2), static_cast<double>(s[2] / 2)));
}
float middle_value(const FloatVolume& image) {
  const auto& s = image.geometry.size;
  return image(s[0] / 2, s[1] / 2, s[2] / 2);
}

FloatVolume through(const FloatVolume& image, const std::string& step, const FilterInputs& inputs = {}) {
  return filtered(image, {step_of_text(step)}, inputs).image;
}

std::string refusal_of(const FloatVolume& image, const std::vector<std::string>& texts,
                       const FilterInputs& inputs = {}) {
  std::vector<FilterStep> steps;
  for (const std::string& text : texts) steps.push_back(step_of_text(text));
  try {
    filtered(image, steps, inputs);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

/// Noise that is the same wherever it is asked for.
double hash_noise(const Vec3& p) {
  const double v = std::sin(p.x() * 12.9898 + p.y() * 78.233 + p.z() * 37.719) * 43758.5453;
  return v - std::floor(v) - 0.5;
}

FloatVolume noisy_ball() {
  FloatVolume image = filled({24, 20, 16}, [](const Vec3& p) {
    return 100.0 + ((p - Vec3(6.0, 5.0, 6.0)).norm() < 3.0 ? 200.0 : 0.0) + 40.0 * hash_noise(p);
  });
  return image;
}

TEST(Gaussian, BlursAGaussianToTheSumOfVariances) {
  FloatVolume image = filled({41, 41, 33}, [](const Vec3&) { return 0.0; });
  const Vec3 middle = middle_of(image);
  image = filled({41, 41, 33},
                 [&](const Vec3& p) { return 1000.0 * std::exp(-(p - middle).squaredNorm() / 2.0); });
  const FloatVolume blurred = through(image, "gaussian:sigma_mm=1.5");
  EXPECT_NEAR(middle_value(blurred), 1000.0 * std::pow(1.0 / (1.0 + 2.25), 1.5), 4.0);
  EXPECT_TRUE(imaging::same_grid(blurred.geometry, image.geometry, 0.0));
}

TEST(Median, TakesASpikeAwayAndKeepsAnEdge) {
  FloatVolume image = filled({12, 12, 12}, [](const Vec3& p) { return p.x() < 3.0 ? 0.0 : 100.0; });
  image(2, 6, 6) = 5000.0F;
  const FloatVolume clean = through(image, "median:radius_mm=0.5");
  EXPECT_EQ(clean(2, 6, 6), 0.0F);
  EXPECT_EQ(clean(5, 6, 6), 0.0F);
  EXPECT_EQ(clean(6, 6, 6), 100.0F);
}

TEST(Smoothing, FlattensNoiseAndLeavesTheStep) {
  const FloatVolume image =
      filled({24, 24, 20}, [](const Vec3& p) { return (p.x() < 6.0 ? 0.0 : 300.0) + 20.0 * hash_noise(p); });
  const auto noise = [](const FloatVolume& v) {
    double sum = 0.0, squares = 0.0;
    int n = 0;
    for (std::int64_t k = 4; k < 16; ++k)
      for (std::int64_t j = 4; j < 20; ++j)
        for (std::int64_t i = 2; i < 8; ++i, ++n) {
          sum += v(i, j, k);
          squares += static_cast<double>(v(i, j, k)) * v(i, j, k);
        }
    return std::sqrt(squares / n - sum * sum / n / n);
  };
  for (const char* step : {"gradient-diffusion:conductance=0.5,steps=20",
                           "curvature-diffusion:conductance=1,steps=20", "curvature-flow:steps=10"}) {
    const FloatVolume smooth = through(image, step);
    EXPECT_LT(noise(smooth), 0.6 * noise(image)) << step;
    EXPECT_GT(smooth(14, 12, 10) - smooth(9, 12, 10), 280.0F) << step;
  }
}

TEST(N4, TakesAKnownShadingOut) {
  const auto tissue = [](const Vec3& p) { return (p - Vec3(16.0, 16.0, 18.0)).norm() < 8.0 ? 300.0 : 150.0; };
  const auto shading = [](const Vec3& p) {
    return std::exp(0.5 * std::sin(0.1 * p.x()) + 0.3 * std::cos(0.09 * p.y()));
  };
  const Vec3 one(1.0, 1.0, 1.5);
  const FloatVolume image = filled(
      {32, 32, 24}, [&](const Vec3& p) { return tissue(p) * shading(p); }, one);
  const auto variation = [&](const FloatVolume& v) {
    const FloatVolume truth = filled({32, 32, 24}, tissue, one);
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < v.voxels.size(); ++i) {
      const double ratio = std::log(static_cast<double>(v.voxels[i] / truth.voxels[i]));
      sum += ratio;
      squares += ratio * ratio;
    }
    const double n = static_cast<double>(v.voxels.size());
    return std::sqrt(squares / n - sum * sum / n / n);
  };
  const FloatVolume flat = through(image, "n4:shrink=2,levels=2");
  EXPECT_GT(variation(image), 0.15);
  EXPECT_LT(variation(flat), 0.25 * variation(image));
}

TEST(N4, WorksWhereAMaskIsAndTellsWhatItLeftOut) {
  FloatVolume image =
      filled({16, 16, 16}, [](const Vec3& p) { return 100.0 + 10.0 * p.x() + 5.0 * hash_noise(p); });
  MaskVolume mask{image.geometry, std::vector<std::uint8_t>(image.voxels.size(), 1)};
  image.voxels[5] = -1.0F;
  const Filtered done =
      filtered(image, {step_of_text("n4:levels=1,shrink=1,iterations=5")}, {&mask, nullptr});
  ASSERT_EQ(done.warnings.size(), 1u);
  EXPECT_THAT(done.warnings[0], HasSubstr("1 voxels of the mask"));
  EXPECT_THAT(refusal_of(filled({8, 8, 8}, [](const Vec3&) { return -500.0; }), {"n4"}),
              HasSubstr("it is for MR"));
  EXPECT_THAT(refusal_of(filled({8, 8, 8}, [](const Vec3&) { return 7.0; }), {"n4"}),
              HasSubstr("all values are the same"));
}

TEST(Objectness, TellsATubeFromAPlateAndABlob) {
  const auto shape = [](const std::function<double(const Vec3&)>& distance) {
    return filled({32, 32, 22}, [&](const Vec3& p) {
      return 300.0 * std::exp(-std::pow(distance(p - Vec3(8.0, 8.0, 8.25)), 2.0) / 2.0);
    });
  };
  const std::map<std::string, FloatVolume> images{
      {"tube", shape([](const Vec3& p) { return std::hypot(p.x(), p.y()); })},
      {"plate", shape([](const Vec3& p) { return std::abs(p.x()); })},
      {"blob", shape([](const Vec3& p) { return p.norm(); })}};
  for (const char* asked : {"tube", "plate", "blob"}) {
    std::map<std::string, float> answers;
    for (const auto& [name, image] : images)
      answers[name] = middle_value(through(
          image, std::string("objectness:sigma_least_mm=1,sigma_most_mm=1,scales=1,object=") + asked));
    for (const auto& [name, answer] : answers) {
      if (name != asked) {
        EXPECT_LT(answer, answers[asked]) << asked << " " << name;
      }
    }
  }
  EXPECT_EQ(middle_value(through(images.at("tube"), "objectness:bright=no")), 0.0F);
}

TEST(GradientMagnitude, OfARampIsItsSlope) {
  const FloatVolume image = filled({24, 24, 24}, [](const Vec3& p) { return 30.0 * p.x() - 40.0 * p.z(); });
  const Filtered done = filtered(image, {step_of_text("gradient-magnitude:sigma_mm=1")});
  EXPECT_NEAR(middle_value(done.image), 50.0, 0.1);
  EXPECT_EQ(done.values, Result::own);
  EXPECT_EQ(done.unit, "the image's unit per mm");
}

TEST(Distance, FromABallIsWithinAVoxel) {
  const Vec3 centre(6.0, 6.0, 6.0);
  const FloatVolume ball =
      filled({24, 24, 16}, [&](const Vec3& p) { return (p - centre).norm() < 4.0 ? 7.0 : 0.0; });
  const FloatVolume map = through(ball, "distance");
  const FloatVolume truth = filled({24, 24, 16}, [&](const Vec3& p) { return (p - centre).norm() - 4.0; });
  for (std::size_t i = 0; i < map.voxels.size(); ++i) EXPECT_NEAR(map.voxels[i], truth.voxels[i], 1.0);
  EXPECT_LT(map(12, 12, 8), -3.0F);
}

TEST(Masks, AreParted) {
  FloatVolume image = filled({20, 10, 10}, [](const Vec3&) { return 0.0; });
  const auto box = [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t k = 2; k < 6; ++k)
      for (std::int64_t j = 2; j < 6; ++j)
        for (std::int64_t i = from; i < to; ++i) image(i, j, k) = 250.0F;
  };
  box(1, 3);
  box(6, 12);
  box(15, 19);
  const FloatVolume mask = through(image, "threshold:lower=200,upper=300");
  EXPECT_EQ(std::count(mask.voxels.begin(), mask.voxels.end(), 1.0F), 12 * 16);
  const Filtered parts =
      filtered(image, {step_of_text("threshold:lower=200"), step_of_text("components:most=2")});
  EXPECT_EQ(parts.values, Result::labels);
  EXPECT_EQ(parts.image(8, 3, 3), 1.0F);  // the largest
  EXPECT_EQ(parts.image(16, 3, 3), 2.0F);
  EXPECT_EQ(parts.image(1, 3, 3), 0.0F);
  ASSERT_EQ(parts.warnings.size(), 1u);
  EXPECT_THAT(parts.warnings[0], HasSubstr("1 of 3 parts"));
  const FloatVolume large = through(image, "components:least_voxels=50");
  EXPECT_EQ(large(1, 3, 3), 0.0F);
  EXPECT_EQ(large(16, 3, 3), 2.0F);
  const FloatVolume classes = through(image, "otsu");
  EXPECT_EQ(classes(8, 3, 3), 1.0F);
  EXPECT_EQ(classes(13, 8, 8), 0.0F);
}

TEST(Morphology, MovesABorderByItsRadius) {
  const FloatVolume box =
      filled({30, 20, 20}, [](const Vec3& p) { return p.x() > 4.9 && p.x() < 10.1 ? 1.0 : 0.0; });
  const auto width = [](const FloatVolume& v) {
    int n = 0;
    for (std::int64_t i = 0; i < 30; ++i) n += v(i, 10, 10) > 0.5F ? 1 : 0;
    return n;
  };
  EXPECT_EQ(width(box), 11);
  EXPECT_EQ(width(through(box, "dilate:radius_mm=1")), 15);
  EXPECT_EQ(width(through(box, "erode:radius_mm=1")), 7);
  EXPECT_EQ(width(through(box, "open:radius_mm=1")), 11);
  EXPECT_EQ(width(through(box, "open:radius_mm=4")), 0);
  FloatVolume hollow = box;
  hollow(14, 10, 10) = 0.0F;
  EXPECT_EQ(width(through(hollow, "close:radius_mm=0.75")), 11);
  EXPECT_EQ(width(through(hollow, "fill-holes")), 11);
}

TEST(Resample, KeepsARampWhateverTheVoxels) {
  const auto ramp = [](const Vec3& p) { return 3.0 * p.x() + 2.0 * p.y() - p.z(); };
  const FloatVolume image = filled({16, 16, 16}, ramp);
  for (const char* by : {"linear", "bspline"}) {
    const FloatVolume fine = through(image, std::string("resample:spacing_mm=0.3,by=") + by);
    for (std::int64_t i = 6; i < 20; ++i) {
      const Vec3 at = image.geometry.index(fine.geometry.world({static_cast<double>(i), 12.0, 12.0}));
      EXPECT_NEAR(fine(i, 12, 12), ramp(filter_spacing.cwiseProduct(at)), 0.05) << by;
    }
  }
  EXPECT_THAT(refusal_of(filled({4000, 4, 4}, [](const Vec3&) { return 0.0; }, {20.0, 20.0, 20.0}),
                         {"resample:spacing_mm=0.05"}),
              HasSubstr("more than the 2147483648"));
}

TEST(MatchHistogram, UndoesAStretch) {
  const auto pattern = [](const Vec3& p) {
    return 100.0 + 50.0 * std::sin(p.x()) + 30.0 * std::cos(p.y() + p.z());
  };
  const FloatVolume reference = filled({24, 24, 20}, pattern);
  const FloatVolume image = filled({24, 24, 20}, [&](const Vec3& p) { return 3.0 * pattern(p) - 70.0; });
  const FloatVolume matched =
      through(image, "match-histogram:above_mean=no,points=50", {nullptr, &reference});
  double worst = 0.0;
  for (std::size_t i = 0; i < matched.voxels.size(); ++i)
    worst = std::max(worst, std::abs(static_cast<double>(matched.voxels[i] - reference.voxels[i])));
  EXPECT_LT(worst, 4.0);
}

TEST(Values, AreClampedAndStretched) {
  const FloatVolume image = filled({8, 8, 8}, [](const Vec3& p) { return 100.0 * p.x(); });
  const FloatVolume clamped = through(image, "clamp:lower=50,upper=200");
  EXPECT_EQ(*std::min_element(clamped.voxels.begin(), clamped.voxels.end()), 50.0F);
  EXPECT_EQ(*std::max_element(clamped.voxels.begin(), clamped.voxels.end()), 200.0F);
  const FloatVolume stretched = through(image, "rescale:lower=-1,upper=1");
  EXPECT_NEAR(stretched(0, 0, 0), -1.0F, 1e-6);
  EXPECT_NEAR(stretched(7, 0, 0), 1.0F, 1e-6);
}

/// A step of each filter that has something to do with `noisy_ball`.
std::vector<std::string> one_step_each() {
  std::vector<std::string> steps;
  for (const FilterFacts& one : filters())
    steps.push_back(one.name == "n4"          ? "n4:shrink=1,levels=2,iterations=4"
                    : one.name == "threshold" ? "threshold:lower=200"
                    : one.name == "clamp"     ? "clamp:lower=100"
                                              : one.name);
  return steps;
}

TEST(Filtered, GivesTheSameBitsForAnyNumberOfThreads) {
  const FloatVolume image = noisy_ball(),
                    reference =
                        filled({10, 10, 10}, [](const Vec3&p) { return 5.0 * p.x() + hash_noise(p); });
  const int before = core::max_threads();
  for (const std::string& step : one_step_each()) {
    const bool matches = step == "match-histogram";
    const bool parts = step == "distance" || step == "components";
    const std::vector<FilterStep> steps =
        parts ? std::vector<FilterStep>{step_of_text("threshold:lower=200"), step_of_text(step)}
              : std::vector<FilterStep>{step_of_text(step)};
    std::vector<FloatVolume> results;
    for (const int threads : {1, 2, 5}) {
      core::set_max_threads(threads);
      results.push_back(filtered(image, steps, {nullptr, matches ? &reference : nullptr}).image);
    }
    core::set_max_threads(before);
    for (const FloatVolume& one : results)
      EXPECT_EQ(std::memcmp(one.voxels.data(), results[0].voxels.data(), one.voxels.size() * sizeof(float)),
                0)
          << step;
    EXPECT_NE(std::memcmp(image.voxels.data(), results[0].voxels.data(), image.voxels.size() * sizeof(float)),
              0)
        << step << " did nothing";
  }
}

TEST(Filtered, LeavesWhatItWasGivenAsItWas) {
  const FloatVolume image = noisy_ball(), copy = image;
  filtered(image, {step_of_text("gaussian"), step_of_text("curvature-flow"), step_of_text("clamp:lower=0")});
  EXPECT_EQ(image.voxels, copy.voxels);
}

TEST(Filtered, EndsWhenItIsCancelledBeforeAndOnTheWay) {
  const FloatVolume image = noisy_ball();
  for (const FilterFacts& one : filters()) {
    core::TaskContext task;
    task.cancel();
    if (one.name == "match-histogram") continue;
    EXPECT_THROW(filtered(image, {{one.name, {}}}, {}, task), Cancelled) << one.name;
  }
  for (const char* step : {"n4:iterations=1000,tolerance=0,shrink=1", "curvature-flow:steps=1000",
                           "gradient-diffusion:steps=1000", "objectness:scales=16"}) {
    const FloatVolume large =
        filled({96, 96, 64}, [](const Vec3& p) { return 100.0 + p.x() + 10.0 * hash_noise(p); });
    const core::TaskContext task;
    std::atomic<bool> done{false};
    std::thread hand([&] {
      while (!done && task.progress() <= 0.0) std::this_thread::yield();
      task.cancel();
    });
    EXPECT_THROW(filtered(large, {step_of_text(step)}, {}, task), Cancelled) << step;
    EXPECT_LT(task.progress(), 1.0) << step;
    done = true;
    hand.join();
  }
}

TEST(Filtered, RefusesWhatItCannotWorkOn) {
  const FloatVolume image = noisy_ball();
  EXPECT_THAT(refusal_of(image, {}), HasSubstr("no filter is given"));
  EXPECT_THAT(refusal_of({}, {"median"}), HasSubstr("0 values for 0 voxels"));
  FloatVolume holed = image;
  holed.voxels[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(refusal_of(holed, {"median"}), HasSubstr("not finite"));
  EXPECT_THAT(refusal_of(filled({20, 20, 3}, [](const Vec3& p) { return p.x(); }), {"gaussian"}),
              HasSubstr("needs 4 voxels"));
  EXPECT_THAT(refusal_of(image, {"match-histogram"}), HasSubstr("needs a reference"));
  EXPECT_THAT(refusal_of(image, {"median"}, {nullptr, &image}), HasSubstr("no filter takes one"));
  const MaskVolume other{{{4, 4, 4}}, std::vector<std::uint8_t>(64, 1)};
  EXPECT_THAT(refusal_of(image, {"median"}, {&other, nullptr}), HasSubstr("no filter takes one"));
  EXPECT_THAT(refusal_of(image, {"n4"}, {&other, nullptr}), HasSubstr("another grid"));
  const MaskVolume own{image.geometry, std::vector<std::uint8_t>(image.voxels.size(), 1)};
  EXPECT_THAT(refusal_of(image, {"resample", "n4"}, {&own, nullptr}), HasSubstr("put it first"));
  EXPECT_THAT(refusal_of(filled({8, 8, 8}, [](const Vec3&) { return 1.0; }), {"otsu"}),
              HasSubstr("no classes"));
  EXPECT_THAT(refusal_of(filled({8, 8, 8}, [](const Vec3&) { return 1.0; }), {"distance"}),
              HasSubstr("no border"));
  EXPECT_THAT(refusal_of(filled({8, 8, 8}, [](const Vec3&) { return 1.0; }), {"rescale"}),
              HasSubstr("all values are the same"));
}

}  // namespace
}  // namespace ostia::filtering
