#include "ostia/meshing/remesh.h"

#include "test_surfaces.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/quality.h"

#include <gtest/gtest.h>

#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

std::vector<double> sizes(const geometry::TriMesh& mesh, const geometry::AnalyticShape& shape, double ratio) {
  SizingOptions options;
  options.edge_ratio = ratio;
  return target_edge_lengths(mesh, TubeFunction(tree_of(shape)), options);
}

/// Largest distance of points of a from b.
double one_sided(const geometry::TriMesh& a, const geometry::TriMesh& b) {
  const geometry::AabbTree tree(b);
  double largest = 0.0;
  for (const Vec3& p : a.points) largest = std::max(largest, tree.closest(p).distance);
  return largest;
}

void expect_good(const RemeshedSurface& result, const geometry::FacedSurface& input) {
  const SurfaceQuality quality = surface_quality(result.surface.mesh);
  EXPECT_TRUE(check(quality).ok()) << check(quality).summary();
  EXPECT_GE(quality.min_angle_deg, 20.0);
  EXPECT_LT(quality.mean_frobenius_aspect, 1.06);
  EXPECT_NEAR(result.report.mean_edge_ratio, 1.0, 0.08);
  EXPECT_LT(result.report.edge_ratio_deviation, 0.15);
  EXPECT_TRUE(result.report.warnings.empty());
  ASSERT_EQ(result.surface.faces.size(), input.faces.size());
  EXPECT_EQ(result.surface.face_ids.size(), result.surface.mesh.triangles.size());
  EXPECT_LT(one_sided(result.surface.mesh, input.mesh), 1e-6);
  // Caps lie in the planes they had, with the areas they had but for the coarser ring.
  for (const geometry::Face& face : input.faces) {
    auto vector_area = [&](const geometry::FacedSurface& s, Vec3& on) {
      Vec3 sum = Vec3::Zero();
      for (std::size_t i = 0; i < s.face_ids.size(); ++i) {
        if (s.face_ids[i] != face.id) continue;
        const auto& t = s.mesh.triangles[i];
        on = s.mesh.points[static_cast<std::size_t>(t[0])];
        sum += 0.5 * (s.mesh.points[static_cast<std::size_t>(t[1])] - on)
                         .cross(s.mesh.points[static_cast<std::size_t>(t[2])] - on);
      }
      return sum;
    };
    if (face.kind == geometry::FaceKind::wall) continue;
    Vec3 before_on, after_on;
    const Vec3 before = vector_area(input, before_on), after = vector_area(result.surface, after_on);
    EXPECT_GT(before.normalized().dot(after.normalized()), 1.0 - 1e-12) << face.name;
    EXPECT_NEAR((after_on - before_on).dot(before.normalized()), 0.0, 1e-9);
    EXPECT_NEAR(after.norm(), before.norm(), 0.06 * before.norm());
    for (std::size_t i = 0; i < result.surface.face_ids.size(); ++i)
      for (const std::int32_t v : result.surface.mesh.triangles[i]) {
        const double off =
            (result.surface.mesh.points[static_cast<std::size_t>(v)] - before_on).dot(before.normalized());
        EXPECT_TRUE(result.surface.face_ids[i] != face.id || std::abs(off) < 1e-9);
      }
  }
}

TEST(Remesh, OfATubeMeetsTheSizeAndTheBars) {
  const auto shape = geometry::straight_tube(12.0, 1.5);
  const auto input = capped_tube();
  for (const double ratio : {0.15, 0.4}) {
    const auto result = remesh(input, sizes(input.mesh, shape, ratio));
    expect_good(result, input);
    // Equation 9: as many triangles as the area holds of the target size (the caps follow their rings).
    const double wall =
        2.0 * std::numbers::pi * 1.5 * 12.0 / (std::sqrt(3.0) / 4.0 * std::pow(ratio * 1.5, 2));
    const auto on_wall =
        static_cast<double>(std::count(result.surface.face_ids.begin(), result.surface.face_ids.end(), 1));
    EXPECT_NEAR(on_wall, wall, 0.12 * wall);
  }
}

TEST(Remesh, ACoarserRingLosesTheVolumeOfItsChordsAndNoMore) {
  const auto shape = geometry::straight_tube(12.0, 1.5);
  const auto input = capped_tube();
  const double truth = std::numbers::pi * 2.25 * 12.0;
  EXPECT_NEAR(geometry::volume(remesh(input, sizes(input.mesh, shape, 0.15)).surface.mesh), truth,
              0.01 * truth);
  EXPECT_NEAR(geometry::volume(remesh(input, sizes(input.mesh, shape, 0.15)).surface.mesh),
              geometry::volume(input.mesh), 0.005 * truth);
  EXPECT_NEAR(geometry::volume(remesh(input, sizes(input.mesh, shape, 0.4)).surface.mesh), truth,
              0.035 * truth);
}

TEST(Remesh, CopesWithMarchingCubesNeedlesOnATree) {
  const auto shape = geometry::coronary_like_tree();
  const auto input = capped(shape, 0.35, true);
  ASSERT_LT(surface_quality(input.mesh, false).min_angle_deg, 2.0);  // there are needles
  const auto result = remesh(input, sizes(input.mesh, shape, 0.3));
  expect_good(result, input);
  EXPECT_NEAR(geometry::volume(result.surface.mesh), geometry::volume(input.mesh),
              0.02 * geometry::volume(input.mesh));
  EXPECT_LT(one_sided(input.mesh, result.surface.mesh), 0.5);  // corners cut off the creases at junctions
}

TEST(Remesh, OfAStenosisFollowsItsRadius) {
  const auto shape = geometry::stenosed_tube(20.0, 1.5, 0.7, 10.0, 8.0);
  const auto input = capped(shape, 0.2, false);
  const auto result = remesh(input, sizes(input.mesh, shape, 0.35));
  expect_good(result, input);
  double at_throat = 0.0, count = 0.0;
  for (const auto& t : result.surface.mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = result.surface.mesh.points[static_cast<std::size_t>(t[i])],
                 &b = result.surface.mesh.points[static_cast<std::size_t>(t[(i + 1) % 3])];
      if (std::abs(0.5 * (a + b).z() - 10.0) > 0.6) continue;
      at_throat += (b - a).norm();
      count += 1.0;
    }
  EXPECT_NEAR(at_throat / count, 0.35 * 0.45, 0.04);
}

TEST(Remesh, OfAnOpenSurfaceKeepsItsRings) {
  const auto shape = geometry::y_junction(10.0, 10.0, 2.0, 1.5, 70.0);
  const auto input = geometry::surface_of(shape, 0.3, true);
  const auto result = remesh(input, sizes(input, shape, 0.3));
  EXPECT_EQ(geometry::boundary_loops(result.mesh).size(), 3u);
  EXPECT_LT(one_sided(result.mesh, input), 1e-6);
  EXPECT_GE(result.report.min_angle_deg, 20.0);
  EXPECT_EQ(result.report.self_intersections, 0u);
  // Every ring point lies on the input's ring.
  std::vector<std::vector<Vec3>> rings;
  for (const auto& loop : geometry::boundary_loops(input)) {
    rings.emplace_back();
    for (const std::int32_t v : loop) rings.back().push_back(input.points[static_cast<std::size_t>(v)]);
  }
  for (const auto& loop : geometry::boundary_loops(result.mesh))
    for (const std::int32_t v : loop) {
      double nearest = 1e300;
      for (const auto& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const Vec3 &a = ring[i], edge = ring[(i + 1) % ring.size()] - a,
                     p = result.mesh.points[static_cast<std::size_t>(v)];
          nearest = std::min(
              nearest, (p - a - std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0) * edge).norm());
        }
      EXPECT_LT(nearest, 1e-9);
    }
}

TEST(Remesh, OfAClosedSurfaceWithoutCaps) {
  const auto shape = geometry::torus(5.0, 1.5);
  const auto input = geometry::raw_surface_of(shape, 0.3, false);
  const auto result = remesh(input, std::vector<double>(input.points.size(), 0.4));
  EXPECT_TRUE(geometry::find_faults(result.mesh, true).closed_manifold());
  EXPECT_GE(result.report.min_angle_deg, 20.0);
  EXPECT_NEAR(geometry::volume(result.mesh), geometry::volume(input), 0.02 * geometry::volume(input));
}

TEST(Remesh, IsTheSameForAnyNumberOfThreads) {
  const auto shape = geometry::straight_tube(12.0, 1.5);
  const auto input = capped_tube();
  const auto lengths = sizes(input.mesh, shape, 0.25);
  core::set_max_threads(1);
  const auto one = remesh(input, lengths).surface.mesh;
  core::set_max_threads(0);
  const auto many = remesh(input, lengths).surface.mesh;
  EXPECT_EQ(one.triangles, many.triangles);
  EXPECT_EQ(one.points, many.points);
}

TEST(Remesh, RefusesWhatItCannotWorkOn) {
  const auto input = capped_tube();
  const std::vector<double> good(input.mesh.points.size(), 0.4);
  EXPECT_THROW(remesh(input, {}), InvalidInput);
  auto zero = good;
  zero[3] = 0.0;
  EXPECT_THROW(remesh(input, zero), InvalidInput);
  RemeshOptions bad;
  bad.iterations = 0;
  EXPECT_THROW(remesh(input, good, bad), InvalidInput);
  EXPECT_THROW(remesh(geometry::TriMesh{}, {}), InvalidInput);
  auto unknown = input;
  unknown.face_ids[0] = 77;
  EXPECT_THROW(remesh(unknown, good), InvalidInput);
  auto holed = input;
  holed.mesh.triangles.pop_back();
  holed.face_ids.pop_back();
  EXPECT_THROW(remesh(holed, good), GeometryError);
  auto dented = input;  // an inner point of a cap pushed in
  dented.mesh.points.back() += Vec3(0.0, 0.0, -0.8);
  EXPECT_THROW(remesh(dented, good), GeometryError);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(remesh(input, good, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
