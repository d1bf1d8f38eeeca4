#include "edited_walls.h"
#include "tried_edits.h"
#include "vessel_trees.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/lumen/live_model.h"
#include "ostia/lumen/tree_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace ostia::lumen {
namespace {

using testing::applied;
using testing::axis_of;
using testing::expect_refused;
using testing::forked_model;
using testing::main_vessel;
using testing::pi;
using testing::radius_on_ray;
using testing::side_vessel;

std::shared_ptr<const TreeField> branch_splitting_field_of(const LumenModel& model) {
  return LiveModel(std::make_shared<const LumenModel>(model)).field();
}

/// A bent vessel with an oval, narrowed and drawn wall: nothing about it is the same along it.
LumenModel lumpy_model() {
  LumenModel model = testing::bent_model(40.0, 1.6);
  for (double s = 4.0; s < 37.0; s += 1.0) {
    const auto wall = [](double at, double theta) {
      return 1.6 - 0.6 * std::exp(-0.08 * (at - 17.0) * (at - 17.0)) +
             0.15 * std::cos(2.0 * theta + 0.1 * at);
    };
    model = apply(model, testing::contour_around(axis_of(model), wall, s, 16)).model;
  }
  return model;
}

/// All samples that are no caps, by id.
std::map<std::int64_t, SurfaceSample> walls_of(const LumenModel& model) {
  std::map<std::int64_t, SurfaceSample> all;
  for (const auto& vessel : model.vessels) {
    for (const SurfaceSample& s : vessel->samples)
      if (s.origin != SampleOrigin::cap) all.emplace(s.id, s);
  }
  return all;
}

/// The largest distance that the wall moved, away from the seam and at it; on rays that point no more than
/// `most_x` to +x, where a side branch opens.
struct Moved {
  double away_mm = 0.0, at_seam_mm = 0.0;
};
Moved moved(const LumenModel& before, const LumenModel& after, const geometry::AxisCurve& axis,
            double seam_mm, double near_mm, double most_x = 2.0) {
  const auto was = branch_splitting_field_of(before), is = branch_splitting_field_of(after);
  Moved most;
  for (double s = 0.5; s < axis.length() - 0.5; s += 0.25) {
    for (int k = 0; k < 12; ++k) {
      const double theta = 2.0 * pi * k / 12.0;
      if (axis.place(s, theta, 1.0).x() - axis.point(s).x() > most_x) continue;
      const double by = std::abs(radius_on_ray(*was, axis, s, theta) - radius_on_ray(*is, axis, s, theta));
      double& so_far = std::abs(s - seam_mm) > near_mm ? most.away_mm : most.at_seam_mm;
      so_far = std::max(so_far, by);
    }
  }
  return most;
}

TEST(BranchSplit, MakesTwoVesselsOfOneAxis) {
  const LumenModel model = testing::bent_model(40.0, 1.6);
  const auto& whole = axis_of(model);
  const EditOutcome outcome = applied(model, BranchSplit{main_vessel, 18.1, ""});
  ASSERT_EQ(outcome.model.vessels.size(), 2U);
  const geometry::Vessel& first = outcome.model.tree.vessels[0];
  const geometry::Vessel& second = outcome.model.tree.vessels[1];
  EXPECT_EQ(first.id, main_vessel);
  EXPECT_EQ(first.name, "LAD");
  EXPECT_EQ(second.name, "LAD distal");
  EXPECT_EQ(second.id, outcome.model.next_tree_id - 1);
  const VesselLumen &proximal = *outcome.model.vessels[0], &distal = *outcome.model.vessels[1];
  EXPECT_NEAR(proximal.axis->length(), 18.1, 0.3);
  EXPECT_NEAR(distal.own_from_mm, proximal.axis->length(), 1e-6);
  EXPECT_NEAR(distal.axis->length(), whole.length(), 1e-9);
  for (double s = 0.0; s < 40.0; s += 0.37) {
    EXPECT_LT((distal.axis->point(s) - whole.point(s)).norm(), 1e-9);
    if (s < proximal.axis->length()) {
      EXPECT_LT((proximal.axis->point(s) - whole.point(s)).norm(), 0.002);
    }
  }
  EXPECT_EQ(merge_parent(outcome.model.tree, second.id), main_vessel);
  EXPECT_EQ(merge_parent(outcome.model.tree, main_vessel), std::nullopt);
  ASSERT_EQ(outcome.changes.size(), 2U);
  EXPECT_TRUE(outcome.changes[0].axis_changed);
}

TEST(BranchSplit, GivesEachSampleToThePartItBelongsTo) {
  const LumenModel model = lumpy_model();
  const EditOutcome outcome = applied(model, BranchSplit{main_vessel, 15.0, "mid"});
  const double seam = outcome.model.vessels[0]->axis->length();
  const auto before = walls_of(model), after = walls_of(outcome.model);
  ASSERT_EQ(before.size(), after.size());
  for (const auto& [id, sample] : before) {
    const SurfaceSample& now = after.at(id);
    EXPECT_EQ(now.position, sample.position);
    EXPECT_EQ(now.normal, sample.normal);
    EXPECT_EQ(now.origin, sample.origin);
    EXPECT_NEAR(now.s_mm, sample.s_mm, 0.01);
  }
  for (const SurfaceSample& s : outcome.model.vessels[0]->samples)
    if (s.origin != SampleOrigin::cap) {
      EXPECT_LE(before.at(s.id).s_mm, seam + 1e-3);
    }
  for (const SurfaceSample& s : outcome.model.vessels[1]->samples)
    if (s.origin != SampleOrigin::cap) {
      EXPECT_GE(before.at(s.id).s_mm, seam - 1e-3);
    }
}

TEST(BranchSplit, TheWallStaysWhereItIs) {
  double away = 0.0, at_seam = 0.0;
  for (const bool lumpy : {false, true}) {
    const LumenModel model = lumpy ? lumpy_model() : testing::bent_model(40.0, 1.6);
    for (const double s : {8.0, 15.3, 17.0, 30.0}) {
      const EditOutcome outcome = applied(model, BranchSplit{main_vessel, s, ""});
      const double seam = outcome.model.vessels[0]->axis->length();
      const Moved most = moved(model, outcome.model, axis_of(model), seam, 3.0);
      away = std::max(away, most.away_mm);
      at_seam = std::max(at_seam, most.at_seam_mm);
      EXPECT_LT(most.away_mm, 0.01) << s << " " << lumpy;
      EXPECT_LT(most.at_seam_mm, 0.03) << s << " " << lumpy;
    }
  }
  RecordProperty("away_um", std::to_string(1000.0 * away));
  RecordProperty("at_seam_um", std::to_string(1000.0 * at_seam));
}

TEST(BranchSplit, TheWallStaysWhereItIsBesideASideBranch) {
  const LumenModel model = forked_model();
  for (const double s : {8.0, 11.0, 12.0, 14.0, 17.0}) {
    const EditOutcome outcome = applied(model, BranchSplit{main_vessel, s, ""});
    const Moved most = moved(model, outcome.model, axis_of(model), s, 3.0, 0.1);
    EXPECT_LT(most.away_mm, 0.01) << s;
    EXPECT_LT(most.at_seam_mm, 0.04) << s;
  }
}

TEST(BranchSplit, SideBranchesBeyondLeaveTheNewVessel) {
  const LumenModel model = forked_model();  // a side branch at 12 mm
  const EditOutcome proximal = applied(model, BranchSplit{main_vessel, 6.0, ""});
  ASSERT_EQ(proximal.model.vessels.size(), 3U);
  const std::int32_t made = proximal.model.tree.vessels[1].id;
  EXPECT_EQ(owner_at(proximal.model.tree, side_vessel, 3.0), main_vessel);
  EXPECT_EQ(owner_at(proximal.model.tree, side_vessel, 9.0), made);
  EXPECT_EQ(vessel(proximal.model, side_vessel).samples.size(), vessel(model, side_vessel).samples.size());
  EXPECT_EQ(applied(proximal.model, BranchDelete{made}).model.vessels.size(), 1U);

  const EditOutcome distal = applied(model, BranchSplit{main_vessel, 20.0, ""});
  EXPECT_EQ(owner_at(distal.model.tree, side_vessel, 9.0), main_vessel);
  EXPECT_EQ(applied(distal.model, BranchDelete{distal.model.tree.vessels[1].id}).model.vessels.size(), 2U);
  // Where the branch leaves: it then leaves the end of the one and the beginning of the other.
  const EditOutcome joint = applied(model, BranchSplit{main_vessel, 12.0, ""});
  EXPECT_EQ(joint.model.tree.segments.size(), model.tree.segments.size());
  const EditOutcome side = applied(model, BranchSplit{side_vessel, 20.0, ""});
  EXPECT_EQ(merge_parent(side.model.tree, side.model.tree.vessels[2].id), side_vessel);
}

TEST(BranchMerge, UndoesASplit) {
  for (const double s : {7.0, 12.0, 14.6, 21.0}) {
    for (const LumenModel& model : {forked_model(), lumpy_model()}) {
      const EditOutcome split = applied(model, BranchSplit{main_vessel, s, ""});
      const EditOutcome merged = applied(split.model, BranchMerge{split.model.tree.vessels[1].id});
      ASSERT_EQ(merged.model.tree.vessels.size(), model.tree.vessels.size());
      EXPECT_EQ(merged.model.tree.segments.size(), model.tree.segments.size());
      EXPECT_EQ(merged.model.tree.vessels[0].name, "LAD");
      for (std::size_t v = 0; v < model.vessels.size(); ++v) {
        const VesselLumen &was = *model.vessels[v], &is = *merged.model.vessels[v];
        EXPECT_EQ(is.vessel, was.vessel);
        EXPECT_NEAR(is.axis->length(), was.axis->length(), 1e-9);
        for (double at = 0.0; at < was.axis->length(); at += 0.7) {
          EXPECT_LT((is.axis->point(at) - was.axis->point(at)).norm(), 1e-9);
          EXPECT_LT((is.axis->frame(at).normal - was.axis->frame(at).normal).norm(), 1e-9);
        }
        EXPECT_EQ(is.interpolation.support_radius_mm, was.interpolation.support_radius_mm);
        ASSERT_EQ(is.samples.size(), was.samples.size());
        std::map<std::int64_t, SurfaceSample> now;
        for (const SurfaceSample& sample : is.samples) now.emplace(sample.id, sample);
        for (const SurfaceSample& sample : was.samples) {
          ASSERT_TRUE(now.contains(sample.id));
          EXPECT_EQ(now.at(sample.id).position, sample.position);
          EXPECT_EQ(now.at(sample.id).normal, sample.normal);
          EXPECT_EQ(now.at(sample.id).origin, sample.origin);
          EXPECT_NEAR(now.at(sample.id).s_mm, sample.s_mm, 1e-6);
        }
      }
    }
  }
}

TEST(BranchMerge, AnAxisOfFewPointsKeepsItsCourse) {
  const LumenModel model = model_of_tubes(testing::straight_vessel(40.0, 1.8, 5.0));
  const EditOutcome split = applied(model, BranchSplit{main_vessel, 17.3, ""});
  EXPECT_NEAR(split.model.vessels[0]->axis->length(), 17.3, 1e-6);
  const EditOutcome merged = applied(split.model, BranchMerge{split.model.tree.vessels[1].id});
  EXPECT_EQ(merged.model.tree.segments.size(), 1U);
  EXPECT_NEAR(merged.model.vessels[0]->axis->length(), 40.0, 1e-6);
  EXPECT_EQ(walls_of(merged.model).size(), walls_of(model).size());
}

TEST(BranchMerge, ThreePartsBecomeOneInAnyOrder) {
  const LumenModel model = lumpy_model();
  LumenModel parts = applied(model, BranchSplit{main_vessel, 12.0, "mid"}).model;
  const std::int32_t mid = parts.tree.vessels[1].id;
  parts = applied(parts, BranchSplit{mid, 25.0, "end"}).model;
  const std::int32_t end = parts.tree.vessels[2].id;
  EXPECT_EQ(merge_parent(parts.tree, end), mid);
  EXPECT_EQ(merge_parent(parts.tree, mid), main_vessel);
  for (const auto& order : {std::pair{end, mid}, std::pair{mid, end}}) {
    LumenModel one = applied(parts, BranchMerge{order.first}).model;
    one = applied(one, BranchMerge{order.second}).model;
    ASSERT_EQ(one.vessels.size(), 1U);
    EXPECT_EQ(testing::ids_of(one.vessels[0]->samples), testing::ids_of(model.vessels[0]->samples));
    EXPECT_EQ(
        testing::difference(testing::geometry_of(*one.vessels[0]), testing::geometry_of(*model.vessels[0])),
        0.0);
  }
}

TEST(BranchSplit, EditsOfThePartsAndTheLiveModelFollow) {
  LumenModel model = lumpy_model();
  LiveModel live(std::make_shared<const LumenModel>(model));
  std::mt19937 random(7);
  const auto follow = [&](const Edit& edit) {
    live.follow(apply(live.model(), edit));
    EXPECT_EQ(find_fault(live.model()), std::nullopt);
  };
  follow(BranchSplit{main_vessel, 20.0, "distal"});
  const std::int32_t distal = live.model().tree.vessels[1].id;
  for (int i = 0; i < 6; ++i) {
    const std::int32_t id = i % 2 ? distal : main_vessel;
    const VesselLumen& part = vessel(live.model(), id);
    std::vector<SurfaceSample> wall;
    for (const SurfaceSample& s : part.samples)
      if (s.origin != SampleOrigin::cap) wall.push_back(s);
    const SurfaceSample& sample = wall[random() % wall.size()];
    follow(WallDrag{id, sample.position, sample.position + 0.2 * sample.normal, 3.0});
  }
  follow(AxisMove{distal, vessel(live.model(), distal).axis->point(21.0),
                  vessel(live.model(), distal).axis->point(21.0) + Vec3(0.0, 0.3, 0.2), 6.0});
  const auto solved_anew = branch_splitting_field_of(live.model());
  const auto& axis = *vessel(live.model(), distal).axis;
  for (double s = 1.0; s < axis.length() - 1.0; s += 0.7)
    for (const double theta : {0.0, 2.0, 4.0})
      EXPECT_NEAR(radius_on_ray(*live.field(), axis, s, theta), radius_on_ray(*solved_anew, axis, s, theta),
                  0.01);
  const auto walls = walls_of(live.model());
  follow(BranchMerge{distal});
  ASSERT_EQ(live.model().vessels.size(), 1U);
  const auto after = walls_of(live.model());
  ASSERT_EQ(after.size(), walls.size());
  for (const auto& [id, sample] : walls) EXPECT_EQ(after.at(id).position, sample.position);
}

/// One random split, join or pull; false where it was refused.
bool random_step(LumenModel& model, std::mt19937& random) {
  const VesselLumen& part = *model.vessels[random() % model.vessels.size()];
  const double share = static_cast<double>(random() % 1000) / 1000.0;
  const double s = part.own_from_mm + share * (part.axis->length() - part.own_from_mm);
  const SurfaceSample& sample = part.samples[random() % part.samples.size()];
  Edit edit = BranchSplit{part.vessel, s, ""};
  const auto kind = random() % 4;
  if (kind == 2) edit = BranchMerge{part.vessel};
  if (kind == 3) edit = WallDrag{part.vessel, sample.position, sample.position + 0.15 * sample.normal, 2.0};
  try {
    EditOutcome outcome = lumen::apply(model, edit);
    EXPECT_EQ(find_fault(outcome.model), std::nullopt);
    if (kind < 3) {
      EXPECT_EQ(walls_of(outcome.model).size(), walls_of(model).size());
    }
    model = std::move(outcome.model);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

TEST(BranchSplit, RandomSplitsJoinsAndPullsLoseNothing) {
  const LumenModel start = model_of_tubes(testing::tree_of(geometry::coronary_like_tree(0.25)));
  std::set<std::int32_t> known;
  for (const auto& vessel : start.vessels) known.insert(vessel->vessel);
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::mt19937 random(seed);
    LumenModel model = start;
    int done = 0;
    for (int step = 0; step < 40; ++step) done += random_step(model, random) ? 1 : 0;
    EXPECT_GT(done, 15) << seed;
    LiveModel live(std::make_shared<const LumenModel>(model));
    const auto faults = geometry::find_faults(live.wall(0.35), true);
    EXPECT_TRUE(faults.closed_manifold()) << seed << " " << faults.summary();
    const auto walls = walls_of(model);
    for (bool joined = true; joined;) {
      joined = false;
      for (const auto& vessel : model.vessels) {
        if (known.contains(vessel->vessel) || !merge_parent(model.tree, vessel->vessel)) continue;
        model = applied(model, BranchMerge{vessel->vessel}).model;
        joined = true;
        break;
      }
    }
    const auto after = walls_of(model);
    ASSERT_EQ(after.size(), walls.size()) << seed;
    for (const auto& [id, sample] : walls) EXPECT_EQ(after.at(id).position, sample.position);
    // A join may have taken a vessel's name for another's: at most as many are left as there were.
    EXPECT_LE(model.vessels.size(), start.vessels.size()) << seed;
  }
}

TEST(BranchSplit, RefusesPlacesWithoutRoomForBothParts) {
  const LumenModel model = testing::bent_model(40.0, 1.6);
  for (const double s : {-1.0, 0.0, 1.0, 39.0, 40.0, 77.0})
    expect_refused(model, BranchSplit{main_vessel, s, ""},
                   {"branch.split on vessel 4 (LAD)", "the place at", "choose", "mm to"});
  expect_refused(model, BranchSplit{main_vessel, std::nan(""), ""}, {"the place at nan"});
  expect_refused(model, BranchSplit{99, 20.0, ""}, {"99"});
  expect_refused(model, BranchSplit{main_vessel, 20.0, "LAD"}, {"in use"});
  expect_refused(model, BranchSplit{main_vessel, 20.0, "a\nb"}, {"printable"});
  expect_refused(forked_model(), BranchSplit{side_vessel, 6.0, ""}, {"own stretch", "choose"});
  const LumenModel tiny = model_of_tubes(testing::straight_vessel(4.0, 1.8));
  expect_refused(tiny, BranchSplit{main_vessel, 2.0, ""}, {"too short to be split"});
}

TEST(BranchMerge, RefusesWhatDoesNotGoOnFromAnEnd) {
  expect_refused(forked_model(), BranchMerge{side_vessel}, {"branch.merge on vessel 7 (D1)", "another ends"});
  expect_refused(forked_model(), BranchMerge{main_vessel}, {"branch.merge on vessel 4 (LAD)"});
  expect_refused(forked_model(), BranchMerge{55}, {"55"});
  const LumenModel parts = apply(testing::bent_model(40.0, 1.6), BranchSplit{main_vessel, 20.0, ""}).model;
  AxisExtend extend{main_vessel, {parts.vessels[0]->axis->point(20.0) + Vec3(0.0, 0.0, 3.0)}};
  expect_refused(parts, extend, {"axis.extend", "LAD distal", "goes on from its end"});
}

}  // namespace
}  // namespace ostia::lumen
