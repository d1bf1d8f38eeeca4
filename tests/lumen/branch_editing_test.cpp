#include "tried_edits.h"
#include "vessel_trees.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"
#include "ostia/lumen/edit.h"
#include "ostia/lumen/start_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

namespace ostia::lumen {
namespace {

using testing::applied;
using testing::expect_refused;
using testing::straight_vessel;
using testing::tree_of;

LumenModel branch_editing_straight() {
  return model_of_tubes(straight_vessel(40.0, 1.8));
}
LumenModel branch_editing_coronary() {
  static const LumenModel model = model_of_tubes(tree_of(geometry::coronary_like_tree(0.25)));
  return model;
}

BranchAdd side_branch(double z, double angle_deg) {
  BranchAdd add;
  add.parent = 4;
  add.name = "D1";
  const double angle = angle_deg * 3.14159265358979 / 180.0;
  for (int i = 0; i < 8; ++i) {
    add.points.push_back(Vec3(0, 0, z) + (1.0 + 2.0 * i) * Vec3(std::sin(angle), 0, std::cos(angle)));
    add.radius_mm.push_back(1.2 - 0.05 * i);
  }
  return add;
}

TEST(BranchAdd, MakesATubeThatBeginsInsideItsParent) {
  for (const double angle : {35.0, 60.0, 90.0, 110.0}) {
    const LumenModel model = branch_editing_straight();
    const EditOutcome outcome = applied(model, side_branch(20.0, angle));
    ASSERT_EQ(outcome.model.vessels.size(), 2U) << angle;
    EXPECT_EQ(outcome.model.vessels[0], model.vessels[0]);
    const VesselLumen& branch = *outcome.model.vessels[1];
    EXPECT_EQ(outcome.model.tree.vessels[1].name, "D1");
    EXPECT_GT(branch.vessel, 4);
    EXPECT_GT(branch.own_from_mm, 12.0);
    EXPECT_LT(branch.own_from_mm, 20.5);
    for (const SurfaceSample& s : branch.samples) {
      // What begins within the parent stays within it.
      if (s.s_mm <= branch.own_from_mm + 1e-6) {
        EXPECT_LT(std::hypot(s.position.x(), s.position.y()), 1.8) << angle;
      }
    }
    const BranchAdd add = side_branch(20.0, angle);
    for (std::size_t i = 3; i < add.points.size(); ++i) {
      const auto foot = branch.axis->nearest_foot(add.points[i]);
      EXPECT_LT(foot.rho_mm, 0.01) << angle << " " << i;
      EXPECT_NEAR(branch.axis->radius(foot.s_mm), add.radius_mm[i], 0.02);
    }
    ASSERT_EQ(outcome.changes.size(), 1U);
    EXPECT_TRUE(outcome.changes[0].axis_changed);
    EXPECT_EQ(outcome.changes[0].added.size(), branch.samples.size());
  }
}

TEST(BranchAdd, AndDeleteLeaveTheParentAsItWas) {
  const LumenModel model = branch_editing_straight();
  const EditOutcome added = applied(model, side_branch(20.0, 60.0));
  const std::int32_t id = added.model.tree.vessels[1].id;
  const EditOutcome deleted = applied(added.model, BranchDelete{id});
  ASSERT_EQ(deleted.model.vessels.size(), 1U);
  EXPECT_EQ(deleted.model.vessels[0], model.vessels[0]);
  ASSERT_EQ(deleted.changes.size(), 1U);
  EXPECT_EQ(deleted.changes[0].vessel, id);
  EXPECT_EQ(deleted.changes[0].removed.size(), added.model.vessels[1]->samples.size());
  // Its ids do not come back.
  std::set<std::int32_t> used;
  for (const auto& s : added.model.tree.segments) used.insert(s.id);
  for (const auto& n : added.model.tree.nodes) used.insert(n.id);
  used.insert(id);
  const EditOutcome again = applied(deleted.model, side_branch(30.0, 60.0));
  EXPECT_FALSE(used.contains(again.model.tree.vessels.back().id));
  EXPECT_FALSE(used.contains(again.model.tree.segments.back().id));
  EXPECT_GE(again.model.vessels.back()->samples.front().id, added.model.next_sample_id);
}

TEST(BranchAdd, SplitsAnAxisOfFewPointsWhereItIs) {
  const LumenModel model = model_of_tubes(straight_vessel(40.0, 1.8, 5.0));
  const EditOutcome outcome = applied(model, side_branch(23.0, 60.0));
  EXPECT_EQ(outcome.model.tree.segments.size(), 3U);
  EXPECT_NEAR(vessel(outcome.model, 4).axis->length(), 40.0, 1e-6);
  ASSERT_EQ(vessel(outcome.model, 4).samples.size(), model.vessels[0]->samples.size());
  for (std::size_t i = 0; i < model.vessels[0]->samples.size(); ++i)
    EXPECT_EQ(vessel(outcome.model, 4).samples[i].position, model.vessels[0]->samples[i].position);
}

TEST(BranchAdd, OnABranchOfABranch) {
  const LumenModel model = branch_editing_coronary();
  BranchAdd add;
  add.parent = model.tree.vessels[2].id;
  add.name = "twig";
  const auto& axis = *vessel(model, add.parent).axis;
  const double s = vessel(model, add.parent).own_from_mm + 12.0;
  const geometry::Frame frame = axis.frame(s);
  for (int i = 0; i < 6; ++i) {
    add.points.push_back(axis.point(s) + (0.5 + 2.0 * i) * (frame.normal + 0.8 * frame.tangent).normalized());
    add.radius_mm.push_back(0.7);
  }
  const EditOutcome outcome = applied(model, add);
  ASSERT_EQ(outcome.model.tree.vessels.size(), 5U);
  EXPECT_GE(outcome.model.tree.vessels.back().segments.size(), 4U);
  EXPECT_EQ(owner_at(outcome.model.tree, outcome.model.tree.vessels.back().id, s - 5.0), add.parent);
}

/// Elliptic: 1.2 and 0.8 mm.
double oval(double theta) {
  return 0.96 / std::hypot(0.8 * std::cos(theta), 1.2 * std::sin(theta));
}
NewWall oval_wall(int rings) {
  NewWall wall;
  wall.around = 32;
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < wall.around; ++k)
      wall.radius_mm.push_back(oval(2.0 * std::numbers::pi * k / wall.around));
  return wall;
}
/// Where its samples lie about its axis, over the stretch that is not bent by a take-off or an end.
void expect_oval(const VesselLumen& vessel, double from_mm, double to_mm) {
  int seen = 0;
  for (const SurfaceSample& sample : vessel.samples) {
    if (sample.s_mm < from_mm || sample.s_mm > to_mm) continue;
    const geometry::AxisFoot foot = vessel.axis->nearest_foot(sample.position);
    EXPECT_NEAR(foot.rho_mm, oval(foot.theta), 0.02) << sample.s_mm;
    ++seen;
  }
  EXPECT_GT(seen, 20);
}

TEST(BranchAdd, StartsWithTheWallThatItIsGiven) {
  BranchAdd add = side_branch(20.0, 60.0);
  add.wall = oval_wall(30);
  const EditOutcome outcome = applied(branch_editing_straight(), add);
  const VesselLumen& branch = *outcome.model.vessels[1];
  expect_oval(branch, branch.own_from_mm + 3.0, branch.axis->length() - 2.0);
  EXPECT_EQ(digest(applied(branch_editing_straight(), add).model), digest(outcome.model));
}

VesselAdd second_artery() {
  VesselAdd add;
  add.name = "RCA";
  for (int i = 0; i <= 30; ++i) {
    add.points.emplace_back(30.0, 0.02 * i * i, static_cast<double>(i));
    add.radius_mm.push_back(1.0);
  }
  return add;
}

TEST(VesselAdd, BeginsATreeOfItsOwn) {
  const LumenModel model = branch_editing_straight();
  VesselAdd add = second_artery();
  add.wall = oval_wall(60);
  const EditOutcome outcome = applied(model, add);
  ASSERT_EQ(outcome.model.vessels.size(), 2U);
  EXPECT_EQ(outcome.model.vessels[0], model.vessels[0]);
  EXPECT_EQ(outcome.model.tree.vessels[1].name, "RCA");
  EXPECT_EQ(geometry::roots(outcome.model.tree).size(), 2U);
  const VesselLumen& artery = *outcome.model.vessels[1];
  EXPECT_EQ(artery.own_from_mm, 0.0);
  EXPECT_NEAR(artery.axis->length(), geometry::length(add.points), 0.01);
  expect_oval(artery, 2.0, artery.axis->length() - 2.0);
  const EditOutcome deleted = applied(outcome.model, BranchDelete{outcome.model.tree.vessels[1].id});
  ASSERT_EQ(deleted.model.vessels.size(), 1U);
  EXPECT_EQ(deleted.model.vessels[0], model.vessels[0]);
}

TEST(VesselAdd, RefusesWhatCannotBeAVessel) {
  const LumenModel model = branch_editing_straight();
  const auto with = [](const std::function<void(VesselAdd&)>& change) {
    VesselAdd add = second_artery();
    change(add);
    return add;
  };
  expect_refused(model, with([](VesselAdd& a) { a.name = "LAD"; }), {"vessel.add", "LAD", "in use"});
  expect_refused(model, with([](VesselAdd& a) { a.radius_mm.pop_back(); }), {"31 points and 30 radii"});
  expect_refused(model, with([](VesselAdd& a) { a.radius_mm[3] = 0.0; }), {"radius 3", "0.10 mm"});
  expect_refused(model, with([](VesselAdd& a) {
                   a.points.assign(5, geometry::Vec3::Zero());
                   a.radius_mm.assign(5, 1.0);
                 }),
                 {"apart from each other"});
  expect_refused(model, with([](VesselAdd& a) {
                   a.wall = {8, std::vector<double>(15, 1.0)};
                 }),
                 {"two whole rings"});
  expect_refused(model, with([](VesselAdd& a) {
                   a.wall = {4, std::vector<double>(16, 1.0)};
                 }),
                 {"8 to 128 rays"});
  expect_refused(model, with([](VesselAdd& a) {
                   a.wall = {8, std::vector<double>(16, 99.0)};
                 }),
                 {"distance 0 of the wall", "15.00 mm"});
}

TEST(BranchAdd, RefusesWhatCannotBeABranch) {
  const LumenModel model = branch_editing_straight();
  const auto with = [](const std::function<void(BranchAdd&)>& change) {
    BranchAdd add = side_branch(20.0, 60.0);
    change(add);
    return add;
  };
  expect_refused(model, with([](BranchAdd& a) { a.name = "LAD"; }), {"LAD", "in use", "vessel 4"});
  expect_refused(model, with([](BranchAdd& a) { a.name = " "; }), {"name"});
  expect_refused(model, with([](BranchAdd& a) { a.parent = 77; }), {"no vessel 77"});
  expect_refused(model, with([](BranchAdd& a) {
                   a.points.resize(1);
                   a.radius_mm.resize(1);
                 }),
                 {"two points", "1"});
  expect_refused(model, with([](BranchAdd& a) { a.points.assign(8, a.points[0]); }), {"coincide"});
  expect_refused(model, with([](BranchAdd& a) { a.radius_mm.pop_back(); }), {"8 points", "7 radii"});
  expect_refused(model, with([](BranchAdd& a) { a.radius_mm[3] = -1.0; }), {"radius 3"});
  expect_refused(model, with([](BranchAdd& a) { a.points[2].x() = std::nan(""); }), {"finite"});
  expect_refused(model, with([](BranchAdd& a) {
                   for (Vec3& p : a.points) p.y() += 15.0;
                 }),
                 {"from the axis", "10.00 mm"});
  expect_refused(model, with([](BranchAdd& a) {
                   for (Vec3& p : a.points) p.z() += 25.0;
                 }),
                 {"axis.extend"});
}

TEST(BranchDelete, TakesWhatLeavesItAndKeepsTheLast) {
  const LumenModel model = branch_editing_coronary();
  BranchAdd add;
  add.parent = model.tree.vessels[1].id;
  add.name = "twig";
  const auto& axis = *vessel(model, add.parent).axis;
  const double s = vessel(model, add.parent).own_from_mm + 14.0;
  const geometry::Frame frame = axis.frame(s);
  for (int i = 0; i < 6; ++i) {
    add.points.push_back(axis.point(s) + (0.5 + 2.0 * i) * (frame.normal + 0.8 * frame.tangent).normalized());
    add.radius_mm.push_back(0.7);
  }
  const EditOutcome grown = applied(model, add);
  const EditOutcome outcome = applied(grown.model, BranchDelete{add.parent});
  EXPECT_EQ(outcome.model.vessels.size(), 3U);
  EXPECT_EQ(outcome.changes.size(), 2U);
  ASSERT_EQ(outcome.notes.size(), 1U);
  EXPECT_NE(outcome.notes[0].find("twig"), std::string::npos);
  EXPECT_EQ(outcome.model.vessels[0], model.vessels[0]);
  expect_refused(model, BranchDelete{model.tree.vessels[0].id}, {"branch.delete", "last"});
  expect_refused(branch_editing_straight(), BranchDelete{4}, {"last"});
  expect_refused(model, BranchDelete{999}, {"999"});
}

TEST(BranchAttach, JoinsTheVesselElsewhereAndItsSamplesFollow) {
  const LumenModel model = branch_editing_coronary();
  const std::int32_t trunk = model.tree.vessels[0].id, branch = model.tree.vessels[2].id;
  const VesselLumen& before = vessel(model, branch);
  const Vec3 at = vessel(model, trunk).axis->point(before.own_from_mm + 7.0);
  const EditOutcome outcome = applied(model, BranchAttach{branch, trunk, at});
  const VesselLumen& after = vessel(outcome.model, branch);
  EXPECT_EQ(outcome.model.vessels[0], model.vessels[0]);
  EXPECT_GT(after.own_from_mm, before.own_from_mm);
  int stayed = 0;
  for (const SurfaceSample& s : after.samples) {
    const auto foot = after.axis->foot_near(s.position, s.s_mm, 0.5);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->s_mm, s.s_mm, 1e-6);
    if (s.origin != SampleOrigin::cap && s.s_mm > after.own_from_mm + 0.5) {
      EXPECT_NEAR(foot->rho_mm, after.axis->radius(s.s_mm), 0.08) << s.s_mm - after.own_from_mm;
    }
    for (const SurfaceSample& old : before.samples) stayed += old.id == s.id && old.position == s.position;
  }
  EXPECT_GT(stayed, 50);
  // And home again.
  const Vec3 home = before.axis->point(before.own_from_mm);
  const EditOutcome back = applied(outcome.model, BranchAttach{branch, trunk, home});
  EXPECT_NEAR(vessel(back.model, branch).axis->length(), before.axis->length(), 1.0);
}

TEST(BranchAttach, ToALaterVesselChangesTheOrderOfOwners) {
  LumenModel model = branch_editing_straight();
  for (const double z : {17.0, 21.0}) {
    BranchAdd add = side_branch(z, 60.0);
    add.name = z < 20.0 ? "D1" : "D2";
    while (add.points.size() < 15) {
      add.points.push_back(2.0 * add.points.back() - add.points[add.points.size() - 2]);
      add.radius_mm.push_back(0.8);
    }
    model = applied(model, add).model;
  }
  const std::int32_t first = model.tree.vessels[1].id, second = model.tree.vessels[2].id;
  const VesselLumen& target = vessel(model, second);
  const double at = target.own_from_mm + 5.0;
  ASSERT_EQ(owner_at(model.tree, second, at), second);
  const EditOutcome outcome = applied(model, BranchAttach{first, second, target.axis->point(at)});
  const double from = vessel(outcome.model, first).own_from_mm;
  EXPECT_GT(from, target.own_from_mm + 1.0);
  EXPECT_EQ(owner_at(outcome.model.tree, first, from - 0.5), second);
  EXPECT_EQ(outcome.model.vessels.back()->vessel, first);
  EXPECT_EQ(outcome.model.vessels[1], model.vessels[2]);
}

TEST(BranchAttach, RefusesToTearAVesselFarFromWhereItWas) {
  const LumenModel model = branch_editing_coronary();
  const std::int32_t trunk = model.tree.vessels[0].id, branch = model.tree.vessels[1].id;
  const Vec3 far = vessel(model, trunk).axis->point(45.0);
  expect_refused(model, BranchAttach{branch, trunk, far}, {"branch.attach", "would move by", "too far"});
}

TEST(BranchAttach, RefusesLoops) {
  const LumenModel model = branch_editing_coronary();
  const std::int32_t trunk = model.tree.vessels[0].id, branch = model.tree.vessels[1].id;
  const Vec3 on_branch = vessel(model, branch).axis->point(vessel(model, branch).own_from_mm + 8.0);
  expect_refused(model, BranchAttach{trunk, branch, on_branch}, {"branch.attach", "loop"});
  expect_refused(model, BranchAttach{branch, branch, on_branch}, {"loop"});
  expect_refused(model, BranchAttach{branch, 999, on_branch}, {"999"});
  expect_refused(model, BranchAttach{branch, trunk, Vec3(500, 0, 0)}, {"from the axis"});
}

TEST(VesselRename, ChangesTheNameAlone) {
  const LumenModel model = branch_editing_coronary();
  const std::int32_t id = model.tree.vessels[1].id;
  const EditOutcome outcome = applied(model, VesselRename{id, "D1"});
  EXPECT_EQ(outcome.model.tree.vessels[1].name, "D1");
  EXPECT_TRUE(outcome.changes.empty());
  for (std::size_t i = 0; i < model.vessels.size(); ++i)
    EXPECT_EQ(outcome.model.vessels[i], model.vessels[i]);
  EXPECT_EQ(digest(applied(outcome.model, VesselRename{id, model.tree.vessels[1].name}).model),
            digest(model));
  expect_refused(model, VesselRename{id, model.tree.vessels[0].name}, {"in use"});
  expect_refused(model, VesselRename{id, ""}, {"name"});
  expect_refused(model, VesselRename{id, "a\nb"}, {"printable"});
  applied(model, VesselRename{id, model.tree.vessels[1].name});
}

}  // namespace
}  // namespace ostia::lumen
