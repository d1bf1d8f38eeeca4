// What keeps a mesh's shape: local radii, points moved so that the volume stays, deviations both ways.

#include "ostia/meshing/shape_kept.h"

#include "test_surfaces.h"

#include "ostia/core/error.h"
#include "ostia/geometry/faces.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"
#include "ostia/meshing/volume_keeping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::FacedSurface;
using geometry::Vec3;

/// A tube of radius 1.5 mm remeshed with sixteen edges around.
struct Remeshed {
  FacedSurface before = capped_tube(20.0);
  FacedSurface after;
  Remeshed() {
    const TubeFunction tube(tree_of(geometry::straight_tube(20.0, 1.5)));
    after = remesh(before, target_edge_lengths(before.mesh, tube)).surface;
  }
};

geometry::MixedMesh boundary_only(const FacedSurface& surface) {
  geometry::MixedMesh mesh;
  mesh.points = surface.mesh.points;
  mesh.triangles = surface.mesh.triangles;
  mesh.triangle_face_ids = surface.face_ids;
  mesh.faces = surface.faces;
  return mesh;
}

TEST(KeepVolume, OfATubeHoldsTheCirclesArea) {
  Remeshed r;
  const double before = geometry::volume(r.before.mesh), lost = geometry::volume(r.after.mesh);
  ASSERT_LT(lost, 0.985 * before) << "nothing to keep";
  const VolumeKept kept = keep_volume(r.after, r.before);
  EXPECT_NEAR(geometry::volume(r.after.mesh), before, 0.003 * before);
  EXPECT_DOUBLE_EQ(kept.after_mm3, geometry::volume(r.after.mesh));
  EXPECT_LT(kept.largest_move_mm, 0.03 * 1.5);  // edge^2 / 12 radius is 0.0133 radii
  for (const Vec3& p : r.after.mesh.points) EXPECT_LT(std::hypot(p.x(), p.y()), 1.03 * 1.5);
  EXPECT_TRUE(check(surface_quality(r.after.mesh)).ok());
}

TEST(KeepVolume, LeavesRingsAndCapsWhereTheyAre) {
  Remeshed r;
  const FacedSurface before = r.after;
  keep_volume(r.after, r.before);
  const geometry::FacesByKind faces(before.faces);
  for (std::size_t i = 0; i < before.mesh.triangles.size(); ++i) {
    if (faces.wall(before.face_ids[i])) continue;
    for (const std::int32_t v : before.mesh.triangles[i]) {
      const auto p = static_cast<std::size_t>(v);
      EXPECT_EQ(before.mesh.points[p], r.after.mesh.points[p]);
    }
  }
}

TEST(KeepVolume, RefusesSurfacesWithoutFaces) {
  Remeshed r;
  FacedSurface none = r.before;
  none.face_ids.clear();
  EXPECT_THROW(keep_volume(r.after, none), InvalidInput);
  EXPECT_THROW(keep_volume(none, r.before), InvalidInput);
}

TEST(LocalRadii, AreTheInscribedOnesWhereAxesExplainTheWall) {
  const auto shape = geometry::straight_tube(20.0, 1.5);
  const FacedSurface surface = capped_tube(20.0);
  for (const double r : local_radii(surface.mesh, TubeFunction(tree_of(shape)))) {
    EXPECT_LE(r, 1.5 + 1e-6);
    EXPECT_GE(r, 0.0);
  }
}

/// The axis of the wide branch alone: what rays see tells how thin the other one is.
TEST(LocalRadii, SeeABranchThatNobodyGaveAnAxis) {
  const auto shape = geometry::y_junction(20.0, 25.0, 2.0, 1.0, 80.0);
  const geometry::TriMesh surface = geometry::surface_of(shape, 0.25, false);
  geometry::AnalyticShape known = shape;
  known.tubes.erase(known.tubes.begin() + 2, known.tubes.end());
  const TubeFunction tube(tree_of(known));
  const std::vector<double> radii = local_radii(surface, tube);
  const std::vector<double> lengths = target_edge_lengths(surface, tube);
  const geometry::Centerline& lost = shape.tubes[2].axis;
  const Vec3 tip = lost.points.back();
  int near = 0;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const double from_tip = (surface.points[i] - tip).norm();
    if (from_tip > 8.0 || from_tip < 2.0) continue;
    ++near;
    EXPECT_NEAR(radii[i], 1.0, 0.3);
    EXPECT_LT(lengths[i], 0.4 * 1.25 * 1.3);
    EXPECT_GT(tube(surface.points[i]).distance_mm, 5.0) << "the axis is too near to test anything";
  }
  EXPECT_GT(near, 200);
}

TEST(ShapeKept, OfTheSameSurfaceIsAllThere) {
  const FacedSurface surface = capped_tube(12.0);
  ShapeKept kept =
      shape_kept(boundary_only(surface), surface, std::vector<double>(surface.mesh.points.size(), 1.5));
  kept.volume_mm3 = geometry::volume(surface.mesh);
  EXPECT_NEAR(kept.surface_to_mesh.max_mm, 0.0, 1e-9);
  EXPECT_NEAR(kept.mesh_to_surface.max_mm, 0.0, 1e-9);
  EXPECT_NEAR(kept.volume_change(), 0.0, 1e-12);
  EXPECT_TRUE(check(kept).ok());
}

/// A wall 0.2 mm farther out: exactly 0.2 / (0.05 * 1.5 + 0.05) = 1.6 times what is allowed, both ways.
TEST(ShapeKept, TellsHowFarAWallIsOff) {
  const FacedSurface surface = capped_tube(12.0);
  FacedSurface wider = surface;
  for (Vec3& p : wider.mesh.points) {
    const Vec3 out(p.x(), p.y(), 0.0);
    if (out.norm() > 1.0) p += 0.2 * out.normalized();
  }
  ShapeKept kept =
      shape_kept(boundary_only(wider), surface, std::vector<double>(surface.mesh.points.size(), 1.5));
  kept.volume_mm3 = geometry::volume(wider.mesh);
  EXPECT_NEAR(kept.mesh_to_surface.p999_mm, 0.2, 0.01);
  EXPECT_NEAR(kept.surface_to_mesh.p999_mm, 0.2, 0.01);
  EXPECT_NEAR(kept.surface_to_mesh.p999_share, 1.6, 0.08);
  ShapeBounds strict;
  strict.max_p999_share = 1.0;
  const QualityVerdict verdict = check(kept, strict);
  ASSERT_EQ(verdict.reasons.size(), 3u);
  EXPECT_NE(verdict.reasons[0].find("mm3"), std::string::npos);
  ShapeBounds lax;
  lax.max_p999_share = 2.0;
  lax.max_volume_change = 0.5;
  EXPECT_TRUE(check(kept, lax).ok());
}

/// What a mesh has lost is seen from the surface alone: its own wall lies on the surface everywhere.
TEST(ShapeKept, FindsABranchThatIsGone) {
  const FacedSurface tube = capped_tube(12.0);
  FacedSurface with_branch = tube;
  FacedSurface branch = capped_tube(9.0);
  for (Vec3& p : branch.mesh.points) p = Vec3(p.z() + 3.0, p.y(), p.x() + 6.0);
  const auto offset = static_cast<std::int32_t>(with_branch.mesh.points.size());
  with_branch.mesh = geometry::merged(with_branch.mesh, branch.mesh);
  with_branch.face_ids.insert(with_branch.face_ids.end(), branch.face_ids.begin(), branch.face_ids.end());
  ASSERT_GT(offset, 0);
  ShapeKept kept =
      shape_kept(boundary_only(tube), with_branch, std::vector<double>(with_branch.mesh.points.size(), 1.5));
  kept.volume_mm3 = geometry::volume(tube.mesh);
  EXPECT_NEAR(kept.mesh_to_surface.max_mm, 0.0, 1e-9);
  EXPECT_GT(kept.surface_to_mesh.p999_mm, 5.0);
  EXPECT_GT(kept.surface_to_mesh.worst_at.x(), 8.0);
  EXPECT_FALSE(check(kept).ok());
}

TEST(ShapeKept, ShortensEdgesWhereAWallIsOffAndNowhereElse) {
  const FacedSurface surface = capped_tube(12.0);
  const std::vector<double> radii(surface.mesh.points.size(), 1.5);
  std::vector<double> lengths(surface.mesh.points.size(), 0.6);
  EXPECT_EQ(shorten_where_off(surface, surface, radii, 0.8, lengths), 0u);
  FacedSurface dented = surface;
  for (Vec3& p : dented.mesh.points)
    if (p.x() > 1.0 && std::abs(p.z() - 6.0) < 1.5) p.x() -= 0.4;
  EXPECT_GT(shorten_where_off(surface, dented, radii, 0.8, lengths), 0u);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const Vec3& p = surface.mesh.points[i];
    if (p.x() > 1.3 && std::abs(p.z() - 6.0) < 0.8) {
      EXPECT_EQ(lengths[i], 0.3);
    }
    if (p.x() < 0.0 || std::abs(p.z() - 6.0) > 3.0) {
      EXPECT_EQ(lengths[i], 0.6);
    }
  }
  lengths.pop_back();
  EXPECT_THROW(shorten_where_off(surface, dented, radii, 0.8, lengths), InvalidInput);
}

TEST(ShapeKept, RefusesListsThatDoNotBelongTogether) {
  const FacedSurface surface = capped_tube(6.0);
  EXPECT_THROW(shape_kept(boundary_only(surface), surface, {1.0}), InvalidInput);
  EXPECT_THROW(
      shape_kept(geometry::MixedMesh{}, surface, std::vector<double>(surface.mesh.points.size(), 1.0)),
      InvalidInput);
  ShapeBounds bounds;
  bounds.max_p999_share = 0.0;
  EXPECT_THROW(check(ShapeKept{}, bounds), InvalidInput);
}

}  // namespace
}  // namespace ostia::meshing
