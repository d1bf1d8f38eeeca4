#include "curved_axes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/reformat/plane_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::reformat {
namespace {

using namespace testing;

const Vec3 slope(10.0, 20.0, -5.0);

/// A rotated image about `middle` whose value is slope . position (+ 7).
imaging::FloatVolume ramp(const Vec3& middle, int size = 60, double spacing = 1.0) {
  imaging::FloatVolume image;
  image.geometry.size = {size, size + 5, size - 4};
  image.geometry.spacing = Vec3(1.0, 0.9, 1.1) * spacing;
  image.geometry.direction = Eigen::AngleAxisd(0.4, Vec3(1, -1, 2).normalized()).toRotationMatrix();
  image.geometry.origin =
      middle - image.geometry.world(0.5 * Vec3(size - 1, size + 4, size - 5));  // the origin was 0 so far
  for (int k = 0; k < size - 4; ++k)
    for (int j = 0; j < size + 5; ++j)
      for (int i = 0; i < size; ++i)
        image.voxels.push_back(static_cast<float>(image.geometry.world(Vec3(i, j, k)).dot(slope) + 7.0));
  return image;
}

bool well_inside(const imaging::Geometry& grid, const Vec3& place, double margin) {
  const Vec3 at = grid.index(place);
  for (int a = 0; a < 3; ++a)
    if (at[a] < margin || at[a] > static_cast<double>(grid.size[static_cast<std::size_t>(a)] - 1) - margin)
      return false;
  return true;
}

TEST(CurvedImage, OfALinearFieldIsExact) {
  const Axis axis = coronary();
  const imaging::FloatVolume image = ramp(axis->point(0.5 * axis->length()));
  for (const CurvedMode mode : both) {
    for (const auto how : {imaging::Interpolation::trilinear, imaging::Interpolation::cubic}) {
      const CurvedReformation view(axis, options(mode, 50.0));
      const CurvedImage picture = reformatted(image, view, how);
      ASSERT_EQ(picture.values.size(), 101U * 240U);
      int inside = 0;
      for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 101; ++x) {
          const Vec3 place = view.world({x + 0.5, y + 0.5});
          if (!well_inside(image.geometry, place, how == imaging::Interpolation::cubic ? 1.0 : 0.0)) continue;
          ++inside;
          ASSERT_NEAR(picture(x, y), place.dot(slope) + 7.0, 2e-3);
        }
      }
      EXPECT_GT(inside, 12000);
    }
  }
}

TEST(CurvedImage, EqualsTheImageSampledPlaceByPlace) {
  const Axis axis = coronary();
  imaging::ImageVolume image;
  image.geometry = ramp(axis->point(20.0), 40, 0.8).geometry;
  std::uint32_t noise = 7;
  for (std::int64_t i = 0; i < image.geometry.voxels(); ++i) {
    noise = noise * 1664525U + 1013904223U;
    image.voxels.push_back(static_cast<std::int16_t>(static_cast<int>(noise >> 21) - 1024));
  }
  int border = 0, outside = 0;
  for (const CurvedMode mode : both) {
    for (const auto how : {imaging::Interpolation::nearest, imaging::Interpolation::trilinear,
                           imaging::Interpolation::cubic}) {
      const CurvedReformation view(axis, options(mode, -70.0));
      const CurvedImage picture = reformatted(image, view, how);
      for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 101; ++x) {
          const Vec3 place = view.world({x + 0.5, y + 0.5});
          if (!image.geometry.contains(place)) {
            ASSERT_TRUE(std::isnan(picture(x, y))) << x << " " << y;
            ++outside;
            continue;
          }
          border += well_inside(image.geometry, place, 0.0) ? 0 : 1;
          ASSERT_NEAR(picture(x, y), imaging::sample(image, place, how), 0.01);
        }
      }
    }
  }
  EXPECT_GT(border, 50);
  EXPECT_GT(outside, 1000);
}

TEST(CurvedImage, MirrorsAtHalfATurn) {
  const Axis axis = coronary();
  const imaging::FloatVolume image = ramp(axis->point(20.0));
  for (const CurvedMode mode : both) {
    const CurvedReformation view(axis, options(mode, 10.0));
    const CurvedImage a = reformatted(image, view), b = reformatted(image, view.rotated(190.0));
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 101; ++x) {
        const float left = a(x, y), right = b(100 - x, y);
        if (std::isnan(left) || std::isnan(right)) continue;
        ASSERT_NEAR(left, right, 2e-3);
      }
  }
}

/// A thin bright plate, 1 mm beside the plane x = 0.
imaging::ImageVolume plate() {
  imaging::ImageVolume image;
  image.geometry.size = {41, 41, 61};
  image.geometry.spacing = {0.5, 0.5, 0.5};
  image.geometry.origin = {-10.0, -10.0, 0.0};
  image.voxels.assign(static_cast<std::size_t>(image.geometry.voxels()), 100);
  for (int k = 0; k < 61; ++k)
    for (int j = 0; j < 41; ++j) image(22, j, k) = 900;
  return image;
}

TEST(CurvedImage, SlabsTakeTheMeanAndTheMaximumAcrossTheView) {
  const imaging::ImageVolume image = plate();
  const Axis axis = straight();
  CurvedOptions o = options(CurvedMode::straightened, 0.0, 0.5);
  o.width = 21;
  o.height = 40;
  o.s_start_mm = 2.0;
  // Which turn looks across x?
  for (const CurvedMode mode : both) {
    o.mode = mode;
    o.slab = Slab::none;
    double turn = 0.0;
    for (const double theta : {0.0, 90.0}) {
      o.theta_deg = theta;
      if (std::abs(CurvedReformation(axis, o).row(3.0).across.x()) > 0.9) turn = theta;
    }
    o.theta_deg = turn;
    const auto middle = [&](Slab slab, double thick) {
      CurvedOptions at = o;
      at.slab = slab;
      at.slab_mm = thick;
      return static_cast<double>(reformatted(image, CurvedReformation(axis, at))(10, 20));
    };
    EXPECT_NEAR(middle(Slab::none, 0.0), 100.0, 1e-3);
    EXPECT_NEAR(middle(Slab::maximum, 0.9), 100.0, 1e-3);
    // The plate's profile is a triangle of 800 HU, 1 mm wide at its foot; a layer passes 1/8 mm from its top.
    EXPECT_NEAR(middle(Slab::maximum, 2.5), 700.0, 1.0);
    EXPECT_NEAR(middle(Slab::mean, 4.0), 200.0, 1.0);
  }
}

TEST(CurvedImage, LayersOutsideTheImageDoNotCount) {
  const imaging::FloatVolume image = ramp(Vec3(0, 0, 15), 20);
  CurvedOptions o = options(CurvedMode::straightened, 0.0, 0.5);
  o.slab = Slab::mean;
  o.slab_mm = 60.0;
  const CurvedImage thick = reformatted(image, CurvedReformation(straight(), o));
  int inside = 0;
  for (const float v : thick.values) inside += std::isnan(v) ? 0 : 1;
  o.slab = Slab::none;
  int thin_inside = 0;
  for (const float v : reformatted(image, CurvedReformation(straight(), o)).values)
    thin_inside += std::isnan(v) ? 0 : 1;
  EXPECT_GT(inside, thin_inside);
  EXPECT_LT(inside, 101 * 240);
}

TEST(CurvedImage, DoesNotDependOnTheNumberOfThreadsAndCanBeCancelled) {
  const Axis axis = coronary();
  const imaging::FloatVolume image = ramp(axis->point(20.0), 30);
  CurvedOptions o = options(CurvedMode::stretched, 10.0);
  o.slab = Slab::mean;
  o.slab_mm = 2.0;
  const CurvedReformation view(axis, o);
  core::set_max_threads(1);
  const CurvedImage one = reformatted(image, view, imaging::Interpolation::cubic);
  core::set_max_threads(4);
  const CurvedImage four = reformatted(image, view, imaging::Interpolation::cubic);
  core::set_max_threads(0);
  for (std::size_t i = 0; i < one.values.size(); ++i)
    ASSERT_TRUE(one.values[i] == four.values[i] || (std::isnan(one.values[i]) && std::isnan(four.values[i])));
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(reformatted(image, view, imaging::Interpolation::trilinear, task), Cancelled);
}

TEST(CrossSection, SlabsTakeTheMeanAndTheMaximumAlongTheAxis) {
  const imaging::ImageVolume image = plate();
  Plane plane;
  plane.origin = {0.0, -5.0, 5.0};
  plane.u = Vec3::UnitY();
  plane.v = Vec3::UnitZ();
  plane.pixel_mm = 0.5;
  plane.width = plane.height = 20;
  EXPECT_NEAR(slice(image, plane)(10, 10), 100.0, 1e-3);
  EXPECT_NEAR(slab_slice(image, plane, Slab::mean, 4.0)(10, 10), 200.0, 1.0);
  EXPECT_NEAR(slab_slice(image, plane, Slab::maximum, 2.5)(10, 10), 700.0, 1.0);
  EXPECT_THROW(slab_slice(image, plane, Slab::mean, 0.0), InvalidInput);
  EXPECT_THROW(slab_slice(image, plane, Slab::maximum, 1e6), InvalidInput);
}

}  // namespace
}  // namespace ostia::reformat
