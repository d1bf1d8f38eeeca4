#include "ostia/pipeline/repair.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

TEST(Repair, SaysWhenNothingIsLeft) {
  EXPECT_THROW(repaired(TriMesh{{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}}), GeometryError);
}

}  // namespace
}  // namespace ostia::pipeline
