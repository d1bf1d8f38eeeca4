#include "ostia/meshing/caps.h"

#include "test_surfaces.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/quality.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

TEST(Caps, AreFlatOutwardAndAsLargeAsTheSection) {
  const auto shape = geometry::tapered_tube(20.0, 2.0, 1.0);
  const auto clipped = clip_ends(geometry::surface_of(shape, 0.15, true), tree_of(shape));
  const geometry::FacedSurface surface = cap_ends(clipped);
  EXPECT_TRUE(geometry::find_faults(surface.mesh, true).closed_manifold());
  ASSERT_EQ(surface.faces.size(), 3u);
  EXPECT_EQ(surface.faces[0].name, "wall");
  EXPECT_EQ(surface.faces[1].name, "inlet_tube");
  EXPECT_EQ(surface.faces[1].id, 2);
  EXPECT_EQ(surface.faces[2].name, "outlet_tube");
  EXPECT_EQ(surface.faces[2].id, 3);
  std::map<std::int32_t, Vec3> vector_area;
  double cap_min_angle = 180.0;
  for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i) {
    const auto& t = surface.mesh.triangles[i];
    const Vec3 &a = surface.mesh.points[static_cast<std::size_t>(t[0])],
               &b = surface.mesh.points[static_cast<std::size_t>(t[1])],
               &c = surface.mesh.points[static_cast<std::size_t>(t[2])];
    vector_area.try_emplace(surface.face_ids[i], Vec3::Zero()).first->second += 0.5 * (b - a).cross(c - a);
    for (const Vec3& p : {a, b, c}) EXPECT_TRUE(surface.face_ids[i] != 2 || std::abs(p.z()) < 1e-9);
    if (surface.face_ids[i] > 1) cap_min_angle = std::min(cap_min_angle, min_angle_deg(a, b, c));
  }
  EXPECT_NEAR(vector_area[2].z(), -std::numbers::pi * 4.0, 0.01 * std::numbers::pi * 4.0);
  EXPECT_NEAR(vector_area[3].z(), std::numbers::pi, 0.015 * std::numbers::pi);
  EXPECT_GT(cap_min_angle, 3.0);  // the marching cubes' short ring edges bound it
  EXPECT_NEAR(geometry::volume(surface.mesh), std::numbers::pi * 20.0 / 3.0 * (4.0 + 2.0 + 1.0), 1.5);
}

TEST(Caps, KeepThePointsOfTheWall) {
  const auto shape = geometry::y_junction(12.0, 12.0, 2.0, 1.5, 70.0);
  const auto clipped = clip_ends(geometry::raw_surface_of(shape, 0.3, false), tree_of(shape));
  const auto surface = cap_ends(clipped);
  EXPECT_TRUE(geometry::find_faults(surface.mesh, true).closed_manifold());
  EXPECT_TRUE(
      std::equal(clipped.mesh.points.begin(), clipped.mesh.points.end(), surface.mesh.points.begin()));
  EXPECT_EQ(surface.faces.size(), 4u);
}

TEST(Caps, RefuseBadOptionsAndObeyCancel) {
  const auto shape = geometry::straight_tube(8.0, 1.0);
  const auto clipped = clip_ends(geometry::surface_of(shape, 0.3, true), tree_of(shape));
  EXPECT_THROW(cap_ends(clipped, {.edge_factor = 0.0}), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(cap_ends(clipped, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
