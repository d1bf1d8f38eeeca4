#include "ostia/analysis/graph_report.h"

#include "graph_trees.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

namespace {

using namespace ostia;
using namespace ostia::analysis;
using namespace ostia::analysis::testing;
using std::numbers::pi;

std::vector<ForkAngles> angles_of(const VesselGraph& graph, double reach = 0.0) {
  const geometry::GraphIncidence incidence(graph);
  return fork_angles(graph, incidence, link_tree(graph, incidence), reach);
}

TEST(GraphAngles, AreThoseOfAForkInAPlane) {
  // Down z; the wide child turns by 20 degrees to one side, the narrow one by 50 to the other.
  const double a = 20.0 * pi / 180.0, b = 50.0 * pi / 180.0;
  const VesselGraph graph =
      graph_of({{0, 0, 0}, {0, 0, 1}, {std::sin(a), 0, 1 + std::cos(a)}, {-std::sin(b), 0, 1 + std::cos(b)}},
               {{0, 1, 1, 1}, {1, 3, 0.5, 0.5}, {1, 2, 0.9, 0.9}});
  const std::vector<ForkAngles> forks = angles_of(graph);
  ASSERT_EQ(forks.size(), 1U);
  EXPECT_EQ(forks[0].wide, 2);
  EXPECT_EQ(forks[0].narrow, 1);
  EXPECT_NEAR(forks[0].wide_rad, a, 1e-12);
  EXPECT_NEAR(forks[0].narrow_rad, b, 1e-12);
  EXPECT_NEAR(forks[0].between_rad, a + b, 1e-12);
  EXPECT_NEAR(forks[0].tilt_rad, 0.0, 1e-12);
}

TEST(GraphAngles, TheTiltIsThatOfTheChildrensPlane) {
  // Both children in the plane z = x tan(0.3)... seen along x it is tilted by 0.3.
  const double t = 0.3;
  const Vec3 u(std::cos(t), 0.0, std::sin(t));
  const Vec3 at(1, 0, 0), y(0, 1, 0);
  const VesselGraph graph = graph_of({{0, 0, 0}, at, at + u + 0.5 * y, at + u - 0.5 * y},
                                     {{0, 1, 1, 1}, {1, 2, 0.8, 0.8}, {1, 3, 0.8, 0.8}});
  EXPECT_NEAR(angles_of(graph)[0].tilt_rad, t, 1e-12);
}

TEST(GraphAngles, AForkOfThreeHasTwoPairsAndAReachLooksFurther) {
  VesselGraph three = graph_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 2}, {0, 0, 2}, {-1, 0, 2}},
                               {{0, 1, 1, 1}, {1, 2, 0.5, 0.5}, {1, 3, 0.9, 0.9}, {1, 4, 0.5, 0.5}});
  const std::vector<ForkAngles> pairs = angles_of(three);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_NEAR(pairs[0].between_rad, pi / 4, 1e-12);
  EXPECT_NEAR(pairs[0].wide_rad, 0.0, 1e-7);
  // A child that leaves at a right angle, then turns to the parent's direction.
  const VesselGraph bent = graph_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 9}, {-1, 0, 1}},
                                    {{0, 1, 1, 1}, {1, 2, 0.9, 0.9}, {2, 3, 0.9, 0.9}, {1, 4, 0.5, 0.5}});
  EXPECT_NEAR(angles_of(bent)[0].wide_rad, pi / 2, 1e-12);
  EXPECT_NEAR(angles_of(bent, 2.0)[0].wide_rad, pi / 4, 1e-12);
  EXPECT_THROW(angles_of(bent, -1.0), InvalidInput);
}

TEST(GraphScaling, MurraysExponentIsTheOneTheRadiiWereMadeWith) {
  for (const double k : {2.0, 7.0 / 3.0, 3.0, 5.5}) {
    const double x = 0.63, y = std::pow(1.0 - std::pow(x, k), 1.0 / k);
    EXPECT_NEAR(murray_exponent(0.02, {0.02 * x, 0.02 * y}).value(), k, 1e-9) << k;
  }
  EXPECT_NEAR(murray_exponent(1.0, {0.5, 0.5, 0.5}).value(), std::log(3.0) / std::log(2.0), 1e-9);
  EXPECT_FALSE(murray_exponent(1.0, {1.0, 0.5}).has_value());
  EXPECT_FALSE(murray_exponent(1.0, {0.5}).has_value());
  EXPECT_FALSE(murray_exponent(0.0, {0.5, 0.5}).has_value());
  EXPECT_FALSE(murray_exponent(1.0, {0.5, 0.0}).has_value());
}

TEST(GraphScaling, LinesOnALogarithmicScale) {
  const LogFit fit = fit_log({1, 2, 3, 4}, {3.0, 6.0, 12.0, 24.0});
  EXPECT_NEAR(fit.ratio, 2.0, 1e-12);
  EXPECT_NEAR(fit.a, std::log10(1.5), 1e-12);
  EXPECT_NEAR(fit.r_squared, 1.0, 1e-12);
  EXPECT_EQ(fit_log({1, 2, 3}, {0.0, 5.0, -1.0}).points, 1);
  EXPECT_EQ(fit_log({1, 2, 3}, {0.0, 5.0, -1.0}).ratio, 1.0);
}

TEST(GraphScaling, KassabsFitComesOutOfHisTable) {
  // Element diameters of the right coronary artery, um, and the line he gives for them: 0.556 + 0.259 n.
  const LogFit fit = fit_log({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11},
                             {9.3, 12.8, 17.7, 28.6, 63.1, 132, 256, 428, 706, 1302, 3218});
  EXPECT_NEAR(fit.b, 0.259, 0.003);
  EXPECT_NEAR(fit.a, 0.556, 0.04);
}

TEST(GraphScaling, HistogramsCountEveryValueOnce) {
  const std::vector<double> values{1.0, 10.0, 100.0, 1000.0, -5.0, std::nan("")};
  const Histogram log = histogram(values, 3, true);
  EXPECT_EQ(log.counts, (std::vector<std::int64_t>{1, 1, 2}));
  EXPECT_NEAR(log.bounds[1], 10.0, 1e-9);
  const Histogram linear = histogram(values, 2, false);
  EXPECT_EQ(linear.counts, (std::vector<std::int64_t>{4, 1}));
  EXPECT_EQ(histogram({7.0, 7.0}, 5, true).counts, (std::vector<std::int64_t>{2}));
  EXPECT_TRUE(histogram({}, 5, false).counts.empty());
  EXPECT_THROW(histogram(values, 0, false), InvalidInput);
}

TEST(GraphReport, OfABinaryTreeHasItsRatios) {
  const double murray = std::pow(2.0, -1.0 / 3.0);
  const VesselGraph graph = binary_tree(10, 0.45, murray);
  const TreeReport report = measure_tree(graph);
  EXPECT_EQ(report.total.segments, 1023);
  EXPECT_EQ(report.total.ends, 512);
  EXPECT_NEAR(report.murray_median, 3.0, 1e-9);
  ASSERT_EQ(report.orders.size(), 10U);
  EXPECT_NEAR(report.murray_by_order[5], 3.0, 1e-9);
  EXPECT_NEAR(report.diameter_fit.ratio, 1.0 / murray, 1e-9);
  EXPECT_NEAR(report.length_fit.ratio, 1.0 / 0.45, 1e-9);
  EXPECT_NEAR(report.number_fit.ratio, 0.5, 1e-9);
  EXPECT_NEAR(report.angles[100].between_rad, pi / 2, 1e-9);
  EXPECT_EQ(report.connectivity.at(3, 4), 2.0);
}

TEST(GraphReport, WritesItsTables) {
  VesselGraph graph = graph_of({{0, 0, 0}, {0, 0, 2}, {1, 0, 3}, {-1, 0, 3}},
                               {{0, 1, 1, 1}, {1, 2, 0.5, 0.5}, {1, 3, 0.5, 0.25}});
  graph.references = {11, 22, 33};
  const TreeReport report = measure_tree(graph);
  const std::vector<GraphTable> tables = tree_tables(graph, report);
  ASSERT_EQ(tables.size(), 5U);
  std::ostringstream csv, json;
  write_csv(tables[0], csv);
  std::istringstream lines(csv.str());
  std::string header, first, second;
  std::getline(lines, header);
  std::getline(lines, first);
  std::getline(lines, second);
  EXPECT_EQ(header.substr(0, 30), "segment,reference,parent,branc");
  EXPECT_EQ(first.substr(0, 20), "0,11,-1,0,2,2,2,1,1,");
  EXPECT_EQ(second.substr(0, 12), "1,22,0,1,1,1");
  write_json(tables[2], json);
  EXPECT_EQ(json.str().substr(0, 43), "{\"v\":1,\"name\":\"orders\",\"columns\":[\"order\",\"");
  EXPECT_NE(json.str().find("\n[1,2,2,"), std::string::npos) << json.str();
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(write_csv(tables[0], csv, task), Cancelled);
  EXPECT_THROW(measure_tree(graph, task), Cancelled);
}

}  // namespace
