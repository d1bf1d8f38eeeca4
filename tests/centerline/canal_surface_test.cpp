#include "ostia/centerline/canal_surface.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <numbers>

namespace ostia::centerline {
namespace {

using geometry::Centerline;

Centerline line_along_z(double length, double radius) {
  Centerline line;
  for (int i = 0; i <= 20; ++i) {
    line.points.emplace_back(0.0, 0.0, length * i / 20.0);
    line.radius.push_back(radius);
  }
  geometry::complete(line);
  return line;
}

TEST(CanalSurface, of_a_straight_line_is_a_capsule) {
  const geometry::TriMesh mesh = canal_surface({line_along_z(6.0, 1.0)}, 0.1);
  const double exact = std::numbers::pi * 6.0 + 4.0 / 3.0 * std::numbers::pi;
  EXPECT_NEAR(geometry::volume(mesh), exact, 0.01 * exact);
  EXPECT_TRUE(geometry::find_faults(mesh, false).closed_manifold());
}

TEST(CanalSurface, refuses_what_has_no_envelope) {
  EXPECT_THROW(canal_surface(std::vector<Centerline>{}, 0.1), InvalidInput);
  EXPECT_THROW(canal_surface({line_along_z(6.0, 1.0)}, 0.0), InvalidInput);
  Centerline bare = line_along_z(6.0, 1.0);
  bare.radius.clear();
  EXPECT_THROW(canal_surface({bare}, 0.1), InvalidInput);
}

}  // namespace
}  // namespace ostia::centerline
