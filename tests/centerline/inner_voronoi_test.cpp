#include "ostia/centerline/inner_voronoi.h"

#include "support/shapes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/kd_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::centerline {
namespace {

using geometry::Vec3;

TEST(InnerVoronoi, of_a_capsule_lies_inside_and_holds_no_surface_point) {
  const geometry::TriMesh mesh = testing::capsule(8.0, 1.0, 0.2);
  const InnerVoronoi diagram = inner_voronoi(mesh);
  const geometry::AabbTree tree(mesh);
  const geometry::KdTree cloud(mesh.points);
  ASSERT_GT(diagram.points.size(), 1000u);
  for (std::size_t i = 0; i < diagram.points.size(); ++i) {
    EXPECT_TRUE(tree.inside(diagram.points[i])) << diagram.points[i].transpose();
    const auto near = static_cast<std::size_t>(cloud.nearest(diagram.points[i]));
    EXPECT_NEAR((mesh.points[near] - diagram.points[i]).norm(), diagram.radius[i], 1e-4);
    EXPECT_LT(diagram.radius[i], 1.02);
  }
}

TEST(InnerVoronoi, polygons_are_plane_and_convex) {
  const InnerVoronoi diagram =
      inner_voronoi(geometry::surface_of(geometry::helix_tube(5, 8, 0.3, 1.0), 0.3, false));
  std::size_t checked = 0;
  for (std::size_t p = 0; p < diagram.polygon_count(); ++p) {
    std::vector<Vec3> corners;
    for (std::int32_t k = diagram.polygon_first[p]; k < diagram.polygon_first[p + 1]; ++k)
      corners.push_back(
          diagram.points[static_cast<std::size_t>(diagram.corners[static_cast<std::size_t>(k)])]);
    ASSERT_GE(corners.size(), 3u);
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = 0; k < corners.size(); ++k)
      normal += (corners[k] - corners[0]).cross(corners[(k + 1) % corners.size()] - corners[0]);
    if (normal.norm() < 1e-3) continue;  // too small to measure
    normal.normalize();
    ++checked;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 a = corners[(k + 1) % corners.size()] - corners[k];
      const Vec3 b = corners[(k + 2) % corners.size()] - corners[(k + 1) % corners.size()];
      EXPECT_NEAR((corners[k] - corners[0]).dot(normal), 0.0, 1e-6);
      EXPECT_GE(a.cross(b).dot(normal), -1e-6);
    }
  }
  EXPECT_GT(checked, 100u);
}

TEST(InnerVoronoi, incidence_and_links_are_mutual) {
  const InnerVoronoi diagram = inner_voronoi(testing::capsule(4.0, 1.0, 0.3));
  for (std::size_t i = 0; i < diagram.points.size(); ++i) {
    for (const std::int32_t n : diagram.links[i]) {
      if (n < 0) continue;
      const auto& back = diagram.links[static_cast<std::size_t>(n)];
      EXPECT_NE(std::find(back.begin(), back.end(), static_cast<std::int32_t>(i)), back.end());
    }
    for (std::int32_t k = diagram.incidence_first[i]; k < diagram.incidence_first[i + 1]; ++k) {
      const auto p = static_cast<std::size_t>(diagram.incidence[static_cast<std::size_t>(k)]);
      const auto first = diagram.corners.begin() + diagram.polygon_first[p];
      const auto last = diagram.corners.begin() + diagram.polygon_first[p + 1];
      EXPECT_NE(std::find(first, last, static_cast<std::int32_t>(i)), last);
    }
  }
}

TEST(InnerVoronoi, of_a_structured_tube_with_cospherical_rings_follows_the_axis) {
  const geometry::AnalyticShape shape = geometry::straight_tube(10, 1.0);
  const geometry::TriMesh mesh = geometry::surface_of(shape, 0.25, false);
  const InnerVoronoi diagram = inner_voronoi(mesh);
  for (double z = 1.0; z < 9.0; z += 0.5) {
    double nearest = 1e9;
    for (const Vec3& p : diagram.points) nearest = std::min(nearest, (p - Vec3(0, 0, z)).norm());
    EXPECT_LT(nearest, 0.2) << z;
  }
}

TEST(InnerVoronoi, refuses_an_inverted_surface) {
  geometry::TriMesh mesh = testing::capsule(4.0, 1.0, 0.4);
  for (geometry::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  EXPECT_THROW(inner_voronoi(mesh), GeometryError);
}

}  // namespace
}  // namespace ostia::centerline
