#include "ostia/glview/shown_surface.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/glview/sample_motion.h"
#include "ostia/glview/surface_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::glview {
namespace {

using geometry::TriMesh;

/// A tube along z, in a cage that goes by a linear map.
struct Tube {
  TriMesh mesh = geometry::structured_surface(geometry::straight_tube(30.0, 2.0).tubes[0], 24, 0.8);
  geometry::CageMotion motion;
  Eigen::Matrix3d map = Eigen::Vector3d(0.9, 1.0, 1.2).asDiagonal();

  Tube() {
    motion.grid = geometry::cage_around(mesh.points, 2);
    motion.template_phase = 0.0;
    const auto rest = geometry::rest_points(motion.grid);
    for (const double amount : {0.0, 1.0, 0.5}) {
      geometry::CagePhase phase;
      phase.phase = static_cast<double>(motion.phases.size()) / 3.0;
      for (const Vec3& p : rest) phase.control_points.push_back(p + amount * (map * p - p));
      motion.phases.push_back(phase);
    }
  }
};

TEST(ShownSurface, KnowsTheWayAlongATube) {
  const Tube tube;
  const ShownSurface shown = shown_surface(tube.mesh, tube.motion.grid);
  ASSERT_EQ(shown.vertices.size(), tube.mesh.points.size());
  EXPECT_TRUE(shown.along.empty()) << "they are found when they are asked for";
  const std::vector<Direction> along = find_directions(shown);
  ASSERT_EQ(along.size(), shown.vertices.size());
  for (const Direction& direction : along) EXPECT_GT(std::abs(direction[2]), 0.98F);
}

TEST(ShownSurface, ClosesOpenEndsBehindTheTrianglesOfTheSurface) {
  const Tube tube;
  const ShownSurface shown = shown_surface(tube.mesh, tube.motion.grid);
  EXPECT_EQ(shown.open_triangles, tube.mesh.triangles.size());
  EXPECT_EQ(shown.triangles.size(), tube.mesh.triangles.size() + 2 * (24 - 2));
  EXPECT_TRUE(geometry::boundary_loops({tube.mesh.points, shown.triangles}).empty());
  EXPECT_TRUE(shown.closed);
  TriMesh inward = tube.mesh;
  for (auto& t : inward.triangles) std::swap(t[1], t[2]);
  const ShownSurface turned = shown_surface(inward, tube.motion.grid);
  for (std::size_t t = 0; t < shown.open_triangles; ++t)
    EXPECT_EQ(turned.triangles[t], shown.triangles[t]) << "turned outward";
  EXPECT_EQ(turned.vertices[100].normal, shown.vertices[100].normal);
}

TEST(ShownSurface, ClosesAnEndOfManyVerticesByOneVertexMore) {
  TriMesh mesh;  // one end of 600 vertices; the other a point
  constexpr int around = 600;
  for (int i = 0; i < around; ++i) {
    const double angle = 2.0 * 3.14159265358979 * i / around;
    mesh.points.emplace_back(20.0 * std::cos(angle), 20.0 * std::sin(angle), 0.0);
    mesh.triangles.push_back({i, (i + 1) % around, around});
  }
  mesh.points.emplace_back(0.0, 0.0, 15.0);
  const ShownSurface shown = shown_surface(mesh, geometry::cage_around(mesh.points, 2));
  EXPECT_TRUE(shown.closed);
  ASSERT_EQ(shown.vertices.size(), mesh.points.size() + 1);
  EXPECT_EQ(shown.triangles.size(), 2U * around);
  const ShownVertex& centre = shown.vertices.back();
  EXPECT_NEAR(centre.rest[0], 0.0, 1e-5);
  EXPECT_NEAR(centre.rest[2], 0.0, 1e-5);
  EXPECT_NEAR(centre.normal[2], -1.0, 1e-5);
  EXPECT_NEAR(find_directions(shown).back()[2], 0.0, 1e-5);
}

TEST(ShownSurface, GradientsAreThoseOfALinearMap) {
  const Tube tube;
  const ShownSurface shown = shown_surface(tube.mesh, tube.motion.grid);
  for (const auto& gradient : gradients(shown, tube.motion.phases[1].control_points))
    EXPECT_LT((gradient - tube.map).norm(), 1e-9);
}

TEST(ShownSurface, RefusesWhatCannotBeShown) {
  const Tube tube;
  EXPECT_THROW(shown_surface({}, tube.motion.grid), InvalidInput);
  TriMesh wrong = tube.mesh;
  wrong.triangles[3][1] = static_cast<std::int32_t>(wrong.points.size());
  EXPECT_THROW(shown_surface(wrong, tube.motion.grid), InvalidInput);
  wrong = tube.mesh;
  wrong.points[5].x() = std::nan("");
  EXPECT_THROW(shown_surface(wrong, tube.motion.grid), InvalidInput);
}

TEST(ShownSurface, EndsWhenItIsCancelled) {
  const Tube tube;
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(shown_surface(tube.mesh, tube.motion.grid, task), Cancelled);
  const ShownSurface shown = shown_surface(tube.mesh, tube.motion.grid);
  EXPECT_THROW(find_directions(shown, 3.0, task), Cancelled);
}

TEST(SurfaceValues, StretchAndCurvatureNeedTheDirections) {
  const Tube tube;
  const ShownSurface shown = shown_surface(tube.mesh, tube.motion.grid);
  const motion::MovingCage cage(tube.motion);
  EXPECT_THROW(values_at(shown, cage, 0.2, SurfaceValue::stretch), InvalidInput);
  EXPECT_THROW(bending_table(shown, cage), InvalidInput);
  EXPECT_GT(value_range(shown, cage, SurfaceValue::displacement).high, 0.0);
}

TEST(SurfaceValues, OfALinearStretch) {
  const Tube tube;
  ShownSurface shown = shown_surface(tube.mesh, tube.motion.grid);
  shown.along = find_directions(shown);
  const motion::MovingCage cage(tube.motion);
  const double phase = tube.motion.phases[1].phase;
  for (const double stretch : values_at(shown, cage, phase, SurfaceValue::stretch))
    EXPECT_NEAR(stretch, 20.0, 0.6);
  const auto away = values_at(shown, cage, phase, SurfaceValue::displacement);
  for (std::size_t i = 0; i < away.size(); ++i)
    EXPECT_NEAR(away[i], (tube.map * tube.mesh.points[i] - tube.mesh.points[i]).norm(), 1e-4);
  // Speeds of a cycle twice as long are half as large.
  const auto fast = values_at(shown, cage, 0.2, SurfaceValue::velocity, 0.8);
  const auto slow = values_at(shown, cage, 0.2, SurfaceValue::velocity, 1.6);
  EXPECT_GT(*std::max_element(fast.begin(), fast.end()), 1.0);
  for (std::size_t i = 0; i < fast.size(); ++i) EXPECT_NEAR(fast[i], 2.0 * slow[i], 1e-9);
  const ValueRange range = value_range(shown, cage, SurfaceValue::stretch);
  EXPECT_DOUBLE_EQ(range.low, -range.high);
  EXPECT_GE(range.high, 20.0);
}

TEST(SurfaceValues, ATubeThatIsBentGetsTheCurvatureOfItsAxis) {
  // Along z, of radius 1.5, bent to an arc of radius 30: curvature 0.33 1/cm more.
  const double bend_mm = 30.0;
  TriMesh mesh = geometry::structured_surface(geometry::straight_tube(30.0, 1.5).tubes[0], 24, 0.5);
  geometry::CageMotion motion;
  motion.grid = geometry::cage_around(mesh.points, 4);
  motion.template_phase = 0.0;
  const auto rest = geometry::rest_points(motion.grid);
  for (int k = 0; k < 4; ++k) {
    geometry::CagePhase phase;
    phase.phase = k / 4.0;
    for (const Vec3& p : rest) {
      const double angle = p.z() / bend_mm, across = bend_mm - p.x();
      phase.control_points.push_back(
          k == 2 ? Vec3(bend_mm - across * std::cos(angle), p.y(), across * std::sin(angle)) : p);
    }
    motion.phases.push_back(phase);
  }
  const motion::MovingCage cage(motion);
  ShownSurface shown = shown_surface(mesh, motion.grid);
  shown.along = find_directions(shown);
  const BendingTable table = bending_table(shown, cage, 4);
  const auto values = values_at(shown, cage, 0.5, SurfaceValue::bending, 1.0, &table);
  // At an angle t from the outer side the wall bends with cos t / (R + r cos t).
  double off = 0.0, most = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Vec3& p = mesh.points[i];
    if (p.z() < 6.0 || p.z() > 24.0) continue;
    const double expected = 10.0 * -p.x() / 1.5 / (bend_mm - p.x());
    EXPECT_NEAR(values[i], expected, 0.12);
    off += std::abs(values[i] - expected);
    most = std::max(most, values[i]);
    ++count;
  }
  ASSERT_GT(count, 500);
  EXPECT_LT(off / count, 0.04);
  EXPECT_GT(most, 0.25);
  for (const double v : values_at(shown, cage, 0.0, SurfaceValue::bending, 1.0, &table))
    EXPECT_NEAR(v, 0.0, 1e-3);
  EXPECT_THROW(values_at(shown, cage, 0.0, SurfaceValue::bending), InvalidInput);
}

TEST(SurfaceValues, ColoursAndTitles) {
  EXPECT_EQ(color(SurfaceValue::stretch, 0.5), figure::Color({240 / 255.0, 240 / 255.0, 240 / 255.0, 1.0}));
  EXPECT_LT(color(SurfaceValue::velocity, 0.0).g, 0.1);
  EXPECT_GT(color(SurfaceValue::velocity, 1.0).g, 0.85);
  for (const SurfaceValue value : all_values) EXPECT_STRNE(title(value), "");
}

}  // namespace
}  // namespace ostia::glview
