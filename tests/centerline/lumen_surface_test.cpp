#include "ostia/centerline/lumen_surface.h"

#include "support/shapes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::centerline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

TriMesh open_tube() {
  return geometry::surface_of(geometry::straight_tube(8, 1.0), 0.3, true);
}

TEST(LumenSurface, caps_the_ends_of_a_tube) {
  const LumenSurface surface = prepare_lumen(open_tube());
  ASSERT_EQ(surface.openings.size(), 2u);
  for (const Opening& opening : surface.openings) {
    EXPECT_NEAR(opening.centre.head<2>().norm(), 0.0, 1e-2);
    EXPECT_NEAR(opening.radius, 1.0, 0.01);
  }
  EXPECT_EQ(geometry::find_faults(surface.capped, false).open_edges, 0u);
  EXPECT_NEAR(geometry::volume(surface.capped), 8.0 * M_PI, 0.03 * 8.0 * M_PI);
}

TEST(LumenSurface, turns_an_inverted_tube_outward) {
  TriMesh mesh = open_tube();
  for (geometry::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  EXPECT_GT(geometry::volume(prepare_lumen(mesh).capped), 0.0);
}

TEST(LumenSurface, joins_and_counts_equal_points) {
  TriMesh mesh = open_tube();
  const std::size_t count = mesh.points.size();
  TriMesh soup;
  for (const geometry::Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::int32_t>(soup.points.size());
    for (const std::int32_t v : t) soup.points.push_back(mesh.points[static_cast<std::size_t>(v)]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const LumenSurface surface = prepare_lumen(soup);
  EXPECT_EQ(surface.wall.points.size(), count);
  EXPECT_EQ(surface.welded_points, soup.points.size() - count);
}

TEST(LumenSurface, leaves_flaps_out_and_says_so) {
  TriMesh mesh = open_tube();
  const geometry::Triangle at = mesh.triangles[mesh.triangles.size() / 2];
  const auto tip = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.push_back(1.3 * mesh.points[static_cast<std::size_t>(at[0])]);
  mesh.triangles.push_back({at[0], at[1], tip});
  const LumenSurface surface = prepare_lumen(mesh);
  EXPECT_EQ(surface.openings.size(), 2u);
  EXPECT_EQ(geometry::find_faults(surface.wall, false).non_manifold_edges, 0u);
  ASSERT_EQ(surface.warnings.size(), 1u);
  EXPECT_EQ(surface.warnings[0].substr(0, 2), "1 ");
}

TEST(LumenSurface, opens_borders_that_touch_in_a_point) {
  const TriMesh mesh = testing::capsule(4.0, 1.0, 0.3);
  // Two triangles that share one vertex only.
  std::vector<bool> keep(mesh.triangles.size(), true);
  const auto middle = mesh.triangles.size() / 2;
  const std::int32_t hub = mesh.triangles[middle][0];
  keep[middle] = false;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    const auto& tri = mesh.triangles[t];
    int shared = 0;
    bool at_hub = false;
    for (const std::int32_t v : tri) {
      at_hub = at_hub || v == hub;
      for (const std::int32_t w : mesh.triangles[middle]) shared += v == w;
    }
    if (at_hub && shared == 1) {
      keep[t] = false;
      break;
    }
  }
  const TriMesh holed = geometry::subset(mesh, keep);
  ASSERT_EQ(geometry::find_faults(holed, false).non_manifold_vertices, 1u);
  const LumenSurface surface = prepare_lumen(holed);
  EXPECT_EQ(surface.openings.size(), 1u);
  EXPECT_EQ(geometry::find_faults(surface.capped, false).open_edges, 0u);
}

TEST(LumenSurface, cutting_long_edges_keeps_shape_and_connection) {
  const TriMesh mesh = testing::capsule(4.0, 1.0, 0.5);
  const TriMesh cut = with_edges_cut(mesh, 0.2);
  EXPECT_NEAR(geometry::area(cut), geometry::area(mesh), 1e-9);
  EXPECT_NEAR(geometry::volume(cut), geometry::volume(mesh), 1e-9);
  EXPECT_TRUE(geometry::find_faults(cut, false).closed_manifold());
  for (const geometry::Triangle& t : cut.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LE(
          (cut.points[static_cast<std::size_t>(t[k])] - cut.points[static_cast<std::size_t>(t[(k + 1) % 3])])
              .norm(),
          0.2);
  EXPECT_EQ(with_edges_cut(mesh, 10.0).points.size(), mesh.points.size());
  EXPECT_THROW(with_edges_cut(mesh, 0.0), InvalidInput);
}

TEST(LumenSurface, refuses_what_is_no_surface) {
  EXPECT_THROW(prepare_lumen({}), GeometryError);
  TriMesh flat{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 1}}};
  EXPECT_THROW(prepare_lumen(flat), GeometryError);
  TriMesh broken = open_tube();
  broken.points[5].x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(prepare_lumen(broken), InvalidInput);
}

}  // namespace
}  // namespace ostia::centerline
