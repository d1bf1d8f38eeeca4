// Overlap and accuracy of lines whose scores are known.

#include "ostia/evaluation/centerline_scores.h"

#include "ostia/core/error.h"
#include "ostia/evaluation/frame_hint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace ostia::evaluation {
namespace {

using geometry::Vec3;

constexpr double step_mm = 0.03;

/// Along x from 0.
io::RotterdamReference straight(std::size_t points, double radius_mm = 1.5) {
  io::RotterdamReference line;
  for (std::size_t i = 0; i < points; ++i)
    line.points.emplace_back(step_mm * static_cast<double>(i), 0.0, 0.0);
  line.radius.assign(points, radius_mm);
  line.observer_spread.assign(points, 0.2);
  return line;
}

std::vector<Vec3> shifted(std::vector<Vec3> points, const Vec3& by) {
  for (Vec3& p : points) p += by;
  return points;
}

/// Mean length of the pairs of two parallel lines: straight across, and one step on, in turn.
double staircase(double distance_mm) {
  return 0.5 * (distance_mm + std::hypot(distance_mm, step_mm));
}

TEST(CenterlineScores, TheReferenceItselfIsPerfect) {
  const auto reference = straight(1001);
  const CenterlineScores s = score_centerline(reference, reference.points);
  EXPECT_EQ(s.ov, 1.0);
  EXPECT_EQ(s.of, 1.0);
  EXPECT_EQ(s.ot, 1.0);
  // A step goes on in one of the lines alone, so every second pair is a step long: half a step in the mean.
  EXPECT_NEAR(s.ai_mm, 0.5 * step_mm, 1e-4);
  EXPECT_NEAR(s.ai_score, 100.0 - 50.0 * 0.5 * step_mm / 0.2, 0.02);
  EXPECT_FALSE(s.resampled);
}

TEST(CenterlineScores, AParallelLineWithinTheRadiusIsItsDistanceOff) {
  const auto reference = straight(1001);
  const CenterlineScores s = score_centerline(reference, shifted(reference.points, {0.0, 0.4, 0.0}));
  EXPECT_EQ(s.ov, 1.0);
  EXPECT_NEAR(s.ai_mm, staircase(0.4), 1e-5);
  EXPECT_NEAR(s.ai_score, 50.0 * 0.2 / 0.4, 0.05);
}

TEST(CenterlineScores, OutsideTheRadiusNothingCounts) {
  const auto reference = straight(501, 0.5);
  const CenterlineScores s =
      score_centerline(reference, shifted(reference.points, {0.0, 0.6, 0.0}), {.clip = false});
  EXPECT_EQ(s.ov, 0.0);
  EXPECT_EQ(s.of, 0.0);
  EXPECT_TRUE(std::isnan(s.ai_mm));
}

TEST(CenterlineScores, AHalfLineMissesTheRestButTheReachOfItsEnd) {
  const double radius = 1.5;
  const auto reference = straight(2001, radius);
  const std::vector<Vec3> half(reference.points.begin(), reference.points.begin() + 1001);
  const CenterlineScores s = score_centerline(reference, half);
  // The end's ball holds radius / step further points of the reference; the rest is missed.
  const double reach = std::floor(radius / step_mm);
  EXPECT_EQ(s.tpm, 1001u);
  EXPECT_EQ(s.fp, 0u);
  EXPECT_NEAR(static_cast<double>(s.tpr), 1001.0 + reach, 1.0);
  EXPECT_NEAR(s.ov, (2002.0 + reach) / 3002.0, 1e-3);
  EXPECT_NEAR(s.of, (1001.0 + reach) / 2001.0, 1e-3);
}

TEST(CenterlineScores, OtEndsWhereTheVesselIsThin) {
  auto reference = straight(2001);
  for (std::size_t i = 1000; i < reference.radius.size(); ++i) reference.radius[i] = 0.7;
  const std::vector<Vec3> half(reference.points.begin(), reference.points.begin() + 1001);
  const CenterlineScores s = score_centerline(reference, half);
  EXPECT_LT(s.ov, 0.7);
  EXPECT_EQ(s.ot, 1.0);
}

TEST(CenterlineScores, AGapEndsOf) {
  const auto reference = straight(1001);
  std::vector<Vec3> line = reference.points;
  for (std::size_t i = 400; i < 600; ++i) line[i].y() = 3.0;
  const CenterlineScores s = score_centerline(reference, line);
  EXPECT_GT(s.ov, 0.7);
  EXPECT_LT(s.ov, 0.95);
  EXPECT_NEAR(s.of, 0.44, 0.06) << "the pairs nearest to the gap still count";
}

TEST(CenterlineScores, WhatLiesBeforeTheDiscIsCutOff) {
  const auto reference = straight(1001);
  std::vector<Vec3> line;
  for (int i = -400; i <= 1000; ++i) line.emplace_back(step_mm * i, 0.1, 0.0);
  const CenterlineScores s = score_centerline(reference, line);
  EXPECT_EQ(s.clipped_points, 400u);
  EXPECT_EQ(s.ov, 1.0);
  EXPECT_NEAR(s.ai_mm, staircase(0.1), 1e-5);
  EXPECT_LT(score_centerline(reference, line, {.clip = false}).ov, 0.95);
}

TEST(CenterlineScores, ACoarseLineIsResampled) {
  const auto reference = straight(1001);
  std::vector<Vec3> line;
  for (int i = 0; i <= 60; ++i) line.emplace_back(0.5 * i, 0.2, 0.0);
  const CenterlineScores s = score_centerline(reference, line);
  EXPECT_TRUE(s.resampled);
  EXPECT_EQ(s.ov, 1.0);
  EXPECT_NEAR(s.ai_mm, staircase(0.2), 1e-5);
}

TEST(CenterlineScores, WhatGoesOnBeyondTheEndIsFalse) {
  const auto reference = straight(1001);  // its end reaches 50 steps far
  std::vector<Vec3> line = reference.points;
  for (int i = 1001; i <= 1300; ++i) line.emplace_back(step_mm * i, 0.0, 0.0);
  const CenterlineScores s = score_centerline(reference, line);
  EXPECT_DOUBLE_EQ(s.of, 1000.0 / 1001.0) << "a pair fails at the last point";
  EXPECT_EQ(s.ot, 1.0) << "the end was reached";
  EXPECT_EQ(s.fn, 0u);
  EXPECT_NEAR(static_cast<double>(s.fp), 250.0, 1.0);
  EXPECT_NEAR(s.ov, (1001.0 + 1051.0) / 2302.0, 1e-3);
}

TEST(CenterlineScores, SwappedLinesOverlapAsMuch) {
  const auto full = straight(2001), half = straight(1001);
  const CenterlineScores a = score_centerline(full, half.points), b = score_centerline(half, full.points);
  EXPECT_DOUBLE_EQ(a.ov, b.ov);
  EXPECT_EQ(a.fn, b.fp);
  EXPECT_EQ(a.tpr, b.tpm);
  EXPECT_LT(a.of, 0.6);
  EXPECT_DOUBLE_EQ(b.of, 1000.0 / 1001.0);
}

TEST(CenterlineScores, ADetourIsFalseAndTheReferenceIsNotMissed) {
  const auto reference = straight(1001);
  std::vector<Vec3> line(reference.points.begin(), reference.points.begin() + 501);
  for (int k = 1; k <= 200; ++k) line.emplace_back(line[500].x(), step_mm * k, 0.0);
  for (int k = 199; k >= 0; --k) line.emplace_back(line[500].x(), step_mm * k, 0.0);
  line.insert(line.end(), reference.points.begin() + 501, reference.points.end());
  const CenterlineScores s = score_centerline(reference, line, {.rules = OverlapRules::paper});
  EXPECT_EQ(s.of, 1.0);
  EXPECT_NEAR(score_centerline(reference, line).of, 500.0 / 1001.0, 1e-2) << "the challenge sees it stray";
  EXPECT_EQ(s.fn, 0u);
  EXPECT_NEAR(static_cast<double>(s.fp), 299.0, 2.0) << "150 points up and 149 down are beyond 1.5 mm";
  EXPECT_NEAR(s.ov, (1001.0 + 1102.0) / 2402.0, 1e-3);
}

/// Least sum of distances over all monotone paths, by trying every one of them.
double least_sum(const std::vector<Vec3>& a, const std::vector<Vec3>& b, std::size_t i, std::size_t j) {
  const double here = (a[i] - b[j]).norm();
  if (i == 0 && j == 0) return here;
  double best = std::numeric_limits<double>::infinity();
  if (i > 0) best = least_sum(a, b, i - 1, j);
  if (j > 0) best = std::min(best, least_sum(a, b, i, j - 1));
  return here + best;
}

/// A walk of unit steps.
std::vector<Vec3> walk(std::size_t points, std::uint32_t seed) {
  const auto next = [&] {
    seed = seed * 1664525u + 1013904223u;
    return static_cast<double>(seed >> 8) / static_cast<double>(1u << 24) - 0.5;
  };
  std::vector<Vec3> out{Vec3::Zero()};
  while (out.size() < points) {
    const double x = next(), y = next(), z = next();
    out.push_back(out.back() + Vec3(x + 0.2, y, z).normalized());
  }
  return out;
}

TEST(CenterlineScores, NoMonotonePathIsShorter) {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    io::RotterdamReference reference;
    reference.points = walk(2 + seed % 7, seed);
    reference.radius.assign(reference.points.size(), 1.0);
    const std::vector<Vec3> line = walk(2 + (seed / 7) % 7, seed + 1000);
    const CenterlineScores s =
        score_centerline(reference, line, {.clip = false, .direction = LineDirection::as_given});
    double sum = 0.0;
    for (std::size_t k = 0; k < s.pairs.size(); ++k) {
      sum += s.pairs[k].distance_mm;
      if (k == 0) continue;
      const std::size_t steps =
          s.pairs[k].reference - s.pairs[k - 1].reference + s.pairs[k].candidate - s.pairs[k - 1].candidate;
      EXPECT_EQ(steps, 1u) << "never both at once";
    }
    ASSERT_EQ(s.line.size(), line.size()) << "not resampled";
    EXPECT_NEAR(sum, least_sum(reference.points, line, reference.points.size() - 1, line.size() - 1), 1e-9)
        << "seed " << seed;
  }
}

TEST(CenterlineScores, ALineFromItsDistalEndIsTurnedRound) {
  const auto reference = straight(1001);
  std::vector<Vec3> line = shifted(reference.points, {0.0, 0.2, 0.0});
  const CenterlineScores forward = score_centerline(reference, line);
  std::reverse(line.begin(), line.end());
  const CenterlineScores back = score_centerline(reference, line);
  EXPECT_FALSE(forward.turned);
  EXPECT_TRUE(back.turned);
  EXPECT_EQ(back.ov, forward.ov);
  EXPECT_EQ(back.ai_mm, forward.ai_mm);
  EXPECT_LT(score_centerline(reference, line, {.direction = LineDirection::as_given}).ov, 0.2);
}

TEST(CenterlineScores, TheDiscCutsOnlyWhatPassesThroughIt) {
  const auto reference = straight(1001);  // the disc: x = 0, within 3 mm
  std::vector<Vec3> aorta;
  for (int i = -300; i < 0; ++i) aorta.emplace_back(step_mm * i, step_mm * i, 0.0);
  aorta.insert(aorta.end(), reference.points.begin(), reference.points.end());
  EXPECT_EQ(score_centerline(reference, aorta).ov, 1.0);
  std::vector<Vec3> around;  // passes the plane 4 mm away, then comes back beside the vessel
  for (int i = -100; i < 100; ++i) around.emplace_back(step_mm * i, 4.0, 0.0);
  for (const Vec3& p : reference.points)
    if (p.x() > 3.0) around.push_back(p);
  EXPECT_EQ(score_centerline(reference, around).clipped_points, 0u);
}

TEST(CenterlineScores, RepeatedPointsOfACandidateDoNotMatter) {
  const auto reference = straight(1001);
  std::vector<Vec3> line;
  for (const Vec3& p : reference.points) line.insert(line.end(), 3, p);
  const CenterlineScores s = score_centerline(reference, line);
  EXPECT_TRUE(s.resampled);
  EXPECT_EQ(s.line.size(), 1001u);
  EXPECT_EQ(s.ov, 1.0);
}

TEST(CenterlineScores, OfMayOverlookTheStart) {
  const auto reference = straight(1001, 0.5);
  std::vector<Vec3> line = reference.points;
  for (std::size_t i = 0; i < 100; ++i) line[i].y() = 1.0 - 0.01 * static_cast<double>(i);
  EXPECT_LT(score_centerline(reference, line, {.clip = false}).of, 0.05);
  const CenterlineScores s = score_centerline(reference, line, {.free_start_mm = 5.0, .clip = false});
  EXPECT_GT(s.of, 0.9);
  EXPECT_DOUBLE_EQ(s.of, static_cast<double>(s.tpr) / 1001.0) << "what is overlooked is not counted as right";
}

TEST(CenterlineScores, AThinVesselHasNoOt) {
  const auto reference = straight(101, 0.7);
  EXPECT_TRUE(std::isnan(score_centerline(reference, reference.points).ot));
}

TEST(CenterlineScores, TheScoreAlongTheVessel) {
  const auto reference = straight(2001);
  const std::vector<Vec3> half(reference.points.begin(), reference.points.begin() + 1001);
  const CenterlineScores s = score_centerline(reference, half);
  const auto along = along_reference(reference, s);
  ASSERT_EQ(along.size(), 2001u);
  EXPECT_NEAR(along[1000].s_mm, 30.0, 1e-9);
  EXPECT_TRUE(along[1000].matched);
  EXPECT_FALSE(along[1060].matched);
  EXPECT_NEAR(along[2000].distance_mm, 30.0, 1e-9);
  EXPECT_THROW(along_reference(straight(10), s), InvalidInput);
}

/// A root, a stem to 15 mm, one branch straight on to 30 mm and one off to the side.
geometry::VesselTree fork() {
  geometry::VesselTree tree;
  const auto segment = [&](std::int32_t id, std::int32_t from, std::int32_t to, const Vec3& a,
                           const Vec3& b) {
    geometry::TreeSegment s{id, from, to, {}};
    for (int i = 0; i <= 30; ++i) s.axis.points.push_back(a + i / 30.0 * (b - a));
    s.axis.radius.assign(31, 1.5);
    tree.segments.push_back(s);
  };
  const std::array<Vec3, 4> at{Vec3::Zero(), Vec3(15, 0, 0), Vec3(30, 0, 0), Vec3(15, 20, 0)};
  for (std::int32_t i = 0; i < 4; ++i) tree.nodes.push_back({i, at[static_cast<std::size_t>(i)]});
  segment(10, 0, 1, at[0], at[1]);
  segment(11, 1, 2, at[1], at[2]);
  segment(12, 1, 3, at[1], at[3]);
  tree.vessels = {{1, "LAD", {10, 11}}, {2, "D1", {12}}};
  return tree;
}

TEST(CenterlineScores, OfATreeTheBestPathFromTheRootCounts) {
  const std::vector<NamedLine> lines = lines_of(fork());
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].name, "LAD");
  EXPECT_EQ(lines[1].name, "D1");
  EXPECT_NEAR((lines[1].points.front() - Vec3::Zero()).norm(), 0.0, 1e-12) << "from the root on";
  EXPECT_NEAR((lines[2].points.front() - Vec3(15, 0, 0)).norm(), 0.0, 1e-12) << "D1 as it is given";
  const auto reference = straight(1001);
  const BestLine best = score_best_line(reference, lines);
  EXPECT_EQ(lines[best.index].name, "LAD");
  EXPECT_EQ(best.scores.ov, 1.0);
  for (std::size_t i = 0; i < lines.size(); ++i)
    EXPECT_LE(score_centerline(reference, lines[i].points).ov, best.scores.ov);
  io::RotterdamReference side;
  for (int i = 0; i < 500; ++i) side.points.emplace_back(step_mm * i, 0.0, 0.0);
  for (int i = 0; i <= 666; ++i) side.points.emplace_back(15.0, step_mm * i, 0.0);
  side.radius.assign(side.points.size(), 1.0);
  EXPECT_EQ(score_best_line(side, lines).index, 1u);
  EXPECT_THROW(score_best_line(reference, {}), InvalidInput);
}

TEST(CenterlineScores, ATreeWithALoopIsRefused) {
  geometry::VesselTree tree = fork();
  tree.segments[0].from = 2;
  tree.segments[0].to = 1;
  tree.segments[1].from = 1;
  tree.segments[1].to = 2;
  EXPECT_THROW(lines_of(tree), InvalidInput);
}

TEST(CenterlineScores, MeansLeaveOutWhatHasNoScore) {
  const auto reference = straight(501);
  const auto thin = straight(501, 0.5);
  const std::vector<Vec3> far = shifted(reference.points, {0.0, 50.0, 0.0});
  const MeanCenterlineScores mean =
      mean_scores({score_centerline(reference, reference.points), score_centerline(thin, far)});
  EXPECT_EQ(mean.vessels, 2u);
  EXPECT_EQ(mean.missed, 1u);
  EXPECT_EQ(mean.ov, 0.5);
  EXPECT_EQ(mean.of, 0.5);
  EXPECT_EQ(mean.ot, 1.0) << "the thin vessel has none";
  EXPECT_NEAR(mean.ai_mm, 0.5 * step_mm, 1e-4);
  EXPECT_THROW(mean_scores({}), InvalidInput);
}

TEST(CenterlineScores, OtherUnitsAndAxesScoreNothingAndAreNamed) {
  auto reference = straight(1001);
  for (Vec3& p : reference.points) p = Vec3(30.0 + p.x(), -80.0 + 0.5 * p.x(), 120.0 - 0.3 * p.x());
  const auto changed = [&](double x, double y, double z) {
    std::vector<Vec3> out = reference.points;
    for (Vec3& p : out) p = Vec3(x * p.x(), y * p.y(), z * p.z());
    return out;
  };
  EXPECT_EQ(score_centerline(reference, changed(1e-3, 1e-3, 1e-3)).ov, 0.0);
  EXPECT_NE(hint_of_other_frame(reference.points, changed(1e-3, 1e-3, 1e-3)).find("metre"),
            std::string::npos);
  EXPECT_EQ(score_centerline(reference, changed(-1, -1, 1)).ov, 0.0);
  EXPECT_NE(hint_of_other_frame(reference.points, changed(-1, -1, 1)).find("RAS"), std::string::npos);
  EXPECT_TRUE(hint_of_other_frame(reference.points, changed(1, 1, 1)).empty());
  try {
    score_centerline(reference, changed(1e3, 1e3, 1e3));
    ADD_FAILURE() << "micrometres were taken";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("another unit"), std::string::npos);
  }
}

TEST(CenterlineScores, ScoresAgainstAnObserver) {
  EXPECT_DOUBLE_EQ(overlap_score(0.4, 0.8), 25.0);
  EXPECT_DOUBLE_EQ(overlap_score(0.8, 0.8), 50.0);
  EXPECT_DOUBLE_EQ(overlap_score(0.9, 0.8), 75.0);
  EXPECT_DOUBLE_EQ(overlap_score(0.9996, 0.8), 100.0);
  EXPECT_DOUBLE_EQ(distance_score(0.0, 0.2), 100.0);
  EXPECT_DOUBLE_EQ(distance_score(0.2, 0.2), 50.0);
  EXPECT_DOUBLE_EQ(distance_score(0.4, 0.2), 25.0);
  EXPECT_THROW(overlap_score(1.1, 0.8), InvalidInput);
  EXPECT_THROW(overlap_score(0.5, std::nan("")), InvalidInput);
  EXPECT_THROW(distance_score(-0.1, 0.2), InvalidInput);
}

TEST(CenterlineScores, BadInputIsRefused) {
  const auto reference = straight(100);
  EXPECT_THROW(score_centerline(reference, {}), InvalidInput);
  EXPECT_THROW(score_centerline(reference, {Vec3::Zero()}), InvalidInput);
  EXPECT_THROW(score_centerline(reference, {Vec3::Zero(), Vec3::Zero()}), InvalidInput);
  EXPECT_THROW(
      score_centerline(reference, {Vec3::Zero(), Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0)}),
      InvalidInput);
  EXPECT_THROW(score_centerline(straight(1), reference.points), InvalidInput);
  auto thin = reference;
  thin.radius[5] = 0.0;
  EXPECT_THROW(score_centerline(thin, reference.points), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(score_centerline(reference, reference.points, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::evaluation
