#include "ostia/lumen/live_model.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/lumen/start_surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::lumen {
namespace {

geometry::VesselTree straight_vessel(double length_mm, double radius_mm) {
  geometry::Centerline axis;
  for (double z = 0.0; z <= length_mm + 1e-9; z += 0.5) {
    axis.points.push_back({0.0, 0.0, z});
    axis.radius.push_back(radius_mm);
  }
  geometry::complete(axis);
  geometry::VesselTree tree;
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, axis}};
  tree.vessels = {{4, "LAD", {3}}};
  return tree;
}

std::shared_ptr<const LumenModel> tube() {
  return std::make_shared<const LumenModel>(model_of_tubes(straight_vessel(30.0, 1.5)));
}

/// A stroke along the wall in the direction theta = 0, at another distance from the axis.
CprStroke stroke_at(const LumenModel& model, double rho_mm, double from_mm, double to_mm) {
  CprStroke stroke;
  stroke.vessel = 4;
  for (int i = 0; i <= 6; ++i)
    stroke.points.push_back(
        model.vessels[0]->axis->place(from_mm + (to_mm - from_mm) * i / 6.0, 0.0, rho_mm));
  return stroke;
}

TEST(LiveModel, FollowsAnEditLikeAFreshSolution) {
  const auto model = tube();
  LiveModel live(model);
  const EditOutcome outcome = apply(*model, stroke_at(*model, 1.0, 10.0, 18.0));
  const LiveChange change = live.follow(outcome);
  const ImplicitSurface fresh = solve(*outcome.model.vessels[0]);
  const auto& axis = *model->vessels[0]->axis;
  for (double s = 1.0; s < 29.0; s += 0.9) {
    for (double theta = 0.0; theta < 6.0; theta += 0.8) {
      const Vec3 place = axis.place(s, theta, 1.3);
      EXPECT_NEAR(live.surface(4)->value(place), fresh.value(place), 1e-6);
    }
  }
  EXPECT_NEAR(live.surface(4)->value(axis.place(14.0, 0.0, 1.0)), 0.0, 0.02);
  EXPECT_TRUE(change.box.contains(axis.place(14.0, 0.0, 1.0)));
  ASSERT_EQ(change.vessels.size(), 1U);
  EXPECT_FALSE(change.vessels[0].solved_anew);
  EXPECT_LE(change.vessels[0].from_mm, 10.0);
  EXPECT_GE(change.vessels[0].to_mm, 18.0);
}

TEST(LiveModel, TheWallAfterAnEditIsTheWallMadeAnew) {
  const auto model = tube();
  LiveModel live(model);
  const double before = geometry::volume(live.wall(0.4));
  const EditOutcome outcome = apply(*model, stroke_at(*model, 1.0, 10.0, 18.0));
  live.follow(outcome);
  const geometry::TriMesh after = live.wall(0.4);
  LiveModel fresh(std::make_shared<const LumenModel>(outcome.model));
  const geometry::TriMesh anew = fresh.wall(0.4);
  EXPECT_EQ(after.triangles.size(), anew.triangles.size());
  // What an edit has not visibly changed is kept.
  EXPECT_NEAR(geometry::volume(after), geometry::volume(anew), unseen_mm * geometry::area(anew));
  EXPECT_LT(geometry::volume(after), before - 1.0);
}

TEST(LiveModel, AFailedEditLeavesAllAsItWas) {
  const auto model = tube();
  LiveModel live(model);
  const Vec3 place = model->vessels[0]->axis->place(14.0, 0.0, 1.2);
  const double before = live.surface(4)->value(place);
  EditOutcome outcome = apply(*model, stroke_at(*model, 1.0, 10.0, 18.0));
  outcome.changes.front().removed.push_back(987654321);  // no such sample
  EXPECT_THROW(live.follow(outcome), Error);
  EXPECT_EQ(live.surface(4)->value(place), before);
  EXPECT_EQ(digest(live.model()), digest(*model));
}

TEST(LiveModel, KnowsItsVessels) {
  LiveModel live(tube());
  EXPECT_THROW(live.surface(99), InvalidInput);
}

}  // namespace
}  // namespace ostia::lumen
