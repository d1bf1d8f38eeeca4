// OF and OT of short lines that are counted by hand, by the challenge's rules and by the paper's.

#include "ostia/evaluation/centerline_scores.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace ostia::evaluation {
namespace {

using geometry::Vec3;

/// Points 1 mm apart along x. A step of the pairing goes on in one line alone, so the pairs of two equal
/// lines are 0 and 1 mm long in turn: a radius of 1.2 mm lets both count.
io::RotterdamReference unit_steps(std::size_t points, double radius_mm = 1.2) {
  io::RotterdamReference line;
  for (std::size_t i = 0; i < points; ++i) line.points.emplace_back(static_cast<double>(i), 0.0, 0.0);
  line.radius.assign(points, radius_mm);
  line.observer_spread.assign(points, 0.2);
  return line;
}

CenterlineScores scored(const io::RotterdamReference& reference, const std::vector<Vec3>& line,
                        OverlapRules rules, double free_start_mm = 0.0) {
  return score_centerline(
      reference, line,
      {.free_start_mm = free_start_mm, .clip = false, .direction = LineDirection::as_given, .rules = rules});
}

TEST(OverlapRules, TheChallengesAreTheDefault) {
  EXPECT_EQ(CenterlineScoreOptions{}.rules, OverlapRules::challenge);
}

// Candidate x = 0..7 against x = 0..4: the points 6 and 7 are 2 and 3 mm beyond the end.
TEST(OverlapRules, ALineThatGoesOnBeyondTheEnd) {
  const auto reference = unit_steps(5);
  const std::vector<Vec3> line = unit_steps(8).points;
  const CenterlineScores challenge = scored(reference, line, OverlapRules::challenge);
  EXPECT_EQ(challenge.tpr, 5u);
  EXPECT_EQ(challenge.fn, 0u);
  EXPECT_EQ(challenge.tpm, 6u);
  EXPECT_EQ(challenge.fp, 2u);
  EXPECT_DOUBLE_EQ(challenge.ov, 11.0 / 13.0);
  EXPECT_DOUBLE_EQ(challenge.of, 4.0 / 5.0) << "a pair fails at the last point, four lie before it";
  EXPECT_DOUBLE_EQ(challenge.ot, 1.0) << "what lies beyond the end does not count";
  const CenterlineScores paper = scored(reference, line, OverlapRules::paper);
  EXPECT_DOUBLE_EQ(paper.ov, 11.0 / 13.0);
  EXPECT_DOUBLE_EQ(paper.of, 1.0) << "no point of the reference is missed";
  EXPECT_DOUBLE_EQ(paper.ot, 11.0 / 13.0) << "the last point's pairs count, all of them";
}

// Candidate: 0..3 along x, up to (3, 2) and back, 3..6 along x. One point is 2 mm off, at the fourth of
// seven.
TEST(OverlapRules, ALineThatStraysAndComesBack) {
  const auto reference = unit_steps(7);
  std::vector<Vec3> line = unit_steps(4).points;
  for (const double y : {1.0, 2.0, 1.0, 0.0}) line.emplace_back(3.0, y, 0.0);
  for (const double x : {4.0, 5.0, 6.0}) line.emplace_back(x, 0.0, 0.0);
  const CenterlineScores challenge = scored(reference, line, OverlapRules::challenge);
  const CenterlineScores paper = scored(reference, line, OverlapRules::paper);
  EXPECT_EQ(challenge.fn, 0u);
  EXPECT_EQ(challenge.fp, 1u);
  EXPECT_DOUBLE_EQ(challenge.ov, 17.0 / 18.0);
  EXPECT_DOUBLE_EQ(paper.ov, 17.0 / 18.0);
  EXPECT_DOUBLE_EQ(challenge.of, 3.0 / 7.0);
  EXPECT_DOUBLE_EQ(paper.of, 1.0);
  EXPECT_DOUBLE_EQ(scored(reference, line, OverlapRules::challenge, 3.5).of, 1.0)
      << "it lies in the free start";
  EXPECT_DOUBLE_EQ(scored(reference, line, OverlapRules::challenge, 3.0).of, 3.0 / 7.0);
}

// Candidate: 0..3 along x, then off to (3, 3): its last three points are all nearest to the reference's last.
TEST(OverlapRules, OtLeavesOutWhatTheLastWidePointGathers) {
  auto reference = unit_steps(4);
  std::vector<Vec3> line = unit_steps(4).points;
  for (const double y : {1.0, 2.0, 3.0}) line.emplace_back(3.0, y, 0.0);
  const CenterlineScores challenge = scored(reference, line, OverlapRules::challenge);
  const CenterlineScores paper = scored(reference, line, OverlapRules::paper);
  EXPECT_DOUBLE_EQ(challenge.ot, 1.0);
  EXPECT_DOUBLE_EQ(paper.ot, (4.0 + 5.0) / (4.0 + 7.0)) << "(3, 1) is near enough, (3, 2) and (3, 3) are not";
  EXPECT_DOUBLE_EQ(challenge.of, 3.0 / 4.0);
  EXPECT_DOUBLE_EQ(paper.of, 1.0);
  reference.radius.assign(4, 0.7);
  EXPECT_TRUE(std::isnan(scored(reference, line, OverlapRules::challenge).ot));
  EXPECT_TRUE(std::isnan(scored(reference, line, OverlapRules::paper).ot));
}

// Where a line ends early both rules agree: the candidate x = 0..3 reaches one point further.
TEST(OverlapRules, ALineThatEndsEarlyIsTheSameByBoth) {
  const auto reference = unit_steps(8);
  const std::vector<Vec3> line = unit_steps(4).points;
  for (const OverlapRules rules : {OverlapRules::challenge, OverlapRules::paper}) {
    const CenterlineScores s = scored(reference, line, rules);
    EXPECT_DOUBLE_EQ(s.ov, 9.0 / 12.0);
    EXPECT_DOUBLE_EQ(s.of, 5.0 / 8.0);
  }
}

TEST(OverlapRules, APointThatIsRepeatedIsAPointMore) {
  auto reference = unit_steps(5);
  reference.points.insert(reference.points.begin() + 2, reference.points[2]);
  reference.radius.push_back(1.2);
  reference.observer_spread.push_back(0.2);
  const CenterlineScores s = scored(reference, reference.points, OverlapRules::challenge);
  EXPECT_EQ(s.tpr, 6u);
  EXPECT_EQ(s.tpm, 6u);
  EXPECT_FALSE(s.resampled) << "its spacing is the reference's, repeated points and all";
  EXPECT_EQ(s.of, 1.0);
  EXPECT_EQ(s.ot, 1.0);
  reference.points.insert(reference.points.begin(), 3, reference.points[0]);
  reference.radius.assign(reference.points.size(), 1.2);
  reference.observer_spread.clear();
  EXPECT_EQ(score_centerline(reference, unit_steps(5).points).ov, 1.0)
      << "the disc has a direction all the same";
}

TEST(OverlapRules, OvAndAiDoNotDependOnThemAndOfIsNeverMoreByTheChallenges) {
  std::uint32_t seed = 7;
  const auto next = [&] {
    seed = seed * 1664525u + 1013904223u;
    return static_cast<double>(seed >> 8) / static_cast<double>(1u << 24) - 0.5;
  };
  int differ = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto reference = unit_steps(20, 1.3);
    std::vector<Vec3> line;
    for (int i = 0; i < 24; ++i) line.emplace_back(i - 2.0, 2.5 * next(), 0.0);
    const CenterlineScores a = scored(reference, line, OverlapRules::challenge);
    const CenterlineScores b = scored(reference, line, OverlapRules::paper);
    EXPECT_EQ(a.ov, b.ov);
    EXPECT_TRUE(a.ai_mm == b.ai_mm || (std::isnan(a.ai_mm) && std::isnan(b.ai_mm)));
    EXPECT_LE(a.of, b.of);
    differ += a.of < b.of;
  }
  EXPECT_GT(differ, 10);
}

}  // namespace
}  // namespace ostia::evaluation
