#include "ostia/figure/plot.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::figure {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;

TEST(Ticks, AreRoundNumbersWithinTheRange) {
  EXPECT_THAT(nice_ticks(0.0, 10.0, 5), ElementsAre(0.0, 2.0, 4.0, 6.0, 8.0, 10.0));
  EXPECT_THAT(nice_ticks(-0.3, 0.31, 3), ElementsAre(DoubleEq(-0.2), DoubleEq(0.0), DoubleEq(0.2)));
  EXPECT_THAT(nice_ticks(713.0, 748.0, 4), ElementsAre(720.0, 730.0, 740.0));
  EXPECT_TRUE(nice_ticks(1.0, 1.0, 4).empty());
  EXPECT_TRUE(nice_ticks(0.0, NAN, 4).empty());
}

TEST(Ticks, AreAboutAsManyAsAskedForOverManyRanges) {
  for (double span = 1e-4; span < 1e6; span *= 1.37) {
    const auto ticks = nice_ticks(0.123 * span, 1.123 * span, 6);
    EXPECT_GE(ticks.size(), 3U) << span;
    EXPECT_LE(ticks.size(), 10U) << span;
  }
}

TEST(Ticks, TextHasTheDecimalsOfItsStep) {
  EXPECT_EQ(tick_text(0.1 + 0.2, 0.1), "0.3");
  EXPECT_EQ(tick_text(1200.0, 200.0), "1200");
  EXPECT_EQ(tick_text(-0.0, 0.5), "0.0");
  EXPECT_EQ(tick_text(0.025, 0.005), "0.025");
  EXPECT_EQ(tick_text(NAN, 0.5), "\xE2\x80\x93");
}

/// Columns of the plot where a colour close to `color` is drawn, and the mean height there.
std::vector<double> curve_heights(const Raster& raster, const Color& color) {
  std::vector<double> heights;
  for (int x = 0; x < raster.width; ++x) {
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < raster.height; ++y) {
      const std::uint8_t* p = raster.pixel(x, y);
      const double off =
          std::abs(p[0] - 255 * color.r) + std::abs(p[1] - 255 * color.g) + std::abs(p[2] - 255 * color.b);
      if (off < 40.0) {
        sum += y;
        ++count;
      }
    }
    heights.push_back(count > 0 ? sum / count : NAN);
  }
  return heights;
}

TEST(LinePlot, AStraightLineIsStraightAndAGapStaysOpen) {
  Series series;
  series.color = Color{1, 0, 0};
  for (int i = 0; i <= 100; ++i) {
    series.x.push_back(i);
    series.y.push_back(i >= 40 && i <= 60 ? NAN : 2.0 * i);
  }
  const Raster raster = line_plot({series}, {.width_px = 500, .height_px = 300}).raster();
  const std::vector<double> heights = curve_heights(raster, *series.color);
  std::vector<std::pair<double, double>> seen;
  for (std::size_t x = 0; x < heights.size(); ++x) {
    if (std::isfinite(heights[x])) seen.emplace_back(static_cast<double>(x), heights[x]);
  }
  ASSERT_GT(seen.size(), 250U);
  const double slope = (seen.back().second - seen.front().second) / (seen.back().first - seen.front().first);
  EXPECT_LT(slope, 0.0);  // up in the picture
  double widest_gap = 0.0;
  for (std::size_t i = 1; i < seen.size(); ++i) {
    EXPECT_NEAR(seen[i].second, seen.front().second + slope * (seen[i].first - seen.front().first), 2.0);
    widest_gap = std::max(widest_gap, seen[i].first - seen[i - 1].first);
  }
  const double width = seen.back().first - seen.front().first;
  EXPECT_NEAR(widest_gap, 0.22 * width, 0.03 * width);  // from 39 to 61 of 100
}

TEST(LinePlot, ValuesThatDifferByRoundingAloneAreDrawnAsALevelLine) {
  Series series;
  series.color = Color{1, 0, 0};
  series.x = {0.0, 1.0, 2.0};
  series.y = {0.3, 0.1 + 0.2, 0.3};
  const Raster raster = line_plot({series}, {.width_px = 400, .height_px = 240}).raster();
  std::vector<double> heights;
  for (const double h : curve_heights(raster, *series.color)) {
    if (std::isfinite(h)) heights.push_back(h);
  }
  ASSERT_GT(heights.size(), 200U);
  EXPECT_NEAR(*std::max_element(heights.begin(), heights.end()),
              *std::min_element(heights.begin(), heights.end()), 1.0);
}

TEST(LinePlot, RefusesWhatItCannotShow) {
  EXPECT_THROW(line_plot({}), InvalidInput);
  EXPECT_THROW(line_plot({{.name = "a", .x = {1, 2}, .y = {1}}}), InvalidInput);
  EXPECT_THROW(line_plot({{.name = "a", .x = {1}, .y = {NAN}}}), InvalidInput);
  EXPECT_THROW(line_plot({{.name = "a", .x = {1, 2}, .y = {1, 2}}}, {.width_px = 5}), InvalidInput);
  EXPECT_THROW(line_plot({{.name = "a", .x = {1, 2}, .y = {1, 2}}}, {.y_range = Range{2.0, 2.0}}),
               InvalidInput);
  EXPECT_NO_THROW(line_plot({{.name = "one point", .x = {3}, .y = {0}}}));
}

TEST(Histogram, CountsEveryValueOnce) {
  const Histogram h = histogram({0.0, 0.5, 1.0, 1.5, 2.0, -1.0, 9.0, NAN}, 2, Range{0.0, 2.0});
  EXPECT_THAT(h.counts, ElementsAre(2U, 3U));  // the last bin is closed
  EXPECT_EQ(h.below, 1U);
  EXPECT_EQ(h.above, 1U);
  EXPECT_EQ(h.not_finite, 1U);
  const Histogram whole = histogram({3.0, 7.0}, 4);
  EXPECT_EQ(whole.low, 3.0);
  EXPECT_EQ(whole.high, 7.0);
  EXPECT_THAT(whole.counts, ElementsAre(1U, 0U, 0U, 1U));
}

TEST(Histogram, OfEqualOrNoValuesCanStillBeDrawn) {
  EXPECT_NO_THROW(histogram_plot(histogram({5.0, 5.0}, 10)));
  EXPECT_NO_THROW(histogram_plot(histogram({}, 10)));
  EXPECT_THROW(histogram({1.0}, 0), InvalidInput);
  EXPECT_THROW(histogram({1.0}, 3, Range{1.0, 1.0}), InvalidInput);
}

TEST(HistogramPlot, BarsAreAsHighAsTheirCounts) {
  PlotOptions options{.width_px = 400, .height_px = 300};
  options.y_range = Range{0.0, 4.0};
  const Raster raster = histogram_plot(histogram({0.1, 0.2, 0.3, 1.5}, 2, Range{0.0, 2.0}), options).raster();
  std::vector<int> columns;  // bar pixels in each column
  for (int x = 0; x < raster.width; ++x) {
    int count = 0;
    for (int y = 0; y < raster.height; ++y) {
      const std::uint8_t* p = raster.pixel(x, y);
      count += p[2] > 150 && p[0] < 30;
    }
    if (count > 0) columns.push_back(count);
  }
  ASSERT_GT(columns.size(), 200U);
  EXPECT_NEAR(columns[columns.size() / 4], 3.0 * columns[3 * columns.size() / 4], 3.0);
}

}  // namespace
}  // namespace ostia::figure
