// What is known of a surface beforehand changes no bit of its centerlines.

#include "ostia/centerline/known_surface.h"

#include "support/shapes.h"

#include "ostia/centerline/extract_centerlines.h"
#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::centerline {
namespace {

TriMesh a_y(bool open) {
  return geometry::surface_of(geometry::y_junction(10, 10, 1.5, 1.1, 70), 0.3, open);
}

KnownSurface all_of(const TriMesh& mesh) {
  KnownSurface known{geometry::boundary_loops(mesh), geometry::fill_holes(mesh).mesh, nullptr, nullptr};
  known.tree = std::make_shared<const geometry::AabbTree>(known.closed);
  known.tetrahedra = std::make_shared<DelaunayAhead>(mesh.points);
  return known;
}

TEST(KnownSurface, changes_nothing_for_any_number_of_threads) {
  const TriMesh mesh = a_y(true);
  const CenterlineResult plain = extract_centerlines(mesh, std::nullopt, {});
  for (const int threads : {1, 2}) {
    core::set_max_threads(threads);
    const KnownSurface known = all_of(mesh);
    const CenterlineResult result = extract_centerlines(mesh, std::nullopt, {}, {}, core::no_task(), &known);
    EXPECT_TRUE(testing::identical(plain, result)) << threads;
    EXPECT_FALSE(known.tetrahedra->take(mesh.points)) << "the tetrahedra were not used";
  }
  core::set_max_threads(0);
}

TEST(KnownSurface, of_a_closed_one_lends_its_tree_to_the_wall_too) {
  const TriMesh mesh = a_y(false);
  const KnownSurface known = all_of(mesh);
  const Vec3 source(0, 0, -8);
  const std::vector<Vec3> targets = extract_centerlines(a_y(true), std::nullopt, {}).ends;
  const CenterlineResult plain = extract_centerlines(mesh, source, targets);
  EXPECT_TRUE(
      testing::identical(plain, extract_centerlines(mesh, source, targets, {}, core::no_task(), &known)));
}

TEST(KnownSurface, of_another_surface_is_passed_over) {
  const TriMesh mesh = a_y(true);
  TriMesh other = mesh;
  for (Vec3& p : other.points) p *= 1.5;
  const KnownSurface known = all_of(other);
  EXPECT_TRUE(is_of(known, other));
  EXPECT_FALSE(is_of(known, mesh));
  EXPECT_FALSE(is_of(known, {}));
  EXPECT_TRUE(testing::identical(extract_centerlines(mesh, std::nullopt, {}),
                                 extract_centerlines(mesh, std::nullopt, {}, {}, core::no_task(), &known)));
}

TEST(KnownSurface, with_edges_to_be_cut_has_its_own_tetrahedra) {
  // Long triangles: the diagram is of more points than the surface has.
  const TriMesh mesh = geometry::structured_surface(geometry::straight_tube(10.0, 1.0).tubes[0], 12, 4.0);
  const KnownSurface known = all_of(mesh);
  EXPECT_TRUE(testing::identical(extract_centerlines(mesh, std::nullopt, {}),
                                 extract_centerlines(mesh, std::nullopt, {}, {}, core::no_task(), &known)));
  EXPECT_TRUE(known.tetrahedra->take(mesh.points)) << "they are of other points, and nobody's";
}

TEST(DelaunayAhead, gives_what_delaunay_gives_once_and_for_its_points_alone) {
  const std::vector<Vec3> points = a_y(true).points;
  DelaunayAhead ahead(points);
  std::vector<Vec3> others = points;
  others.back().x() += 1e-9;
  EXPECT_FALSE(ahead.take(others));
  const std::optional<Delaunay> taken = ahead.take(points);
  ASSERT_TRUE(taken);
  const Delaunay plain = delaunay(points);
  EXPECT_EQ(taken->cells, plain.cells);
  EXPECT_EQ(taken->neighbours, plain.neighbours);
  EXPECT_FALSE(ahead.take(points));
}

TEST(DelaunayAhead, throws_when_it_is_taken_and_is_given_up_when_nobody_does) {
  std::vector<Vec3> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  DelaunayAhead ahead(flat);
  EXPECT_THROW(ahead.take(flat), GeometryError);
  flat[0].x() = std::numeric_limits<double>::quiet_NaN();
  DelaunayAhead not_a_number(flat);
  DelaunayAhead given_up(a_y(true).points);
}

}  // namespace
}  // namespace ostia::centerline
