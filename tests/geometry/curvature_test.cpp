#include "ostia/geometry/curvature.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/analytic_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ostia::geometry {
namespace {

std::vector<PrincipalCurvatures> curvatures(const TriMesh& mesh, double reach_mm) {
  return principal_curvatures(mesh, std::vector<double>(mesh.points.size(), reach_mm));
}

TEST(Curvature, ATubeBendsAroundItselfAndNotAlong) {
  for (const double radius : {0.5, 2.0}) {
    const double length = 8.0 * radius;
    const TriMesh tube = structured_surface(straight_tube(length, radius).tubes.front(), 48, 0.1 * radius);
    const auto found = curvatures(tube, 0.4 * radius);
    std::size_t looked_at = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (std::abs(tube.points[i].z() - 0.5 * length) > 0.3 * length) continue;
      ++looked_at;
      EXPECT_NEAR(found[i].largest * radius, 1.0, 0.02);
      EXPECT_NEAR(found[i].other * radius, 0.0, 0.02);
    }
    EXPECT_GT(looked_at, 1000U);
  }
}

TEST(Curvature, ATorusIsASaddleInsideAndConvexOutside) {
  constexpr double ring = 4.0, radius = 1.0;
  const TriMesh mesh = surface_of(torus(ring, radius), 0.12, false);
  const auto found = curvatures(mesh, 0.4);
  double worst = 0.0, squared = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vec3& p = mesh.points[i];
    const double from_axis = p.head<2>().norm();
    const double along = (from_axis - ring) / radius / from_axis;  // of the circle around the torus' axis
    EXPECT_NEAR(found[i].largest, 1.0 / radius, 0.12) << p.transpose();
    worst = std::max(worst, std::abs(found[i].other - along));
    squared += std::pow(found[i].other - along, 2);
  }
  EXPECT_LT(worst, 0.12);
  EXPECT_LT(std::sqrt(squared / static_cast<double>(found.size())), 0.03);
}

TEST(Curvature, TurnedInsideOutItChangesSign) {
  TriMesh mesh = surface_of(torus(4.0, 1.0), 0.2, false);
  const auto outward = curvatures(mesh, 0.5);
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  const auto inward = curvatures(mesh, 0.5);
  for (std::size_t i = 0; i < outward.size(); ++i) {
    EXPECT_NEAR(inward[i].largest, -outward[i].largest, 1e-9);
    EXPECT_NEAR(inward[i].other, -outward[i].other, 1e-9);
  }
}

TEST(Curvature, NoiseIsAveragedOverTheReach) {
  TriMesh tube = structured_surface(straight_tube(12.0, 1.0).tubes.front(), 32, 0.2);
  for (std::size_t i = 0; i < tube.points.size(); ++i)
    tube.points[i].head<2>() *= 1.0 + 0.01 * std::sin(12.9898 * static_cast<double>(i * i % 1009));
  const auto spread = [&](double reach_mm) {
    double squared = 0.0;
    std::size_t count = 0;
    const auto found = curvatures(tube, reach_mm);
    for (std::size_t i = 0; i < found.size(); ++i)
      if (std::abs(tube.points[i].z() - 6.0) < 4.0) {
        squared += std::pow(found[i].largest - 1.0, 2);
        ++count;
      }
    return std::sqrt(squared / static_cast<double>(count));
  };
  EXPECT_GT(spread(0.05), 0.4);
  EXPECT_LT(spread(0.8), 0.12);
}

TEST(Curvature, IsTheSameWithOneThread) {
  const TriMesh mesh = surface_of(torus(4.0, 1.0), 0.2, false);
  const auto many = curvatures(mesh, 0.5);
  core::set_max_threads(1);
  const auto one = curvatures(mesh, 0.5);
  core::set_max_threads(0);
  for (std::size_t i = 0; i < many.size(); ++i) ASSERT_EQ(many[i].largest, one[i].largest);
}

TEST(Curvature, WithoutNeighboursItIsFlat) {
  const TriMesh lone{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, {{0, 1, 2}}};
  for (const PrincipalCurvatures& c : curvatures(lone, 1.0)) {
    EXPECT_EQ(c.largest, 0.0);
    EXPECT_EQ(c.other, 0.0);
  }
}

TEST(Curvature, RefusesReachesThatAreNone) {
  const TriMesh mesh = surface_of(torus(4.0, 1.0), 0.4, false);
  EXPECT_THROW(principal_curvatures(mesh, {1.0}), InvalidInput);
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(curvatures(mesh, bad), InvalidInput);
}

TEST(Curvature, CanBeCancelled) {
  const TriMesh mesh = surface_of(torus(4.0, 1.0), 0.2, false);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(principal_curvatures(mesh, std::vector<double>(mesh.points.size(), 0.5), task), Cancelled);
}

}  // namespace
}  // namespace ostia::geometry
