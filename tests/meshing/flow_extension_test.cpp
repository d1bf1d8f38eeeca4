#include "ostia/meshing/flow_extension.h"

#include "cutting/seam.h"
#include "extension_checks.h"
#include "extension_shapes.h"
#include "test_surfaces.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/quality.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"
#include "ostia/meshing/tetrahedralize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;

TEST(FlowExtension, GoesOnWithACylinder) {
  const OpenTube tube = tube_of_section(circle, 32, 12.0, 1.5);
  const ClippedSurface clipped = clip_ends(tube.mesh, tube.tree);
  const ExtendedEnds out = extend_ends(clipped, tube.tree);
  expect_sound(out, 2);
  ASSERT_EQ(out.extensions.size(), 2u);
  for (const Vec3& p : out.surface.mesh.points) EXPECT_NEAR(p.head<2>().norm(), 1.5, 1e-6 * 1.5);
  const geometry::Box3 box = geometry::bounds(out.surface.mesh.points);
  EXPECT_NEAR(box.min().z(), -15.0, 1e-6);
  EXPECT_NEAR(box.max().z(), 27.0, 1e-6);
  // The triangles of the lumen are still there, in their places.
  for (std::size_t i = 0; i < clipped.mesh.triangles.size(); ++i)
    EXPECT_EQ(out.surface.mesh.triangles[i], clipped.mesh.triangles[i]);
}

TEST(FlowExtension, MakesUnlikeSectionsRound) {
  const std::vector<std::pair<std::string, std::function<Vec3(double)>>> sections{
      {"2:1", [](double a) { return ellipse(a, 2.0); }},
      {"3:1", [](double a) { return ellipse(a, 3.0); }},
      {"kidney", kidney}};
  for (const auto& [name, section] : sections) {
    const OpenTube tube = tube_of_section(section, 48, 10.0, 1.0);
    const ExtendedEnds out = extend_ends(clip_ends(tube.mesh, tube.tree), tube.tree);
    SCOPED_TRACE(name);
    expect_sound(out, 2);
    for (std::size_t end = 0; end < 2; ++end) {
      expect_round(out, end);
      EXPECT_LT(degrees_between(out.surface.ends[end].plane.normal, Vec3(0, 0, end == 0 ? -1 : 1)), 1e-6);
    }
    // Not one step jumps: areas between the section's and the circle's stay near them.
    EXPECT_NEAR(out.extensions[0].length_mm, 5.0 * out.extensions[0].diameter_mm, 1e-9);
  }
}

TEST(FlowExtension, EllipseHasTheAreaItShould) {
  const OpenTube tube = tube_of_section([](double a) { return ellipse(a, 2.0); }, 64, 10.0, 1.0);
  const ExtendedEnds out = extend_ends(clip_ends(tube.mesh, tube.tree), tube.tree);
  // Both polygons of 64 corners miss 1 - sin(x) / x of their curves.
  const double x = 2.0 * std::numbers::pi / 64;
  EXPECT_NEAR(out.extensions[0].section_area_mm2, 2.0 * std::numbers::pi * std::sin(x) / x, 1e-6);
}

TEST(FlowExtension, DoesNotFoldAtAnObliqueCut) {
  for (const double slope : {0.3, 0.65}) {
    const OpenTube tube = tube_of_section(circle, 40, 12.0, 1.5, slope);
    ASSERT_TRUE(clip_ends(tube.mesh, tube.tree).ends[1].was_open);
    FlowExtensionOptions options;
    options.area_across_axis = true;
    const ExtendedEnds out = extend_ends(clip_ends(tube.mesh, tube.tree), tube.tree, options);
    SCOPED_TRACE(slope);
    EXPECT_TRUE(geometry::self_intersections(out.surface.mesh, 1).empty());
    for (const FlowExtension& e : out.extensions) EXPECT_GE(e.seam_angle_deg, 25.0);
    EXPECT_LT(degrees_between(out.surface.ends[1].plane.normal, Vec3::UnitZ()), 1e-6);
    // Seen along the axis the section is the cylinder's own, and so is the extension.
    EXPECT_NEAR(out.surface.ends[1].plane.radius_mm, 1.5, 0.01);
    for (const Vec3& p : out.surface.mesh.points) EXPECT_NEAR(p.head<2>().norm(), 1.5, 0.03);
  }
}

TEST(FlowExtension, RefusesAnObliqueCutThatIsTooShort) {
  const OpenTube tube = tube_of_section(circle, 40, 12.0, 1.5, 0.65);
  FlowExtensionOptions options;
  options.outlet_diameters = 0.3;
  try {
    extend_ends(clip_ends(tube.mesh, tube.tree), tube.tree, options);
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_THAT(error.what(), HasSubstr("outlet_"));
    EXPECT_THAT(error.what(), HasSubstr("mm or more"));
  }
}

TEST(FlowExtension, FollowsTheLastDiameterOfABentAxis) {
  const OpenTube arc = ring_arc(12.0, 1.5, 120.0);
  const ExtendedEnds out = extend_ends(clip_ends(arc.mesh, arc.tree), arc.tree);
  expect_sound(out, 2);
  // Over the last diameter of 3 mm the axis turns by 3 / 12; its mean direction is that of the middle.
  const double a = 120.0 / 180.0 * std::numbers::pi - 0.5 * 3.0 / 12.0;
  EXPECT_LT(degrees_between(out.extensions[1].direction, {-std::sin(a), std::cos(a), 0.0}), 1.0);
  EXPECT_LT(degrees_between(out.extensions[0].direction, {std::sin(0.125), -std::cos(0.125), 0.0}), 1.0);
  FlowExtensionOptions options;
  options.direction = ExtensionDirection::section;
  const ExtendedEnds straight = extend_ends(clip_ends(arc.mesh, arc.tree), arc.tree, options);
  EXPECT_LT(degrees_between(straight.extensions[0].direction, {0.0, -1.0, 0.0}), 0.1);
}

TEST(FlowExtension, BendsOnTheSideAsked) {
  const OpenTube tube = tube_of_section(circle, 32, 12.0, 1.5);
  FlowExtensionOptions options;
  options.bend_deg = 90.0;
  options.bend_towards = {1.0, 0.0, 0.3};
  const ClippedSurface clipped = clip_ends(tube.mesh, tube.tree);
  options.ends = {end_name(clipped.ends[1].plane)};
  const ExtendedEnds out = extend_ends(clipped, tube.tree, options);
  EXPECT_TRUE(geometry::self_intersections(out.surface.mesh, 1).empty());
  EXPECT_LT(degrees_between(out.surface.ends[1].plane.normal, Vec3::UnitX()), 0.5);
  expect_round(out, 1);
  // A quarter of a circle 15 mm long.
  const double radius = 15.0 / (0.5 * std::numbers::pi);
  EXPECT_LT((out.surface.ends[1].plane.origin - Vec3(radius, 0.0, 12.0 + radius)).norm(), 0.1);
  EXPECT_EQ(out.surface.ends[0].loop, clipped.ends[0].loop);
  options.bend_deg = 0.0;
  options.axes[options.ends[0]] = {{0.0, 0.0, 16.0}, {1.0, 0.0, 20.0}, {4.0, 0.0, 24.0}};
  const ExtendedEnds along = extend_ends(clipped, tube.tree, options);
  EXPECT_LT((along.surface.ends[1].plane.origin - Vec3(4.0, 0.0, 24.0)).norm(), 1e-6);
  options.axes.clear();
  options.bend_deg = 180.0;
  options.outlet_diameters = 2.0;
  EXPECT_THROW(extend_ends(clipped, tube.tree, options), GeometryError);
}

TEST(FlowExtension, ForkGoesOnToAMesh) {
  const geometry::AnalyticShape shape = geometry::y_junction(6.0, 10.0, 2.0, 1.4, 60.0);
  const geometry::VesselTree tree = tree_of(shape);
  for (const bool raw : {false, true}) {
    SCOPED_TRACE(raw);
    const auto lumen =
        raw ? geometry::raw_surface_of(shape, 0.25, false) : geometry::surface_of(shape, 0.25, false);
    const ClippedSurface clipped = clip_ends(lumen, tree);
    const ExtendedEnds out = extend_ends(clipped, tree);
    ASSERT_EQ(out.extensions.size(), 3u);
    expect_sound(out, 3);
    EXPECT_TRUE(out.warnings.empty()) << out.warnings[0];
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_LT(degrees_between(out.extensions[i].direction, out.surface.ends[i].plane.normal), 1e-6);
    const geometry::FacedSurface capped = cap_ends(out.surface);
    const RemeshedSurface even = remesh(capped, target_edge_lengths(capped.mesh, TubeFunction(out.tree)));
    EXPECT_EQ(even.report.self_intersections, 0u);
    EXPECT_GE(even.report.min_angle_deg, 25.0);
    if (raw) continue;
    const auto volume = tetrahedralize(even.surface);
    EXPECT_EQ(volume.report.quality.inverted, 0u);
    EXPECT_EQ(volume.report.quality.boundary_mismatches, 0u);
    EXPECT_EQ(volume.mesh.faces.size(), 4u);
  }
}

TEST(FlowExtension, MakesARoundEndAndNoMore) {
  const OpenTube tube = tube_of_section([](double a) { return ellipse(a, 1.6); }, 48, 10.0, 1.0);
  FlowExtensionOptions options;
  options.inlet_diameters = options.outlet_diameters = 0.75;
  options.transition_share = 1.0;
  const ExtendedEnds out = extend_ends(clip_ends(tube.mesh, tube.tree), tube.tree, options);
  expect_sound(out, 2);
  expect_round(out, 0);
  EXPECT_NEAR(out.extensions[0].length_mm, 0.75 * out.extensions[0].diameter_mm, 1e-9);
}

TEST(FlowExtension, TreeCarriesTheSizesOn) {
  const OpenTube tube = tube_of_section(circle, 32, 12.0, 1.5);
  const ExtendedEnds out = extend_ends(clip_ends(tube.mesh, tube.tree), tube.tree);
  const TubeFunction function(out.tree);
  for (const Vec3& p : out.surface.mesh.points) {
    EXPECT_NEAR(function(p).distance_mm, 1.5, 1e-4);
    EXPECT_NEAR(function(p).radius_mm, 1.5, 1e-4);
  }
}

TEST(FlowExtension, FindsItsEndsInATreeOfTheCutLumen) {
  const geometry::AnalyticShape shape = geometry::y_junction(6.0, 10.0, 2.0, 1.4, 60.0);
  const geometry::VesselTree tree = tree_of(shape);
  const ClippedSurface clipped = clip_ends(geometry::surface_of(shape, 0.3, false), tree);
  geometry::VesselTree renumbered = tree;
  std::reverse(renumbered.nodes.begin(), renumbered.nodes.end());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {  // the ids of others
    const std::int32_t id = tree.nodes[i].id, next = tree.nodes[(i + 1) % tree.nodes.size()].id;
    for (geometry::TreeNode& node : renumbered.nodes)
      if (node.position == tree.nodes[i].position) node.id = next;
    for (std::size_t s = 0; s < tree.segments.size(); ++s) {
      if (tree.segments[s].from == id) renumbered.segments[s].from = next;
      if (tree.segments[s].to == id) renumbered.segments[s].to = next;
    }
  }
  ASSERT_FALSE(geometry::find_fault(renumbered).has_value());
  const ExtendedEnds out = extend_ends(clipped, renumbered), usual = extend_ends(clipped, tree);
  expect_sound(out, 3);
  EXPECT_EQ(out.surface.mesh.points, usual.surface.mesh.points);
}

TEST(FlowExtension, EvensARaggedSeam) {
  const auto shape = geometry::straight_tube(12.0, 1.5);
  const geometry::VesselTree tree = tree_of(shape);
  const ClippedSurface clipped = clip_ends(geometry::raw_surface_of(shape, 0.3, false), tree);
  ASSERT_LT(seam_angle_deg(clipped.mesh, clipped.ends[0].loop), 25.0);
  FlowExtensionOptions options;
  options.even_seam = false;
  const ExtendedEnds ragged = extend_ends(clipped, tree, options);
  EXPECT_LT(ragged.extensions[0].seam_angle_deg, 25.0);
  ASSERT_FALSE(ragged.warnings.empty());
  EXPECT_THAT(ragged.warnings.back(), HasSubstr("seam"));
  options.even_seam = true;
  const ExtendedEnds even = extend_ends(clipped, tree, options);
  expect_sound(even, 2);
  // Far from the ends nothing has changed.
  const geometry::AabbTree before(clipped.mesh);
  for (const Vec3& p : even.surface.mesh.points) {
    if (p.z() > 2.0 && p.z() < 10.0) {
      EXPECT_LT(before.closest(p).distance, 1e-9);
    }
  }
}

TEST(FlowExtension, RefusesBadInput) {
  const OpenTube tube = tube_of_section(circle, 32, 12.0, 1.5);
  const ClippedSurface clipped = clip_ends(tube.mesh, tube.tree);
  const auto refused = [&](const FlowExtensionOptions& options, const std::string& what) {
    try {
      extend_ends(clipped, tube.tree, options);
      ADD_FAILURE() << what;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr(what));
    }
  };
  FlowExtensionOptions options;
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    options = {};
    options.inlet_diameters = bad;
    refused(options, "inlet_diameters");
    options = {};
    options.outlet_diameters = bad;
    refused(options, "outlet_diameters");
  }
  options = {};
  options.transition_share = 1.5;
  refused(options, "transition_share");
  options = {};
  options.ends = {"outlet_nowhere"};
  refused(options, "there is no end outlet_nowhere; the ends are inlet_");
  options = {};
  options.axes["outlet_nowhere"] = {Vec3::Zero()};
  refused(options, "there is no end outlet_nowhere");
  options = {};
  options.bend_deg = 45.0;
  options.bend_towards = Vec3::UnitZ();
  refused(options, "lies along the axis");

  EXPECT_THROW(extend_ends({tube.mesh, {}, {}}, tube.tree), InvalidInput);
  ClippedSurface wrong = clipped;
  std::swap(wrong.ends[0].loop[0], wrong.ends[0].loop[2]);
  EXPECT_THROW(extend_ends(wrong, tube.tree), InvalidInput);
  wrong = clipped;
  wrong.ends[1].loop.clear();
  EXPECT_THROW(extend_ends(wrong, tube.tree), InvalidInput);
  const geometry::VesselTree elsewhere = tree_of(geometry::helix_tube(60.0, 80.0, 0.8, 1.2));
  EXPECT_THROW(extend_ends(clipped, elsewhere), InvalidInput);

  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(extend_ends(clipped, tube.tree, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
