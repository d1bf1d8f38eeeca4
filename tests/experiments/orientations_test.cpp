#include "ostia/experiments/orientations.h"

#include "experiment_schema.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/experiments/orientations_report.h"
#include "ostia/geometry/polyline.h"
#include "ostia/imaging/sampling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace ostia::experiments {
namespace {

namespace fs = std::filesystem;

/// A wide tube and a thin one beside it.
std::vector<PhantomTube> orientations_small_phantom() {
  return {{"wide", Vec3(0.0, 0.0, -12.0), Vec3(3.0, 4.0, 10.0), 1.56},
          {"thin", Vec3(-9.0, -8.0, -10.0), Vec3(-6.0, 9.0, 6.0), 0.78}};
}

TEST(VascularPhantom, HasSeventeenTubesOfThePapersRadii) {
  const std::vector<PhantomTube> tubes = vascular_phantom();
  ASSERT_EQ(tubes.size(), 17U);
  std::set<std::string> names;
  double least = 1e9, most = 0.0;
  for (const PhantomTube& tube : tubes) {
    names.insert(tube.name);
    least = std::min(least, tube.radius_mm);
    most = std::max(most, tube.radius_mm);
    EXPECT_GT(tube.length_mm(), 20.0) << tube.name;
  }
  EXPECT_EQ(names.size(), 17U);
  EXPECT_DOUBLE_EQ(least, 0.78);
  EXPECT_DOUBLE_EQ(most, 2.34);
  // Tubes that do not meet keep clear of each other by two slices.
  for (const PhantomTube& a : tubes)
    for (const PhantomTube& b : tubes) {
      const bool meet = (a.from - b.from).norm() < 1e-9 || (a.from - b.to).norm() < 1e-9 ||
                        (a.to - b.from).norm() < 1e-9 || (a.to - b.to).norm() < 1e-9;
      if (meet) continue;
      for (int i = 0; i <= 100; ++i) {
        const Vec3 p = a.from + 0.01 * i * (a.to - a.from);
        const double apart = (geometry::closest({b.from, b.to}, p).point - p).norm();
        EXPECT_GT(apart - a.radius_mm - b.radius_mm, 2.5) << a.name << " and " << b.name;
      }
    }
}

TEST(TwelveOrientations, AreDifferentTurns) {
  const std::vector<Orientation> all = twelve_orientations();
  ASSERT_EQ(all.size(), 12U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_NEAR(all[i].turn.determinant(), 1.0, 1e-12);
    EXPECT_TRUE((all[i].turn * all[i].turn.transpose()).isIdentity(1e-12));
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT((all[i].turn - all[k].turn).norm(), 0.5);
  }
}

TEST(TubeScan, ShowsTheTurnedTubesInTheGel) {
  TubeScanOptions options;
  options.noise_hu = 0.0;
  const Orientation turned = twelve_orientations()[2];  // X90
  const imaging::ImageVolume image = scan_of(orientations_small_phantom(), turned, options);
  EXPECT_EQ(image.geometry.spacing, Vec3(0.6, 0.6, 1.25));
  const auto at = [&](const Vec3& in_phantom) {
    return imaging::sample(image, Vec3(turned.turn * in_phantom), imaging::Interpolation::trilinear);
  };
  const PhantomTube wide = orientations_small_phantom()[0];
  const Vec3 middle = 0.5 * (wide.from + wide.to), along = (wide.to - wide.from).normalized();
  const Vec3 across = along.unitOrthogonal();
  EXPECT_NEAR(at(middle), options.lumen_hu, 80.0);
  EXPECT_NEAR(at(middle + 4.0 * across), options.gel_hu, 1.0);
  EXPECT_NEAR(at(wide.to + 3.0 * along), options.gel_hu, 30.0);
  EXPECT_THROW(scan_of({}, turned, options), InvalidInput);
}

TEST(Orientations, TwoTubesInTwoOrientationsHaveTheirLengthsAndRadii) {
  const std::vector<Orientation> all = twelve_orientations();
  const std::vector<OrientationRun> runs =
      measure_orientations(orientations_small_phantom(), {all[0], all[7]});
  ASSERT_EQ(runs.size(), 2U);
  for (const OrientationRun& run : runs) {
    EXPECT_EQ(run.components, 2) << run.name;
    EXPECT_EQ(run.loops, 0);
    EXPECT_EQ(run.other_lines, 0);
    ASSERT_EQ(run.tubes.size(), 2U);
    for (const TubeMeasure& tube : run.tubes) {
      EXPECT_EQ(tube.lines, 1) << run.name << " " << tube.tube;
      EXPECT_NEAR(tube.length_mm, tube.true_length_mm, 1.0) << run.name << " " << tube.tube;
      EXPECT_NEAR(tube.radius_mm, tube.true_radius_mm, 0.20) << run.name << " " << tube.tube;
      EXPECT_NEAR(tube.grey_radius_mm, tube.true_radius_mm, 0.12) << run.name << " " << tube.tube;
    }
  }
  const OrientationRun again = measure_orientation(orientations_small_phantom(), all[7]);
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_EQ(again.tubes[t].length_mm, runs[1].tubes[t].length_mm);
    EXPECT_EQ(again.tubes[t].grey_radius_mm, runs[1].tubes[t].grey_radius_mm);
  }
}

/// Lengths 10 -+ 0.3 and 20 -+ 0.4 in two orientations; the second tube's truth is 19.5.
std::vector<OrientationRun> made_runs() {
  std::vector<OrientationRun> runs(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const double sign = i == 0 ? -1.0 : 1.0;
    runs[i].name = i == 0 ? "a" : "b";
    runs[i].tubes = {{"one", runs[i].name, 10.0, 1.0, 1, 10.0 + 0.3 * sign, 1.0, 1.0 + 0.1 * sign},
                     {"two", runs[i].name, 19.5, 2.0, 1, 20.0 + 0.4 * sign, 2.0, 2.0}};
  }
  return runs;
}

TEST(OrientationsSummary, IsOfTheDifferencesFromEachTubesMean) {
  const OrientationsSummary s = summarize(made_runs(), TubeQuantity::length);
  EXPECT_EQ(s.pairs, 4U);
  EXPECT_EQ(s.missing, 0U);
  // Two means were taken of four values: two are left.
  EXPECT_NEAR(s.two_sd_mm, 2.0 * std::sqrt((2.0 * 0.09 + 2.0 * 0.16) / 2.0), 1e-12);
  EXPECT_NEAR(s.farthest_mm, 0.4, 1e-12);
  EXPECT_EQ(s.beyond, 0U);
  EXPECT_NEAR(s.bias_mm, 0.25, 1e-12);
  EXPECT_NEAR(summarize(made_runs(), TubeQuantity::radius).two_sd_mm, 0.0, 1e-12);
  std::vector<OrientationRun> lacking = made_runs();
  lacking[0].tubes[1].lines = 0;
  EXPECT_EQ(summarize(lacking, TubeQuantity::length).missing, 1U);
  EXPECT_EQ(against_truth(lacking, TubeQuantity::length).result.size(), 3U);
  lacking.pop_back();
  EXPECT_THROW(summarize(lacking, TubeQuantity::length), InvalidInput);
}

TEST(OrientationsReport, WritesTablesAndPlots) {
  const fs::path folder = fs::temp_directory_path() / "ostia-orientations-report";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const OrientationsOptions options;
  write_orientations_report(folder, made_runs(), options);
  for (const char* name : {"measures.csv", "report.html", "length.png", "radius.png"})
    EXPECT_GT(fs::file_size(folder / name), 100U) << name;
  EXPECT_THAT(core::read_file(folder / "measures.csv"), ::testing::HasSubstr("two,b,19.500,2.000,1,20.4000"));
  EXPECT_TRUE(fits_schema(orientations_json(made_runs(), options), "orientations"));
  EXPECT_THAT(orientations_text(made_runs()), ::testing::HasSubstr("length"));
  fs::remove_all(folder);
}

TEST(Orientations, RefusesOptionsOutOfRange) {
  OrientationsOptions options;
  options.tau = 1.0;
  EXPECT_THROW(validate(options), InvalidInput);
  options = {};
  options.scan.lumen_hu = options.scan.gel_hu;
  EXPECT_THROW(measure_orientations(orientations_small_phantom(), twelve_orientations(), options),
               InvalidInput);
}

}  // namespace
}  // namespace ostia::experiments
