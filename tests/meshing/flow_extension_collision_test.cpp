#include "extension_checks.h"
#include "extension_shapes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/meshing/flow_extension.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace ostia::meshing {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;

/// Ends of an arc of 300 degrees face each other, 10 mm apart.
struct FacingEnds : ::testing::Test {
  OpenTube arc = ring_arc(10.0, 1.2, 300.0, 24);
  ClippedSurface clipped = clip_ends(arc.mesh, arc.tree);
  FlowExtensionOptions options;
};

TEST_F(FacingEnds, AreShortened) {
  const ExtendedEnds out = extend_ends(clipped, arc.tree);
  expect_sound(out, 2);
  EXPECT_LT(out.extensions[0].length_mm, out.extensions[0].wanted_length_mm);
  EXPECT_GT(out.extensions[0].length_mm, out.extensions[0].diameter_mm);
  EXPECT_EQ(out.warnings.size(), 2u);
}

TEST_F(FacingEnds, AreBentAway) {
  options.collision = ExtensionCollision::bend;
  const ExtendedEnds out = extend_ends(clipped, arc.tree, options);
  expect_sound(out, 2);
  EXPECT_EQ(out.extensions[0].length_mm, out.extensions[0].wanted_length_mm);
  EXPECT_GT(out.extensions[0].bend_deg + out.extensions[1].bend_deg, 0.0);
}

TEST_F(FacingEnds, AreRefusedByBothNames) {
  const std::string one = end_name(clipped.ends[0].plane), other = end_name(clipped.ends[1].plane);
  const auto expect_both = [&] {
    try {
      extend_ends(clipped, arc.tree, options);
      FAIL();
    } catch (const GeometryError& error) {
      EXPECT_THAT(error.what(), HasSubstr(one));
      EXPECT_THAT(error.what(), HasSubstr(other));
    }
  };
  options.collision = ExtensionCollision::refuse;
  expect_both();
  options.collision = ExtensionCollision::shorten;
  options.min_diameters = 5.0;
  expect_both();
}

/// Two flat tubes side by side, 2.6 mm from axis to axis; circles of their area are 3.5 mm wide.
struct FlatNeighbours : ::testing::Test {
  FlatNeighbours() {
    const OpenTube one = tube_of_section([](double a) { return ellipse(a, 3.0); }, 48, 10.0, 1.0);
    OpenTube other = one;
    const auto move = [](Vec3& p) { p.y() += 2.6; };
    std::for_each(other.mesh.points.begin(), other.mesh.points.end(), move);
    tree = one.tree;
    for (geometry::TreeNode node : other.tree.nodes) {
      move(node.position);
      node.id += 1000;
      tree.nodes.push_back(node);
    }
    for (geometry::TreeSegment segment : other.tree.segments) {
      std::for_each(segment.axis.points.begin(), segment.axis.points.end(), move);
      segment.id += 1000, segment.from += 1000, segment.to += 1000;
      tree.segments.push_back(segment);
    }
    for (geometry::Vessel vessel : other.tree.vessels) {
      vessel.id += 1000;
      vessel.name = "neighbour";
      for (std::int32_t& id : vessel.segments) id += 1000;
      tree.vessels.push_back(vessel);
    }
    clipped = clip_ends(geometry::merged(one.mesh, other.mesh), tree);
    options.ends = {"outlet_tube", "outlet_neighbour"};
  }
  geometry::VesselTree tree;
  ClippedSurface clipped;
  FlowExtensionOptions options;
};

TEST_F(FlatNeighbours, AreToldByName) {
  options.collision = ExtensionCollision::refuse;
  try {
    extend_ends(clipped, tree, options);
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_THAT(error.what(), HasSubstr("outlet_tube"));
    EXPECT_THAT(error.what(), HasSubstr("outlet_neighbour"));
  }
}

TEST_F(FlatNeighbours, GetOutOfEachOthersWay) {
  options.collision = ExtensionCollision::bend;
  const ExtendedEnds out = extend_ends(clipped, tree, options);
  EXPECT_TRUE(geometry::self_intersections(out.surface.mesh, 1).empty());
  ASSERT_EQ(out.extensions.size(), 2u);
  EXPECT_FALSE(out.warnings.empty());
  const Vec3 one = out.surface.ends[2].plane.origin, other = out.surface.ends[3].plane.origin;
  EXPECT_GT((one - other).norm(), 2.6);
  for (const FlowExtension& e : out.extensions) EXPECT_GE(e.seam_angle_deg, 25.0);
}

TEST(FlowExtension, StopsBeforeTheWall) {
  // One end of an arc of 330 degrees alone: its extension meets the other end's wall.
  const OpenTube arc = ring_arc(10.0, 1.2, 330.0, 24);
  const ClippedSurface clipped = clip_ends(arc.mesh, arc.tree);
  FlowExtensionOptions options;
  options.ends = {end_name(clipped.ends[1].plane)};
  const ExtendedEnds out = extend_ends(clipped, arc.tree, options);
  EXPECT_TRUE(geometry::self_intersections(out.surface.mesh, 1).empty());
  EXPECT_LT(out.extensions[0].length_mm, 5.1);
  options.collision = ExtensionCollision::refuse;
  try {
    extend_ends(clipped, arc.tree, options);
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_THAT(error.what(), HasSubstr(options.ends[0]));
    EXPECT_THAT(error.what(), HasSubstr("wall of the lumen"));
  }
}

TEST_F(FacingEnds, AreTheSameForAnyNumberOfThreads) {
  core::set_max_threads(1);
  const geometry::TriMesh one = extend_ends(clipped, arc.tree).surface.mesh;
  core::set_max_threads(0);
  const geometry::TriMesh many = extend_ends(clipped, arc.tree).surface.mesh;
  EXPECT_EQ(one.points, many.points);
  EXPECT_EQ(one.triangles, many.triangles);
}

}  // namespace
}  // namespace ostia::meshing
