#include "remeshing/edit_mesh.h"

#include "test_surfaces.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <random>

namespace ostia::meshing {
namespace {

/// Every link of the structure agrees with every other.
void expect_sound(const EditMesh& mesh) {
  for (std::int32_t h = 0; h < mesh.half_edge_count(); ++h) {
    if (!mesh.alive(h)) continue;
    const std::int32_t t = mesh.twin(h);
    if (t == EditMesh::none) {
      ASSERT_EQ(mesh.out(mesh.origin(h)), h);
      continue;
    }
    ASSERT_EQ(mesh.twin(t), h);
    ASSERT_EQ(mesh.origin(t), mesh.target(h));
    ASSERT_EQ(mesh.target(t), mesh.origin(h));
  }
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v)
    ASSERT_TRUE(!mesh.alive_vertex(v) || mesh.origin(mesh.out(v)) == v);
}

TEST(EditMesh, KeepsTheSurfaceItWasMadeOf) {
  const geometry::TriMesh grid = grid_surface(3);
  const EditMesh mesh(grid);
  expect_sound(mesh);
  EXPECT_EQ(mesh.compact().triangles, grid.triangles);
  EXPECT_TRUE(mesh.border(0));
  EXPECT_FALSE(mesh.border(5));
  EXPECT_EQ(mesh.valence(5), 6);
}

TEST(EditMesh, RandomEditsLeaveAManifoldOfTheSameKind) {
  for (const bool closed : {false, true}) {
    EditMesh mesh(closed ? capped_tube().mesh : grid_surface(12));
    std::mt19937 random(7);
    std::size_t splits = 0, flips = 0, collapses = 0;
    for (int k = 0; k < 4000; ++k) {
      const auto h = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(mesh.half_edge_count()));
      if (!mesh.alive(h)) continue;
      switch (random() % 3) {
        case 0:
          mesh.split(h, 0.5 * (mesh.at(mesh.origin(h)) + mesh.at(mesh.target(h))));
          ++splits;
          break;
        case 1:
          if (mesh.can_flip(h)) mesh.flip(h), ++flips;
          break;
        default:
          if (mesh.can_collapse(h)) mesh.collapse(h), ++collapses;
      }
    }
    EXPECT_GT(std::min({splits, flips, collapses}), 100u);
    expect_sound(mesh);
    const geometry::TriMesh result = mesh.compact();
    EXPECT_EQ(result.triangles.size(), mesh.live_faces());
    const geometry::SurfaceFaults faults = geometry::find_faults(result, false);
    EXPECT_EQ(faults.non_manifold_edges + faults.non_manifold_vertices + faults.inconsistent_edges, 0u);
    EXPECT_EQ(faults.components, 1u);
    EXPECT_EQ(geometry::boundary_loops(result).size(), closed ? 0u : 1u);
    // Euler's characteristic: a sphere 2, a disc 1.
    std::size_t edges = 0;
    for (std::int32_t h = 0; h < mesh.half_edge_count(); ++h) edges += mesh.canonical(h) ? 1 : 0;
    EXPECT_EQ(static_cast<std::ptrdiff_t>(result.points.size() + result.triangles.size()) -
                  static_cast<std::ptrdiff_t>(edges),
              closed ? 2 : 1);
  }
}

TEST(EditMesh, RefusesWhatWouldBreakTheManifold) {
  EditMesh tetrahedron(tetrahedron_surface(1.0));
  for (std::int32_t h = 0; h < tetrahedron.half_edge_count(); ++h) {
    EXPECT_FALSE(tetrahedron.can_collapse(h));
    EXPECT_FALSE(tetrahedron.can_flip(h));
  }
  EditMesh grid(grid_surface(1));
  for (std::int32_t h = 0; h < grid.half_edge_count(); ++h)
    EXPECT_TRUE(grid.twin(h) == EditMesh::none || !grid.can_collapse(h));
}

TEST(EditMesh, RefusesNonManifoldInput) {
  geometry::TriMesh three_on_an_edge = grid_surface(1);
  three_on_an_edge.points.emplace_back(0.0, 0.0, 1.0);
  three_on_an_edge.triangles.push_back({0, 3, 4});
  EXPECT_THROW(EditMesh{three_on_an_edge}, GeometryError);
  geometry::TriMesh turned = grid_surface(1);
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_THROW(EditMesh{turned}, GeometryError);
  geometry::TriMesh bow_tie = grid_surface(1);
  bow_tie.points.insert(bow_tie.points.end(), {{-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}});
  bow_tie.triangles.push_back({0, 4, 5});
  EXPECT_THROW(EditMesh{bow_tie}, GeometryError);
  geometry::TriMesh no_such_point = grid_surface(1);
  no_such_point.triangles[0][2] = 99;
  EXPECT_THROW(EditMesh{no_such_point}, GeometryError);
}

}  // namespace
}  // namespace ostia::meshing
