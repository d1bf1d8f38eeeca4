#include "ostia/centerline/axis_fit.h"

#include "support/shapes.h"

#include "ostia/centerline/lumen_surface.h"
#include "ostia/geometry/isosurface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::centerline {
namespace {

using geometry::Vec3;

Axis line_along_z(double length, double step, double radius) {
  Axis axis;
  for (double z = 0.0; z <= length + 1e-9; z += step) {
    axis.points.emplace_back(0.0, 0.0, z);
    axis.radius.push_back(radius);
  }
  return axis;
}

double largest_offset(const Axis& axis) {
  double largest = 0.0;
  for (const Vec3& p : axis.points) largest = std::max(largest, p.head<2>().norm());
  return largest;
}

TEST(AxisFit, equal_steps_keep_the_ends_and_join_coincident_points) {
  const Axis axis = at_equal_steps({{{0, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 0, 2.5}}, {1, 1, 2, 2}}, 0.4);
  EXPECT_EQ(axis.points.size(), 8u);
  EXPECT_EQ(axis.points.front(), Vec3(0, 0, 0));
  EXPECT_EQ(axis.points.back(), Vec3(0, 0, 2.5));
  EXPECT_NEAR(axis.radius[1], 1.0 + 2.5 / 7.0, 1e-12);
}

TEST(AxisFit, smoothing_removes_a_zigzag_and_keeps_a_bend) {
  Axis zigzag = line_along_z(20.0, 0.1, 1.0), bend = zigzag;
  std::vector<Vec3> arc;
  for (std::size_t i = 0; i < zigzag.points.size(); ++i) {
    zigzag.points[i].x() = i % 2 ? 0.05 : -0.05;
    const double angle = bend.points[i].z() / 15.0;
    bend.points[i] = Vec3(15.0 * (1.0 - std::cos(angle)), 0.0, 15.0 * std::sin(angle));
  }
  const std::vector<double> bound(zigzag.points.size(), 0.2);
  Axis smooth = smoothed_axis(zigzag, 2.0, bound);
  smooth.points.erase(smooth.points.begin(), smooth.points.begin() + 30);
  smooth.points.resize(smooth.points.size() - 30);
  EXPECT_LT(largest_offset(smooth), 2e-3);
  const Axis kept = smoothed_axis(bend, 2.0, bound);
  for (std::size_t i = 30; i + 30 < bend.points.size(); ++i)
    EXPECT_LT((kept.points[i] - bend.points[i]).norm(), 1e-4);
}

TEST(AxisFit, smoothing_stays_within_its_bound) {
  Axis wave = line_along_z(10.0, 0.1, 1.0);
  for (Vec3& p : wave.points) p.x() = 0.5 * std::sin(2.0 * M_PI * p.z());
  const std::vector<double> bound(wave.points.size(), 0.1);
  const Axis smooth = smoothed_axis(wave, 2.0, bound);
  for (std::size_t i = 0; i < wave.points.size(); ++i)
    EXPECT_LE((smooth.points[i] - wave.points[i]).norm(), 0.1 + 1e-12);
}

TEST(AxisFit, recentring_finds_the_axis_of_a_tube) {
  const LumenSurface surface =
      prepare_lumen(geometry::surface_of(geometry::straight_tube(10, 1.0), 0.25, true));
  const Wall wall(surface.wall);
  Axis off = line_along_z(10.0, 0.1, 1.0);
  for (std::size_t i = 1; i + 1 < off.points.size(); ++i)
    off.points[i].x() += 0.1 * std::sin(0.1 * M_PI * off.points[i].z());
  const Axis centred = recentred_axis(off, wall, std::vector<double>(off.points.size(), 0.25), 1.0);
  EXPECT_GT(largest_offset(off), 0.099);
  EXPECT_LT(largest_offset(centred), 2e-3);
}

TEST(AxisFit, recentring_of_an_ellipse_goes_to_its_centre_and_no_farther_than_the_bound) {
  const auto ellipse = [](const Vec3& p) { return std::hypot(p.x() / 1.6, p.y()) - 1.0; };
  const geometry::TriMesh mesh = geometry::isosurface(ellipse, {Vec3(-2, -1.5, -1), Vec3(2, 1.5, 9)}, 0.15);
  const Wall wall(mesh);
  Axis off = line_along_z(8.0, 0.1, 1.0);
  for (std::size_t i = 1; i + 1 < off.points.size(); ++i) off.points[i].y() = 0.05;
  const Axis centred = recentred_axis(off, wall, std::vector<double>(off.points.size(), 0.15), 1.0);
  for (std::size_t i = 20; i + 20 < off.points.size(); ++i) EXPECT_NEAR(centred.points[i].y(), 0.0, 0.01);
  const Axis held = recentred_axis(off, wall, std::vector<double>(off.points.size(), 0.01), 1.0);
  for (std::size_t i = 0; i < off.points.size(); ++i)
    EXPECT_LE((held.points[i] - off.points[i]).norm(), 0.01 + 1e-12);
}

TEST(AxisFit, wall_distance_takes_out_the_chord_error) {
  const LumenSurface surface =
      prepare_lumen(geometry::surface_of(geometry::straight_tube(10, 1.0), 0.3, true));
  const Wall wall(surface.wall);
  const geometry::AabbTree flat(surface.wall);
  for (double z = 2.0; z < 8.0; z += 0.37) {
    const Vec3 p(0.0, 0.0, z);
    EXPECT_NEAR(wall.distance(p), 1.0, 1e-3);
    EXPECT_NEAR(wall.inscribed_radius(p), 1.0, 6e-3);  // the rings of points are 0.3 mm apart
    EXPECT_LT(flat.closest(p).distance, 1.0 - 2e-3);
  }
}

TEST(AxisFit, a_branch_leaves_along_its_parent) {
  std::vector<Vec3> parent;
  for (int i = 0; i <= 20; ++i) parent.emplace_back(0.0, 0.0, -2.0 + 0.1 * i);
  Axis branch;
  for (int i = 0; i <= 100; ++i) {
    branch.points.emplace_back(0.07 * i, 0.0, 0.07 * i);
    branch.radius.push_back(1.0);
  }
  const Axis led = led_out_of(parent, branch, 2.0);
  EXPECT_EQ(led.points.front(), branch.points.front());
  const Vec3 first = (led.points[1] - led.points[0]).normalized();
  EXPECT_GT(first.z(), std::cos(M_PI / 8.0));  // less than half of the corner of 45 degrees
  for (std::size_t i = 60; i < led.points.size(); ++i)
    EXPECT_LT((led.points[i] - branch.points[i]).norm(), 0.01);
}

}  // namespace
}  // namespace ostia::centerline
