// Thick layers against the same image sampled place by place, and against what is known of it.

#include "row_loops.h"
#include "row_sampler.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/reformat/plane_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

namespace ostia::reformat {
namespace {

/// A cone of rings about a slanted axis, in a rotated grid: curved everywhere, and asked anywhere.
double rings(const Vec3& at) {
  return 500.0 * std::sin(0.35 * at.norm()) + 20.0 * at.x() - 15.0 * at.z();
}

imaging::ImageVolume analytic() {
  imaging::ImageVolume image;
  image.geometry.size = {70, 64, 50};
  image.geometry.spacing = {0.5, 0.6, 0.8};
  image.geometry.origin = {-17, -20, -18};
  image.geometry.direction = Eigen::AngleAxisd(0.3, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  for (int k = 0; k < 50; ++k)
    for (int j = 0; j < 64; ++j)
      for (int i = 0; i < 70; ++i)
        image(i, j, k) = static_cast<std::int16_t>(std::lround(rings(image.geometry.world(Vec3(i, j, k)))));
  return image;
}

Plane oblique_plane(const imaging::ImageVolume& image) {
  Plane plane;
  const Eigen::Matrix3d turned =
      (Eigen::AngleAxisd(0.7, Vec3::UnitX()) * Eigen::AngleAxisd(-0.5, Vec3::UnitY())).toRotationMatrix();
  plane.u = turned.col(0);
  plane.v = turned.col(1);
  plane.width = 61;
  plane.height = 47;
  plane.pixel_mm = 0.7;
  plane.origin = image.geometry.world(Vec3(35, 32, 25)) - 20.0 * plane.u - 16.0 * plane.v;
  return plane;
}

/// Of one pixel, by single samples of `value` along the normal. NaN where none lies in the image.
template <class Value>
double brute(const imaging::ImageVolume& image, const Plane& plane, int column, int row, Slab slab,
             double thick, double step, const Value& value) {
  const Vec3 middle = world(plane, Vec2(column + 0.5, row + 0.5));
  const int count = static_cast<int>(std::ceil(thick / step));
  double sum = 0.0, low = INFINITY, high = -INFINITY;
  int inside = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 at = middle + thick * ((i + 0.5) / count - 0.5) * plane.normal();
    const Vec3 index = image.geometry.index(at);
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
      within = within && index[axis] >= -0.5 &&
               index[axis] <= static_cast<double>(image.geometry.size[static_cast<std::size_t>(axis)]) - 0.5;
    if (!within) continue;
    const double here = value(at);
    ++inside;
    sum += here;
    low = std::min(low, here);
    high = std::max(high, here);
  }
  if (inside == 0) return std::nan("");
  return slab == Slab::mean ? sum / inside : slab == Slab::maximum ? high : low;
}

TEST(Slab, IsWhatSingleSamplesOfTheImageMakeOfIt) {
  const imaging::ImageVolume image = analytic();
  const Plane plane = oblique_plane(image);
  const double thick = 6.0;
  int compared = 0, outside = 0;
  for (const Slab slab : {Slab::mean, Slab::maximum, Slab::minimum}) {
    const PlaneImage made = slab_slice(image, plane, slab, thick);
    for (int row = 0; row < plane.height; row += 3)
      for (int column = 0; column < plane.width; column += 3) {
        const double expected = brute(image, plane, column, row, slab, thick, 0.25, [&](const Vec3& at) {
          return imaging::sample(image, at, imaging::Interpolation::trilinear);
        });
        if (std::isnan(expected)) {
          ++outside;
          EXPECT_TRUE(std::isnan(made(column, row)));
          continue;
        }
        ++compared;
        EXPECT_NEAR(made(column, row), expected, 0.02) << column << ", " << row;
      }
  }
  EXPECT_GT(compared, 500);
  EXPECT_GT(outside, 10);
}

TEST(Slab, IsNearWhatTheImagesOwnFunctionMakesOfIt) {
  const imaging::ImageVolume image = analytic();
  Plane plane = oblique_plane(image);
  plane.width = plane.height = 20;
  plane.origin = image.geometry.world(Vec3(35, 32, 25)) - 7.0 * plane.u - 7.0 * plane.v;
  for (const Slab slab : {Slab::mean, Slab::maximum, Slab::minimum}) {
    const PlaneImage made = slab_slice(image, plane, slab, 8.0);
    for (int row = 0; row < plane.height; ++row)
      for (int column = 0; column < plane.width; ++column)
        EXPECT_NEAR(made(column, row), brute(image, plane, column, row, slab, 8.0, 0.01, rings), 25.0);
  }
}

TEST(Slab, MinimumIsBelowMeanIsBelowMaximum) {
  const imaging::ImageVolume image = analytic();
  const Plane plane = oblique_plane(image);
  const PlaneImage low = slab_slice(image, plane, Slab::minimum, 5.0),
                   mean = slab_slice(image, plane, Slab::mean, 5.0),
                   high = slab_slice(image, plane, Slab::maximum, 5.0);
  int less = 0;
  for (std::size_t i = 0; i < mean.values.size(); ++i) {
    if (std::isnan(mean.values[i])) continue;
    EXPECT_LE(low.values[i], mean.values[i] + 1e-2F);
    EXPECT_GE(high.values[i], mean.values[i] - 1e-2F);
    less += low.values[i] < high.values[i] - 10.0F ? 1 : 0;
  }
  EXPECT_GT(less, 1000);
}

TEST(Slab, DoesNotDependOnTheNumberOfThreads) {
  const imaging::ImageVolume image = analytic();
  const Plane plane = oblique_plane(image);
  const auto bits = [&](int threads) {
    core::set_max_threads(threads);
    std::vector<std::uint32_t> all;
    for (const float value : slab_slice(image, plane, Slab::minimum, 5.0).values)
      all.push_back(std::bit_cast<std::uint32_t>(value));
    core::set_max_threads(0);
    return all;
  };
  EXPECT_EQ(bits(1), bits(3));
}

TEST(RowLoops, OfNewerProcessorsGiveTheSameBits) {
  const imaging::ImageVolume image = analytic();
  const imaging::FloatVolume floats = [&] {
    imaging::FloatVolume copy;
    copy.geometry = image.geometry;
    copy.voxels.assign(image.voxels.begin(), image.voxels.end());
    return copy;
  }();
  // Numbers of sixteen bits go through the new loops, the same as floats through the old.
  const RowSampler<std::int16_t> fast(image, imaging::Interpolation::trilinear);
  const RowSampler<float> slow(floats, imaging::Interpolation::trilinear);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-25.0, 25.0), step(-0.6, 0.6);
  std::vector<float> a(83), b(83);
  int numbers = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 start(place(random), place(random), place(random)),
        by(step(random), step(random), step(random));
    fast.row(start, by, a);
    slow.row(start, by, b);
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(std::isnan(a[k]), std::isnan(b[k]));
      if (std::isnan(a[k])) continue;
      ++numbers;
      EXPECT_EQ(std::bit_cast<std::uint32_t>(a[k]), std::bit_cast<std::uint32_t>(b[k]));
    }
  }
  EXPECT_GT(numbers, 5000);
}

TEST(RowLoops, FoldsLetNumbersWinOverNone) {
  const float none = std::nanf("");
  for (const RowLoops& loops : {row_loops_plain(), row_loops()}) {
    std::vector<float> layer, out;
    for (int i = 0; i < 11; ++i) {
      layer.push_back(i % 3 == 0 ? none : static_cast<float>(i));
      out.push_back(i % 2 == 0 ? none : 5.0F);
    }
    std::vector<float> high = out, low = out;
    loops.larger(layer.data(), 11, high.data());
    loops.smaller(layer.data(), 11, low.data());
    for (std::size_t i = 0; i < 11; ++i) {
      if (std::isnan(layer[i]) && std::isnan(out[i])) {
        EXPECT_TRUE(std::isnan(high[i]) && std::isnan(low[i]));
        continue;
      }
      EXPECT_EQ(high[i], std::fmax(layer[i], out[i]));
      EXPECT_EQ(low[i], std::fmin(layer[i], out[i]));
    }
  }
}

// A layer whose values bend little within a pixel looks the same coarsely, to what linear steps miss.
TEST(SlabDraft, IsTheSlabButForDetailsOfAPixel) {
  const imaging::ImageVolume image = analytic();
  const Plane plane = oblique_plane(image);
  for (const Slab slab : {Slab::mean, Slab::maximum, Slab::minimum}) {
    const PlaneImage whole = slab_slice(image, plane, slab, 6.0), draft = slab_draft(image, plane, slab, 6.0);
    ASSERT_EQ(draft.values.size(), whole.values.size());
    EXPECT_EQ(draft.plane.pixel_mm, plane.pixel_mm);
    double off = 0.0, largest = 0.0;
    int both = 0, one = 0;
    for (std::size_t i = 0; i < whole.values.size(); ++i) {
      if (std::isnan(whole.values[i]) || std::isnan(draft.values[i])) {
        if (std::isnan(whole.values[i]) != std::isnan(draft.values[i])) ++one;
        continue;
      }
      off += std::abs(whole.values[i] - draft.values[i]);
      largest = std::max<double>(largest, std::abs(whole.values[i]));
      ++both;
    }
    EXPECT_GT(both, 1500);
    EXPECT_LT(one, both / 10);  // at the image's border
    EXPECT_LT(off / both, 0.02 * largest);
  }
}

TEST(SlabDraft, HasThePlanesSizeWhateverItIs) {
  const imaging::ImageVolume image = analytic();
  Plane plane = oblique_plane(image);
  for (const auto& [width, height] : {std::pair(1, 1), {2, 1}, {7, 5}, {8, 6}}) {
    plane.width = width;
    plane.height = height;
    const PlaneImage draft = slab_draft(image, plane, Slab::maximum, 4.0);
    EXPECT_EQ(draft.values.size(), static_cast<std::size_t>(width * height));
  }
  EXPECT_THROW(slab_draft(image, plane, Slab::maximum, 0.0), InvalidInput);
  EXPECT_THROW(slab_draft({}, plane, Slab::maximum, 4.0), InvalidInput);
}

}  // namespace
}  // namespace ostia::reformat
