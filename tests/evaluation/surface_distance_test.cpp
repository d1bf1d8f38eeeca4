#include "ostia/evaluation/surface_distance.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/isosurface.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::evaluation {
namespace {

using geometry::Box3;
using geometry::TriMesh;
using geometry::Vec3;

TriMesh offset_ball(double radius, const Vec3& centre = Vec3::Zero()) {
  const Vec3 reach = Vec3::Constant(radius + 1.0);
  TriMesh mesh = geometry::isosurface([&](const Vec3& p) { return (p - centre).norm() - radius; },
                                      Box3(centre - reach, centre + reach), 0.25);
  for (Vec3& p : mesh.points) p = centre + radius * (p - centre).normalized();
  return mesh;
}

TEST(SurfaceDistance, ConcentricBallsAreTheirRadiiApart) {
  const SurfaceDistances d = compare_surfaces(offset_ball(3.0), offset_ball(3.5));
  EXPECT_NEAR(d.msd_mm, 0.5, 0.01);
  EXPECT_NEAR(d.rms_sd_mm, 0.5, 0.01);
  EXPECT_NEAR(d.max_sd_mm, 0.5, 0.02);
  EXPECT_NEAR(d.hd95_mm, 0.5, 0.01);
  EXPECT_NEAR(d.signed_mean_mm, 0.5, 0.01);
  EXPECT_NEAR(d.signed_sd_mm, 0.0, 0.01);
  EXPECT_NEAR(compare_surfaces(offset_ball(3.5), offset_ball(3.0)).signed_mean_mm, -0.5, 0.01);
}

TEST(SurfaceDistance, IsNothingToItself) {
  const TriMesh mesh = offset_ball(2.0);
  EXPECT_NEAR(compare_surfaces(mesh, mesh).max_sd_mm, 0.0, 1e-9);
}

TEST(SurfaceDistance, ShiftedBallHasTheShiftAsItsMaximum) {
  const SurfaceDistances d = compare_surfaces(offset_ball(3.0), offset_ball(3.0, Vec3(0.4, 0, 0)));
  EXPECT_NEAR(d.max_sd_mm, 0.4, 0.02);
  // Mean of |cos| over the sphere is a half, to first order in the shift.
  EXPECT_NEAR(d.msd_mm, 0.2, 0.02);
  EXPECT_NEAR(d.signed_mean_mm, 0.0, 0.02);
}

/// Area-weighted mean of what the winding number and the nearest point say at the triangles' centroids.
double signed_mean_by_winding(const TriMesh& reference, const TriMesh& result) {
  const geometry::AabbTree tree(reference);
  double sum = 0.0, area = 0.0;
  for (const geometry::Triangle& t : result.triangles) {
    const Vec3 a = result.points[static_cast<std::size_t>(t[0])],
               b = result.points[static_cast<std::size_t>(t[1])],
               c = result.points[static_cast<std::size_t>(t[2])];
    const double own = 0.5 * (b - a).cross(c - a).norm();
    sum += own * tree.signed_distance((a + b + c) / 3.0);
    area += own;
  }
  return sum / area;
}

TEST(SurfaceDistance, SidesAreThoseOfTheWindingNumber) {
  SurfaceDistanceOptions centroids;
  centroids.sample_mm = 5.0;
  const TriMesh result = offset_ball(0.8, Vec3(3.2, 0, 0));
  for (const TriMesh& reference :
       {offset_ball(3.0),
        geometry::merged(offset_ball(3.0), offset_ball(3.0, Vec3(2, 0, 0)))}) {  // the second overlaps itself
    const double exact = signed_mean_by_winding(reference, result);
    EXPECT_NEAR(compare_surfaces(reference, result, centroids).signed_mean_mm, exact, 1e-9);
  }
  EXPECT_LT(compare_surfaces(geometry::merged(offset_ball(3.0), offset_ball(3.0, Vec3(2, 0, 0))), result)
                .signed_mean_mm,
            -0.3)
      << "inside the second ball, though beyond a sheet of the first";
}

TEST(SurfaceDistance, AsksOnlyWhereItCounts) {
  TriMesh bumped = offset_ball(3.0);
  for (Vec3& p : bumped.points) {
    if (p.z() > 2.0) p *= 1.3;
  }
  SurfaceDistanceOptions options;
  options.reference_region = options.result_region = [](const Vec3& p) { return p.z() < 0.0; };
  EXPECT_NEAR(compare_surfaces(offset_ball(3.0), bumped, options).max_sd_mm, 0.0, 1e-6);
  EXPECT_GT(compare_surfaces(offset_ball(3.0), bumped).max_sd_mm, 0.8);
}

TEST(SurfaceDistance, DoesNotDependOnThreads) {
  core::set_max_threads(1);
  const SurfaceDistances one = compare_surfaces(offset_ball(3.0), offset_ball(3.2, Vec3(0.1, 0, 0)));
  core::set_max_threads(3);
  const SurfaceDistances three = compare_surfaces(offset_ball(3.0), offset_ball(3.2, Vec3(0.1, 0, 0)));
  core::set_max_threads(0);
  EXPECT_EQ(one.msd_mm, three.msd_mm);
  EXPECT_EQ(one.signed_sd_mm, three.signed_sd_mm);
}

TEST(SurfaceDistance, RefusesNothing) {
  SurfaceDistanceOptions nowhere;
  nowhere.result_region = [](const Vec3&) { return false; };
  EXPECT_THROW(compare_surfaces(offset_ball(1.0), offset_ball(1.0), nowhere), InvalidInput);
  EXPECT_THROW(compare_surfaces(offset_ball(1.0), TriMesh{}), InvalidInput);
  SurfaceDistanceOptions bad;
  bad.sample_mm = 0.0;
  EXPECT_THROW(compare_surfaces(offset_ball(1.0), offset_ball(1.0), bad), InvalidInput);
}

TEST(SurfaceDistance, CanBeCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(compare_surfaces(offset_ball(1.0), offset_ball(1.1), {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::evaluation
