// The files of a report, and its key images.

#include "report_cases.h"
#include "schema_rules.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/session/case_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>

namespace ostia::session {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

struct Made {
  lumen::LumenModel model;
  CaseReport report;
  std::vector<KeyImage> images;
};

Made made_of(lumen::LumenModel model, const Annotations& notes = {},
             const imaging::ImageVolume* image = nullptr, const std::vector<JournalEntry>& journal = {}) {
  const analysis::SurfaceOfVessel surfaces = solved_surfaces(model);
  CaseReport report = make_case_report(model, surfaces, notes, journal, image);
  std::vector<KeyImage> images = key_images(report, model, surfaces, image);
  return {std::move(model), std::move(report), std::move(images)};
}

/// A report alone: pictures take their time.
Made without_images() {
  lumen::LumenModel model = tube_model();
  CaseReport report = report_of(model);
  return {std::move(model), std::move(report), {}};
}

pipeline::JobKey job() {
  return {"report", {{"case", "1"}}, "{}"};
}

std::vector<std::string> names_of(const std::vector<KeyImage>& images) {
  std::vector<std::string> names;
  for (const KeyImage& image : images) names.push_back(image.name);
  return names;
}

/// All files of a folder but the manifest, by name.
std::map<std::string, std::string> content(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename() != "manifest.json")
      files[fs::relative(entry.path(), folder).generic_string()] = core::read_file(entry.path());
  return files;
}

TEST(KeyImages, ShowTheTreeAndTheVesselsThatMatter) {
  const imaging::ImageVolume image = tube_image();
  const Made made = made_of(narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6), {}, &image);
  EXPECT_THAT(names_of(made.images), ElementsAre("tree", "vessel-4"));
  EXPECT_THAT(made.images[1].caption, HasSubstr("RCA"));
  EXPECT_THAT(made.images[1].caption, HasSubstr("throat"));
  const Made without = made_of(narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6));
  EXPECT_NE(made.images[1].picture.png(), without.images[1].picture.png());
  EXPECT_EQ(made.images[0].picture.png(), without.images[0].picture.png());
}

TEST(KeyImages, AVesselWithoutANameOrStenosisIsShownWhereItIsOneOfTheLongest) {
  const Made made = made_of(narrowed_tube("vessel", 30.0, 1.5, 15.0, 1.5));
  EXPECT_THAT(names_of(made.images), ElementsAre("tree", "vessel-4"));
  EXPECT_THAT(made.images[1].caption, Not(HasSubstr("throat")));
}

TEST(KeyImages, SideBranchesAreShownFromAStenosisOn) {
  geometry::VesselTree tree = lumen::testing::tree_of(geometry::y_junction(15.0, 20.0, 2.0, 1.4, 70.0));
  tree.vessels[0].name = "LAD";
  tree.vessels[1].name = "D1";
  const lumen::LumenModel model = lumen::model_of_tubes(tree);
  const std::string lad = "vessel-" + std::to_string(tree.vessels[0].id);
  EXPECT_THAT(names_of(made_of(model).images), ElementsAre("tree", lad));
}

TEST(KeyImages, AShutLumenHasThemToo) {
  const Made made = made_of(shut_tube());
  ASSERT_FALSE(made.report.stenoses.empty());
  EXPECT_EQ(made.report.stenoses[0].stenosis.diameter_percent, 100.0);
  EXPECT_EQ(to_string(made.report.category), "N");  // nobody has checked it
  EXPECT_EQ(made.images.size(), 2U);
  for (const ReportSegment& segment : made.report.segments)
    EXPECT_EQ(segment.volume_mm3.has_value(), segment.worst_percent < 100.0) << segment.label;
}

TEST(ReportFolder, HoldsAllFilesAndTheSameBytesTwice) {
  const TempFolder folder;
  const imaging::ImageVolume image = tube_image();
  for (const char* name : {"a", "b"}) {
    const Made made = made_of(narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6), {}, &image);
    write_case_report(folder / name, made.report, made.images, job());
  }
  const auto files = content(folder / "a");
  std::set<std::string> names;
  for (const auto& [name, bytes] : files) names.insert(name);
  EXPECT_EQ(names, (std::set<std::string>{"images/tree.png", "images/vessel-4.png", "measurements.csv",
                                          "plaque.csv", "report.html", "report.json", "report.pdf",
                                          "segments.csv", "stenoses.csv"}));
  const auto again = content(folder / "b");
  for (const auto& [name, bytes] : files) EXPECT_TRUE(again.at(name) == bytes) << name;
  EXPECT_TRUE(pipeline::already_done(folder / "a", job()));
  EXPECT_FALSE(pipeline::already_done(folder / "a", {"report", {{"case", "2"}}, "{}"}));
}

TEST(ReportFolder, NamesAPatientInTheTwoDocumentsAloneAndWhereAsked) {
  const TempFolder folder;
  const Made made = without_images();
  const imaging::ShownIdentity jane{"Doe <Jane>", "id-4711", "2024-03-01", "CTA 0.6", 0};
  write_case_report(folder / "plain", made.report, made.images, job());
  write_case_report(folder / "named", made.report, made.images, job(), 0.0, core::no_task(), jane);
  const auto plain = content(folder / "plain"), named = content(folder / "named");
  for (const auto& [name, bytes] : named) {
    const bool document = name == "report.html" || name == "report.pdf";
    EXPECT_EQ(bytes != plain.at(name), document) << name;
    for (const char* word : {"Jane", "4711", "2024-03-01", "CTA 0.6"}) {
      const bool says = bytes.find(word) != std::string::npos;
      EXPECT_TRUE(document || !says) << name << ": " << word;
    }
  }
  const std::string& html = named.at("report.html");
  for (const char* word : {"Doe &lt;Jane&gt;", "id-4711", "2024-03-01", "CTA 0.6"})
    EXPECT_NE(html.find(word), std::string::npos) << word;
  EXPECT_EQ(bytes_of_file(folder / "named" / "manifest.json").find("4711"), std::string::npos);
}

TEST(ReportFolder, IsWrittenWholeOrNotAtAll) {
  const TempFolder folder;
  const Made made = without_images();
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(write_case_report(folder / "a", made.report, made.images, job(), 0.0, task), Cancelled);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  fs::create_directory(folder / "b");
  write_bytes(folder / "b" / "mine.txt", "mine");
  EXPECT_THROW(write_case_report(folder / "b", made.report, made.images, job()), InvalidInput);
  EXPECT_EQ(bytes_of_file(folder / "b" / "mine.txt"), "mine");
  EXPECT_THROW(write_case_report(folder / "b" / "mine.txt" / "c", made.report, made.images, job()), IoError);
}

TEST(ReportFolder, TakesFurtherPicturesAndRefusesUnfitNames) {
  const TempFolder folder;
  Made made = without_images();
  const figure::Picture pinned = figure::picture_of({1, 1, {9, 9, 9, 255}});
  made.images.push_back({"pinned-1", "The tree as it was seen", pinned});
  write_case_report(folder / "a", made.report, made.images, job());
  EXPECT_TRUE(fs::exists(folder / "a" / "images" / "pinned-1.png"));
  EXPECT_THAT(core::read_file(folder / "a" / "report.html"), HasSubstr("The tree as it was seen"));
  for (const std::string& name : {std::string("Pinned-1"), std::string(), std::string("../x"),
                                  std::string("a.b"), std::string(65, 'a')}) {
    std::vector<KeyImage> images = made.images;
    images.push_back({name, "again", pinned});
    EXPECT_THROW(write_case_report(folder / "b", made.report, images, job()), InvalidInput) << name;
  }
  EXPECT_FALSE(fs::exists(folder / "b"));
}

TEST(ReportText, APersonsOwnWordsAppearAndAreEscaped) {
  Annotations notes;
  notes.marks = {{tube_vessel, true, true, std::nullopt, "<script>alert(1)</script>"}};
  notes.measurements = {measurement(analysis::MeasureKind::distance)};
  notes.measurements[0].id = 1;
  notes.measurements[0].name = "=1+1, \"x\"";
  const CaseReport report = report_of(tube_model(), notes);
  const std::string html = report_html(report, {});
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)"));
  EXPECT_THAT(html, HasSubstr("Every vessel was checked by a person"));
  EXPECT_THAT(measurements_csv(report), HasSubstr("1,distance,\"'=1+1, \"\"x\"\"\",,length,"));
  EXPECT_EQ(Json::parse(report_json(report, {}))["measurements"][0]["name"], "=1+1, \"x\"");
}

TEST(ReportText, WhatNobodyCheckedStandsOut) {
  const std::string html = report_html(report_of(tube_model()), {});
  EXPECT_THAT(html, HasSubstr("Not checked by a person: LAD"));
  EXPECT_THAT(html, HasSubstr("research software"));
  EXPECT_THAT(html, Not(HasSubstr("Every vessel was checked")));
}

TEST(ReportText, TheTablesHaveALineForEach) {
  const CaseReport report = report_of(narrowed_tube("RCA", 40.0, 1.5, 23.0, 0.6));
  const auto lines = [](const std::string& csv) { return std::count(csv.begin(), csv.end(), '\n'); };
  EXPECT_EQ(lines(segments_csv(report)), 1 + static_cast<long>(report.segments.size()));
  EXPECT_EQ(lines(stenoses_csv(report)), 2);
  EXPECT_EQ(lines(measurements_csv(report)), 1);
  EXPECT_EQ(lines(plaque_csv(report)), 1);  // no image
  for (const std::string& csv : {segments_csv(report), stenoses_csv(report)}) {
    std::istringstream in(csv);
    std::string line;
    std::getline(in, line);
    const auto columns = std::count(line.begin(), line.end(), ',');
    while (std::getline(in, line)) EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
  }
  EXPECT_THAT(stenoses_csv(report), HasSubstr("S1,RCA,dRCA (3),RCA,"));
}

TEST(ReportJson, HasTheFieldsOfItsSchema) {
  Annotations notes;
  notes.measurements = {measurement(analysis::MeasureKind::stenosis)};
  notes.measurements[0].id = 1;
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6);
  ReportOptions options;
  options.image = ImageReference{std::string(64, 'a'), "image-aaaaaaaa"};
  const CaseReport report = report_of(
      model, notes, {{1, "case.begin", "{}", false, false, StepKind::begin, {"note"}}}, nullptr, options);
  const std::vector<KeyImage> images{{"tree", "The tree", figure::picture_of({1, 1, {9, 9, 9, 255}})}};
  const Json json = Json::parse(report_json(report, images));
  const Schema schema("case-report.schema.json");
  EXPECT_EQ(names_in(schema["properties"]), names_in(json));
  const std::map<std::string, std::string> lists{{"vessels", "vessel"},
                                                 {"segments", "segment"},
                                                 {"stenoses", "stenosis"},
                                                 {"measurements", "measurement"},
                                                 {"steps", "step"},
                                                 {"images", "image"},
                                                 {"standard_segments", "standard_segment"}};
  for (const auto& [list, one] : lists) {
    ASSERT_FALSE(json[list].empty()) << list;
    EXPECT_EQ(names_in(schema.definition(one)["properties"]), names_in(json[list][0])) << list;
    EXPECT_EQ(schema.definition(one)["required"].size(), json[list][0].size()) << list;
  }
}

TEST(ReportText, PlaqueStandsInTablesAndInJsonAsItsSchemaHasIt) {
  const imaging::ImageVolume image = walled_image(1.5, 2.6, 60.0);
  const CaseReport report = report_of(narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6), {}, {}, &image);
  const std::string csv = plaque_csv(report);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);  // header, vessel, stenosis, plaque on both sides
  EXPECT_THAT(csv, HasSubstr("\r\nRCA,,"));
  EXPECT_THAT(csv, HasSubstr("\r\nRCA,S1,"));
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  const auto columns = std::count(line.begin(), line.end(), ',');
  while (std::getline(in, line)) EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
  EXPECT_THAT(report_html(report, {}), HasSubstr("Remodelling index"));
  EXPECT_THAT(report_html(report_of(tube_model()), {}), HasSubstr("Not measured: the image was not at hand"));
  const Json json = Json::parse(report_json(report, {}));
  const Schema schema("case-report.schema.json");
  for (const Json& plaque : {json["vessels"][0]["plaque"], json["stenoses"][0]["plaque"]}) {
    EXPECT_EQ(names_in(schema.definition("plaque")["properties"]), names_in(plaque));
    EXPECT_EQ(schema.definition("plaque")["required"].size(), plaque.size());
  }
  EXPECT_GT(json["stenoses"][0]["remodelling_index"].get<double>(), 0.5);
  EXPECT_TRUE(Json::parse(report_json(report_of(tube_model()), {}))["vessels"][0]["plaque"].is_null());
}

TEST(ReportDigest, FollowsWhatTheReportIsMadeOf) {
  const TempFolder folder;
  std::set<std::string> digests;
  digests.insert(report_digest(CaseFile::create(folder / "a.ostia", tube_model())));
  CaseFile file = CaseFile::open(folder / "a.ostia");
  digests.insert(report_digest(file));
  EXPECT_EQ(digests.size(), 1U);
  file.annotate(marked("seen"));
  digests.insert(report_digest(file));
  file.annotate(added(analysis::MeasureKind::distance));
  digests.insert(report_digest(file));
  file.apply(ring(10.0, 1.8));
  digests.insert(report_digest(file));
  file.undo();
  digests.insert(report_digest(file));
  EXPECT_EQ(digests.size(), 5U);
  ReportOptions turned;
  turned.theta_deg = 30.0;
  EXPECT_NE(report_job(file, false, {}).parameters, report_job(file, false, turned).parameters);
  EXPECT_NE(report_job(file, false, {}).parameters, report_job(file, false, {}, {}, true).parameters);
  const std::vector<KeyImage> pinned{
      {"pinned-1", "Pinned by the reader", figure::picture_of({2, 1, {255, 0, 0, 255, 0, 0, 0, 255}})}};
  pipeline::JobKey later = report_job(file, false, {});
  add_further(later, pinned);
  EXPECT_EQ(later.parameters, report_job(file, false, {}, pinned).parameters);
  EXPECT_NE(later.parameters, report_job(file, false, {}).parameters);
}

}  // namespace
}  // namespace ostia::session
