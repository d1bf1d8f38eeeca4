#include "ostia/meshing/flat_caps.h"

#include "thick_walls.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::FacedSurface;
using geometry::TriMesh;
using geometry::Vec3;

/// A Y of radii 2 and 1.5 mm whose three ends are closed by flat fans; each cap has a label of its own.
FacedSurface capped_y() {
  const TriMesh open = geometry::surface_of(geometry::y_junction(20.0, 15.0, 2.0, 1.5, 60.0), 0.4, true);
  const geometry::FilledHoles filled = geometry::fill_holes(open);
  FacedSurface surface;
  surface.mesh = filled.mesh;
  for (const std::int32_t hole : filled.hole_of_triangle)
    surface.face_ids.push_back(hole < 0 ? 7 : 11 + hole);
  surface.faces = {{7, "wall", geometry::FaceKind::wall}};
  return surface;
}

FacedSurface without_labels(FacedSurface surface) {
  surface.face_ids.clear();
  surface.faces.clear();
  return surface;
}

void expect_three_ends(const OpenedCaps& opened, double area_of_wall) {
  ASSERT_EQ(opened.ends.size(), 3u);
  EXPECT_EQ(geometry::boundary_loops(opened.wall).size(), 3u);
  EXPECT_NEAR(geometry::area(opened.wall), area_of_wall, 1e-9 * area_of_wall);
  int parents = 0;
  for (const GivenEnd& end : opened.ends) {
    const bool parent = std::abs(end.normal.z() + 1.0) < 1e-6;
    parents += parent;
    EXPECT_NEAR(end.radius_mm, parent ? 2.0 : 1.5, 0.03);
    EXPECT_GT(std::abs(end.normal.z()), parent ? 0.999 : 0.8);  // children leave at 30 degrees
    if (parent) {
      EXPECT_NEAR((end.centre - Vec3(0.0, 0.0, -20.0)).norm(), 0.0, 0.02);
    }
  }
  EXPECT_EQ(parents, 1);
}

TEST(FlatCaps, AreKnownByTheirLabels) {
  const FacedSurface surface = capped_y();
  double wall = 0.0;
  std::vector<bool> is_wall;
  for (const std::int32_t id : surface.face_ids) is_wall.push_back(id == 7);
  wall = geometry::area(geometry::subset(surface.mesh, is_wall));
  expect_three_ends(without_flat_caps(surface), wall);
}

TEST(FlatCaps, AreKnownByTheirShapeWhereThereAreNoLabels) {
  const FacedSurface surface = capped_y();
  std::vector<bool> is_wall;
  for (const std::int32_t id : surface.face_ids) is_wall.push_back(id == 7);
  const double wall = geometry::area(geometry::subset(surface.mesh, is_wall));
  expect_three_ends(without_flat_caps(without_labels(surface)), wall);
}

TEST(FlatCaps, OneLabelForAllIsNoLabel) {
  FacedSurface surface = capped_y();
  const auto ends = without_flat_caps(without_labels(surface)).ends.size();
  surface.face_ids.assign(surface.face_ids.size(), 1);
  EXPECT_EQ(without_flat_caps(surface).ends.size(), ends);
  EXPECT_EQ(ends, 3u);
}

TEST(FlatCaps, TakeTheNamesThatTheFileHas) {
  FacedSurface surface = capped_y();
  surface.faces.push_back({11, "inflow_aorta", geometry::FaceKind::outlet});
  surface.faces.push_back({12, "cap_LAD", geometry::FaceKind::outlet});
  surface.faces.push_back({13, "outlet_LCx 1.vtp", geometry::FaceKind::outlet});
  std::vector<std::string> names;
  int inlets = 0;
  for (const GivenEnd& end : without_flat_caps(surface).ends) {
    names.push_back(end.name);
    inlets += end.kind == geometry::FaceKind::inlet;
  }
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"LAD", "LCx_1", "aorta"}));
  EXPECT_EQ(inlets, 1);
}

TEST(FlatCaps, RoundedEndsAreNone) {
  FacedSurface surface;
  surface.mesh = geometry::surface_of(geometry::y_junction(20.0, 15.0, 2.0, 1.5, 60.0), 0.4, false);
  const OpenedCaps opened = without_flat_caps(surface);
  EXPECT_TRUE(opened.ends.empty());
  EXPECT_EQ(opened.wall.triangles.size(), surface.mesh.triangles.size());
}

/// Few sides: each strip of the wall is flat and has a rim of 60 degrees.
TEST(FlatCaps, StripsOfACoarseTubeAreWall) {
  const TriMesh open = geometry::structured_surface(geometry::straight_tube(12.0, 2.0).tubes[0], 6, 3.0);
  FacedSurface surface;
  surface.mesh = geometry::fill_holes(open).mesh;
  EXPECT_EQ(without_flat_caps(surface).ends.size(), 2u);
}

/// A lumen of boxes, as a mask's voxels have it: the sides are flat, round enough and sharp, and yet wall.
TEST(FlatCaps, ABoxIsNoVessel) {
  FacedSurface surface;
  for (int i = 0; i < 8; ++i) surface.mesh.points.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  surface.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                            {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  EXPECT_TRUE(without_flat_caps(surface).ends.empty());
}

TEST(FlatCaps, OpenEndsStayAndClosedOnesOpen) {
  const TriMesh open = geometry::structured_surface(geometry::straight_tube(12.0, 2.0).tubes[0], 24, 0.5);
  const geometry::FilledHoles filled = geometry::fill_holes(open);
  std::vector<bool> keep;
  for (const std::int32_t hole : filled.hole_of_triangle) keep.push_back(hole != 0);
  FacedSurface surface;
  surface.mesh = geometry::subset(filled.mesh, keep);  // one cap, one open end
  const OpenedCaps opened = without_flat_caps(surface);
  ASSERT_EQ(opened.ends.size(), 1u);
  EXPECT_NEAR(opened.ends[0].radius_mm,
              2.0 * std::sqrt(std::sin(std::numbers::pi / 12.0) / (std::numbers::pi / 12.0)), 1e-6);
  EXPECT_EQ(geometry::boundary_loops(opened.wall).size(), 2u);
}

/// Each open end closed by a fan about a point `raised` of its radius outside of its plane.
FacedSurface closed_by_fans(TriMesh open, double raised) {
  for (const std::vector<std::int32_t>& loop : geometry::boundary_loops(open)) {
    const GivenEnd end = end_at_loop(open, loop);
    const auto hub = static_cast<std::int32_t>(open.points.size());
    open.points.push_back(end.centre + raised * end.radius_mm * end.normal);
    for (std::size_t i = 0; i < loop.size(); ++i)
      open.triangles.push_back({hub, loop[(i + 1) % loop.size()], loop[i]});
  }
  return {std::move(open), {}, {}};
}

TEST(FlatCaps, MayHaveTheRaisedMiddleThatVmtkGivesThem) {
  const TriMesh open = geometry::surface_of(geometry::y_junction(20.0, 15.0, 2.0, 1.5, 60.0), 0.4, true);
  expect_three_ends(without_flat_caps(closed_by_fans(open, 0.1)), geometry::area(open));
  EXPECT_TRUE(without_flat_caps(closed_by_fans(open, 0.3)).ends.empty()) << "pointed, and no caps";
}

/// Points `share` of an edge behind each of two neighbours on a rim, and `off` of that out of its plane: the
/// fan has two slim triangles.
TriMesh with_slim_edges(TriMesh open, double share, double off) {
  const std::vector<std::int32_t> loop = geometry::boundary_loops(open).front();
  const Vec3 outward = end_at_loop(open, loop).normal;
  for (const std::size_t i : {0U, 7U}) {
    const std::int32_t a = loop[i], b = loop[i + 1], between = static_cast<std::int32_t>(open.points.size());
    const Vec3 from = open.points[static_cast<std::size_t>(a)],
               edge = open.points[static_cast<std::size_t>(b)] - from;
    open.points.push_back(from + share * edge + off * share * edge.norm() * outward);
    const std::size_t count = open.triangles.size();
    for (std::size_t t = 0; t < count; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        if (open.triangles[t][k] != a || open.triangles[t][(k + 1) % 3] != b) continue;
        const std::int32_t c = open.triangles[t][(k + 2) % 3];
        open.triangles[t] = {a, between, c};
        open.triangles.push_back({between, b, c});
      }
  }
  return open;
}

/// A slim triangle's direction says nothing: it parts no cap, and is not left behind on the wall.
TEST(FlatCaps, StayWholeWhereSlimTrianglesRunThroughThem) {
  const TriMesh tube = geometry::structured_surface(geometry::straight_tube(12.0, 2.0).tubes[0], 24, 0.5);
  for (const auto& [share, off] : {std::pair{1e-5, 2.0}, std::pair{0.02, 0.5}}) {
    const TriMesh open = with_slim_edges(tube, share, off);
    const OpenedCaps opened = without_flat_caps(closed_by_fans(open, 0.0));
    ASSERT_EQ(opened.ends.size(), 2u) << share;
    EXPECT_NEAR(geometry::area(opened.wall), geometry::area(open), 1e-9) << share;
  }
}

TEST(FlatCaps, RefusesWhatDoesNotBelongTogether) {
  FacedSurface surface = capped_y();
  surface.face_ids.pop_back();
  EXPECT_THROW(without_flat_caps(surface), InvalidInput);
  FlatCapOptions options;
  options.flat_tolerance = 0.0;
  EXPECT_THROW(without_flat_caps(capped_y(), options), InvalidInput);
}

TEST(FlatCaps, ShapeIsNotAskedWhereLabelsAloneCount) {
  FlatCapOptions labels_alone;
  labels_alone.by_shape = false;
  EXPECT_EQ(without_flat_caps(capped_y(), labels_alone).ends.size(), 3u);
  EXPECT_TRUE(without_flat_caps(without_labels(capped_y()), labels_alone).ends.empty());
}

TEST(FlatRings, JoinALumenToTheOutsideOfItsWall) {
  const auto of = [](double parent, double child) {
    return geometry::surface_of(geometry::y_junction(20.0, 15.0, parent, child, 60.0), 0.4, true);
  };
  const TriMesh lumen = of(2.0, 1.5), outside = of(2.6, 2.1);
  FacedSurface shell{testing::thick_walled(lumen, outside), {}, {}};
  const OpenedRings opened = without_flat_rings(shell);
  ASSERT_EQ(opened.ends.size(), 3u);
  EXPECT_NEAR(geometry::area(opened.walls), geometry::area(lumen) + geometry::area(outside),
              1e-9 * geometry::area(outside));
  for (const GivenEnd& end : opened.ends) {
    const bool parent = end.centre.z() < -10.0;
    EXPECT_NEAR(end.radius_mm, parent ? 2.0 : 1.5, 0.03);
    if (parent) {
      EXPECT_NEAR(end.normal.z(), -1.0, 1e-6);
    }
  }
  // A ring's label names its end.
  shell.face_ids.assign(shell.mesh.triangles.size(), 1);
  for (std::size_t t = lumen.triangles.size() + outside.triangles.size(); t < shell.face_ids.size(); ++t)
    shell.face_ids[t] = 2;
  shell.faces = {{1, "wall", geometry::FaceKind::wall}, {2, "cap_LAD", geometry::FaceKind::outlet}};
  EXPECT_EQ(without_flat_rings(shell).ends.at(0).name, "LAD");
}

TEST(FlatRings, ACappedLumenHasNone) {
  EXPECT_TRUE(without_flat_rings(capped_y()).ends.empty());
  FlatCapOptions bad;
  bad.least_rim_deg = 1.0;
  EXPECT_THROW(without_flat_rings(capped_y(), bad), InvalidInput);
}

}  // namespace
}  // namespace ostia::meshing
