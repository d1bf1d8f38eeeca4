#include "ecg_feed.h"

#include "made_ecg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::live {
namespace {

using motion::EcgSignal;
using motion::PhaseSource;

constexpr double rate = 360.0, interval = 0.8;

motion::MadeEcg even_beats(std::size_t count) {
  motion::MadeEcg ecg;
  ecg.rate = rate;
  ecg.beats(count, [](std::size_t) { return interval; });
  return ecg;
}

TEST(EcgFeed, FollowsEvenBeats) {
  const motion::MadeEcg ecg = even_beats(30);
  EcgFeed feed(ecg.lead(), rate);
  std::size_t checked = 0;
  for (double t = 6.0; t < 20.0; t += 0.0371) {
    feed.advance_to(t);
    EXPECT_LE(feed.time_s(), t);
    EXPECT_GT(feed.time_s(), t - 1.001 / rate);
    const auto now = feed.phase();
    EXPECT_EQ(now.source, PhaseSource::following);
    const double expected = (feed.time_s() - 0.5) / interval;
    EXPECT_LT(std::abs(std::remainder(now.phase - expected, 1.0)), 0.01) << t;
    ++checked;
  }
  EXPECT_GT(checked, 300U);
  EXPECT_EQ(feed.signal(), EcgSignal::good);
}

TEST(EcgFeed, LinesHaveTheLeastAndTheGreatestOfEachColumn) {
  std::vector<double> values(40000);  // 8 s of 5 kHz
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(0.37 * static_cast<double>(i));
  values[20000] = 7.0;
  for (std::size_t i = 30000; i < 30100; ++i) values[i] = std::numeric_limits<double>::quiet_NaN();
  EcgFeed feed(values, 5000.0);
  feed.advance_to(7.9);
  const auto lines = lines_of(feed, 10000, 0.01);
  ASSERT_EQ(lines.size(), 2U) << "missing samples part them";
  std::size_t points = 0, peaks = 0;
  double before = 0.0;
  for (const auto& line : lines)
    for (const LinePoint& point : line) {
      EXPECT_GT(point.time_s, before);
      before = point.time_s;
      EXPECT_DOUBLE_EQ(point.value, values[static_cast<std::size_t>(std::lround(point.time_s * 5000.0))]);
      peaks += point.value > 6.0 ? 1U : 0U;
      ++points;
    }
  EXPECT_EQ(peaks, 1U);
  EXPECT_LE(points, 2U * 592U);
  EXPECT_GT(points, 1100U);
  // Where no column has more than two, all are drawn.
  EXPECT_EQ(lines_of(feed, 39000, 0.0003).front().size(), feed.samples() - 39000);
}

TEST(EcgFeed, KnowsNoMoreThanHasComeIn) {
  const motion::MadeEcg ecg = even_beats(20);
  EcgFeed feed(ecg.lead(), rate);
  EXPECT_EQ(feed.advance_to(5.0), static_cast<std::size_t>(5.0 * rate) + 1);
  EXPECT_EQ(feed.advance_to(5.0), 0U);
  EXPECT_EQ(feed.advance_to(4.0), 0U) << "time does not go back by itself";
  for (const double peak : feed.peaks()) EXPECT_LT(peak, 5.0);
  EXPECT_GE(feed.peaks().size(), 3U);
}

TEST(EcgFeed, ASeekGivesWhatAStreamWouldHave) {
  const motion::MadeEcg ecg = even_beats(90);
  EcgFeed straight(ecg.lead(), rate), sought(ecg.lead(), rate);
  straight.advance_to(55.3);
  sought.advance_to(10.0);
  sought.seek(55.3);
  EXPECT_DOUBLE_EQ(sought.time_s(), straight.time_s());
  EXPECT_NEAR(sought.phase().phase, straight.phase().phase, 1e-3);
  ASSERT_FALSE(sought.peaks().empty());
  EXPECT_NEAR(sought.peaks().back(), straight.peaks().back(), 1e-9);
  sought.seek(2.0);  // back again
  EXPECT_NEAR(sought.time_s(), 2.0, 1.0 / rate);
}

TEST(EcgFeed, CoastsAfterTheRecordHasEnded) {
  const motion::MadeEcg ecg = even_beats(12);
  EcgFeed feed(ecg.lead(), rate);
  feed.advance_to(feed.length_s() - 0.05);
  EXPECT_FALSE(feed.ended());
  feed.advance_to(feed.length_s() + 3.0);
  EXPECT_TRUE(feed.ended());
  EXPECT_EQ(feed.signal(), EcgSignal::missing);
  EXPECT_EQ(feed.phase().source, PhaseSource::coasting);
  const double before = feed.phase().phase;
  feed.advance_to(feed.time_s() + interval / 2.0);
  EXPECT_NEAR(std::abs(std::remainder(feed.phase().phase - before, 1.0)), 0.5, 0.02) << "at the last rate";
  EXPECT_TRUE(std::isnan(feed.value(1'000'000)));
}

TEST(EcgFeed, TellsAFlatLineGapsAndClippedPeaks) {
  const std::vector<double> good = even_beats(30).lead();
  const auto at = [](double s) { return static_cast<std::ptrdiff_t>(s * rate); };
  auto flat = good;
  std::fill(flat.begin() + at(10.0), flat.begin() + at(14.0), 0.1);
  EcgFeed feed(flat, rate);
  feed.advance_to(13.0);
  EXPECT_EQ(feed.signal(), EcgSignal::flat);
  EXPECT_EQ(feed.phase().source, PhaseSource::coasting);
  feed.advance_to(22.0);
  EXPECT_EQ(feed.signal(), EcgSignal::good);
  EXPECT_EQ(feed.phase().source, PhaseSource::following) << "and finds back";
  auto gap = good;
  std::fill(gap.begin() + at(10.0), gap.begin() + at(12.0), std::numeric_limits<double>::quiet_NaN());
  EcgFeed broken(gap, rate);
  broken.advance_to(11.5);
  EXPECT_EQ(broken.signal(), EcgSignal::missing);
  motion::MadeEcg high;
  high.r_mv = 3.0;
  high.beats(30, [](std::size_t) { return interval; });
  auto clipped = high.lead();
  for (double& v : clipped) v = std::min(v, 0.9);
  EcgFeed cut(clipped, rate);
  cut.advance_to(15.0);
  EXPECT_EQ(cut.signal(), EcgSignal::clipped);
  EXPECT_EQ(cut.phase().source, PhaseSource::following) << "beats are found all the same";
}

}  // namespace
}  // namespace ostia::live
