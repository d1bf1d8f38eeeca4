// The wall of flow extensions as a face of its own.

#include "extension_shapes.h"

#include "ostia/geometry/faces.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/caps.h"
#include "ostia/meshing/flow_extension.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"
#include "ostia/meshing/tetrahedralize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

double area_of(const std::vector<Vec3>& points, const geometry::Triangle& t) {
  const auto p = [&](std::size_t i) { return points[static_cast<std::size_t>(t[i])]; };
  return 0.5 * (p(1) - p(0)).cross(p(2) - p(0)).norm();
}

double height_of(const std::vector<Vec3>& points, const geometry::Triangle& t) {
  double z = 0.0;
  for (const std::int32_t v : t) z += points[static_cast<std::size_t>(v)].z() / 3.0;
  return z;
}

TEST(ExtensionWalls, AreAFaceOfTheirOwnOfSurfaceAndMesh) {
  constexpr double radius = 1.5, length = 12.0, edge = 0.45;
  const OpenTube tube = tube_of_section(circle, 32, length, radius);
  const ClippedSurface clipped = clip_ends(tube.mesh, tube.tree);
  FlowExtensionOptions options;
  options.inlet_diameters = 2.0;
  options.outlet_diameters = 1.0;
  const ExtendedEnds extended = extend_ends(clipped, tube.tree, options);
  const geometry::FacedSurface capped = cap_ends(extended.surface);
  geometry::FacedSurface surface =
      remesh(capped, std::vector<double>(capped.mesh.points.size(), edge)).surface;
  geometry::MixedMesh mesh = geometry::mixed(tetrahedralize(surface).mesh);
  mark_extension_walls(clipped, extended.surface.mesh, surface, mesh);

  ASSERT_EQ(surface.faces.size(), 4u);
  EXPECT_EQ(surface.faces[0].name, "wall");
  EXPECT_EQ(surface.faces[3].name, "wall_extensions");
  EXPECT_EQ(surface.faces[3].kind, geometry::FaceKind::wall);
  EXPECT_EQ(surface.faces[3].id, 4);
  ASSERT_EQ(mesh.faces.size(), 4u);
  const auto check = [&](const std::vector<Vec3>& points, const std::vector<geometry::Triangle>& triangles,
                         const std::vector<std::int32_t>& ids) {
    std::map<std::int32_t, double> areas;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      areas[ids[i]] += area_of(points, triangles[i]);
      const double z = height_of(points, triangles[i]);
      if (ids[i] == 1) {
        EXPECT_GT(z, -0.4 * edge);
        EXPECT_LT(z, length + 0.4 * edge);
      }
      if (ids[i] == 4) {
        EXPECT_TRUE(z < 0.4 * edge || z > length - 0.4 * edge) << z;
      }
    }
    const double around = 2.0 * std::numbers::pi * radius;
    EXPECT_NEAR(areas[1], around * length, 0.03 * around * length);
    EXPECT_NEAR(areas[4], around * 9.0, 0.04 * around * 9.0);  // three diameters
  };
  check(surface.mesh.points, surface.mesh.triangles, surface.face_ids);
  check(mesh.points, mesh.triangles, mesh.triangle_face_ids);
}

TEST(ExtensionWalls, OfOneEndAloneLeaveTheOthersCapsAndWallAsTheyAre) {
  const OpenTube tube = tube_of_section(kidney, 48, 10.0, 1.0);
  const ClippedSurface clipped = clip_ends(tube.mesh, tube.tree);
  FlowExtensionOptions options;
  options.ends = {end_name(clipped.ends[0].plane)};
  const ExtendedEnds extended = extend_ends(clipped, tube.tree, options);
  geometry::FacedSurface surface = cap_ends(extended.surface);
  const geometry::FacedSurface before = surface;
  geometry::MixedMesh none;
  mark_extension_walls(clipped, extended.surface.mesh, surface, none);
  ASSERT_EQ(surface.faces.size(), before.faces.size() + 1);
  for (std::size_t i = 0; i < surface.face_ids.size(); ++i) {
    if (surface.face_ids[i] == before.face_ids[i]) continue;
    EXPECT_EQ(before.face_ids[i], 1);
    // Two rows of the lumen's triangles, whose edges were evened beside the section, may go with it.
    EXPECT_LT(height_of(surface.mesh.points, surface.mesh.triangles[i]), 0.75);
  }
  EXPECT_TRUE(none.faces.empty());
}

TEST(ExtensionWalls, WithoutExtensionsNothingChanges) {
  const OpenTube tube = tube_of_section(circle, 32, 12.0, 1.5);
  const ClippedSurface clipped = clip_ends(tube.mesh, tube.tree);
  geometry::FacedSurface surface = cap_ends(clipped);
  const geometry::FacedSurface before = surface;
  geometry::MixedMesh none;
  mark_extension_walls(clipped, clipped.mesh, surface, none);
  EXPECT_EQ(surface.face_ids, before.face_ids);
  EXPECT_EQ(surface.faces.size(), before.faces.size());
}

}  // namespace
}  // namespace ostia::meshing
