#include "ostia/centerline/skeleton_radius.h"

#include "support/masks.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace ostia::centerline {
namespace {

using imaging::MaskVolume;
using test::graph_of;
using test::grid_of;
using test::mask_of;

const Vec3 ct_voxel(0.6, 0.6, 1.25);

struct SkeletonRadiusTube {
  Vec3 a, b;
};

/// 30 mm of tube, in a box that fits it.
struct Scanned {
  SkeletonRadiusTube tube;
  imaging::Geometry grid;
};
Scanned scanned(const Vec3& direction, const Vec3& spacing, const Vec3& shift) {
  const double side = 40.0;
  Scanned s;
  s.grid =
      grid_of(static_cast<std::int64_t>(side / spacing.x()), static_cast<std::int64_t>(side / spacing.y()),
              static_cast<std::int64_t>(side / spacing.z()), spacing);
  const Vec3 middle = Vec3::Constant(0.5 * side) + shift;
  s.tube = {middle - 15.0 * direction.normalized(), middle + 15.0 * direction.normalized()};
  return s;
}

SkeletonGraph lines_of(const MaskVolume& mask) {
  return smoothed(ends_extended(pruned(graph_of(mask)), mask), {.knot_spacing_mm = 8.0, .step_mm = 0.6});
}

struct Spread {
  double mean = 0.0, sd = 0.0;
};
Spread spread(const std::vector<double>& values) {
  Spread s;
  for (const double v : values) s.mean += v / static_cast<double>(values.size());
  for (const double v : values) s.sd += (v - s.mean) * (v - s.mean) / static_cast<double>(values.size() - 1);
  s.sd = std::sqrt(s.sd);
  return s;
}

double mean_radius(const SkeletonGraph& graph) {
  double sum = 0.0;
  const auto& r = graph.edges.at(0).radius_mm;
  for (const double v : r) sum += v / static_cast<double>(r.size());
  return sum;
}

std::vector<Vec3> orientations() {
  // Turns by 45 and 90 degrees about the axes.
  return {{0, 0, 1},  {1, 0, 0}, {0, 1, 0},  {1, 0, 1},     {-1, 0, 1},     {0, 1, 1},
          {0, -1, 1}, {1, 1, 0}, {1, -1, 0}, {1, 1, 1.414}, {1, -1, 1.414}, {-1, 1, 1.414}};
}

/// The share of each voxel inside the tube, by 4 x 4 x 4 points.
imaging::FloatVolume shares(const Scanned& s, double radius) {
  imaging::FloatVolume image{s.grid, {}};
  for (std::int64_t k = 0; k < s.grid.size[2]; ++k)
    for (std::int64_t j = 0; j < s.grid.size[1]; ++j)
      for (std::int64_t i = 0; i < s.grid.size[0]; ++i) {
        const Vec3 centre(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        int inside = 0;
        if (test::to_segment(s.grid.world(centre), s.tube.a, s.tube.b) < radius + 1.0)
          for (int n = 0; n < 64; ++n) {
            const Vec3 part((n % 4 - 1.5) / 4.0, (n / 4 % 4 - 1.5) / 4.0, (n / 16 - 1.5) / 4.0);
            inside += test::in_tube(s.grid.world(centre + part), s.tube.a, s.tube.b, radius) ? 1 : 0;
          }
        image.voxels.push_back(static_cast<float>(inside) / 64.0F);
      }
  return image;
}

TEST(Measured, TubesInTwelveOrientationsOfACtGrid) {
  for (const double radius : {0.78, 1.56, 2.34}) {
    std::vector<double> radii, by_shares, lengths;
    int i = 0;
    for (const Vec3& direction : orientations()) {
      ++i;
      const Scanned s = scanned(direction, ct_voxel, Vec3(0.13, -0.21, 0.37) * i);
      const MaskVolume mask =
          mask_of(s.grid, [&](const Vec3& p) { return test::in_tube(p, s.tube.a, s.tube.b, radius); });
      const SkeletonGraph lines = lines_of(mask);
      ASSERT_EQ(lines.edges.size(), 1U) << radius << " orientation " << i;
      const MeasuredSkeleton sections = measured(lines, mask);
      EXPECT_EQ(find_fault(sections.graph), std::nullopt);
      radii.push_back(mean_radius(sections.graph));
      by_shares.push_back(mean_radius(measured(lines, shares(s, radius)).graph));
      lengths.push_back(length_mm(lines.edges[0]));
    }
    const Spread r = spread(radii), f = spread(by_shares), l = spread(lengths);
    std::printf(
        "radius %.2f: bias %+.3f, 2 sd %.3f mm; by shares %+.3f, %.3f; length 30: bias %+.2f, 2 sd %.2f\n",
        radius, r.mean - radius, 2.0 * r.sd, f.mean - radius, 2.0 * f.sd, l.mean - 30.0, 2.0 * l.sd);
    EXPECT_NEAR(r.mean, radius, 0.05);
    EXPECT_LT(2.0 * r.sd, 0.18);  // a tube along the grid is rounded to voxels the same way all along
    EXPECT_NEAR(f.mean, radius, 0.05);
    EXPECT_LT(2.0 * f.sd, 0.10);
    EXPECT_NEAR(l.mean, 30.0, 0.5);
    EXPECT_LT(2.0 * l.sd, 1.0);
  }
}

TEST(Measured, AnEllipseHasItsAxes) {
  const Vec3 across = Vec3(1.0, 0.4, 0.0).normalized();
  const MaskVolume mask = mask_of(grid_of(60, 60, 60, Vec3(0.4, 0.4, 0.5)), [&](const Vec3& p) {
    const Vec3 q = p - Vec3(12.0, 12.0, 0.0);
    const double u = q.dot(across), v = q.dot(Vec3(-across.y(), across.x(), 0.0));
    return p.z() > 2.0 && p.z() < 28.0 && std::hypot(u / 3.2, v / 2.0) <= 1.0;
  });
  const SkeletonGraph lines = lines_of(mask);
  ASSERT_EQ(lines.edges.size(), 1U);
  const MeasuredSkeleton sections = measured(lines, mask);
  std::size_t checked = 0;
  for (const SkeletonSection& s : sections.sections[0]) {
    if (s.centre.z() < 7.0 || s.centre.z() > 23.0) continue;
    ++checked;
    EXPECT_TRUE(s.measured);
    EXPECT_NEAR(s.semi_major_mm, 3.2, 0.15);
    EXPECT_NEAR(s.semi_minor_mm, 2.0, 0.12);
    EXPECT_GT(std::abs(s.major_axis.dot(across)), 0.99);
    EXPECT_LT(std::hypot(s.ellipse_centre.x() - 12.0, s.ellipse_centre.y() - 12.0), 0.15);
    EXPECT_GT(s.radius_mm, 1.8);
    EXPECT_LT(s.radius_mm, 3.3);
  }
  EXPECT_GT(checked, 20U);
}

TEST(Measured, AGreyImageGivesTheSameTube) {
  const Scanned s = scanned(Vec3(0.5, 0.3, 1.0), Vec3(0.4, 0.4, 0.5), Vec3::Zero());
  const Vec3 axis = (s.tube.b - s.tube.a).normalized();
  constexpr double radius = 1.6, blur = 0.45;
  imaging::ImageVolume image;
  image.geometry = s.grid;
  const MaskVolume mask =
      mask_of(s.grid, [&](const Vec3& p) { return test::in_tube(p, s.tube.a, s.tube.b, radius); });
  for (std::int64_t k = 0; k < s.grid.size[2]; ++k)
    for (std::int64_t j = 0; j < s.grid.size[1]; ++j)
      for (std::int64_t i = 0; i < s.grid.size[0]; ++i) {
        const Vec3 p =
            s.grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        const double d = (p - s.tube.a - (p - s.tube.a).dot(axis) * axis).norm();
        // Of a disc blurred by a Gaussian, by quadrature over the rings.
        double sum = 0.0;
        if (d < radius + 3.0)
          for (double t = 0.025; t < radius; t += 0.05) {
            const double z = d * t / (blur * blur);
            const double scaled = z > 40.0 ? 1.0 / std::sqrt(2.0 * std::numbers::pi * z)
                                           : std::cyl_bessel_i(0.0, z) * std::exp(-z);
            sum += 0.05 * t / (blur * blur) * std::exp(-0.5 * (d - t) * (d - t) / (blur * blur)) * scaled;
          }
        image.voxels.push_back(static_cast<std::int16_t>(std::lround(-50.0 + 450.0 * sum)));
      }
  const SkeletonGraph lines = lines_of(mask);
  ASSERT_EQ(lines.edges.size(), 1U);
  const MeasuredSkeleton found = measured(lines, image, {.image_blur_mm = blur});
  const MeasuredSkeleton raw = measured(lines, image, {.correct_blur = false});
  const std::size_t n = found.graph.edges[0].radius_mm.size();
  for (std::size_t i = n / 5; i < n - n / 5; ++i) {
    EXPECT_NEAR(found.graph.edges[0].radius_mm[i], radius, 0.04);
    EXPECT_LT(raw.graph.edges[0].radius_mm[i], radius - 0.06);
    const Vec3 p = found.graph.edges[0].points[i] - s.tube.a;
    EXPECT_LT((p - p.dot(axis) * axis).norm(), 0.06);
  }
}

TEST(Measured, TheSameForAnyNumberOfThreads) {
  const Scanned s = scanned(Vec3(0.2, 0.3, 1.0), ct_voxel, Vec3::Zero());
  const MaskVolume mask =
      mask_of(s.grid, [&](const Vec3& p) { return test::in_tube(p, s.tube.a, s.tube.b, 2.0); });
  const SkeletonGraph lines = lines_of(mask);
  core::set_max_threads(1);
  const MeasuredSkeleton one = measured(lines, mask);
  core::set_max_threads(4);
  const MeasuredSkeleton four = measured(lines, mask);
  core::set_max_threads(0);
  EXPECT_EQ(one.graph.edges[0].radius_mm, four.graph.edges[0].radius_mm);
  EXPECT_EQ(one.graph.edges[0].points, four.graph.edges[0].points);
}

TEST(Measured, WhereNothingIsSeenTheFirstGuessStays) {
  const Scanned s = scanned(Vec3(0.0, 0.0, 1.0), ct_voxel, Vec3::Zero());
  const MaskVolume mask =
      mask_of(s.grid, [&](const Vec3& p) { return test::in_tube(p, s.tube.a, s.tube.b, 2.0); });
  const SkeletonGraph lines = lines_of(mask);
  imaging::ImageVolume flat;
  flat.geometry = s.grid;
  flat.voxels.assign(static_cast<std::size_t>(s.grid.voxels()), 100);
  const MeasuredSkeleton nothing = measured(lines, flat);
  EXPECT_EQ(nothing.interpolated, static_cast<std::int64_t>(lines.edges[0].points.size()));
  EXPECT_EQ(nothing.graph.edges[0].radius_mm, lines.edges[0].radius_mm);
}

TEST(Measured, RefusesBadInputAndCanBeCancelled) {
  const Scanned s = scanned(Vec3(0.0, 0.0, 1.0), ct_voxel, Vec3::Zero());
  const MaskVolume mask =
      mask_of(s.grid, [&](const Vec3& p) { return test::in_tube(p, s.tube.a, s.tube.b, 2.0); });
  const SkeletonGraph lines = lines_of(mask);
  EXPECT_THROW(measured(lines, mask, {.rays = 3}), InvalidInput);
  EXPECT_THROW(measured(lines, mask, {.sigma_mm = 0.0}), InvalidInput);
  EXPECT_THROW(measured(lines, MaskVolume{}), InvalidInput);
  MaskVolume elsewhere = mask;
  elsewhere.geometry.origin = Vec3(500.0, 0.0, 0.0);
  EXPECT_THROW(measured(lines, elsewhere), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(measured(lines, mask, {}, task), Cancelled);
}

TEST(UnblurredRadius, IsTheInverseOfWhereABlurredDiscIsSteepest) {
  for (const double radius : {0.5, 0.78, 1.5, 4.0, 30.0}) {
    constexpr double sigma = 0.4;
    double best = 0.0, most = 0.0;
    for (double r = 0.2; r < radius + 1.0; r += 0.0005) {
      const double z = r * radius / (sigma * sigma);
      const double scaled = z > 200.0 ? (1.0 - 0.375 / z) / std::sqrt(2.0 * std::numbers::pi * z)
                                      : std::cyl_bessel_i(1.0, z) * std::exp(-z);
      const double slope = std::exp(-0.5 * (r - radius) * (r - radius) / (sigma * sigma)) * scaled;
      if (slope > most) {
        most = slope;
        best = r;
      }
    }
    EXPECT_NEAR(unblurred_radius(best, sigma), radius, 0.004) << radius;
  }
  EXPECT_EQ(unblurred_radius(0.3, 0.4), 0.0);
}

}  // namespace
}  // namespace ostia::centerline
