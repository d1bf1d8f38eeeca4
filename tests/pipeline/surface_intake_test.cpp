// Surfaces as other programs bring them: mended, told, with all their ends.

#include "ostia/pipeline/surface_intake.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/pipeline/lumen_axes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace ostia::pipeline {
namespace {

using geometry::FacedSurface;
using geometry::TriMesh;
using geometry::Vec3;

geometry::AnalyticShape a_y() {
  return geometry::y_junction(20.0, 20.0, 2.0, 1.5, 60.0);
}
TriMesh open_y() {
  return geometry::surface_of(a_y(), 0.4, true);
}
TriMesh closed_y() {
  return geometry::surface_of(a_y(), 0.4, false);
}
TriMesh turned_inside_out(TriMesh mesh) {
  for (geometry::Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  return mesh;
}
TriMesh moved(TriMesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.points) p += by;
  return mesh;
}
FacedSurface bare(TriMesh mesh) {
  return {std::move(mesh), {}, {}};
}
bool tells(const TakenSurface& taken, const std::string& words) {
  return std::ranges::any_of(taken.told,
                             [&](const std::string& line) { return line.find(words) != std::string::npos; });
}
void expect_sound(const TriMesh& mesh, std::size_t parts, std::size_t ends) {
  geometry::SurfaceFaults faults = geometry::find_faults(mesh, true);
  faults.open_edges = 0;
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.components, parts);
  EXPECT_EQ(geometry::boundary_loops(mesh).size(), ends);
  EXPECT_GT(geometry::volume(geometry::fill_holes(mesh).mesh), 0.0);
}

TEST(SurfaceIntake, LeavesASoundSurfaceAlone) {
  const TakenSurface taken = take_surface(bare(open_y()), "y");
  EXPECT_TRUE(taken.told.empty());
  EXPECT_EQ(taken.lumen.triangles, open_y().triangles);
  EXPECT_EQ(taken.unit_mm, 1.0);
}

TEST(SurfaceIntake, TurnsOutwardWhatLooksInward) {
  for (const TriMesh& mesh : {open_y(), closed_y()}) {
    const TakenSurface taken = take_surface(bare(turned_inside_out(mesh)), "y");
    expect_sound(taken.lumen, 1, geometry::boundary_loops(mesh).size());
    EXPECT_TRUE(tells(taken, "turned"));
  }
}

TEST(SurfaceIntake, KeepsTwoTreesAndTurnsEach) {
  const TriMesh two = geometry::merged(open_y(), turned_inside_out(moved(closed_y(), Vec3(60.0, 0.0, 0.0))));
  const TakenSurface taken = take_surface(bare(two), "two");
  expect_sound(taken.lumen, 2, 3);
  for (const TriMesh& part : parts_of(taken.lumen))
    EXPECT_GT(geometry::volume(geometry::fill_holes(part).mesh), 0.0);
  EXPECT_TRUE(tells(taken, "2 separate parts"));
}

TEST(SurfaceIntake, LeavesSpecksOutAndTellsHowLargeAndWhere) {
  TriMesh mesh = open_y();
  for (int i = 0; i < 20; ++i)
    mesh = geometry::merged(mesh, moved(geometry::surface_of(geometry::straight_tube(0.2, 0.3), 0.2, false),
                                        Vec3(20.0 + 2.0 * i, 30.0, 0.0)));
  const TakenSurface taken = take_surface(bare(mesh), "specks");
  expect_sound(taken.lumen, 1, 3);
  EXPECT_TRUE(tells(taken, "20 loose specks"));
}

TEST(SurfaceIntake, ClosesHolesInTheWallAndNoEnds) {
  const TriMesh whole = open_y();
  std::vector<bool> keep;
  for (const geometry::Triangle& t : whole.triangles) {
    Vec3 centre = Vec3::Zero();
    for (const std::int32_t v : t) centre += whole.points[static_cast<std::size_t>(v)] / 3.0;
    keep.push_back((centre - Vec3(2.0, 0.0, -10.0)).norm() > 0.7);
  }
  const TakenSurface taken = take_surface(bare(geometry::subset(whole, keep)), "holed");
  expect_sound(taken.lumen, 1, 3);
  EXPECT_TRUE(tells(taken, "a hole in the wall closed"));
}

TEST(SurfaceIntake, PullsInSpikesOfOnePoint) {
  const TriMesh whole = open_y();
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < whole.points.size(); ++i)
    if ((whole.points[i] - Vec3(2.0, 0.0, -10.0)).norm() <
        (whole.points[nearest] - Vec3(2.0, 0.0, -10.0)).norm())
      nearest = i;
  for (const Vec3& to : {Vec3(-5.0, 0.3, -10.2), Vec3(6.0, 0.0, -10.0), Vec3(0.2, 0.0, -10.0)}) {
    TriMesh mesh = whole;  // through the other side, outward, and into the lumen
    mesh.points[nearest] = to;
    const TakenSurface taken = take_surface(bare(mesh), "spiked");
    expect_sound(taken.lumen, 1, 3);
    EXPECT_TRUE(tells(taken, "spikes of one point pulled in: 1"));
    ASSERT_EQ(taken.lumen.points.size(), whole.points.size());
    EXPECT_LT(geometry::AabbTree(whole).closest(taken.lumen.points[nearest]).distance, 0.02);
    EXPECT_NEAR(geometry::area(taken.lumen), geometry::area(whole), 1e-3 * geometry::area(whole));
  }
}

TEST(SurfaceIntake, KnowsCentimetresAndMetresByTheCalibre) {
  for (const double unit : {10.0, 1000.0}) {
    TriMesh mesh = open_y();
    for (Vec3& p : mesh.points) p /= unit;
    const TakenSurface taken = take_surface(bare(mesh), "y");
    EXPECT_EQ(taken.unit_mm, unit);
    EXPECT_NEAR(geometry::bounds(taken.lumen.points).sizes().z(),
                geometry::bounds(open_y().points).sizes().z(), 1e-9);
    EXPECT_TRUE(tells(taken, unit == 10.0 ? "centimetres" : "metres"));
    IntakeOptions told;
    told.unit_mm = 1.0;
    EXPECT_EQ(take_surface(bare(mesh), "y", told).unit_mm, 1.0) << "what the user says holds";
  }
  EXPECT_EQ(unit_by_calibre(3.0, 120.0), 1.0);
  EXPECT_EQ(unit_by_calibre(25.0, 300.0), 1.0);
  EXPECT_EQ(unit_by_calibre(0.3, 12.0), 10.0);
  EXPECT_EQ(unit_by_calibre(0.003, 0.12), 1000.0);
}

TEST(SurfaceIntake, TakesCapsOffAndKeepsTheirNames) {
  const geometry::FilledHoles filled = geometry::fill_holes(open_y());
  FacedSurface capped{filled.mesh, {}, {{1, "wall", geometry::FaceKind::wall}}};
  for (const std::int32_t hole : filled.hole_of_triangle) capped.face_ids.push_back(hole < 0 ? 1 : 2 + hole);
  capped.faces.push_back({2, "cap_LAD", geometry::FaceKind::outlet});
  const TakenSurface taken = take_surface(capped, "capped");
  expect_sound(taken.lumen, 1, 3);
  ASSERT_EQ(taken.ends.size(), 3u);
  EXPECT_EQ(std::ranges::count(taken.ends, "LAD", &meshing::GivenEnd::name), 1);
  EXPECT_TRUE(tells(taken, "flat caps taken as its ends: 3: LAD"));
}

/// All that can be wrong, two at a time.
TEST(SurfaceIntake, MendsFaultsInAllPairs) {
  using Fault = TriMesh (*)(TriMesh);
  const std::vector<Fault> faults{
      turned_inside_out,
      [](TriMesh m) {  // duplicate and degenerate triangles, a point that is nowhere
        m.triangles.push_back(m.triangles[10]);
        m.triangles.push_back({4, 4, 5});
        m.points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
        m.triangles.push_back({0, 1, static_cast<std::int32_t>(m.points.size()) - 1});
        return m;
      },
      [](TriMesh m) {  // unwelded
        TriMesh soup;
        for (const geometry::Triangle& t : m.triangles) {
          const auto n = static_cast<std::int32_t>(soup.points.size());
          for (const std::int32_t v : t) soup.points.push_back(m.points[static_cast<std::size_t>(v)]);
          soup.triangles.push_back({n, n + 1, n + 2});
        }
        return soup;
      },
      [](TriMesh m) {
        return geometry::merged(m, moved(geometry::surface_of(geometry::straight_tube(0.2, 0.3), 0.2, false),
                                         Vec3(30.0, 0.0, 0.0)));
      },
      [](TriMesh m) {  // a hole
        std::vector<bool> keep(m.triangles.size(), true);
        keep[m.triangles.size() / 2] = false;
        return geometry::subset(m, keep);
      },
      [](TriMesh m) {  // half of the triangles turned
        for (std::size_t i = 0; i < m.triangles.size(); i += 2)
          std::swap(m.triangles[i][0], m.triangles[i][1]);
        return m;
      }};
  for (std::size_t i = 0; i < faults.size(); ++i)
    for (std::size_t k = 0; k < faults.size(); ++k) {
      SCOPED_TRACE(std::to_string(i) + " and " + std::to_string(k));
      const TakenSurface taken = take_surface(bare(faults[k](faults[i](open_y()))), "pair");
      expect_sound(taken.lumen, 1, 3);
      EXPECT_NEAR(geometry::area(taken.lumen), geometry::area(open_y()), 0.02 * geometry::area(open_y()));
    }
}

TEST(SurfaceIntake, StrictRefusesAndNamesTheSurface) {
  IntakeOptions strict;
  strict.strict = true;
  EXPECT_NO_THROW(take_surface(bare(open_y()), "y", strict));
  const TriMesh two = geometry::merged(open_y(), moved(open_y(), Vec3(60.0, 0.0, 0.0)));
  try {
    take_surface(bare(two), "two trees", strict);
    FAIL() << "two parts were taken";
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("two trees"), std::string::npos);
  }
}

TEST(SurfaceIntake, SaysWhenNothingIsLeft) {
  TriMesh none;
  none.points.assign(3, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  none.triangles = {{0, 1, 2}};
  EXPECT_THROW(take_surface(bare(none), "none"), GeometryError);
}

TEST(LumenAxes, OfTwoTreesHaveARootEach) {
  const TriMesh two = geometry::merged(open_y(), moved(closed_y(), Vec3(60.0, 0.0, 0.0)));
  const LumenAxes axes = lumen_axes(two, {});
  EXPECT_FALSE(geometry::find_fault(axes.tree)) << *geometry::find_fault(axes.tree);
  EXPECT_EQ(geometry::roots(axes.tree).size(), 2u);
  EXPECT_EQ(geometry::ends(axes.tree).size(), 4u);
  ASSERT_EQ(axes.told.size(), 1u);
  EXPECT_NE(axes.told[0].find("closed ends found"), std::string::npos);
}

TEST(LumenAxes, ABranchThatNoTargetLiesOnIsToldAndBecomesWhatIsAskedFor) {
  const auto shape = a_y();
  AxesRequest request;
  request.sources = {Vec3(0.0, 0.0, -18.0)};
  request.targets = {shape.tubes[1].axis.points.back()};
  const LumenAxes closed = lumen_axes(closed_y(), request);
  EXPECT_EQ(geometry::ends(closed.tree).size(), 1u);
  ASSERT_EQ(closed.told.size(), 1u);
  EXPECT_NE(closed.told[0].find("stays closed"), std::string::npos);
  request.side_branches = SideBranches::axes;
  const LumenAxes axes = lumen_axes(closed_y(), request);
  EXPECT_EQ(geometry::ends(axes.tree).size(), 2u);
  ASSERT_EQ(axes.told.size(), 1u);
  EXPECT_NE(axes.told[0].find("side_1"), std::string::npos);
  EXPECT_TRUE(axes.stubs.empty());
  request.side_branches = SideBranches::stubs;
  const LumenAxes stubs = lumen_axes(closed_y(), request);
  ASSERT_EQ(stubs.stubs.size(), 1u);
  EXPECT_EQ(stubs.stubs[0].end, "outlet_side_1");
  request.side_branches = SideBranches::asked_only;
  EXPECT_EQ(geometry::ends(lumen_axes(closed_y(), request).tree).size(), 1u);
}

TEST(LumenAxes, ATargetBeforeItsBranchsEndMeansTheBranch) {
  const auto shape = a_y();
  AxesRequest request;
  request.sources = {Vec3(0.0, 0.0, -18.0)};
  for (const std::size_t tube : {1u, 2u}) {
    const auto& points = shape.tubes[tube].axis.points;
    request.targets.push_back(points[points.size() * 2 / 3]);
  }
  EXPECT_EQ(geometry::ends(lumen_axes(closed_y(), request).tree).size(), 2u);
}

TEST(LumenAxes, CompletesAxesThatAreKnown) {
  AxesRequest all;
  const LumenAxes axes = lumen_axes(open_y(), all);
  EXPECT_FALSE(with_side_branches(open_y(), axes.tree, {})) << "they come to all ends";
  AxesRequest one;
  one.sources = {a_y().tubes[0].axis.points.front()};
  one.targets = {a_y().tubes[1].axis.points.back()};
  one.target_names = {"LAD"};
  one.side_branches = SideBranches::asked_only;
  const LumenAxes part = lumen_axes(open_y(), one);
  ASSERT_EQ(part.tree.vessels.size(), 1u);
  EXPECT_EQ(part.tree.vessels[0].name, "LAD");
  const auto completed = with_side_branches(open_y(), part.tree, {});
  ASSERT_TRUE(completed);
  EXPECT_EQ(geometry::ends(completed->tree).size(), 2u);
  EXPECT_EQ(std::ranges::count(completed->tree.vessels, "LAD", &geometry::Vessel::name), 1);
  EXPECT_EQ(std::ranges::count(completed->tree.vessels, "side_1", &geometry::Vessel::name), 1);
}

}  // namespace
}  // namespace ostia::pipeline
