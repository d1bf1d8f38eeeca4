#include "tried_edits.h"
#include "vessel_trees.h"

#include "ostia/core/error.h"
#include "ostia/lumen/edit.h"
#include "ostia/lumen/start_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace ostia::lumen {
namespace {

using testing::expect_refused;
using testing::straight_vessel;
using testing::tree_of;

LumenModel straight() {
  return model_of_tubes(straight_vessel(30.0, 1.5));
}
LumenModel coronary() {
  static const LumenModel model = model_of_tubes(tree_of(geometry::coronary_like_tree(0.25)));
  return model;
}

/// An edit that must leave a sound model and account for all samples in its changes.
EditOutcome applied_soundly(const LumenModel& model, const Edit& edit) {
  const std::string before = digest(model);
  EditOutcome outcome = apply(model, edit);
  EXPECT_EQ(digest(model), before);
  EXPECT_EQ(find_fault(outcome.model), std::nullopt);
  EXPECT_EQ(digest(apply(model, edit).model), digest(outcome.model));
  for (const VesselChange& change : outcome.changes) {
    EXPECT_TRUE(change.axis_changed);
    std::map<std::int64_t, SurfaceSample> samples;
    for (const auto& v : model.vessels) {
      if (v->vessel != change.vessel) continue;
      for (const SurfaceSample& s : v->samples) samples.emplace(s.id, s);
    }
    for (const std::int64_t id : change.removed) EXPECT_EQ(samples.erase(id), 1U);
    for (const SurfaceSample& s : change.added) EXPECT_TRUE(samples.emplace(s.id, s).second);
    const auto now = std::find_if(outcome.model.vessels.begin(), outcome.model.vessels.end(),
                                  [&](const auto& v) { return v->vessel == change.vessel; });
    if (now == outcome.model.vessels.end()) {
      EXPECT_TRUE(samples.empty());
      continue;
    }
    EXPECT_EQ(samples.size(), (*now)->samples.size());
    for (const SurfaceSample& s : (*now)->samples) {
      EXPECT_TRUE(samples.contains(s.id));
      EXPECT_EQ(samples[s.id].position, s.position);
      EXPECT_EQ(samples[s.id].s_mm, s.s_mm);
    }
  }
  return outcome;
}

const SurfaceSample& sample(const LumenModel& model, std::int32_t vessel_id, std::int64_t id) {
  for (const SurfaceSample& s : vessel(model, vessel_id).samples) {
    if (s.id == id) return s;
  }
  throw InvalidInput("no sample " + std::to_string(id));
}

double worst_foot_error(const VesselLumen& lumen) {
  double worst = 0.0;
  for (const SurfaceSample& s : lumen.samples) {
    const auto foot = lumen.axis->foot_near(s.position, s.s_mm, 0.5);
    worst = std::max(worst, foot ? std::abs(foot->s_mm - s.s_mm) : 9.0);
  }
  return worst;
}

TEST(AxisMove, TakesTheWallWithIt) {
  const LumenModel model = straight();
  const AxisMove move{4, Vec3(0, 0, 15), Vec3(1.2, 0.5, 15), 8.0};
  const EditOutcome outcome = applied_soundly(model, move);
  const VesselLumen &before = *model.vessels[0], &after = *outcome.model.vessels[0];
  EXPECT_LT((after.axis->nearest_foot(Vec3(1.2, 0.5, 15)).rho_mm), 1e-3);
  EXPECT_GT(after.axis->length(), before.axis->length());
  ASSERT_EQ(after.samples.size(), before.samples.size());
  int moved = 0, still = 0;
  for (const SurfaceSample& s : before.samples) {
    const SurfaceSample& now = sample(outcome.model, 4, s.id);
    if (std::abs(s.s_mm - 15.0) > 8.0) {
      EXPECT_EQ(now.position, s.position);
      EXPECT_EQ(now.normal, s.normal);
      ++still;
    }
    if (std::abs(s.s_mm - 15.0) < 0.3) {
      EXPECT_LT((now.position - s.position - Vec3(1.2, 0.5, 0)).norm(), 0.06);
      ++moved;
    }
    if (s.origin == SampleOrigin::cap) continue;
    // The vessel stays as wide as it was, and its wall faces outwards.
    EXPECT_NEAR(after.axis->nearest_foot(now.position).rho_mm, 1.5, 0.03);
    EXPECT_GT(now.normal.dot(now.position - after.axis->point(now.s_mm)), 1.4);
  }
  EXPECT_GT(moved, 5);
  EXPECT_GT(still, 100);
  EXPECT_LT(worst_foot_error(after), 1e-6);
  EXPECT_EQ(after.interpolation.support_radius_mm, before.interpolation.support_radius_mm);
}

TEST(AxisMove, MovedBackIsNearlyAsBefore) {
  const LumenModel model = straight();
  const Vec3 a(0, 0, 15), b(0.8, -0.4, 15);
  const EditOutcome there = applied_soundly(model, AxisMove{4, a, b, 6.0});
  const EditOutcome back = applied_soundly(there.model, AxisMove{4, b, a, 6.0});
  for (const SurfaceSample& s : model.vessels[0]->samples) {
    const SurfaceSample& now = sample(back.model, 4, s.id);
    EXPECT_LT((now.position - s.position).norm(), 0.06) << s.s_mm;
    EXPECT_GT(now.normal.dot(s.normal), 0.995);
    EXPECT_NEAR(now.s_mm, s.s_mm, 0.06);
  }
}

TEST(AxisMove, MovesAnAxisOfFewPoints) {
  const LumenModel model = model_of_tubes(straight_vessel(30.0, 1.5, 6.0));
  const EditOutcome outcome = applied_soundly(model, AxisMove{4, Vec3(0, 0, 15), Vec3(1.0, 0, 15), 4.0});
  const auto& axis = *outcome.model.vessels[0]->axis;
  EXPECT_LT(axis.nearest_foot(Vec3(1.0, 0, 15)).rho_mm, 0.02);
  EXPECT_LT(std::abs(axis.point(9.0).x()), 0.02);
}

TEST(AxisMove, AtAJunctionTakesAllBranchesAlong) {
  const LumenModel model = coronary();
  const std::int32_t trunk = model.tree.vessels[0].id, branch = model.tree.vessels[1].id;
  const double at = vessel(model, branch).own_from_mm;
  const Vec3 from = vessel(model, trunk).axis->point(at), to = from + Vec3(0.0, 0.7, 0.3);
  const EditOutcome outcome = applied_soundly(model, AxisMove{trunk, from, to, 6.0});
  EXPECT_EQ(outcome.changes.size(), 4U);
  for (const auto& lumen : outcome.model.vessels) EXPECT_LT(worst_foot_error(*lumen), 1e-6);
  const auto& moved = vessel(outcome.model, branch);
  EXPECT_LT((moved.axis->point(moved.own_from_mm) - to).norm(), 0.02);
  for (const SurfaceSample& s : vessel(model, branch).samples) {
    const SurfaceSample& now = sample(outcome.model, branch, s.id);
    if (s.s_mm > at + 6.5) {
      EXPECT_EQ(now.position, s.position);
    }
    if (std::abs(s.s_mm - at) < 0.2) {
      EXPECT_LT((now.position - s.position - (to - from)).norm(), 0.05);
    }
  }
  // Vessels that leave farther on keep their walls; their abscissas count from the root.
  const std::int32_t third = model.tree.vessels[3].id;
  for (const SurfaceSample& s : vessel(model, third).samples)
    EXPECT_EQ(sample(outcome.model, third, s.id).position, s.position);
}

TEST(AxisMove, OnABranchLeavesOtherVesselsAsTheyAre) {
  const LumenModel model = coronary();
  const std::int32_t branch = model.tree.vessels[2].id;
  const Vec3 from = vessel(model, branch).axis->point(vessel(model, branch).own_from_mm + 15.0);
  const EditOutcome outcome = applied_soundly(model, AxisMove{branch, from, from + Vec3(0.4, 0, 0.4), 5.0});
  ASSERT_EQ(outcome.changes.size(), 1U);
  EXPECT_EQ(outcome.model.vessels[0], model.vessels[0]);
  EXPECT_EQ(outcome.model.vessels[1], model.vessels[1]);
  EXPECT_NE(outcome.model.vessels[2], model.vessels[2]);
}

TEST(AxisMove, InATightBendSamplesStayOnTheirSide) {
  // A hairpin narrower than the vessel is wide on its inner side: many samples are nearer to the other leg.
  geometry::Centerline line;
  for (double z = -15.0; z < 0.0; z += 0.25) line.points.push_back({1.6, 0.0, z});
  for (double a = 0.0; a < 3.14; a += 0.12)
    line.points.push_back({1.6 * std::cos(a), 0.0, 1.6 * std::sin(a)});
  for (double z = 0.0; z > -15.0; z -= 0.25) line.points.push_back({-1.6, 0.0, z});
  line.radius.assign(line.points.size(), 1.4);
  const LumenModel model = model_of_tubes(tree_of(line));
  const VesselLumen& before = *model.vessels[0];
  const Vec3 top = before.axis->point(0.5 * before.axis->length());
  const EditOutcome outcome = applied_soundly(model, AxisMove{4, top, top + Vec3(0.0, 0.6, 0.4), 6.0});
  const VesselLumen& after = *outcome.model.vessels[0];
  const double longer = after.axis->length() - before.axis->length();
  ASSERT_GT(longer, 0.0);
  ASSERT_LT(longer, 2.0);
  for (const SurfaceSample& s : before.samples) {
    const SurfaceSample& now = sample(outcome.model, 4, s.id);
    EXPECT_GT(now.s_mm, s.s_mm - 0.8);
    EXPECT_LT(now.s_mm, s.s_mm + longer + 0.8);
  }
}

TEST(AxisMove, RefusesFoldsAndFarPlaces) {
  const LumenModel model = straight();
  expect_refused(model, AxisMove{4, Vec3(0, 0, 15), Vec3(4, 0, 15), 3.0}, {"axis.move", "LAD", "reach"});
  expect_refused(model, AxisMove{4, Vec3(0, 0, 15), Vec3(0.7, 0, 15), 1.0}, {"axis.move", "kink"});
  expect_refused(model, AxisMove{4, Vec3(20, 0, 15), Vec3(21, 0, 15), 3.0}, {"20.00 mm", "from the axis"});
  expect_refused(model, AxisMove{4, Vec3(0, 0, 15), Vec3(0, 0, 15.5), 0.0}, {"reach"});
  expect_refused(model, AxisMove{4, Vec3(0, std::nan(""), 15), Vec3(0, 0, 15.5), 3.0}, {"finite"});
  expect_refused(model, AxisMove{5, Vec3(0, 0, 15), Vec3(0, 0, 15.5), 3.0}, {"no vessel 5"});
}

TEST(AxisInsert, BendsTheAxisToThePointAndLeavesTheWall) {
  const LumenModel model = straight();
  const Vec3 point(0.4, 0.2, 12.1);
  const EditOutcome outcome = applied_soundly(model, AxisInsert{4, point});
  const VesselLumen& after = *outcome.model.vessels[0];
  EXPECT_LT(after.axis->nearest_foot(point).rho_mm, 1e-6);
  EXPECT_LT(worst_foot_error(after), 1e-6);
  EXPECT_LT((after.axis->point(6.0) - Vec3(0, 0, 6)).norm(), 0.05);
  for (const SurfaceSample& s : model.vessels[0]->samples) {
    EXPECT_EQ(sample(outcome.model, 4, s.id).position, s.position);
    EXPECT_EQ(sample(outcome.model, 4, s.id).normal, s.normal);
  }
  double sharpest = 0.0;
  for (double s = 0.0; s < after.axis->length(); s += 0.1)
    sharpest = std::max(sharpest, after.axis->curvature_vector(s).norm());
  EXPECT_LT(sharpest, 0.8);
}

TEST(AxisInsert, OnTheAxisChangesNothingButItsPoints) {
  const LumenModel model = straight();
  const EditOutcome outcome = applied_soundly(model, AxisInsert{4, Vec3(0, 0, 12.2)});
  EXPECT_EQ(outcome.model.tree.segments[0].axis.size(), model.tree.segments[0].axis.size() + 1);
  EXPECT_NEAR(outcome.model.vessels[0]->axis->length(), 30.0, 1e-9);
  const EditOutcome again = apply(outcome.model, AxisInsert{4, Vec3(0, 0, 12.2)});
  EXPECT_EQ(digest(again.model), digest(outcome.model));
  ASSERT_EQ(again.notes.size(), 1U);
  const EditOutcome back = applied_soundly(outcome.model, AxisDelete{4, Vec3(0.1, 0, 12.2)});
  EXPECT_EQ(back.model.tree.segments[0].axis.points, model.tree.segments[0].axis.points);
}

TEST(AxisInsert, RefusesPlacesBeyondTheEndsAndFarAway) {
  const LumenModel model = straight();
  expect_refused(model, AxisInsert{4, Vec3(0, 0, 33)}, {"axis.insert", "axis.extend"});
  expect_refused(model, AxisInsert{4, Vec3(0, 14, 12)}, {"14.00 mm"});
}

TEST(AxisDelete, RefusesEndsAndJoints) {
  const LumenModel model = straight();
  expect_refused(model, AxisDelete{4, Vec3(0, 0, 30.1)}, {"axis.delete", "axis.trim"});
  expect_refused(model, AxisDelete{4, Vec3(0, 0, -0.1)}, {"axis.delete"});
  const LumenModel tree = coronary();
  const Vec3 joint =
      vessel(tree, tree.tree.vessels[0].id).axis->point(vessel(tree, tree.tree.vessels[1].id).own_from_mm);
  expect_refused(tree, AxisDelete{tree.tree.vessels[0].id, joint}, {"join"});
  const LumenModel three = model_of_tubes(straight_vessel(8.0, 1.0, 4.0));
  expect_refused(three, AxisDelete{4, Vec3(0, 0, 4)}, {"2 points"});
}

TEST(AxisExtend, RunsOnWithTheLastRadiusAndANewCap) {
  const LumenModel model = straight();
  const EditOutcome outcome =
      applied_soundly(model, AxisExtend{4, {Vec3(0, 0.3, 33), Vec3(0, 1.2, 36), Vec3(0, 2.5, 39)}});
  const VesselLumen& after = *outcome.model.vessels[0];
  EXPECT_GT(after.axis->length(), 39.0);
  EXPECT_LT(worst_foot_error(after), 1e-6);
  int ring = 0, cap = 0;
  for (const SurfaceSample& s : after.samples) {
    const auto foot = after.axis->foot_near(s.position, s.s_mm, 0.5);
    ASSERT_TRUE(foot);
    if (s.s_mm > 1e-9) {
      EXPECT_NEAR(foot->rho_mm, 1.5, 0.03) << s.s_mm;
    }
    ring += s.s_mm > 31.0 && s.origin != SampleOrigin::cap;
    if (s.origin == SampleOrigin::cap && s.s_mm > 1.0) {
      EXPECT_NEAR(s.s_mm, after.axis->length(), 1e-6);
      ++cap;
    }
  }
  EXPECT_GT(ring, 50);
  EXPECT_GT(cap, 4);
  EXPECT_EQ(outcome.model.tree.nodes[1].position, Vec3(0, 2.5, 39));
  // Trimmed where it ended before, it is as it was: the wall in all that was not made anew, to the spacing.
  const EditOutcome back = applied_soundly(outcome.model, AxisTrim{4, 30.0});
  EXPECT_NEAR(back.model.vessels[0]->axis->length(), 30.0, 0.05);
  for (const SurfaceSample& s : model.vessels[0]->samples) {
    if (s.s_mm < 28.5) {
      EXPECT_EQ(sample(back.model, 4, s.id).position, s.position);
    }
  }
}

TEST(AxisExtend, RefusesTurnsAndNothing) {
  const LumenModel model = straight();
  expect_refused(model, AxisExtend{4, {}}, {"axis.extend"});
  expect_refused(model, AxisExtend{4, {Vec3(0, 0, 30)}}, {"axis.extend", "end"});
  expect_refused(model, AxisExtend{4, {Vec3(0, 0, 90)}}, {"60.00 mm"});
  expect_refused(model, AxisExtend{4, {Vec3(0, 0.5, 26)}}, {"axis.extend on vessel 4 (LAD)"});
}

TEST(AxisTrim, ClosesTheVesselThere) {
  const LumenModel model = straight();
  const EditOutcome outcome = applied_soundly(model, AxisTrim{4, 20.25});
  const VesselLumen& after = *outcome.model.vessels[0];
  EXPECT_NEAR(after.axis->length(), 20.25, 0.31);
  const double end = after.axis->length();
  double reach = 0.0;
  int cap = 0;
  for (const SurfaceSample& s : after.samples) {
    EXPECT_LE(s.s_mm, end + 1e-9);
    reach = std::max(reach, s.position.z());
    cap += s.origin == SampleOrigin::cap && s.s_mm > 10.0;
    if (s.origin != SampleOrigin::cap) {
      EXPECT_NEAR(std::hypot(s.position.x(), s.position.y()), 1.5, 1e-6);
    }
  }
  EXPECT_NEAR(reach, end + 1.5, 1e-6);
  EXPECT_GE(cap, 5);
  for (const SurfaceSample& s : after.samples) {
    for (const SurfaceSample& other : after.samples) {
      if (s.id < other.id) {
        EXPECT_GT((s.position - other.position).norm(), 0.3);
      }
    }
  }
}

TEST(AxisTrim, TakesBranchesBeyondAndLeavesThoseBefore) {
  const LumenModel model = coronary();
  const std::int32_t trunk = model.tree.vessels[0].id;
  const EditOutcome outcome = applied_soundly(model, AxisTrim{trunk, 35.0});
  ASSERT_EQ(outcome.model.vessels.size(), 3U);
  EXPECT_EQ(outcome.notes.size(), 1U);
  EXPECT_EQ(outcome.model.vessels[1], model.vessels[1]);
  EXPECT_EQ(outcome.model.vessels[2], model.vessels[2]);
  EXPECT_NEAR(outcome.model.vessels[0]->axis->length(), 35.0, 0.2);
  EXPECT_EQ(outcome.changes.size(), 2U);
  // Ids are never used again.
  EXPECT_GT(outcome.model.next_tree_id, model.next_tree_id);
}

TEST(AxisTrim, RefusesAnotherVesselsStretch) {
  const LumenModel model = coronary();
  expect_refused(model, AxisTrim{model.tree.vessels[1].id, 5.0}, {"axis.trim", "own stretch"});
  expect_refused(model, AxisTrim{model.tree.vessels[0].id, 500.0}, {"axis.trim", "own stretch"});
  expect_refused(model, AxisTrim{model.tree.vessels[0].id, std::nan("")}, {"axis.trim"});
}

}  // namespace
}  // namespace ostia::lumen
