#include "ostia/meshing/clip.h"

#include "test_surfaces.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

void expect_clean(const ClippedSurface& clipped, std::size_t ends) {
  EXPECT_EQ(geometry::boundary_loops(clipped.mesh).size(), ends);
  ASSERT_EQ(clipped.ends.size(), ends);
  for (const ClippedEnd& end : clipped.ends) {
    ASSERT_GE(end.loop.size(), 6u) << end.plane.vessel;
    for (const std::int32_t v : end.loop)
      EXPECT_LT(
          std::abs(
              (clipped.mesh.points[static_cast<std::size_t>(v)] - end.plane.origin).dot(end.plane.normal)),
          1e-9);
  }
  const geometry::SurfaceFaults faults = geometry::find_faults(clipped.mesh, true);
  EXPECT_EQ(faults.non_manifold_edges + faults.non_manifold_vertices + faults.inconsistent_edges +
                faults.unused_points + faults.self_intersections,
            0u)
      << faults.summary();
}

TEST(ClipEnds, OfARoundedTubeLeavesTheTubeBetweenThePlanes) {
  const auto shape = geometry::straight_tube(20.0, 1.5);
  for (const bool raw : {false, true}) {
    const auto surface =
        raw ? geometry::raw_surface_of(shape, 0.2, false) : geometry::surface_of(shape, 0.2, false);
    const ClippedSurface clipped = clip_ends(surface, tree_of(shape));
    expect_clean(clipped, 2);
    EXPECT_EQ(clipped.ends[0].plane.kind, geometry::FaceKind::inlet);
    EXPECT_EQ(clipped.ends[1].plane.kind, geometry::FaceKind::outlet);
    EXPECT_EQ(clipped.ends[0].plane.vessel, "tube");
    EXPECT_NEAR(clipped.ends[0].plane.origin.z(), 1.5, 0.02);
    EXPECT_NEAR(clipped.ends[1].plane.origin.z(), 18.5, 0.02);
    EXPECT_NEAR(clipped.ends[0].plane.normal.z(), -1.0, 1e-9);
    EXPECT_NEAR(clipped.ends[1].plane.normal.z(), 1.0, 1e-9);
    EXPECT_NEAR(geometry::area(clipped.mesh), 2.0 * std::numbers::pi * 1.5 * 17.0, 1.5);
    for (const Vec3& p : clipped.mesh.points) {
      EXPECT_GE(p.z(), clipped.ends[0].plane.origin.z() - 1e-9);
      EXPECT_LE(p.z(), clipped.ends[1].plane.origin.z() + 1e-9);
    }
  }
}

TEST(ClipEnds, LeaveNoSliversAtTheCut) {
  const auto shape = geometry::helix_tube(6.0, 8.0, 0.8, 1.2);
  const ClippedSurface clipped = clip_ends(geometry::surface_of(shape, 0.25, false), tree_of(shape));
  expect_clean(clipped, 2);
  for (const ClippedEnd& end : clipped.ends)
    for (std::size_t i = 0; i < end.loop.size(); ++i) {
      const Vec3& a = clipped.mesh.points[static_cast<std::size_t>(end.loop[i])];
      const Vec3& b = clipped.mesh.points[static_cast<std::size_t>(end.loop[(i + 1) % end.loop.size()])];
      EXPECT_GT((b - a).norm(), 0.2 * 0.25);
    }
}

TEST(ClipEnds, OfATreeCutEachBranchAndNothingElse) {
  const auto shape = geometry::coronary_like_tree();
  const auto tree = tree_of(shape);
  const auto surface = geometry::raw_surface_of(shape, 0.3, false);
  const ClippedSurface clipped = clip_ends(surface, tree);
  expect_clean(clipped, 5);
  EXPECT_EQ(clipped.ends[0].plane.kind, geometry::FaceKind::inlet);
  EXPECT_EQ(clipped.ends[0].plane.vessel, "main");
  std::vector<std::string> names;
  for (std::size_t i = 1; i < 5; ++i) names.push_back(clipped.ends[i].plane.vessel);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"branch_1", "branch_2", "branch_3", "main"}));
  EXPECT_EQ(geometry::find_faults(clipped.mesh, false).components, 1u);
  // What is gone lies within two radii of an end.
  for (const Vec3& p : surface.points) {
    bool near_end = false;
    for (const ClippedEnd& end : clipped.ends)
      near_end = near_end || (p - end.plane.origin).norm() < 2.5 * end.plane.radius_mm;
    if (near_end) continue;
    bool kept = false;
    for (const Vec3& q : clipped.mesh.points) kept = kept || p == q;
    ASSERT_TRUE(kept) << p.transpose();
  }
}

TEST(ClipEnds, KeepEndsThatAreOpenAndFlat) {
  const auto shape = geometry::y_junction(12.0, 12.0, 2.0, 1.5, 70.0);
  const auto surface = geometry::surface_of(shape, 0.3, true);
  const ClippedSurface clipped = clip_ends(surface, tree_of(shape));
  expect_clean(clipped, 3);
  for (const ClippedEnd& end : clipped.ends) EXPECT_TRUE(end.was_open);
  EXPECT_EQ(clipped.mesh.triangles, surface.triangles);
}

TEST(ClipEnds, CutAnOpenEndThatIsRagged) {
  const auto shape = geometry::straight_tube(16.0, 1.5);
  geometry::TriMesh surface = geometry::surface_of(shape, 0.25, true);
  std::vector<bool> keep;
  for (const auto& t : surface.triangles) {
    Vec3 c = Vec3::Zero();
    for (const std::int32_t v : t) c += surface.points[static_cast<std::size_t>(v)] / 3.0;
    keep.push_back(c.z() > 0.6 + 0.5 * std::sin(3.0 * std::atan2(c.y(), c.x())));
  }
  const ClippedSurface clipped = clip_ends(geometry::subset(surface, keep), tree_of(shape));
  expect_clean(clipped, 2);
  EXPECT_FALSE(clipped.ends[0].was_open);
  EXPECT_TRUE(clipped.ends[1].was_open);
}

TEST(ClipEnds, CutAnOpenEndWhoseRimCrossesItselfALittleInside) {
  const auto shape = geometry::straight_tube(16.0, 1.5);
  geometry::TriMesh surface = geometry::surface_of(shape, 0.25, true);
  for (const std::vector<std::int32_t>& loop : geometry::boundary_loops(surface)) {
    auto at = [&](std::size_t i) -> Vec3& { return surface.points[static_cast<std::size_t>(loop[i])]; };
    if (at(0).z() < 8.0)
      std::swap(at(0), at(1));  // two neighbours in each other's place: their outer edges cross
  }
  const ClippedSurface clipped = clip_ends(surface, tree_of(shape));
  expect_clean(clipped, 2);
  EXPECT_FALSE(clipped.ends[0].was_open);
  EXPECT_TRUE(clipped.ends[1].was_open);
  EXPECT_LT(clipped.ends[0].plane.origin.z(), 0.6 * 1.5);
  ASSERT_FALSE(clipped.warnings.empty());
  EXPECT_NE(clipped.warnings[0].find("its rim crosses itself"), std::string::npos) << clipped.warnings[0];
}

TEST(ClipEnds, GoFartherInsideWhereAnEndIsTornAslant) {
  const auto shape = geometry::straight_tube(16.0, 1.5);
  const geometry::TriMesh surface = geometry::surface_of(shape, 0.25, true);
  std::vector<bool> keep;
  for (const auto& t : surface.triangles) {
    Vec3 c = Vec3::Zero();
    for (const std::int32_t v : t) c += surface.points[static_cast<std::size_t>(v)] / 3.0;
    keep.push_back(c.z() > 1.7 + 0.8 * c.x());  // from 0.5 to 2.9 mm, 39 degrees off the axis
  }
  const ClippedSurface clipped = clip_ends(geometry::subset(surface, keep), tree_of(shape));
  expect_clean(clipped, 2);
  EXPECT_NEAR(clipped.ends[0].plane.origin.z(), 3.0, 0.02);
  ASSERT_EQ(clipped.warnings.size(), 1u);
  EXPECT_NE(clipped.warnings[0].find("inlet of vessel tube"), std::string::npos);
}

/// Half a pipe for its first 9 mm of 40.
geometry::TriMesh half_a_pipe(const geometry::AnalyticShape& shape) {
  const geometry::TriMesh whole = geometry::surface_of(shape, 0.25, true);
  std::vector<bool> keep;
  for (const auto& t : whole.triangles) {
    Vec3 c = Vec3::Zero();
    for (const std::int32_t v : t) c += whole.points[static_cast<std::size_t>(v)] / 3.0;
    keep.push_back(c.z() > 9.0 || c.x() < 0.3);
  }
  return geometry::subset(whole, keep);
}

TEST(ClipEnds, CutsFartherInsideWhereThatIsAskedFor) {
  const auto shape = geometry::straight_tube(40.0, 1.5);
  const geometry::TriMesh surface = half_a_pipe(shape);
  ClipOptions options;
  options.move_inside_radii = 6.0;
  const ClippedSurface clipped = clip_ends(surface, tree_of(shape), options);
  expect_clean(clipped, 2);
  EXPECT_NEAR(clipped.ends[0].plane.origin.z(), 9.5, 0.6);
  ASSERT_EQ(clipped.warnings.size(), 1u);
  EXPECT_NE(clipped.warnings[0].find("the inlet of vessel tube"), std::string::npos);
  EXPECT_NE(clipped.warnings[0].find("mm farther inside, at "), std::string::npos);
  options.move_inside_radii = 2.0;  // not as far as that
  EXPECT_THROW(clip_ends(surface, tree_of(shape), options), EndsNotCut);
  options.move_inside_radii = -1.0;
  EXPECT_THROW(clip_ends(surface, tree_of(shape), options), InvalidInput);
}

TEST(ClipEnds, SayWhereAnEndCanBeCut) {
  const auto shape = geometry::straight_tube(40.0, 1.5);
  const geometry::TriMesh surface = half_a_pipe(shape);
  ClipOptions options;
  try {
    clip_ends(surface, tree_of(shape));
    FAIL() << "half a pipe was cut";
  } catch (const EndsNotCut& error) {
    ASSERT_EQ(error.ends().size(), 1u);
    EXPECT_EQ(end_name(error.ends()[0]), "inlet_tube");
    const std::string said = error.what(), start = "--plane inlet_tube=";
    const std::size_t at = said.find(start);
    ASSERT_NE(at, std::string::npos) << said;
    PlacedPlane plane;
    plane.end = "inlet_tube";
    ASSERT_EQ(
        std::sscanf(said.c_str() + at + start.size(), "%lf,%lf,%lf:%lf,%lf,%lf", &plane.origin[0],
                    &plane.origin[1], &plane.origin[2], &plane.normal[0], &plane.normal[1], &plane.normal[2]),
        6);
    EXPECT_NEAR(plane.origin.z(), 9.5, 0.6);
    options.planes = {plane};
  }
  expect_clean(clip_ends(surface, tree_of(shape), options), 2);
}

TEST(ClipEnds, NameTheEndThatCannotBeCut) {
  const auto shape = geometry::straight_tube(16.0, 1.5);
  auto tree = tree_of(shape);
  const auto surface = geometry::surface_of(shape, 0.3, false);
  auto message = [&](const geometry::VesselTree& t) -> std::string {
    try {
      clip_ends(surface, t);
    } catch (const GeometryError& error) {
      return error.what();
    }
    return "";
  };
  // An axis that leaves the lumen: its far end has no surface around it.
  for (Vec3& p : tree.segments[0].axis.points) p.z() = 2.0 + 2.0 * p.z();
  tree.nodes[0].position = tree.segments[0].axis.points.front();
  tree.nodes[1].position = tree.segments[0].axis.points.back();
  EXPECT_NE(message(tree).find("outlet of vessel tube"), std::string::npos) << message(tree);
  // An axis that stops half way: the rest of the vessel is more than an end.
  auto half = tree_of(geometry::straight_tube(4.0, 1.5));
  EXPECT_NE(message(half).find("more than the end itself"), std::string::npos) << message(half);
}

TEST(ClipEnds, RefuseHolesInsideOutSurfacesAndBadOptions) {
  const auto shape = geometry::straight_tube(16.0, 1.5);
  const auto tree = tree_of(shape);
  const auto surface = geometry::surface_of(shape, 0.3, true);
  geometry::TriMesh holed = surface;
  std::vector<bool> keep(surface.triangles.size(), true);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const Vec3& p = surface.points[static_cast<std::size_t>(surface.triangles[i][0])];
    keep[i] = (p - Vec3(1.5, 0.0, 8.0)).norm() > 0.6;
  }
  EXPECT_THROW(clip_ends(geometry::subset(surface, keep), tree), GeometryError);
  geometry::TriMesh inside_out = surface;
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_THROW(clip_ends(inside_out, tree), GeometryError);
  ClipOptions bad;
  bad.inset_radii = -1.0;
  EXPECT_THROW(clip_ends(surface, tree, bad), InvalidInput);
  EXPECT_THROW(clip_ends({}, tree), InvalidInput);
  EXPECT_THROW(clip_ends(surface, {}), Error);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(clip_ends(surface, tree, {}, task), Cancelled);
}

TEST(ClipEnds, TakesPlanesThatAPersonPlaced) {
  const auto shape = geometry::straight_tube(20.0, 1.5);
  for (const bool open : {false, true}) {
    const auto surface = geometry::surface_of(shape, 0.25, open);
    ClipOptions options;
    options.planes.push_back({"outlet_tube", {0.1, 0.0, 12.0}, {0.0, -0.6, -2.0}});
    const ClippedSurface clipped = clip_ends(surface, tree_of(shape), options);
    ASSERT_EQ(clipped.ends.size(), 2u);
    EXPECT_EQ(clipped.ends[0].was_open, open);
    EXPECT_FALSE(clipped.ends[1].was_open);
    const Vec3 normal = Vec3(0.0, 0.6, 2.0).normalized();
    EXPECT_LT((clipped.ends[1].plane.normal - normal).norm(), 1e-12);
    for (const std::int32_t v : clipped.ends[1].loop) {
      // Up to its hair's breadth of keeping clear of points, on the plane as it was placed.
      const Vec3& p = clipped.mesh.points[static_cast<std::size_t>(v)];
      EXPECT_NEAR((p - Vec3(0.1, 0.0, 12.0)).dot(normal), 0.0, 0.01 * 1.5);
    }
  }
}

TEST(ClipEnds, APlaneWithoutAnEndIsForTheNearest) {
  const auto shape = geometry::straight_tube(20.0, 1.5);
  const auto surface = geometry::surface_of(shape, 0.25, false);
  ClipOptions named, unnamed;
  named.planes = {{"outlet_tube", {0.1, 0.0, 15.0}, {0.0, -0.2, -2.0}},
                  {"inlet_tube", {0.1, 0.0, 4.0}, {0.0, 0.0, 1.0}}};
  unnamed.planes = named.planes;
  for (PlacedPlane& plane : unnamed.planes) plane.end.clear();
  const ClippedSurface a = clip_ends(surface, tree_of(shape), named),
                       b = clip_ends(surface, tree_of(shape), unnamed);
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  unnamed.planes[0].origin.z() = 6.0;  // nearer to the inlet, which has one already
  EXPECT_THROW(clip_ends(surface, tree_of(shape), unnamed), InvalidInput);
}

TEST(ClipEnds, RefusesPlanesThatCannotBe) {
  const auto shape = geometry::straight_tube(20.0, 1.5);
  const auto surface = geometry::surface_of(shape, 0.3, false);
  const auto clip = [&](const PlacedPlane& plane) {
    ClipOptions options;
    options.reach_radii = 100.0;
    options.planes.push_back(plane);
    return clip_ends(surface, tree_of(shape), options);
  };
  EXPECT_THROW(clip({"outlet_other", {0, 0, 12}, {0, 0, 1}}), InvalidInput);
  EXPECT_THROW(clip({"outlet_tube", {0, 0, 12}, {0, 0, 0}}), InvalidInput);
  EXPECT_THROW(clip({"outlet_tube", {0, 0, std::nan("")}, {0, 0, 1}}), InvalidInput);
  EXPECT_THROW(clip({"outlet_tube", {9, 0, 12}, {0, 0, 1}}), GeometryError);  // beside the lumen
  EXPECT_THROW(clip({"outlet_tube", {0, 0, 12}, {1, 0, 0}}), GeometryError);  // along it
}

}  // namespace
}  // namespace ostia::meshing
