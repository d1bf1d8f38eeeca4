// Surfaces whose ends or lumen could get lost on the way: each is kept, or named.

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/polygon.h"
#include "ostia/pipeline/ends_kept.h"
#include "ostia/pipeline/lumen_axes.h"
#include "ostia/pipeline/surface_intake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::pipeline {
namespace {

using geometry::FacedSurface;
using geometry::TriMesh;
using geometry::Vec3;

bool says(const std::vector<std::string>& told, const std::string& words) {
  return std::ranges::any_of(told,
                             [&](const std::string& line) { return line.find(words) != std::string::npos; });
}
TriMesh y_of(double parent, double child, double parent_radius, double child_radius, bool open,
             double edge = 0.4) {
  return geometry::surface_of(geometry::y_junction(parent, child, parent_radius, child_radius, 60.0), edge,
                              open);
}
TriMesh small_y() {
  return y_of(9.0, 9.0, 1.5, 1.2, true);
}

/// Each open end closed by a cone to a middle `height` of its radius outside; labels 1 (wall), 2, 3, 4.
FacedSurface coned(TriMesh mesh, double height, double shaken = 0.0) {
  FacedSurface out;
  const auto loops = geometry::boundary_loops(mesh);
  out.face_ids.assign(mesh.triangles.size(), 1);
  std::int32_t label = 1;
  for (const auto& loop : loops) {
    const meshing::GivenEnd end = meshing::end_at_loop(mesh, loop);
    ++label;
    const auto apex = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.push_back(end.centre + height * end.radius_mm * end.normal);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      mesh.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], apex});
      out.face_ids.push_back(label);
      mesh.points[static_cast<std::size_t>(loop[i])] +=
          (i % 2 == 0 ? shaken : -shaken) * end.radius_mm * end.normal;
    }
  }
  out.mesh = std::move(mesh);
  return out;
}

TEST(NothingLost, AShortWideTrunkIsTheInlet) {
  int of_short_ones = 0;
  for (const double length : {1.0, 3.0, 5.0, 7.0}) {  // some are below six radii, none may be lost
    const LumenAxes axes = lumen_axes(y_of(length, 25.0, 2.4, 1.3, false), {});
    if (!says(axes.told, "a short trunk")) continue;
    ++of_short_ones;
    ASSERT_EQ(geometry::roots(axes.tree).size(), 1u);
    EXPECT_EQ(geometry::ends(axes.tree).size(), 2u);
    const Vec3 begins = geometry::node(axes.tree, geometry::roots(axes.tree)[0]).position;
    EXPECT_LT((begins - Vec3(0.0, 0.0, -length)).norm(), 3.0);
  }
  EXPECT_GE(of_short_ones, 1);
}

TEST(NothingLost, DomedAndShakenLabelledCapsAreEnds) {
  for (const double height : {0.08, 0.3, 0.5}) {
    const TakenSurface taken = take_surface(coned(small_y(), height), "domed");
    EXPECT_EQ(taken.ends.size(), 3u) << height;
    EXPECT_EQ(geometry::boundary_loops(taken.lumen).size(), 3u);
    EXPECT_TRUE(taken.lost.empty());
  }
  const TakenSurface shaken = take_surface(coned(small_y(), 0.0, 0.07), "shaken");
  EXPECT_GE(shaken.ends.size() + shaken.lost.size(), 3u) << "a cap that mending broke is named";
}

TEST(NothingLost, WhatMendingTakesAwayIsTold) {
  int told = 0;
  for (const double shaken : {0.07, 0.3, 0.6}) {
    const FacedSurface came = coned(small_y(), 0.0, shaken);
    const TakenSurface taken = take_surface(came, "shaken");
    const double before = geometry::volume(came.mesh),
                 after = geometry::volume(geometry::fill_holes(taken.lumen).mesh);
    const bool is_told = says(taken.told, "mending changed the volume");
    told += is_told;
    EXPECT_TRUE(is_told || std::abs(after - before) <= 0.04 * std::abs(before))
        << shaken << ": " << before << " to " << after;
  }
  EXPECT_GE(told, 1);
  EXPECT_FALSE(says(take_surface(coned(small_y(), 0.3), "domed").told, "mending changed the volume"));
}

TEST(NothingLost, ALabelThatIsNoCapIsNamedWithItsPlace) {
  FacedSurface surface = coned(small_y(), 0.0);
  surface.mesh.points.back() += 2.0 * (surface.mesh.points.back() - Vec3(0.0, 0.0, 0.0)).normalized();
  surface.faces = {{1, "wall", geometry::FaceKind::wall}, {4, "cap_LAD", geometry::FaceKind::outlet}};
  const TakenSurface taken = take_surface(surface, "steep");
  EXPECT_EQ(taken.ends.size(), 2u);
  EXPECT_TRUE(says(taken.told, "the label LAD at ("));
  ASSERT_EQ(taken.lost.size(), 1u);
  EXPECT_EQ(taken.lost[0].name, "LAD");
}

TEST(NothingLost, PartsMayNumberTheirCapsAlike) {
  const FacedSurface one = coned(small_y(), 0.0);
  TriMesh beside = one.mesh;
  for (Vec3& p : beside.points) p += Vec3(0.0, 40.0, 0.0);
  FacedSurface two{geometry::merged(one.mesh, beside), one.face_ids, {}};
  two.face_ids.insert(two.face_ids.end(), one.face_ids.begin(), one.face_ids.end());
  const TakenSurface taken = take_surface(two, "two");
  EXPECT_EQ(taken.ends.size(), 6u);
  EXPECT_FALSE(says(taken.told, "has no end after mending"));
  EXPECT_TRUE(taken.lost.empty());
  two.mesh.points.back() += 2.0 * Vec3(two.mesh.points.back() - Vec3(0.0, 40.0, 0.0)).normalized();
  const TakenSurface steep = take_surface(two, "steep");
  EXPECT_EQ(steep.ends.size(), 5u);
  ASSERT_EQ(steep.lost.size(), 1u) << "the cap of that part alone, told once";
  EXPECT_GT(steep.lost[0].centre.y(), 20.0);
}

/// Caps as one polygon each, split as readers do, and as fans about a corner, as they were split.
TEST(NothingLost, CapsOfPolygonsAreNoSpikes) {
  for (const bool fan : {false, true}) {
    TriMesh mesh = small_y();
    for (const auto& loop : geometry::boundary_loops(mesh)) {
      const std::vector<std::int32_t> polygon(loop.rbegin(), loop.rend());
      for (std::size_t i = 2; fan && i < polygon.size(); ++i)
        mesh.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
      if (fan) continue;
      const auto split = geometry::triangles_of_polygon(mesh.points, polygon);
      mesh.triangles.insert(mesh.triangles.end(), split.begin(), split.end());
    }
    const TakenSurface taken = take_surface({mesh, {}, {}}, "polygons");
    EXPECT_EQ(taken.ends.size(), 3u) << fan;
    EXPECT_FALSE(says(taken.told, "spikes")) << fan;
  }
}

TEST(NothingLost, ThinOutletsOfATrunkSpeakForCentimetres) {
  TriMesh aorta = y_of(60.0, 50.0, 12.0, 1.2, true, 0.8);
  for (Vec3& p : aorta.points) p /= 10.0;
  const TakenSurface taken = take_surface({aorta, {}, {}}, "aorta");
  EXPECT_EQ(taken.unit_mm, 10.0);
  EXPECT_TRUE(says(taken.told, "taken to be in centimetres, since its thinnest end"));
  const TakenSurface small = take_surface(coned(small_y(), 0.0), "y");
  EXPECT_EQ(small.unit_mm, 1.0);
  EXPECT_FALSE(says(small.told, "centimetres")) << "a small coronary tree in mm raises no doubt";
}

TEST(NothingLost, OfTwoShellsTheInnerIsTheLumen) {
  for (const bool open : {true, false}) {
    const TriMesh inner = y_of(20.0, 20.0, 2.0, 1.5, open), outer = y_of(20.0, 20.0, 3.0, 2.5, open);
    const TakenSurface taken = take_surface({geometry::merged(outer, inner), {}, {}}, "shells");
    EXPECT_NEAR(geometry::area(taken.lumen), geometry::area(inner), 0.01 * geometry::area(inner)) << open;
    EXPECT_TRUE(says(taken.told, "one within the other")) << open;
    EXPECT_TRUE(taken.lost.empty());
  }
}

TEST(NothingLost, AnEndThatNoAxisComesToIsNamed) {
  Source source;
  source.kind = SourceKind::surface;
  source.surface = small_y();
  const LumenAxes all = lumen_axes(source.surface, {});
  EXPECT_TRUE(ends_without_axis(source, all.tree).empty());
  meshing::GivenEnd gone;
  gone.name = "LCx";
  gone.centre = Vec3(30.0, 0.0, 0.0);
  gone.radius_mm = 1.0;
  source.lost = {gone};
  const auto lost = ends_without_axis(source, all.tree);
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_NE(lost[0].find("LCx at (30.0, 0.0, 0.0) mm"), std::string::npos);
}

}  // namespace
}  // namespace ostia::pipeline
