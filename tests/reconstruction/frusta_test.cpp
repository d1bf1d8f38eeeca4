#include "ostia/reconstruction/frusta.h"

#include "test_graphs.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace ostia;
using namespace ostia::reconstruction;
using namespace ostia::reconstruction::testing;

TEST(BSplineAxis, KeepsItsEndsAndStraightLines) {
  const auto curve = b_spline_axis({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, 2);
  ASSERT_EQ(curve.size(), 7u);
  for (std::size_t i = 0; i < curve.size(); ++i)
    EXPECT_LT((curve[i] - Vec3(0.5 * static_cast<double>(i), 0, 0)).norm(), 1e-12);
}

TEST(BSplineAxis, TakesTheStepsOutOfAStaircase) {
  const auto curve = b_spline_axis({{0, 0, 0}, {1, 0.3, 0}, {2, -0.3, 0}, {3, 0.3, 0}, {4, 0, 0}}, 1);
  EXPECT_NEAR(curve[2].y(), (0.3 - 4.0 * 0.3 + 0.3) / 6.0, 1e-12);
  EXPECT_EQ(curve.back(), Vec3(4, 0, 0));
}

TEST(Frusta, OfAStraightVesselAreItsCylinder) {
  const FrustaMesh made = frusta(tube(10.0, 2.0, 5));
  for (std::size_t i = 0; i < made.mesh.points.size(); ++i) {
    const Vec3& p = made.mesh.points[i];
    EXPECT_NEAR(std::hypot(p.y(), p.z()), 2.0, 1e-12);
    EXPECT_LT((made.normals[i] - Vec3(0.0, 0.5 * p.y(), 0.5 * p.z())).norm(), 1e-12);
    EXPECT_NEAR(made.texture[i].x(), p.x(), 1e-12);
    EXPECT_GE(made.texture[i].y(), 0.0);
    EXPECT_LE(made.texture[i].y(), 1.0);
  }
  EXPECT_EQ(made.mesh.triangles.size(), 5u * 12u * 2u);
  EXPECT_EQ(made.edge_of_triangle.front(), 0);
  EXPECT_EQ(made.edge_of_triangle.back(), 4);
}

TEST(Frusta, TurnOutward) {
  const FrustaMesh made = frusta(tube(10.0, 2.0));
  const auto& t = made.mesh.triangles.front();
  const auto p = [&](std::size_t k) { return made.mesh.points[static_cast<std::size_t>(t[k])]; };
  const Vec3 normal = (p(1) - p(0)).cross(p(2) - p(0));
  EXPECT_GT(normal.dot(made.normals[static_cast<std::size_t>(t[0])]), 0.0);
}

TEST(Frusta, ShareTheCircleInTheBisectingPlane) {
  VesselGraph graph;
  graph.points = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}};
  graph.edges = {{0, 1, 1.0, 1.0}, {1, 2, 1.0, 1.0}};
  FrustaOptions options;
  options.smooth = false;
  const FrustaMesh made = frusta(graph, options);
  const Vec3 plane = Vec3(1, 1, 0).normalized();
  for (int k = 0; k <= options.sides; ++k) {
    const Vec3 p = made.mesh.points[static_cast<std::size_t>(options.sides + 1 + k)] - graph.points[1];
    EXPECT_NEAR(p.dot(plane), 0.0, 1e-12);
    EXPECT_NEAR(std::hypot(p.y(), p.z()), 1.0, 1e-9);  // on the first cylinder
    EXPECT_NEAR(std::hypot(p.x(), p.z()), 1.0, 1e-9);  // and on the second
  }
}

TEST(Frusta, StayWithinBoundsWhereAJointTurnsBack) {
  VesselGraph graph;
  graph.points = {{0, 0, 0}, {10, 0, 0}, {0, 0.5, 0}};
  graph.edges = {{0, 1, 1.0, 1.0}, {1, 2, 1.0, 1.0}};
  FrustaOptions options;
  options.smooth = false;
  for (const Vec3& p : frusta(graph, options).mesh.points) {
    EXPECT_TRUE(p.allFinite());
    EXPECT_LT(p.x(), 12.5);
  }
  EXPECT_EQ(frusta(graph, options).mesh.points.size(), 3u * 13u);
}

TEST(Frusta, RefuseBadOptionsAndNetworks) {
  FrustaOptions options;
  options.sides = 2;
  EXPECT_THROW(frusta(tube(1.0, 1.0), options), InvalidInput);
  auto graph = tube(1.0, 1.0);
  graph.edges[0].radius_from = -1.0;
  EXPECT_THROW(frusta(graph), InvalidInput);
}

}  // namespace
