#include "interpolation/constraints.h"

#include "tube_samples.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace ostia::lumen {
namespace {

using testing::bent_axis;
using testing::straight_axis;
using testing::tube_vessel;

double stenosed(double s, double) {
  return 1.5 - 0.9 * std::exp(-std::pow((s - 20.0) / 3.0, 2));
}

bool is_offset(const Constraint& c) {
  return c.key > 0 && c.key % 4 != 0;
}

void expect_same(const std::vector<Constraint>& a, const std::vector<Constraint>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].key, b[i].key);
    ASSERT_EQ(a[i].place, b[i].place);
    ASSERT_EQ(a[i].value, b[i].value);
  }
}

// Some samples near a random place pushed in or out; new ids.
struct Push {
  std::vector<std::int64_t> removed;
  std::vector<SurfaceSample> added;
};
Push random_push(const std::vector<SurfaceSample>& samples, std::mt19937& random, std::int64_t& id,
                 std::size_t count) {
  const Vec3 at = samples[random() % samples.size()].position;
  std::vector<SurfaceSample> near = samples;
  std::sort(near.begin(), near.end(), [&](const SurfaceSample& a, const SurfaceSample& b) {
    return (a.position - at).squaredNorm() < (b.position - at).squaredNorm();
  });
  Push push;
  const double by = 0.3 * static_cast<double>(random() % 1000) / 1000.0 - 0.15;
  for (std::size_t i = 0; i < count; ++i) {
    SurfaceSample sample = near[i];
    push.removed.push_back(sample.id);
    sample.id = id++;
    sample.position += by * sample.normal;
    sample.origin = SampleOrigin::edit;
    push.added.push_back(sample);
  }
  return push;
}

TEST(Constraints, StandInCanonicalOrderWithOneOnTheWallForEachSample) {
  const VesselLumen vessel = tube_vessel(bent_axis(40.0), stenosed);
  const std::vector<Constraint> all = ConstraintSet(vessel).all();
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), constraint_order));
  const auto on_wall = std::count_if(all.begin(), all.end(), [](const Constraint& c) {
    return c.key > 0 && c.key % 4 == 0 && c.value == 0.0;
  });
  EXPECT_EQ(static_cast<std::size_t>(on_wall), vessel.samples.size());
}

TEST(Constraints, AnOffsetsNearestSampleIsItsOwnAlsoWhereTheLumenIsNarrowerThanLambda) {
  for (const double radius : {0.12, 0.2, 0.4, 1.5}) {
    VesselLumen vessel = tube_vessel(
        straight_axis(10.0), [&](double, double) { return radius; }, std::min(1.0, radius));
    vessel.interpolation.support_radius_mm = 1.0;
    int inner = 0;
    for (const Constraint& c : ConstraintSet(vessel).all()) {
      if (!is_offset(c)) continue;
      inner += c.value < 0.0 ? 1 : 0;
      double own = 0.0, nearest = std::numeric_limits<double>::infinity();
      for (const SurfaceSample& sample : vessel.samples) {
        const double d = (sample.position - c.place).norm();
        nearest = std::min(nearest, d);
        if (sample.id == c.key / 4) own = d;
      }
      EXPECT_LE(own, nearest + 1e-12) << "radius " << radius;
      EXPECT_NEAR(own, std::abs(c.value), 1e-12);
      EXPECT_LE(own, std::min(0.25, c.value < 0.0 ? 0.51 * radius : 0.25) + 1e-12);
    }
    EXPECT_GT(inner, 0) << "radius " << radius;
  }
}

TEST(Constraints, LatticeLiesWithinTheLumenAndTellsItsDepth) {
  const double radius = 2.2;
  const VesselLumen vessel = tube_vessel(straight_axis(30.0), [&](double, double) { return radius; });
  int count = 0;
  for (const Constraint& c : ConstraintSet(vessel).all()) {
    if (c.key >= 0 || c.s_mm < 2.0 || c.s_mm > 28.0) continue;
    ++count;
    const double depth = radius - std::hypot(c.place.x(), c.place.y());
    EXPECT_GT(depth, 0.25);
    EXPECT_NEAR(-c.value, depth, 0.2);
  }
  EXPECT_GE(count, 20);
}

TEST(Constraints, LatticeStaysOutsideAWallThatHasLeftItsAxis) {
  VesselLumen vessel = tube_vessel(straight_axis(30.0), [](double, double) { return 1.5; });
  for (SurfaceSample& sample : vessel.samples) sample.position.x() += 4.0;
  for (const Constraint& c : ConstraintSet(vessel).all()) {
    if (c.key >= 0) continue;
    EXPECT_LT((c.place - Vec3(4.0, 0.0, c.place.z())).norm(), 1.5);
  }
}

TEST(Constraints, AfterManyChangesAreThoseMadeAfresh) {
  VesselLumen vessel = tube_vessel(bent_axis(40.0), stenosed);
  ConstraintSet set(vessel);
  std::vector<Constraint> followed = set.all();
  std::mt19937 random(11);
  std::int64_t id = 100000;
  for (int edit = 0; edit < 60; ++edit) {
    Push push = random_push(set.samples(), random, id, 12);
    if (edit % 3 == 1) push.removed.clear();  // they are added beside those that are there
    if (edit % 3 == 2) push.added.clear();
    const ConstraintSet::Difference difference = set.change(push.removed, push.added);
    std::vector<Constraint> kept, next;
    std::set_difference(followed.begin(), followed.end(), difference.removed.begin(),
                        difference.removed.end(), std::back_inserter(kept), constraint_order);
    std::merge(kept.begin(), kept.end(), difference.added.begin(), difference.added.end(),
               std::back_inserter(next), constraint_order);
    followed = next;
    vessel.samples = set.samples();
    expect_same(set.all(), ConstraintSet(vessel).all());
    expect_same(set.all(), followed);
  }
}

TEST(Constraints, OfSamplesOnOnePlaceTheFirstCounts) {
  VesselLumen vessel = tube_vessel(straight_axis(20.0), [](double, double) { return 1.5; });
  const std::vector<Constraint> before = ConstraintSet(vessel).all();
  SurfaceSample twin = vessel.samples[50];
  twin.id = 99999;
  twin.position.x() += 4e-7;
  vessel.samples.push_back(twin);
  expect_same(ConstraintSet(vessel).all(), before);
}

TEST(Constraints, RefuseWhatIsNoSample) {
  const VesselLumen sound = tube_vessel(straight_axis(10.0), [](double, double) { return 1.5; });
  VesselLumen vessel = sound;
  vessel.samples.clear();
  EXPECT_THROW(ConstraintSet{vessel}, InvalidInput);
  vessel = sound;
  vessel.samples[3].position.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ConstraintSet{vessel}, InvalidInput);
  vessel = sound;
  vessel.samples[3].normal *= 2.0;
  EXPECT_THROW(ConstraintSet{vessel}, InvalidInput);
  vessel = sound;
  vessel.samples[3].id = vessel.samples[4].id;
  EXPECT_THROW(ConstraintSet{vessel}, InvalidInput);
  vessel = sound;
  vessel.axis = nullptr;
  EXPECT_THROW(ConstraintSet{vessel}, InvalidInput);
}

TEST(Constraints, ARefusedChangeLeavesAllAsItWas) {
  const VesselLumen vessel = tube_vessel(straight_axis(10.0), [](double, double) { return 1.5; });
  ConstraintSet set(vessel);
  const std::vector<Constraint> before = set.all();
  SurfaceSample bad = vessel.samples[0];
  bad.id = 7777;
  bad.position.x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(set.change({987654}, {}), InvalidInput);
  EXPECT_THROW(set.change({vessel.samples[0].id, vessel.samples[0].id}, {}), InvalidInput);
  EXPECT_THROW(set.change({vessel.samples[0].id}, {bad}), InvalidInput);
  EXPECT_THROW(set.change({}, {vessel.samples[0]}), InvalidInput);
  std::vector<std::int64_t> ids;
  for (const SurfaceSample& sample : vessel.samples) ids.push_back(sample.id);
  EXPECT_THROW(set.change(ids, {}), InvalidInput);
  expect_same(set.all(), before);
}

TEST(Constraints, TellWhereTheWallHasAHole) {
  VesselLumen vessel = tube_vessel(straight_axis(40.0), [](double, double) { return 1.5; });
  EXPECT_NO_THROW(ConstraintSet(vessel).check_for_holes());
  std::erase_if(vessel.samples, [](const SurfaceSample& s) { return s.s_mm > 16.5 && s.s_mm < 23.5; });
  const ConstraintSet set(vessel);
  try {
    set.check_for_holes();
    FAIL() << "a wall with a gap of 7 mm is closed by a support radius of "
           << vessel.interpolation.support_radius_mm;
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("16.0"), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(set.check_for_holes({Vec3(1.5, 0.0, 5.0)}));
}

}  // namespace
}  // namespace ostia::lumen
