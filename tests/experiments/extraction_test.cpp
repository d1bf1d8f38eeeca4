#include "ostia/experiments/extraction.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/experiments/extraction_report.h"
#include "ostia/geometry/polyline.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/lumen/start_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace ostia::experiments {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;

constexpr double radius_mm = 1.5;

/// Straight, narrowed about the middle by a share of its radius.
geometry::Centerline line(const Vec3& from, const Vec3& to, double narrowing) {
  geometry::Centerline made;
  const int steps = static_cast<int>(std::lround((to - from).norm() / 0.5));
  for (int i = 0; i <= steps; ++i) {
    const double off = (i - 0.5 * steps) * 0.5 / 4.0;
    made.points.push_back(from + (to - from) * i / steps);
    made.radius.push_back(
        radius_mm * (1.0 - (std::abs(off) < 1.0 ? narrowing * (0.5 + 0.5 * std::cos(M_PI * off)) : 0.0)));
  }
  geometry::complete(made);
  return made;
}

struct Line {
  Vec3 from, to;
  std::string name;
  double narrowing = 0.0;
};
/// Each line a vessel from a root of its own.
geometry::VesselTree tree_of(const std::vector<Line>& lines) {
  geometry::VesselTree tree;
  for (const Line& one : lines) {
    const auto id = static_cast<std::int32_t>(tree.vessels.size());
    tree.nodes.push_back({2 * id, one.from});
    tree.nodes.push_back({2 * id + 1, one.to});
    tree.segments.push_back({id, 2 * id, 2 * id + 1, line(one.from, one.to, one.narrowing)});
    tree.vessels.push_back({id, one.name, {id}});
  }
  return tree;
}

const Line lad{{0, 0, 0}, {0, 0, 60}, "LAD", 0.6}, lcx{{30, 0, 0}, {30, 0, 50}, "LCX"},
    rca{{60, 0, 0}, {60, 0, 40}, "RCA", 0.6};

ExtractionTruth truth() {
  ExtractionTruth made;
  made.case_name = "dataset00";
  made.tree = tree_of({lad, lcx, rca});
  for (const geometry::Vessel& vessel : made.tree.vessels) {
    const std::vector<Vec3> fine = geometry::resample(geometry::vessel_axis(made.tree, vessel).points, 0.05);
    const std::vector<double> radius(fine.size(), radius_mm), spread(fine.size(), 0.2);
    made.vessels.push_back({vessel.name, true, {fine, radius, spread}});
  }
  geometry::ContourSection section;
  section.section = "s01";
  section.vessel = "LCX";
  section.observer = "truth";
  for (double z = 15.0; z <= 35.0; z += 0.5) {
    geometry::Contour contour;
    contour.s_mm = z;
    for (int i = 0; i < 64; ++i) {
      const double theta = -2.0 * std::numbers::pi * i / 64;  // looking distally
      contour.points.emplace_back(30.0 + radius_mm * std::cos(theta), radius_mm * std::sin(theta), z);
    }
    section.contours.push_back(contour);
  }
  made.contours.sections = {section};
  section.observer = "observer1";  // nobody asks for it
  made.contours.sections.push_back(section);
  made.lesions = {{"LAD", 26.0, 34.0, 30.0, 0.6}, {"RCA", 16.0, 24.0, 20.0, 0.6}};
  return made;
}

session::FoundModel found_as(const std::vector<Line>& lines) {
  session::FoundModel found;
  const geometry::VesselTree tree = tree_of(lines);
  found.model = lumen::model_of_tubes(tree);
  found.found.vessels.tree = tree;
  for (const Line& one : lines) {
    coronary::VesselLabel label;
    label.vessel = static_cast<std::int32_t>(found.found.vessels.labels.size());
    label.likeliest = one.name;
    label.confidence = 1.0;
    found.found.vessels.labels.push_back(std::move(label));
  }
  return found;
}

TEST(ExtractionExperiment, WhatIsFoundMissedAndAstrayIsCounted) {
  // LAD 0.3 mm beside its place, LCX under another name, no RCA, 20 mm of something else.
  const Line beside{{0.3, 0, 0}, {0.3, 0, 60}, "LAD", 0.6}, misnamed{{30, 0, 0}, {30, 0, 50}, "OM1"},
      vein{{0, 20, 0}, {0, 20, 20}, "D1"};
  const ExtractionRun run = score_extraction(truth(), found_as({beside, misnamed, vein}));
  ASSERT_EQ(run.vessels.size(), 3U);
  EXPECT_NEAR(run.vessels[0].scores.ov, 1.0, 1e-9);
  EXPECT_NEAR(run.vessels[0].scores.ai_mm, 0.3, 0.01);
  EXPECT_EQ(run.vessels[0].verdict, NameVerdict::right);
  EXPECT_EQ(run.vessels[1].verdict, NameVerdict::wrong);
  EXPECT_EQ(run.vessels[1].found_name, "OM1");
  EXPECT_EQ(run.vessels[2].verdict, NameVerdict::missing);
  EXPECT_NEAR(run.vessels[2].scores.ov, 0.0, 1e-9);
  ASSERT_EQ(run.vessels[2].missed_mm.size(), 1U);
  EXPECT_NEAR(run.vessels[2].missed_mm[0].second, 40.0, 1e-6);
  EXPECT_NEAR(run.found_mm, 130.0, 1e-6);
  EXPECT_NEAR(run.astray_mm, 20.0, 1e-6);
  EXPECT_NEAR(run.longest_astray_mm, 20.0, 1e-6);

  ASSERT_EQ(run.sections.size(), 1U);
  EXPECT_GT(run.sections[0].dice, 0.97);
  EXPECT_LT(run.sections[0].msd_mm, 0.03);

  const ExtractionSummary all = summarize({run}, {});
  EXPECT_EQ(all.right, 1U);
  EXPECT_EQ(all.wrong, 1U);
  EXPECT_EQ(all.missing, 1U);
  EXPECT_NEAR(all.annotated.ov, 2.0 / 3.0, 1e-9);
  EXPECT_EQ(all.stenoses.all.true_positive, 1U);
  EXPECT_EQ(all.stenoses.all.false_negative, 1U);
  EXPECT_EQ(all.stenoses.all.false_positive, 0U);
}

TEST(ExtractionExperiment, AStenosisWhereNoneIsCountsAsFalse) {
  Line narrowed = lcx;
  narrowed.narrowing = 0.6;
  const ExtractionRun run = score_extraction(truth(), found_as({lad, narrowed, rca}));
  const ExtractionSummary all = summarize({run}, {});
  EXPECT_EQ(all.stenoses.all.true_positive, 2U);
  EXPECT_EQ(all.stenoses.all.false_positive, 1U);
  EXPECT_NEAR(all.stenoses.all.ppv(), 2.0 / 3.0, 1e-9);
  EXPECT_THAT(extraction_text({run}, {}), HasSubstr("LCX: stenosis of - %"));
}

TEST(ExtractionExperiment, NothingFoundIsAllMissed) {
  const ExtractionRun run = score_of_no_extraction(truth(), "no aorta");
  const ExtractionSummary all = summarize({run}, {});
  EXPECT_EQ(all.annotated.ov, 0.0);
  EXPECT_EQ(all.missing, 3U);
  EXPECT_EQ(all.healthy.missing, 1U);
  EXPECT_EQ(all.stenoses.all.false_negative, 2U);
  EXPECT_THAT(extraction_json({run}, {}), HasSubstr("no aorta"));
}

TEST(ExtractionExperiment, SaysWhatASuiteLacks) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "extraction_suite";
  std::filesystem::remove_all(folder);
  EXPECT_THROW(extract_suite(folder), InvalidInput);
  std::filesystem::create_directories(folder / "dataset00");
  try {
    extract_suite(folder);
    FAIL() << "a case without an image";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("holds no image"));
  }
  EXPECT_THROW(read_extraction_truth(folder / "dataset00"), InvalidInput);
  std::filesystem::remove_all(folder);
  ExtractionScoreOptions options;
  options.threshold = 1.0;
  EXPECT_THROW(extract_suite(folder, options), InvalidInput);
}

TEST(ExtractionExperiment, TrueStenosesAreGradedByAreaAsFoundOnesAre) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "graded_truth";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  io::write_centerlines(folder / "centerlines.vtp", tree_of({lad}));
  io::write_contours(folder / "contours.json", truth().contours);
  // Eccentric: by the mean distance from the axis 58 %, by the lumen's area 1 - sqrt(1 - 0.75).
  core::write_file(folder / "case.json",
                   R"({"data_set_vessels": [], "vessels": [{"name": "LAD", "stenoses": [
      {"s_from_mm": 26, "s_to_mm": 34, "s_throat_mm": 30, "diameter_stenosis": 0.58, "area_stenosis": 0.75}]}]})");
  const ExtractionTruth read = read_extraction_truth(folder);
  ASSERT_EQ(read.lesions.size(), 1U);
  EXPECT_DOUBLE_EQ(read.lesions[0].grade, 0.5);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace ostia::experiments
