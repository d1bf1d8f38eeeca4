#include "ostia/evaluation/agreement.h"

#include "ostia/core/error.h"
#include "ostia/evaluation/agreement_plot.h"
#include "ostia/evaluation/motion_error.h"
#include "ostia/evaluation/volume_overlap.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace ostia::evaluation {
namespace {

using geometry::Vec3;

TEST(Agreement, BlandAltmanByHand) {
  const BlandAltman a = bland_altman({1.0, 2.0, 3.0, 4.0}, {1.1, 2.3, 3.1, 4.3});
  EXPECT_EQ(a.count, 4u);
  EXPECT_NEAR(a.bias, 0.2, 1e-12);
  EXPECT_NEAR(a.sd, std::sqrt(4 * 0.01 / 3), 1e-12);
  EXPECT_NEAR(a.upper_limit - a.lower_limit, 2 * 1.96 * a.sd, 1e-12);
  EXPECT_NEAR(a.bias_error, a.sd / 2.0, 1e-12);
  EXPECT_GT(a.correlation, 0.99);
  EXPECT_THROW(bland_altman({1.0}, {1.0}), InvalidInput);
  EXPECT_THROW(bland_altman({1.0, 2.0}, {1.0}), InvalidInput);
  EXPECT_THROW(bland_altman({1.0, std::nan("")}, {1.0, 2.0}), InvalidInput);
}

TEST(Agreement, DetectionCountsEveryPlace) {
  const StenosisDetection d =
      detect_stenoses({{0.6, 0.7}, {0.8, 0.4}, {0.2, 0.55}, {0.0, 0.0}, {0.1, 0.1}}, 0.5);
  EXPECT_EQ(d.true_positive, 1u);
  EXPECT_EQ(d.false_negative, 1u);
  EXPECT_EQ(d.false_positive, 1u);
  EXPECT_EQ(d.true_negative, 2u);
  EXPECT_DOUBLE_EQ(d.sensitivity, 0.5);
  EXPECT_DOUBLE_EQ(d.ppv, 0.5);
  EXPECT_NEAR(d.mean_grade_difference, (0.1 + 0.4 + 0.35) / 5.0, 1e-12);
  EXPECT_NEAR(d.rms_grade_difference, std::sqrt((0.01 + 0.16 + 0.1225) / 5.0), 1e-12);
  EXPECT_THROW(detect_stenoses({{std::nan(""), 0.2}}), InvalidInput);
  EXPECT_TRUE(std::isnan(detect_stenoses({{0.0, 0.0}}).sensitivity));
  EXPECT_THROW(detect_stenoses({}), InvalidInput);
}

TEST(Agreement, WeightedKappaByHand) {
  EXPECT_DOUBLE_EQ(weighted_kappa({{{0, 0}}, {{1, 1}}, {{2, 2}}}, 3), 1.0);
  // Two raters, three categories: observed 1 of 4 off by one, expected sum |a - b| p q.
  const double kappa = weighted_kappa({{{0, 0}}, {{0, 1}}, {{1, 1}}, {{2, 2}}}, 3);
  EXPECT_NEAR(kappa, 1.0 - 1.0 / (0.25 * (2 * (0 + 2 + 2) + 1 * (1 + 0 + 1) + 1 * (2 + 2 + 0))), 1e-12);
  EXPECT_TRUE(std::isnan(weighted_kappa({{{1, 1}}, {{1, 1}}}, 3)));
  EXPECT_THROW(weighted_kappa({{{0, 3}}}, 3), InvalidInput);
}

// Peak expiratory flow (l/min), first readings of two meters: Bland and Altman 1986, table 1.
const std::vector<double> wright{494, 395, 516, 434, 476, 557, 413, 442, 650,
                                 433, 417, 656, 267, 478, 178, 423, 427};
const std::vector<double> mini{512, 430, 520, 428, 500, 600, 364, 380, 658,
                               445, 432, 626, 260, 477, 259, 350, 451};

TEST(Agreement, TheFiguresOfBlandAndAltmanComeOut) {
  const BlandAltman a = bland_altman(mini, wright);
  EXPECT_NEAR(a.bias, -2.1, 0.05);
  EXPECT_NEAR(a.sd, 38.8, 0.05);
  EXPECT_NEAR(a.bias_error, 9.4, 0.05);
  EXPECT_NEAR(a.limit_error, 16.3, 0.05);
  EXPECT_NEAR(a.bias_interval[0], -22.1, 0.1);
  EXPECT_NEAR(a.bias_interval[1], 17.8, 0.1);
  // They take two standard deviations for the limits, here it is 1.96.
  EXPECT_NEAR(a.lower_limit + 0.04 * -a.sd, -79.7, 0.1);
  EXPECT_NEAR(a.lower_limit_interval[0] + 0.04 * -a.sd, -114.3, 0.2);
  EXPECT_NEAR(a.upper_limit_interval[1] + 0.04 * a.sd, 110.1, 0.2);
  EXPECT_NEAR(a.correlation, 0.94, 0.005);
}

TEST(Agreement, ADifferenceThatGrowsWithSizeIsSeen) {
  std::vector<double> reference, result;
  for (int i = 1; i <= 9; ++i) {
    reference.push_back(i);
    result.push_back(1.2 * i + 0.5);
  }
  const BlandAltman a = bland_altman(reference, result);
  // d = 0.2 x + 0.5 and mean = 1.1 x + 0.25: d = (0.2 / 1.1) mean + 0.5 - 0.25 * 0.2 / 1.1.
  EXPECT_NEAR(a.slope, 0.2 / 1.1, 1e-12);
  EXPECT_NEAR(a.intercept, 0.5 - 0.25 * 0.2 / 1.1, 1e-12);
  EXPECT_NEAR(a.slope_error, 0.0, 1e-7);
  EXPECT_TRUE(std::isnan(bland_altman({1.0, 2.0}, {2.0, 1.0}).slope)) << "the means do not vary";
}

TEST(Agreement, StudentsTIsThatOfTheTables) {
  EXPECT_NEAR(student_t(0.95, 1), 12.7062, 1e-4);
  EXPECT_NEAR(student_t(0.95, 2), 4.3027, 1e-4);
  EXPECT_NEAR(student_t(0.95, 5), 2.5706, 1e-4);
  EXPECT_NEAR(student_t(0.95, 16), 2.1199, 1e-4);
  EXPECT_NEAR(student_t(0.99, 30), 2.7500, 1e-4);
  EXPECT_NEAR(student_t(0.95, 1000000), 1.95996, 1e-4);
  EXPECT_THROW(student_t(0.95, 0), InvalidInput);
  EXPECT_THROW(student_t(1.0, 5), InvalidInput);
}

TEST(Agreement, ConcordanceOfThePublishedFlows) {
  EXPECT_NEAR(concordance_correlation(mini, wright), 0.943, 5e-4);
  EXPECT_DOUBLE_EQ(concordance_correlation(mini, mini), 1.0);
  std::vector<double> shifted = mini;
  for (double& v : shifted) v += 100.0;
  EXPECT_LT(concordance_correlation(mini, shifted), 0.8) << "although the correlation is 1";
  EXPECT_TRUE(std::isnan(concordance_correlation({1.0, 1.0}, {1.0, 1.0})));
}

TEST(Agreement, IntraclassCorrelationOfShroutAndFleiss) {
  const std::vector<std::vector<double>> ratings{{9, 2, 5, 8}, {6, 1, 3, 2},  {8, 4, 6, 8},
                                                 {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}};
  EXPECT_NEAR(intraclass_correlation(ratings), 0.29, 0.005);
  EXPECT_DOUBLE_EQ(intraclass_correlation({{1, 1}, {2, 2}, {5, 5}}), 1.0);
  EXPECT_THROW(intraclass_correlation({{1, 2}}), InvalidInput);
  EXPECT_THROW(intraclass_correlation({{1, 2}, {1}}), InvalidInput);
  EXPECT_THROW(intraclass_correlation({{1, 2}, {1, std::nan("")}}), InvalidInput);
}

std::vector<std::array<int, 2>> ratings_of(const std::vector<std::vector<int>>& table) {
  std::vector<std::array<int, 2>> out;
  for (std::size_t i = 0; i < table.size(); ++i)
    for (std::size_t j = 0; j < table[i].size(); ++j)
      out.insert(out.end(), static_cast<std::size_t>(table[i][j]),
                 {static_cast<int>(i), static_cast<int>(j)});
  return out;
}

TEST(Agreement, KappaOfPublishedTables) {
  // Cohen 1968: 200 diagnoses by two psychiatrists.
  const auto diagnoses = ratings_of({{88, 14, 18}, {10, 40, 10}, {2, 6, 12}});
  EXPECT_NEAR(weighted_kappa(diagnoses, 3, KappaWeights::none), 0.492, 5e-4);
  // Agresti, Categorical Data Analysis: ratings of 91 married couples.
  const auto couples = ratings_of({{7, 7, 2, 3}, {2, 8, 3, 7}, {1, 5, 4, 9}, {2, 8, 9, 14}});
  EXPECT_NEAR(weighted_kappa(couples, 4, KappaWeights::none), 0.1293, 5e-5);
  EXPECT_NEAR(weighted_kappa(couples, 4, KappaWeights::linear), 0.2374, 5e-5);
  // With quadratic weights kappa is the concordance correlation of the categories' numbers.
  std::vector<double> first, second;
  for (const auto& [a, b] : couples) {
    first.push_back(a);
    second.push_back(b);
  }
  EXPECT_NEAR(weighted_kappa(couples, 4, KappaWeights::quadratic), concordance_correlation(first, second),
              1e-12);
}

/// Pixels of the first series' hue: those of the dots.
std::size_t dotted(const figure::Picture& plot) {
  const figure::Raster raster = plot.raster();
  std::size_t count = 0;
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < 580; ++x) {  // without the key at the right
      const std::uint8_t* p = raster.pixel(x, y);
      count += p[0] > p[1] + 30 && p[1] > p[2] + 60;
    }
  return count;
}

TEST(Agreement, ThePlotShowsEveryPair) {
  const figure::Picture all = agreement_plot(mini, wright, {.title = "Flow", .unit = "l/min"});
  const std::vector<double> few{mini.begin(), mini.begin() + 6}, of_few{wright.begin(), wright.begin() + 6};
  EXPECT_EQ(all.width(), 720);
  const auto many = static_cast<double>(dotted(all));
  EXPECT_NEAR(many / static_cast<double>(dotted(agreement_plot(few, of_few))), 17.0 / 6.0, 0.3);
  EXPECT_GT(dotted(agreement_plot({1.0, 2.0}, {1.0, 2.0})), 20u) << "no spread at all";
  const std::vector<double> same{1.1, 2.3, 3.7}, rounded{1.1 + 2e-16, 2.3 - 4e-16, 3.7};
  EXPECT_GT(dotted(agreement_plot(same, rounded)), 20u) << "nothing but rounding";
  EXPECT_GT(dotted(agreement_plot({2.0, 2.0}, {2.0, 2.0 + 4e-16})), 10u);
  EXPECT_THROW(agreement_plot({1.0}, {1.0}), InvalidInput);
}

TEST(VolumeOverlap, ShiftedAndConcentricBalls) {
  const auto ball = [](double radius, const Vec3& shift) {
    geometry::AnalyticShape shape = geometry::straight_tube(0.001, radius);
    geometry::TriMesh mesh = geometry::surface_of(shape, 0.15, false);
    for (Vec3& p : mesh.points) p += shift;
    return mesh;
  };
  const double r = 2.0, d = 1.0;
  const VolumeOverlap v = compare_enclosed(ball(r, Vec3::Zero()), ball(r, Vec3(d, 0, 0)), 0.05);
  const double lens = std::numbers::pi / 12.0 * (4.0 * r + d) * (2.0 * r - d) * (2.0 * r - d);
  const double whole = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  EXPECT_NEAR(v.dice, lens / whole, 0.002);
  EXPECT_NEAR(v.reference_mm3, whole, 0.005 * whole);
  const VolumeOverlap c = compare_enclosed(ball(2.0, Vec3::Zero()), ball(1.0, Vec3::Zero()), 0.05);
  EXPECT_NEAR(c.jaccard, 1.0 / 8.0, 0.002);
  EXPECT_NEAR(c.relative_difference, -7.0 / 8.0, 0.002);
  geometry::TriMesh open = ball(1.0, Vec3::Zero());
  open.triangles.pop_back();
  EXPECT_THROW(compare_enclosed(open, ball(1.0, Vec3::Zero())), InvalidInput);
}

TEST(VolumeOverlap, Masks) {
  imaging::MaskVolume a;
  a.geometry.size = {10, 10, 10};
  a.geometry.spacing = Vec3(0.5, 0.5, 0.5);
  a.voxels.assign(1000, 0);
  imaging::MaskVolume b = a;
  for (std::size_t i = 0; i < 400; ++i) a.voxels[i] = 1;
  for (std::size_t i = 200; i < 600; ++i) b.voxels[i] = 7;
  const VolumeOverlap v = compare_masks(a, b);
  EXPECT_DOUBLE_EQ(v.dice, 0.5);
  EXPECT_DOUBLE_EQ(v.reference_mm3, 50.0);
  b.geometry.origin.x() = 1.0;
  EXPECT_THROW(compare_masks(a, b), InvalidInput);
}

TEST(MotionError, PointByPoint) {
  PointMotion reference{{0.0, 50.0}, {{Vec3::Zero(), Vec3(1, 0, 0)}, {Vec3(0, 0, 4), Vec3(1, 0, 4)}}};
  PointMotion result = reference;
  result.phases[1][0].y() = 3.0;
  const MotionError e = compare_motion(reference, result);
  EXPECT_DOUBLE_EQ(e.phases[0].max_mm, 0.0);
  EXPECT_DOUBLE_EQ(e.phases[1].mean_mm, 1.5);
  EXPECT_DOUBLE_EQ(e.max_mm, 3.0);
  EXPECT_DOUBLE_EQ(e.amplitude_mm, 4.0);
  EXPECT_NEAR(e.rms_mm, std::sqrt(9.0 / 4.0), 1e-12);
  result.phases[1].pop_back();
  EXPECT_THROW(compare_motion(reference, result), InvalidInput);
  result = reference;
  result.percent[1] = 60.0;
  EXPECT_THROW(compare_motion(reference, result), InvalidInput);
  EXPECT_THROW(compare_motion({}, {}), InvalidInput);
}

}  // namespace
}  // namespace ostia::evaluation
