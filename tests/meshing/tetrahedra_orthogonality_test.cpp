#include "test_surfaces.h"
#include "tetrahedra/mending.h"
#include "tetrahedra/orthogonality.h"
#include "tetrahedra/quality.h"
#include "tetrahedra_samples.h"

#include "ostia/geometry/mixed_mesh_split.h"
#include "ostia/meshing/mixed_quality.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"
#include "ostia/meshing/tetrahedralize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::Vec3;
using geometry::VolumeMesh;

double degrees(double cosine) {
  return std::acos(cosine) * 180.0 / std::numbers::pi;
}

/// By OpenFOAM's formulas.
double non_orthogonality(const VolumeMesh& mesh) {
  return mixed_quality(geometry::mixed(mesh)).openfoam.max_non_orthogonality_deg;
}

double tetrahedra_orthogonality_least_quality(const VolumeMesh& mesh) {
  double least = 1.0;
  const auto at = [&](std::int32_t v) { return mesh.points[static_cast<std::size_t>(v)]; };
  for (const auto& t : mesh.tetrahedra)
    least = std::min(least, tetrahedron_quality(at(t[0]), at(t[1]), at(t[2]), at(t[3])));
  return least;
}

MendingReport orthogonal(VolumeMesh& mesh, double goal_deg, double quality) {
  TetrahedraComplex complex(mesh);
  MendingReport report;
  make_orthogonal(complex, goal_deg, quality, report);
  complex.write_to(mesh);
  return report;
}

/// A bipyramid on an equilateral triangle in the plane z = 0, its apexes drawn apart sideways by `shear`
/// each.
VolumeMesh sheared_bipyramid(double shear) {
  VolumeMesh mesh;
  for (const double angle : {0.0, 2.0, 4.0})
    mesh.points.emplace_back(std::cos(angle * std::numbers::pi / 3.0),
                             std::sin(angle * std::numbers::pi / 3.0), 0.0);
  mesh.points.emplace_back(shear, 0, 0.8);
  mesh.points.emplace_back(-shear, 0, -0.8);
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 0, 2, 4}};
  take_boundary(mesh);
  return mesh;
}

TEST(TetrahedraOrthogonality, IsTheAngleThatIsKnown) {
  for (const double shear : {0.0, 0.3, 0.8}) {
    const VolumeMesh mesh = sheared_bipyramid(shear);
    const TetrahedraComplex complex(mesh);
    // The face lies in z = 0, the apexes differ by (2 shear, 0, 1.6).
    const double known = degrees(1.6 / std::hypot(2.0 * shear, 1.6));
    TetrahedraComplex changed = complex;
    TetrahedraOrthogonality faces(changed, 0.0);
    EXPECT_NEAR(degrees(faces.cosine(0, 3)), known, 1e-6);
    EXPECT_NEAR(degrees(faces.cosine(1, 3)), known, 1e-6);  // from the other side
    EXPECT_EQ(faces.cosine(0, 0), 1.0);                     // of the boundary
    EXPECT_NEAR(non_orthogonality(mesh), known, 1e-6);      // as OpenFOAM has it
  }
}

TEST(TetrahedraOrthogonality, MovesPointsAndKeepsWhatTheTetrahedraAreWorth) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    VolumeMesh mesh = random_box(5, seed);
    const VolumeMesh old = mesh;
    const double before = non_orthogonality(mesh), quality = tetrahedra_orthogonality_least_quality(mesh);
    ASSERT_GT(before, 70.0);
    const MendingReport report = orthogonal(mesh, 50.0, quality);
    EXPECT_GT(report.points_moved, 0u);
    EXPECT_LT(non_orthogonality(mesh), before - 10.0);
    EXPECT_GE(tetrahedra_orthogonality_least_quality(mesh), quality);
    expect_sound(mesh, old);
  }
}

TEST(TetrahedraOrthogonality, FlipsWhereNoPointMayMove) {
  // All points belong to the boundary, and the face between the two tetrahedra is far from orthogonal:
  // three around a new edge between the apexes are nearer.
  VolumeMesh mesh = sheared_bipyramid(0.45);
  mesh.points[3].z() = 0.35, mesh.points[4].z() = -0.35;
  const VolumeMesh old = mesh;
  const double before = non_orthogonality(mesh);
  ASSERT_GT(before, 50.0);
  const MendingReport report = orthogonal(mesh, 30.0, 0.0);
  EXPECT_EQ(report.flips, 1u);
  EXPECT_EQ(report.points_moved, 0u);
  EXPECT_EQ(mesh.tetrahedra.size(), 3u);
  EXPECT_LT(non_orthogonality(mesh), before - 3.0);
  expect_sound(mesh, old);
}

TEST(TetrahedraOrthogonality, LeavesWhatIsWithinTheGoalBitForBit) {
  VolumeMesh mesh = random_box(4, 4);
  const VolumeMesh old = mesh;
  const MendingReport report = orthogonal(mesh, 89.9, 0.0);
  EXPECT_EQ(report.points_moved + report.flips + report.points_added, 0u);
  EXPECT_EQ(mesh.tetrahedra, old.tetrahedra);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) EXPECT_EQ(mesh.points[i], old.points[i]);
}

TEST(TetrahedraOrthogonality, IsWhatMendingEndsWith) {
  // A fork that is filled without further ado has faces beyond 60 degrees; OpenFOAM's own bound is 70.
  const auto shape = geometry::y_junction(8.0, 24.0, 2.0, 1.4, 15.0);
  const geometry::FacedSurface input = capped(shape, 0.3, false);
  SizingOptions sizing;
  const auto surface =
      remesh(input, target_edge_lengths(input.mesh, TubeFunction(tree_of(shape)), sizing)).surface;
  TetrahedralizeOptions options;
  options.mending_rounds = 0;
  VolumeMesh mesh = tetrahedralize(surface, options).mesh;
  ASSERT_GT(non_orthogonality(mesh), 65.0);
  const VolumeMesh old = mesh;
  mend_tetrahedra(mesh, {});
  EXPECT_LT(non_orthogonality(mesh), 60.5);
  EXPECT_GE(volume_quality(mesh).min_dihedral_deg, 16.0);
  EXPECT_EQ(mesh.boundary, old.boundary);
}

}  // namespace
}  // namespace ostia::meshing
