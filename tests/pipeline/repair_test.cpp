#include "ostia/pipeline/repair.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

TriMesh tube() {
  return geometry::surface_of(geometry::straight_tube(12.0, 2.0), 0.5, true);
}

void expect_sound(const TriMesh& mesh) {
  geometry::SurfaceFaults faults = geometry::find_faults(mesh, true);
  EXPECT_EQ(geometry::boundary_loops(mesh).size(), 2u);
  faults.open_edges = 0;
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.components, 1u);
}

TEST(Repair, LeavesASoundSurfaceAlone) {
  const Repaired out = repaired(tube());
  EXPECT_TRUE(out.done.empty());
  EXPECT_EQ(out.mesh.triangles.size(), tube().triangles.size());
  EXPECT_EQ(out.left, "none");
}

TEST(Repair, DropsWhatIsNoSurface) {
  TriMesh bad = tube();
  const auto n = static_cast<std::int32_t>(bad.points.size());
  bad.points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  bad.points.emplace_back(30, 0, 0);
  bad.points.emplace_back(31, 0, 0);
  bad.points.emplace_back(30, 1, 0);
  bad.triangles.push_back({0, 1, n});
  bad.triangles.push_back({n + 1, n + 2, n + 3});
  bad.triangles.push_back(bad.triangles.front());
  bad.triangles.push_back({3, 3, 4});
  const Repaired out = repaired(bad);
  expect_sound(out.mesh);
  EXPECT_GE(out.done.size(), 3u);
  EXPECT_EQ(out.mesh.triangles.size(), tube().triangles.size());
}

TEST(Repair, CutsAFoldOut) {
  TriMesh bad = tube();
  for (std::size_t p = 0; p < bad.points.size(); ++p) {
    // One point in the middle of the wall pushed through the opposite wall.
    if (std::abs(bad.points[p].z() - 6.0) < 0.3 && bad.points[p].x() > 1.9) {
      bad.points[p].x() = -2.5;
      break;
    }
  }
  ASSERT_FALSE(geometry::self_intersections(bad).empty());
  const Repaired out = repaired(bad);
  expect_sound(out.mesh);
  EXPECT_NEAR(geometry::area(out.mesh), geometry::area(tube()), 0.03 * geometry::area(tube()));
}

std::size_t count_of(const Repaired& out, const std::string& what) {
  for (const RepairStep& step : out.steps)
    if (step.what == what) return step.count;
  return 0;
}

TEST(Repair, CountsWhatItDid) {
  TriMesh bad = tube();
  const auto n = static_cast<std::int32_t>(bad.points.size());
  bad.points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  bad.points.push_back(
      bad.points[static_cast<std::size_t>(bad.triangles[7][0])]);  // a crack along a triangle's corner
  bad.points.emplace_back(30, 0, 0);
  bad.points.emplace_back(31, 0, 0);
  bad.points.emplace_back(30, 1, 0);
  bad.triangles[7][0] = n + 1;
  std::swap(bad.triangles[40][0], bad.triangles[40][1]);
  std::swap(bad.triangles[80][0], bad.triangles[80][1]);
  bad.triangles.push_back({0, 1, n});
  bad.triangles.push_back({0, 2, n});
  bad.triangles.push_back({n + 2, n + 3, n + 4});
  bad.triangles.push_back(bad.triangles[3]);
  bad.triangles.push_back({3, 3, 4});
  const Repaired out = repaired(bad);
  expect_sound(out.mesh);
  EXPECT_EQ(count_of(out, "not_finite_triangles_dropped"), 2u);
  EXPECT_EQ(count_of(out, "equal_points_joined"), 1u);
  EXPECT_EQ(count_of(out, "degenerate_triangles_dropped"), 1u);
  EXPECT_EQ(count_of(out, "duplicate_triangles_dropped"), 1u);
  EXPECT_EQ(count_of(out, "triangles_turned"), 2u);
  EXPECT_EQ(count_of(out, "specks_dropped"), 1u);
  EXPECT_EQ(out.steps.size(), 6u);
  EXPECT_EQ(out.left, "none");
  ASSERT_EQ(out.done.size(), out.steps.size());
  EXPECT_EQ(out.done[0], "triangles with points that are not finite dropped: 2");
}

TEST(Repair, TurnsAnInwardTubeOutward) {
  TriMesh inward = tube();
  for (geometry::Triangle& t : inward.triangles) std::swap(t[1], t[2]);
  const Repaired out = repaired(inward);
  EXPECT_EQ(count_of(out, "triangles_turned_outward"), inward.triangles.size());
  EXPECT_GT(geometry::volume(geometry::fill_holes(out.mesh).mesh), 0.0);
}

TEST(Repair, TakesApartWhatOnlyTouches) {
  const TriMesh one = tube();
  TriMesh other = one;
  // Side by side, with what lies farthest out in common.
  std::size_t touching = 0;
  for (std::size_t p = 0; p < one.points.size(); ++p)
    if (one.points[p].x() > one.points[touching].x()) touching = p;
  for (Vec3& p : other.points) p = Vec3(2.0 * one.points[touching].x() - p.x(), p.y(), p.z());
  for (geometry::Triangle& t : other.triangles) std::swap(t[1], t[2]);
  const TriMesh both = geometry::welded(geometry::merged(one, other), 1e-9);
  const geometry::SurfaceFaults faults = geometry::find_faults(both, false);
  ASSERT_GT(faults.non_manifold_vertices + faults.non_manifold_edges, 0u);
  const Repaired out = repaired(both);
  EXPECT_GE(count_of(out, "points_split"), 1u);
  EXPECT_EQ(geometry::find_faults(out.mesh, false).components, 2u);
  EXPECT_EQ(out.left, "none");
  RepairOptions options;
  options.parts = KeptParts::largest;
  expect_sound(repaired(both, options).mesh);
}

TEST(Repair, FillsHolesUpToTheWidthAsked) {
  TriMesh holed = tube();
  const Vec3 middle(2.0, 0.0, 6.0);
  std::erase_if(holed.triangles, [&](const geometry::Triangle& t) {
    return (holed.points[static_cast<std::size_t>(t[0])] - middle).norm() < 0.8;
  });
  const auto loops = [](const TriMesh& mesh) { return geometry::boundary_loops(mesh).size(); };
  EXPECT_EQ(loops(repaired(holed).mesh), 3u);
  RepairOptions options;
  options.fill_holes_up_to_mm = 3.0;
  const Repaired out = repaired(holed, options);
  expect_sound(out.mesh);
  EXPECT_EQ(count_of(out, "holes_filled"), 1u);
  options.fill_holes_up_to_mm = 4.1;  // the ends are 4 mm wide
  EXPECT_EQ(count_of(repaired(holed, options), "holes_filled"), 3u);
  EXPECT_EQ(loops(repaired(holed, options).mesh), 0u);
  options.fill_holes_up_to_mm = -1.0;
  EXPECT_THROW(repaired(holed, options), InvalidInput);
}

TEST(Repair, SaysWhenNothingIsLeft) {
  EXPECT_THROW(repaired(TriMesh{{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}}), GeometryError);
}

}  // namespace
}  // namespace ostia::pipeline
