// Vessels cut off as trees of their own, and connected by new pieces.

#include "edited_walls.h"
#include "tried_edits.h"

#include "ostia/geometry/mesh_topology.h"
#include "ostia/lumen/live_model.h"
#include "ostia/lumen/tree_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace ostia::lumen {
namespace {

using testing::applied;
using testing::axis_of;
using testing::expect_refused;
using testing::forked_model;
using testing::line_of;
using testing::main_vessel;
using testing::pi;
using testing::radius_on_ray;
using testing::side_vessel;

constexpr std::int32_t loose_vessel = 9;

/// A vessel along +z, and beside it a tree of its own that begins at (9, 0, 26) and goes up at 45 degrees.
LumenModel two_trees() {
  geometry::Centerline first = line_of([](double s) { return Vec3(0.0, 0.0, s); }, 40.0, 0.5, 1.8);
  const Vec3 along = Vec3(1.0, 0.0, 1.0).normalized();
  geometry::Centerline second =
      line_of([&](double s) -> Vec3 { return Vec3(9.0, 0.0, 26.0) + s * along; }, 20.0, 0.5, 1.1);
  geometry::VesselTree tree;
  tree.nodes = {{1, first.points.front()},
                {2, first.points.back()},
                {5, second.points.front()},
                {6, second.points.back()}};
  tree.segments = {{3, 1, 2, first}, {7, 5, 6, second}};
  tree.vessels = {{main_vessel, "LAD", {3}}, {loose_vessel, "D1", {7}}};
  return model_of_tubes(tree);
}

std::shared_ptr<const TreeField> field_of(const LumenModel& model) {
  return LiveModel(std::make_shared<const LumenModel>(model)).field();
}

void expect_sound_wall(const LumenModel& model) {
  LiveModel live(std::make_shared<const LumenModel>(model));
  const auto faults = geometry::find_faults(live.wall(0.35), true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
}

/// Positions of a vessel's samples by id, caps left out.
std::map<std::int64_t, Vec3> wall_of(const VesselLumen& lumen) {
  std::map<std::int64_t, Vec3> wall;
  for (const SurfaceSample& s : lumen.samples)
    if (s.origin != SampleOrigin::cap) wall[s.id] = s.position;
  return wall;
}

TEST(BranchCut, WhatLiesBeyondIsATreeOfItsOwnInTheSamePlace) {
  const LumenModel model = testing::bent_model(40.0, 1.6);
  const auto& whole = axis_of(model);
  const EditOutcome outcome = applied(model, BranchCut{main_vessel, 18.1, ""});
  ASSERT_EQ(outcome.model.vessels.size(), 2U);
  EXPECT_EQ(geometry::roots(model.tree).size(), 1U);
  EXPECT_EQ(geometry::roots(outcome.model.tree).size(), 2U);
  const geometry::Vessel& distal = outcome.model.tree.vessels[1];
  EXPECT_EQ(distal.name, "LAD distal");
  EXPECT_EQ(distal.segments.size(), 1U);
  EXPECT_EQ(merge_parent(outcome.model.tree, distal.id), std::nullopt);
  const double cut = axis_of(outcome.model).length();
  EXPECT_NEAR(cut, 18.1, 0.3);
  const VesselLumen& part = vessel(outcome.model, distal.id);
  EXPECT_EQ(part.own_from_mm, 0.0);
  EXPECT_NEAR(part.axis->length(), whole.length() - cut, 1e-3);
  for (double s = 0.0; s < part.axis->length(); s += 0.37) {
    EXPECT_LT((part.axis->point(s) - whole.point(cut + s)).norm(), 0.005) << s;
  }
  for (const SurfaceSample& s : part.samples) {
    if (s.origin == SampleOrigin::cap) continue;
    const auto foot = part.axis->foot_near(s.position, s.s_mm, 0.5);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->s_mm, s.s_mm, 1e-6);
  }
  // No sample of the wall is lost or moved.
  auto parts = wall_of(outcome.model.vessels[0] ? *outcome.model.vessels[0] : part);
  parts.merge(wall_of(part));
  EXPECT_EQ(parts, wall_of(*model.vessels[0]));
  expect_sound_wall(outcome.model);
}

TEST(BranchCut, TheWallStaysWhereItIs) {
  const LumenModel model = testing::bent_model(40.0, 1.6);
  const EditOutcome outcome = applied(model, BranchCut{main_vessel, 15.3, "end"});
  EXPECT_EQ(outcome.model.tree.vessels[1].name, "end");
  const auto before = field_of(model), after = field_of(outcome.model);
  const auto& axis = axis_of(model);
  for (double s = 0.5; s < axis.length() - 0.5; s += 0.5)
    for (int k = 0; k < 8; ++k)
      EXPECT_NEAR(radius_on_ray(*after, axis, s, 0.25 * pi * k),
                  radius_on_ray(*before, axis, s, 0.25 * pi * k), 0.03)
          << s;
}

TEST(BranchCut, BranchesBeyondGoWithIt) {
  const LumenModel model = forked_model();
  const EditOutcome outcome = applied(model, BranchCut{main_vessel, 6.0, ""});
  ASSERT_EQ(outcome.model.vessels.size(), 3U);
  EXPECT_EQ(geometry::roots(outcome.model.tree).size(), 2U);
  const std::int32_t distal = outcome.model.tree.vessels[1].id;
  const VesselLumen &before = vessel(model, side_vessel), &branch = vessel(outcome.model, side_vessel);
  EXPECT_NEAR(branch.axis->length(), before.axis->length() - 6.0, 0.01);
  EXPECT_NEAR(branch.own_from_mm, before.own_from_mm - 6.0, 0.01);
  EXPECT_EQ(wall_of(branch), wall_of(before));
  EXPECT_LT((branch.axis->point(0.0) - axis_of(outcome.model, distal).point(0.0)).norm(), 1e-9);
  // A branch alone, too: the vessel that it left is not touched.
  const EditOutcome twig =
      applied(model, BranchCut{side_vessel, vessel(model, side_vessel).own_from_mm + 8.0, ""});
  EXPECT_EQ(twig.model.vessels[0], model.vessels[0]);
  EXPECT_EQ(geometry::roots(twig.model.tree).size(), 2U);
}

TEST(BranchCut, RefusesPlacesWithoutRoom) {
  const LumenModel model = testing::bent_model(40.0, 1.6);
  for (const double s : {-1.0, 0.0, 1.0, 39.0, 77.0})
    expect_refused(model, BranchCut{main_vessel, s, ""},
                   {"branch.cut on vessel 4 (LAD)", "the place at", "choose"});
  expect_refused(model, BranchCut{99, 20.0, ""}, {"99"});
  expect_refused(model, BranchCut{main_vessel, 20.0, "LAD"}, {"in use"});
}

TEST(BranchConnect, ATreeOfItsOwnBecomesABranchAndStaysWhereItIs) {
  const LumenModel model = two_trees();
  const Vec3 at(0.3, 0.1, 15.0);
  const EditOutcome outcome = applied(model, BranchConnect{loose_vessel, main_vessel, at});
  EXPECT_EQ(geometry::roots(outcome.model.tree).size(), 1U);
  ASSERT_EQ(outcome.model.vessels.size(), 2U);
  EXPECT_EQ(wall_of(vessel(outcome.model, main_vessel)), wall_of(vessel(model, main_vessel)));
  const VesselLumen &before = vessel(model, loose_vessel), &after = vessel(outcome.model, loose_vessel);
  // It leaves the other vessel a bow's leg before the place and leads straight on to where it was.
  EXPECT_GT(after.own_from_mm, 8.0);
  EXPECT_LT(after.own_from_mm, 15.0);
  const double way = (Vec3(9.0, 0.0, 26.0) - Vec3(0.0, 0.0, 15.0)).norm();
  const double added = after.axis->length() - before.axis->length();
  EXPECT_NEAR(added, 15.0 + way, 2.5);
  for (double s = 1.0; s < before.axis->length(); s += 1.0)
    EXPECT_LT((after.axis->point(added + s) - before.axis->point(s)).norm(), 0.05) << s;
  const auto was = wall_of(before), is = wall_of(after);
  std::size_t stayed = 0;
  for (const auto& [id, place] : was) stayed += is.contains(id) && is.at(id) == place ? 1U : 0U;
  EXPECT_GT(stayed, was.size() * 8 / 10);
  // The new piece is a wall as wide as the vessel, all the way; no rounded end is left within it.
  const auto field = field_of(outcome.model);
  for (double s = after.own_from_mm + 8.0; s < added + 5.0; s += 0.5)
    for (int k = 0; k < 8; ++k)
      EXPECT_NEAR(radius_on_ray(*field, *after.axis, s, 0.25 * pi * k), 1.1, 0.25) << s;
  expect_sound_wall(outcome.model);
}

TEST(BranchConnect, UndoesACut) {
  const LumenModel model = testing::bent_model(40.0, 1.6);
  const LumenModel parts = applied(model, BranchCut{main_vessel, 20.0, ""}).model;
  const std::int32_t distal = parts.tree.vessels[1].id;
  const Vec3 at = axis_of(parts).point(16.0);
  const EditOutcome outcome = applied(parts, BranchConnect{distal, main_vessel, at});
  EXPECT_EQ(geometry::roots(outcome.model.tree).size(), 1U);
  EXPECT_NEAR(axis_of(outcome.model, distal).length(), axis_of(model).length(), 0.2);
  expect_sound_wall(outcome.model);
}

TEST(BranchConnect, ABranchLeavesItsParentForAnotherPlaceWithAllThatLeavesIt) {
  LumenModel model = forked_model();
  BranchAdd twig{side_vessel, "twig", {}, {}};
  const VesselLumen& side = vessel(model, side_vessel);
  const geometry::Frame frame = side.axis->frame(side.own_from_mm + 10.0);
  for (int i = 0; i < 6; ++i) {
    twig.points.push_back(side.axis->point(side.own_from_mm + 10.0) +
                          (0.5 + 2.0 * i) * (frame.binormal + 0.8 * frame.tangent).normalized());
    twig.radius_mm.push_back(0.6);
  }
  model = applied(model, twig).model;
  const std::int32_t small = model.tree.vessels.back().id;
  const EditOutcome outcome = applied(model, BranchConnect{side_vessel, main_vessel, Vec3(0.0, 0.0, 6.0)});
  EXPECT_LT(vessel(outcome.model, side_vessel).own_from_mm, 6.1);
  const VesselLumen &before = vessel(model, small), &after = vessel(outcome.model, small);
  EXPECT_EQ(wall_of(after), wall_of(before));
  EXPECT_LT((after.axis->point(after.own_from_mm) - before.axis->point(before.own_from_mm)).norm(), 0.05);
}

TEST(BranchConnect, RefusesLoopsAndPlacesThatAreNone) {
  const LumenModel model = two_trees();
  const Vec3 at(0.0, 0.0, 15.0);
  expect_refused(model, BranchConnect{loose_vessel, loose_vessel, Vec3(9.0, 0.0, 26.0)}, {"loop"});
  expect_refused(model, BranchConnect{loose_vessel, 77, at}, {"no vessel 77"});
  expect_refused(model, BranchConnect{77, main_vessel, at}, {"77"});
  expect_refused(model, BranchConnect{loose_vessel, main_vessel, Vec3(40.0, 0.0, 15.0)}, {"from the axis"});
  expect_refused(model, BranchConnect{loose_vessel, main_vessel, Vec3(0.0, 0.0, 45.0)}, {"distal end"});
  expect_refused(model, BranchConnect{loose_vessel, main_vessel, Vec3(std::nan(""), 0.0, 15.0)}, {"finite"});
  const LumenModel joined = applied(model, BranchConnect{loose_vessel, main_vessel, at}).model;
  expect_refused(joined, BranchConnect{main_vessel, loose_vessel, Vec3(12.0, 0.0, 29.0)},
                 {"branch.connect", "loop"});
}

}  // namespace
}  // namespace ostia::lumen
