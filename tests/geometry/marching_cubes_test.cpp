#include "marching_cubes.h"

#include "surface_checks.h"

#include "ostia/geometry/cube_patterns.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::geometry {
namespace {

TEST(MarchingCubes, CrossingIsLinearAndKeptOffTheNodes) {
  EXPECT_DOUBLE_EQ(crossing_fraction(-1.0f, 3.0f, 0.0f), 0.25);
  EXPECT_DOUBLE_EQ(crossing_fraction(3.0f, -1.0f, 0.0f), 0.75);
  EXPECT_DOUBLE_EQ(crossing_fraction(-1.0f, 0.0f, 0.0f), 1.0 - node_clearance);
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_DOUBLE_EQ(crossing_fraction(-inf, inf, 5.0f), 0.5);
}

// A plane z = height that fills several chunks from below, sampled where asked.
MarchingCubes plane(double height, std::int64_t slices) {
  MarchingCubes job;
  job.size = {4, 3, slices};
  job.fill = [height](std::int64_t first, std::int64_t count, float* out) {
    for (std::int64_t i = 0; i < count * 12; ++i)
      out[i] = static_cast<float>(first + i / 12) - static_cast<float>(height);
  };
  job.place = [](const CrossedEdge& e) -> Vec3 {
    Vec3 p(static_cast<double>(e.node[0]), static_cast<double>(e.node[1]), static_cast<double>(e.node[2]));
    p[e.axis] += crossing_fraction(e.from, e.to, 0.0f);
    return p;
  };
  return job;
}

TEST(MarchingCubes, PlaneAtAnyHeightIsFoundOnceWhateverTheChunk) {
  for (const double height : {0.5, 6.5, 7.5, 8.0, 8.5, 15.5, 16.25, 18.75}) {
    const TriMesh mesh = march(plane(height, 20), core::no_task());
    EXPECT_EQ(mesh.points.size(), 12u) << height;
    EXPECT_NEAR(test::area_of(mesh), 6.0, 1e-9) << height;
    for (const Vec3& p : mesh.points) EXPECT_NEAR(p.z(), height, 2.0 * node_clearance);
    const Triangle& t = mesh.triangles.front();
    const auto at = [&](std::size_t c) { return mesh.points[static_cast<std::size_t>(t[c])]; };
    EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0)).z(), 0.0);  // towards larger values
  }
}

TEST(MarchingCubes, LeftHandedMapsTurnTriangles) {
  MarchingCubes job = plane(5.5, 20);
  job.left_handed = true;
  const TriMesh mesh = march(job, core::no_task());
  const Triangle& t = mesh.triangles.front();
  const auto at = [&](std::size_t c) { return mesh.points[static_cast<std::size_t>(t[c])]; };
  EXPECT_LT((at(1) - at(0)).cross(at(2) - at(0)).z(), 0.0);
}

TEST(MarchingCubes, FlatGridsHaveNoCubes) {
  EXPECT_TRUE(march(plane(0.5, 1), core::no_task()).points.empty());
}

}  // namespace
}  // namespace ostia::geometry
