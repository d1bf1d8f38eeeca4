#include "vertex_clustering.h"

#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <numbers>

namespace ostia::motion {
namespace {

using geometry::TriMesh;

TriMesh dense_tube() {
  return geometry::structured_surface(geometry::straight_tube(40.0, 2.0).tubes[0], 120, 0.1);
}

TEST(Thinned, KeepsAboutAsManyPointsAsAskedAllOnTheSurface) {
  const TriMesh tube = dense_tube(), thin = clustered(tube, 2000);
  EXPECT_GT(thin.points.size(), 1000U);
  EXPECT_LT(thin.points.size(), 4000U);
  const geometry::AabbTree tree(tube);
  for (const auto& p : thin.points) EXPECT_LT(tree.closest(p).distance, 1e-12);
  EXPECT_NEAR(geometry::area(thin) / geometry::area(tube), 1.0, 0.05);
}

TEST(Thinned, LooksOutwardAsTheSurfaceDoes) {
  const TriMesh thin = clustered(dense_tube(), 2000);
  double outward = 0.0, all = 0.0;
  for (const auto& t : thin.triangles) {
    const auto p = [&](std::size_t k) { return thin.points[static_cast<std::size_t>(t[k])]; };
    const geometry::Vec3 normal = (p(1) - p(0)).cross(p(2) - p(0)), middle = (p(0) + p(1) + p(2)) / 3.0;
    const geometry::Vec3 out(middle.x(), middle.y(), 0.0);
    outward += normal.dot(out) > 0.0 ? normal.norm() : 0.0;
    all += normal.norm();
  }
  EXPECT_GT(outward, 0.97 * all);
}

TEST(Thinned, ASmallSurfaceStaysAsItIs) {
  const TriMesh tube = dense_tube();
  const TriMesh same = clustered(tube, tube.points.size());
  EXPECT_EQ(same.points.size(), tube.points.size());
  EXPECT_EQ(same.triangles, tube.triangles);
}

}  // namespace
}  // namespace ostia::motion
