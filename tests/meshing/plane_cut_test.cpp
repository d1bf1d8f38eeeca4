#include "cutting/plane_cut.h"

#include "test_surfaces.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

EndPlane plane_at(double z) {
  return {"v", geometry::FaceKind::outlet, 0, {0, 0, z}, {0, 0, 1}, 1.5};
}

TEST(PlaneCut, ThroughRingsOfPointsMovesTheHairThatItNeeds) {
  // A structured tube has whole rings of points on the plane.
  const auto shape = geometry::straight_tube(10.0, 1.5);
  const auto tube = geometry::structured_surface(shape.tubes[0], 24, 0.5);
  EndPlane plane = plane_at(8.0);
  const auto cut = cut_branch(tube, plane, {0, 0, 10}, {}, "the end");
  EXPECT_NEAR(plane.origin.z(), 8.0, 0.015);
  const auto loops = geometry::boundary_loops(cut);
  ASSERT_EQ(loops.size(), 2u);
  double highest = 0.0;
  for (const Vec3& p : cut.points) highest = std::max(highest, p.z());
  EXPECT_NEAR(highest, plane.origin.z(), 1e-9);
}

TEST(PlaneCut, LeavesAParallelVesselAlone) {
  const auto shape = geometry::straight_tube(10.0, 1.5);
  const auto one = geometry::surface_of(shape, 0.3, false);
  auto other = one;
  for (Vec3& p : other.points) p.x() += 3.2;
  EndPlane plane = plane_at(8.0);
  const auto cut = cut_branch(geometry::merged(one, other), plane, {0, 0, 10}, {}, "the end");
  double left = 0.0, right = 0.0;
  for (const Vec3& p : cut.points) (p.x() < 1.6 ? left : right) = std::max(p.x() < 1.6 ? left : right, p.z());
  EXPECT_NEAR(left, plane.origin.z(), 1e-9);
  EXPECT_NEAR(right, 11.5, 0.05);
}

TEST(PlaneCut, RefusesALoopOfTheVesselAroundThePlane) {
  // A ring has no end: beyond the plane one comes back to the other side.
  const auto shape = geometry::torus(6.0, 1.2);
  const auto ring = geometry::surface_of(shape, 0.3, false);
  EndPlane plane{"v", geometry::FaceKind::outlet, 0, {6, 0, 0}, {0, 1, 0}, 1.2};
  ClipOptions options;
  options.reach_radii = 100.0;
  EXPECT_THROW(cut_branch(ring, plane, {6, 1, 0}, options, "the end"), GeometryError);
}

}  // namespace
}  // namespace ostia::meshing
