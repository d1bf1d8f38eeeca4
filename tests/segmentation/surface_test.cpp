#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/segmentation/segment.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::segmentation {
namespace {

imaging::Geometry grid(const Vec3& spacing = Vec3::Constant(0.5)) {
  imaging::Geometry geometry;
  geometry.size = {40, 40, 40};
  geometry.spacing = spacing;
  geometry.origin = Vec3(3, -4, 5);
  return geometry;
}

template <class T, class F>
imaging::Volume<T> filled(const imaging::Geometry& geometry, const F& f) {
  imaging::Volume<T> out;
  out.geometry = geometry;
  out.voxels.resize(static_cast<std::size_t>(geometry.voxels()));
  for (std::int64_t n = 0; n < geometry.voxels(); ++n) {
    out.voxels[static_cast<std::size_t>(n)] = static_cast<T>(f(geometry.world(
        Vec3(static_cast<double>(n % 40), static_cast<double>(n / 40 % 40), static_cast<double>(n / 1600)))));
  }
  return out;
}

const Vec3 kCentre = grid().world(Vec3(12, 20, 20));
const Vec3 kOther = grid().world(Vec3(32, 20, 20));

TEST(Surface, HoldsThePartsOfTheSeedsAloneAndNoBubbles) {
  const auto phi = filled<float>(grid(), [](const Vec3& p) {
    const double shell =
        std::max((p - kCentre).norm() - 4.0, 1.5 - (p - kCentre).norm());  // a ball with a bubble in it
    return std::min(shell, (p - kOther).norm() - 2.0);
  });
  const geometry::TriMesh one = surface_of(phi, {kCentre + Vec3(3, 0, 0)});
  const auto faults = geometry::find_faults(one, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.components, 1U);
  EXPECT_EQ(faults.self_intersections, 0U);
  EXPECT_NEAR(geometry::volume(one), 4.0 / 3.0 * 3.14159 * 64.0, 5.0);  // positive: outward
  SurfaceOptions keep;
  keep.fill_cavities = false;
  EXPECT_EQ(geometry::find_faults(surface_of(phi, {kCentre + Vec3(3, 0, 0)}, keep), false).components, 2U);
  EXPECT_EQ(geometry::find_faults(surface_of(phi, {}), false).components, 2U);
  EXPECT_THROW(surface_of(phi, {grid().world(Vec3(1, 1, 1))}), GeometryError);
}

TEST(Surface, OfAMaskIsSmoothBelowAVoxel) {
  const auto mask =
      filled<std::uint8_t>(grid(), [](const Vec3& p) { return (p - kCentre).norm() < 5.0 ? 1 : 0; });
  const geometry::TriMesh mesh = segment_mask(mask);
  double worst = 0.0;
  for (const Vec3& p : mesh.points) worst = std::max(worst, std::abs((p - kCentre).norm() - 5.0));
  EXPECT_LT(worst, 0.3);  // stairs would give 0.43 and more
  EXPECT_TRUE(geometry::find_faults(mesh, false).closed_manifold());
  EXPECT_NEAR(geometry::volume(mesh), 4.0 / 3.0 * 3.14159 * 125.0, 20.0);
}

TEST(Surface, OfAMaskKeepsWhatIsOneVoxelThin) {
  auto mask = filled<std::uint8_t>(grid(), [](const Vec3&) { return 0; });
  for (std::int64_t i = 3; i < 37; ++i) mask(i, 20, 20) = 1;
  const geometry::TriMesh mesh = segment_mask(mask);
  const geometry::Box3 box = geometry::bounds(mesh.points);
  EXPECT_GT(box.sizes().x(), 16.5);
  EXPECT_EQ(geometry::find_faults(mesh, false).components, 1U);
}

TEST(Surface, OfAMaskIsClosedAtTheBorder) {
  const auto mask = filled<std::uint8_t>(
      grid(), [](const Vec3& p) { return (p - kCentre).head<2>().norm() < 3.0 ? 1 : 0; });
  const geometry::TriMesh mesh = segment_mask(mask);
  EXPECT_TRUE(geometry::find_faults(mesh, false).closed_manifold());
  EXPECT_NEAR(geometry::bounds(mesh.points).sizes().z(), 20.0, 0.6);
}

TEST(Surface, OfAMaskMayBeTheLargestPartAlone) {
  const auto mask = filled<std::uint8_t>(
      grid(), [](const Vec3& p) { return (p - kCentre).norm() < 4.0 || (p - kOther).norm() < 2.0 ? 1 : 0; });
  EXPECT_EQ(geometry::find_faults(segment_mask(mask), false).components, 2U);
  MaskSurfaceOptions options;
  options.largest_part_only = true;
  const geometry::TriMesh mesh = segment_mask(mask, options);
  EXPECT_EQ(geometry::find_faults(mesh, false).components, 1U);
  EXPECT_GT(geometry::volume(mesh), 200.0);
}

TEST(Surface, RefusesEmptyMasksAndOddOptions) {
  const auto empty = filled<std::uint8_t>(grid(), [](const Vec3&) { return 0; });
  EXPECT_THROW(segment_mask(empty), InvalidInput);
  MaskSurfaceOptions options;
  options.sigma_voxels = -1.0;
  EXPECT_THROW(segment_mask(empty, options), InvalidInput);
}

TEST(Surface, HasNoDegenerateTrianglesWhereItMeetsVoxels) {
  // A box's faces a hair off the voxels' centres.
  imaging::FloatVolume phi;
  phi.geometry.size = {16, 16, 16};
  phi.geometry.spacing = Vec3::Constant(0.4);
  for (int n = 0; n < 16 * 16 * 16; ++n) {
    const Vec3 p = phi.geometry.world(Vec3(n % 16, n / 16 % 16, n / 256)) - Vec3::Constant(3.0);
    phi.voxels.push_back(static_cast<float>(p.cwiseAbs().maxCoeff() - 1.4001));
  }
  const geometry::TriMesh mesh = surface_of(phi, {});
  double shortest = 1e9;
  for (const auto& t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) {
      const Vec3 edge = mesh.points[static_cast<std::size_t>(t[static_cast<std::size_t>(c)])] -
                        mesh.points[static_cast<std::size_t>(t[static_cast<std::size_t>((c + 1) % 3)])];
      shortest = std::min(shortest, edge.norm());
    }
  }
  EXPECT_GT(shortest, 0.02 * 0.4);
  for (const Vec3& p : mesh.points)
    EXPECT_NEAR((p - Vec3::Constant(3.0)).cwiseAbs().maxCoeff(), 1.4, 0.04 * 0.4);
}

}  // namespace
}  // namespace ostia::segmentation
