#include "ostia/meshing/quality.h"

#include "test_surfaces.h"

#include "ostia/core/error.h"
#include "ostia/meshing/mixed_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

TEST(TriangleQuality, OfKnownTriangles) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), apex(0.5, std::sqrt(0.75), 0);
  EXPECT_NEAR(min_angle_deg(a, b, apex), 60.0, 1e-12);
  EXPECT_NEAR(frobenius_aspect(a, b, apex), 1.0, 1e-14);
  EXPECT_NEAR(min_angle_deg(a, b, {0, 1, 0}), 45.0, 1e-12);
  EXPECT_NEAR(frobenius_aspect(a, b, {0, 1, 0}), 4.0 / (2.0 * std::sqrt(3.0)), 1e-14);
  EXPECT_EQ(min_angle_deg(a, b, {2, 0, 0}), 0.0);
  EXPECT_TRUE(std::isinf(frobenius_aspect(a, b, {2, 0, 0})));
}

TEST(TetrahedronQuality, OfKnownTetrahedra) {
  const auto regular = tetrahedron_surface(2.0).points;
  const auto range = dihedral_range_deg(regular[0], regular[1], regular[2], regular[3]);
  const double expected = std::acos(1.0 / 3.0) * 180.0 / std::numbers::pi;
  EXPECT_NEAR(range[0], expected, 1e-12);
  EXPECT_NEAR(range[1], expected, 1e-12);
  EXPECT_NEAR(std::abs(scaled_jacobian(regular[0], regular[1], regular[2], regular[3])), 1.0, 1e-14);
  // The corner of a cube: three right angles, and acos(1 / sqrt(3)) at the slanted face.
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const auto corner = dihedral_range_deg(o, x, y, z);
  EXPECT_NEAR(corner[0], std::acos(1.0 / std::sqrt(3.0)) * 180.0 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(corner[1], 90.0, 1e-12);
  EXPECT_NEAR(scaled_jacobian(o, x, y, z), std::sqrt(2.0) / 2.0, 1e-14);
  EXPECT_LT(scaled_jacobian(o, y, x, z), 0.0);
  EXPECT_EQ(dihedral_range_deg(o, x, y, {1, 1, 0})[0], 0.0);
}

TEST(SurfaceQuality, CountsWhatIsThere) {
  const SurfaceQuality closed = surface_quality(tetrahedron_surface(1.0));
  EXPECT_EQ(closed.triangles, 4u);
  EXPECT_EQ(
      closed.open_edges + closed.non_manifold_edges + closed.inconsistent_edges + closed.self_intersections,
      0u);
  EXPECT_EQ(closed.valence[3], 4u);
  EXPECT_NEAR(closed.volume_mm3, 1.0 / (6.0 * std::sqrt(2.0)), 1e-14);
  EXPECT_NEAR(closed.area_mm2, std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(closed.mean_edge_mm, 1.0, 1e-14);
  EXPECT_TRUE(check(closed).ok()) << check(closed).summary();
  const SurfaceQuality open = surface_quality(grid_surface(4));
  EXPECT_EQ(open.open_edges, 16u);
  EXPECT_EQ(open.valence[6], 9u);
  EXPECT_NEAR(open.mean_min_angle_deg, 45.0, 1e-12);
  EXPECT_FALSE(check(open).ok());
}

TEST(SurfaceQuality, GateNamesEveryFault) {
  geometry::TriMesh inward = tetrahedron_surface(1.0);
  for (auto& t : inward.triangles) std::swap(t[0], t[1]);
  EXPECT_NE(check(surface_quality(inward)).summary().find("inward"), std::string::npos);
  geometry::TriMesh turned = tetrahedron_surface(1.0);
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_EQ(surface_quality(turned).inconsistent_edges, 3u);
  geometry::TriMesh crossing = tetrahedron_surface(1.0);
  const auto other = tetrahedron_surface(1.5);
  for (auto t : other.triangles) {
    for (auto& v : t) v += 4;
    crossing.triangles.push_back(t);
  }
  for (const Vec3& p : other.points) crossing.points.push_back(p + Vec3(0.3, 0.1, 0.0));
  EXPECT_GT(surface_quality(crossing).self_intersections, 0u);
  EXPECT_EQ(surface_quality(crossing, false).self_intersections, 0u);
  QualityBounds strict;
  strict.min_angle_deg = 59.0;
  EXPECT_TRUE(check(surface_quality(tetrahedron_surface(1.0)), strict).ok());
  EXPECT_NE(check(surface_quality(capped_tube().mesh), strict).summary().find("smallest angle"),
            std::string::npos);
  EXPECT_FALSE(check(SurfaceQuality{}).ok());
}

geometry::VolumeMesh quality_one_tetrahedron() {
  const auto surface = tetrahedron_surface(1.0);
  geometry::VolumeMesh mesh;
  mesh.points = surface.points;
  mesh.tetrahedra = {{0, 1, 2, 3}};
  const Vec3 &a = mesh.points[0], &b = mesh.points[1], &c = mesh.points[2], &d = mesh.points[3];
  if ((b - a).cross(c - a).dot(d - a) < 0.0) mesh.tetrahedra = {{1, 0, 2, 3}};
  mesh.boundary = surface.triangles;
  mesh.boundary_face_ids.assign(4, 1);
  mesh.faces = {{1, "wall", geometry::FaceKind::wall}};
  return mesh;
}

QualityVerdict gate(const geometry::VolumeMesh& mesh) {
  return check(mixed_quality(geometry::mixed(mesh)));
}

TEST(VolumeQuality, SeesInversionAndForeignBoundaries) {
  geometry::VolumeMesh mesh = quality_one_tetrahedron();
  VolumeQuality quality = volume_quality(mesh);
  EXPECT_EQ(quality.inverted, 0u);
  EXPECT_EQ(quality.boundary_mismatches, 0u);
  EXPECT_NEAR(quality.min_dihedral_deg, 70.528779, 1e-6);
  EXPECT_EQ(quality.min_dihedral_histogram[14], 1u);
  EXPECT_NEAR(quality.volume_mm3, 1.0 / (6.0 * std::sqrt(2.0)), 1e-14);
  EXPECT_TRUE(gate(mesh).ok()) << gate(mesh).summary();
  std::swap(mesh.boundary[0][0], mesh.boundary[0][1]);
  EXPECT_EQ(volume_quality(mesh).boundary_mismatches, 1u);
  mesh.boundary.erase(mesh.boundary.begin());
  EXPECT_EQ(volume_quality(mesh).boundary_mismatches, 1u);
  mesh = quality_one_tetrahedron();
  std::swap(mesh.tetrahedra[0][0], mesh.tetrahedra[0][1]);
  quality = volume_quality(mesh);
  EXPECT_EQ(quality.inverted, 1u);
  EXPECT_LT(quality.min_scaled_jacobian, 0.0);
  EXPECT_FALSE(gate(mesh).ok());
}

TEST(QualityBounds, RefuseNonsense) {
  QualityBounds bad;
  bad.min_angle_deg = 61.0;
  EXPECT_THROW(check(SurfaceQuality{}, bad), InvalidInput);
  bad = {};
  bad.max_frobenius_aspect = 0.5;
  EXPECT_THROW(validate(bad), InvalidInput);
}

}  // namespace
}  // namespace ostia::meshing
