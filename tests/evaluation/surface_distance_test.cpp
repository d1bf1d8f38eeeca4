#include "ostia/evaluation/surface_distance.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/isosurface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::evaluation {
namespace {

using geometry::Box3;
using geometry::TriMesh;
using geometry::Vec3;

TriMesh ball(double radius, const Vec3& centre = Vec3::Zero()) {
  const Vec3 reach = Vec3::Constant(radius + 1.0);
  TriMesh mesh = geometry::isosurface([&](const Vec3& p) { return (p - centre).norm() - radius; },
                                      Box3(centre - reach, centre + reach), 0.25);
  for (Vec3& p : mesh.points) p = centre + radius * (p - centre).normalized();
  return mesh;
}

TEST(SurfaceDistance, ConcentricBallsAreTheirRadiiApart) {
  const SurfaceDistances d = compare_surfaces(ball(3.0), ball(3.5));
  EXPECT_NEAR(d.msd_mm, 0.5, 0.01);
  EXPECT_NEAR(d.rms_sd_mm, 0.5, 0.01);
  EXPECT_NEAR(d.max_sd_mm, 0.5, 0.02);
  EXPECT_NEAR(d.hd95_mm, 0.5, 0.01);
  EXPECT_NEAR(d.signed_mean_mm, 0.5, 0.01);
  EXPECT_NEAR(d.signed_sd_mm, 0.0, 0.01);
  EXPECT_NEAR(compare_surfaces(ball(3.5), ball(3.0)).signed_mean_mm, -0.5, 0.01);
}

TEST(SurfaceDistance, IsNothingToItself) {
  const TriMesh mesh = ball(2.0);
  EXPECT_NEAR(compare_surfaces(mesh, mesh).max_sd_mm, 0.0, 1e-9);
}

TEST(SurfaceDistance, ShiftedBallHasTheShiftAsItsMaximum) {
  const SurfaceDistances d = compare_surfaces(ball(3.0), ball(3.0, Vec3(0.4, 0, 0)));
  EXPECT_NEAR(d.max_sd_mm, 0.4, 0.02);
  // Mean of |cos| over the sphere is a half, to first order in the shift.
  EXPECT_NEAR(d.msd_mm, 0.2, 0.02);
  EXPECT_NEAR(d.signed_mean_mm, 0.0, 0.02);
}

TEST(SurfaceDistance, AsksOnlyWhereItCounts) {
  TriMesh bumped = ball(3.0);
  for (Vec3& p : bumped.points) {
    if (p.z() > 2.0) p *= 1.3;
  }
  SurfaceDistanceOptions options;
  options.reference_region = options.result_region = [](const Vec3& p) { return p.z() < 0.0; };
  EXPECT_NEAR(compare_surfaces(ball(3.0), bumped, options).max_sd_mm, 0.0, 1e-6);
  EXPECT_GT(compare_surfaces(ball(3.0), bumped).max_sd_mm, 0.8);
}

TEST(SurfaceDistance, DoesNotDependOnThreads) {
  core::set_max_threads(1);
  const SurfaceDistances one = compare_surfaces(ball(3.0), ball(3.2, Vec3(0.1, 0, 0)));
  core::set_max_threads(3);
  const SurfaceDistances three = compare_surfaces(ball(3.0), ball(3.2, Vec3(0.1, 0, 0)));
  core::set_max_threads(0);
  EXPECT_EQ(one.msd_mm, three.msd_mm);
  EXPECT_EQ(one.signed_sd_mm, three.signed_sd_mm);
}

TEST(SurfaceDistance, RefusesNothing) {
  SurfaceDistanceOptions nowhere;
  nowhere.result_region = [](const Vec3&) { return false; };
  EXPECT_THROW(compare_surfaces(ball(1.0), ball(1.0), nowhere), InvalidInput);
  EXPECT_THROW(compare_surfaces(ball(1.0), TriMesh{}), InvalidInput);
  SurfaceDistanceOptions bad;
  bad.sample_mm = 0.0;
  EXPECT_THROW(compare_surfaces(ball(1.0), ball(1.0), bad), InvalidInput);
}

TEST(SurfaceDistance, CanBeCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(compare_surfaces(ball(1.0), ball(1.1), {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::evaluation
