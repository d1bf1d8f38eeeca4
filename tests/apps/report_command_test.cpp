// `ostia report`: a case's folder of report, tables and pictures.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/imaging/image_file.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_file.h"
#include "ostia/session/image_digest.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>

namespace ostia::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::json;
namespace fs = std::filesystem;

/// 24 mm along z, with 0.4 of its diameter in the middle.
lumen::LumenModel model() {
  geometry::VesselTree tree;
  geometry::Centerline axis = geometry::straight_tube(24.0, 1.5, 0.5).tubes.front().axis;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const double t = (axis.points[i].z() - 13.0) / 3.5;
    if (std::abs(t) < 1.0) axis.radius[i] *= 1.0 - 0.3 * (1.0 + std::cos(3.14159265358979 * t));
  }
  geometry::complete(axis);
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, std::move(axis)}};
  tree.vessels = {{4, "LAD", {3}}};
  return lumen::model_of_tubes(tree);
}

imaging::ImageVolume image(std::int16_t lumen_hu = 400) {
  imaging::ImageVolume made;
  made.geometry.size = {24, 24, 30};
  made.geometry.spacing = {0.8, 0.8, 0.8};
  made.geometry.origin = {-9.6, -9.6, 0.0};
  for (int z = 0; z < 30; ++z)
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x)
        // Many values: an image of few is taken for a mask.
        made.voxels.push_back(std::hypot(0.8 * x - 9.6, 0.8 * y - 9.6) < 1.5
                                  ? lumen_hu
                                  : static_cast<std::int16_t>(-100 + 7 * x + 3 * y + z));
  return made;
}

/// A folder with `heart.nrrd`, and `heart.ostia` made with it.
fs::path report_case_folder(const std::string& name = "heart") {
  const fs::path folder = temporary_folder("report");
  imaging::write_image(folder / (name + ".nrrd"), image());
  session::CaseFile file = session::CaseFile::create(folder / (name + ".ostia"), model(),
                                                     session::image_reference(folder / (name + ".nrrd")));
  analysis::Measurement distance;
  distance.name = "my distance";
  distance.points = {{0.0, 0.0, 2.0}, {0.0, 0.0, 8.0}};
  file.annotate(session::MeasureAdd{distance});
  return folder;
}

TEST(ReportCommand, MakesTheFolderOnce) {
  const fs::path folder = report_case_folder();
  const std::vector<std::string> command{"report", "heart.ostia", "--image", "heart.nrrd",
                                         "-o",     "out",         "--date",  "2026-01-31"};
  const Outcome made = ostia(command, {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("CAD-RADS 3"));
  EXPECT_THAT(names_in(folder / "out"),
              ::testing::ElementsAre("images", "images/tree.png", "images/vessel-4.png", "manifest.json",
                                     "measurements.csv", "plaque.csv", "report.html", "report.json",
                                     "report.pdf", "segments.csv", "stenoses.csv"));
  const Json report = Json::parse(core::read_file(folder / "out" / "report.json"));
  EXPECT_EQ(report["date"], "2026-01-31");
  EXPECT_EQ(report["stenoses"].size(), 1U);
  EXPECT_NEAR(report["stenoses"][0]["diameter_percent"].get<double>(), 60.0, 4.0);
  EXPECT_EQ(report["measurements"][0]["values"][0]["value"], 6.0);
  EXPECT_GT(report["vessels"][0]["plaque"]["vessel_mm3"], report["vessels"][0]["plaque"]["lumen_mm3"]);
  EXPECT_EQ(core::read_file(folder / "out" / "report.pdf").substr(0, 5), "%PDF-");
  const auto written = fs::last_write_time(folder / "out" / "report.pdf");
  const Outcome again = ostia(command + std::vector<std::string>{"--json"}, {folder, ""});
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.err, HasSubstr("nothing to do"));
  EXPECT_EQ(Json::parse(again.out), report);
  EXPECT_EQ(fs::last_write_time(folder / "out" / "report.pdf"), written);
}

/// What a ring about the lumen of the report's case measures in the image.
double ring_hu(const fs::path& folder, const std::string& case_file, const std::string& image_file) {
  const Outcome made =
      ostia({"report", case_file, "--image", image_file, "-o", case_file + "-out", "--json"}, {folder, ""});
  EXPECT_EQ(made.code, 0) << made.err;
  if (made.code != 0) return 0.0;
  const Json report = Json::parse(made.out);
  return report["measurements"][0]["values"][0]["value"].get<double>();
}

TEST(ReportCommand, TurnsAnImageWhoseAxesWereGivenByHand) {
  const fs::path folder = temporary_folder("report");
  const imaging::ImageVolume right = image();
  // The same heart in a file that has its axes in another order and says nothing of it.
  imaging::ImageVolume wrong;
  wrong.geometry.size = {30, 24, 24};
  wrong.geometry.spacing = {0.8, 0.8, 0.8};
  const geometry::Vec3 middle(11.5, 11.5, 14.5);
  wrong.geometry.origin = right.geometry.world(middle) - 0.8 * geometry::Vec3(14.5, 11.5, 11.5);
  for (std::int64_t k = 0; k < 24; ++k)
    for (std::int64_t j = 0; j < 24; ++j)
      for (std::int64_t i = 0; i < 30; ++i) wrong.voxels.push_back(right(k, j, i));
  imaging::write_image(folder / "right.nrrd", right);
  imaging::write_image(folder / "wrong.nrrd", wrong);
  analysis::Measurement ring;
  ring.kind = analysis::MeasureKind::ring_hu;
  ring.vessel = 4;
  ring.from_mm = 5.0;
  ring.inner_mm = 0.2;
  ring.outer_mm = 2.0;
  for (const auto& [name, axes] : {std::pair("right", ""), std::pair("wrong", "SPL")}) {
    session::ImageReference reference = session::image_reference(folder / (std::string(name) + ".nrrd"));
    reference.axes = axes;
    session::CaseFile::create(folder / (std::string(name) + ".ostia"), model(), reference)
        .annotate(session::MeasureAdd{ring});
  }
  EXPECT_NEAR(ring_hu(folder, "wrong.ostia", "wrong.nrrd"), ring_hu(folder, "right.ostia", "right.nrrd"),
              0.5);
  const Json report = Json::parse(core::read_file(folder / "wrong.ostia-out" / "report.json"));
  EXPECT_EQ(report["image"]["axes"], "SPL");
  EXPECT_THAT(core::read_file(folder / "wrong.ostia-out" / "report.html"),
              HasSubstr("SPL, given by a person"));
  EXPECT_FALSE(
      Json::parse(core::read_file(folder / "right.ostia-out" / "report.json"))["image"].contains("axes"));
  // Labels of the case lie on the voxels of the file as it is.
  ASSERT_EQ(ostia({"convert", "wrong.ostia", "labels.nrrd", "--grid", "wrong.nrrd"}, {folder, ""}).code, 0);
  const auto labels = imaging::read_labels(folder / "labels.nrrd").volume;
  ASSERT_TRUE(imaging::same_grid(labels.geometry, wrong.geometry));
  std::size_t inside = 0, lumen = 0;
  for (std::size_t n = 0; n < labels.voxels.size(); ++n) {
    if (labels.voxels[n] == 0) continue;
    ++inside;
    lumen += wrong.voxels[n] == 400 ? 1U : 0U;
  }
  EXPECT_GT(inside, 100U);
  EXPECT_GT(lumen, inside * 9 / 10) << "labels are not where the lumen is";
}

TEST(ReportCommand, TakesACalciumScoreAndAnImpressionAndKeepsASignature) {
  const fs::path folder = report_case_folder();
  core::write_file(folder / "calcium.json", R"({"kind": "calcium score", "total": {"agatston": 312.5}})");
  core::write_file(folder / "text.txt", "Moderate stenosis of the LAD.\n");
  const auto report = [&](const std::string& output, const std::vector<std::string>& more) {
    return ostia(std::vector<std::string>{"report", "heart.ostia", "-o", output, "--json"} + more,
                 {folder, ""});
  };
  const std::string before = core::read_file(folder / "heart.ostia");
  Outcome made =
      report("a", {"--calcium", "calcium.json", "--impression", "text.txt", "--template", "short"});
  ASSERT_EQ(made.code, 0) << made.err;
  Json json = Json::parse(made.out);
  EXPECT_EQ(json["cad_rads"]["burden"]["by_calcium"], "P3");
  EXPECT_EQ(json["impression"]["text"], "Moderate stenosis of the LAD.");
  EXPECT_EQ(json["impression"]["by_person"], true);
  EXPECT_EQ(json["signed"], false);
  EXPECT_EQ(core::read_file(folder / "heart.ostia"), before) << "the case was written without being asked";
  const std::vector<std::string> sign{"--date", "2026-01-31", "--sign", "Dr. A"};
  made =
      report("b", sign + std::vector<std::string>{"--impression", "text.txt", "--calcium", "calcium.json"});
  ASSERT_EQ(made.code, 0) << made.err;
  json = Json::parse(made.out);
  EXPECT_EQ(json["signed"], true);
  EXPECT_EQ(json["versions"].size(), 1U);
  EXPECT_EQ(json["versions"][0]["signer"], "Dr. A");
  made = report("c", {});
  json = Json::parse(made.out);
  EXPECT_EQ(json["impression"]["text"], "Moderate stenosis of the LAD.") << "the case keeps it";
  EXPECT_EQ(json["signed"], true);
  made = report("d", sign);
  EXPECT_EQ(made.code, 3);
  EXPECT_THAT(made.err, HasSubstr("nothing has changed since version 1"));
  core::write_file(folder / "text.txt", "Another reading.");
  const std::vector<std::string> anew = sign + std::vector<std::string>{"--impression", "text.txt"};
  made = report("e", anew);
  EXPECT_EQ(made.code, 3);
  EXPECT_THAT(made.err, HasSubstr("does not say what changed"));
  EXPECT_EQ(Json::parse(report("f", {}).out)["impression"]["text"], "Moderate stenosis of the LAD.")
      << "half of a refused signature was kept";
  made = report("g", anew + std::vector<std::string>{"--change", "read again"});
  ASSERT_EQ(made.code, 0) << made.err;
  json = Json::parse(made.out);
  EXPECT_EQ(json["versions"].size(), 2U);
  EXPECT_EQ(json["versions"][1]["changes"], "read again");
}

TEST(ReportCommand, ASignatureIsKeptWithItsReportAlone) {
  const fs::path folder = report_case_folder();
  const std::vector<std::string> sign{"report", "heart.ostia", "-o",     "out",  "--json",
                                      "--date", "2026-01-31",  "--sign", "Dr. A"};
  ASSERT_LT(fs::file_size(folder / "heart.ostia"), 200'000U) << "its copy must fit below the limit";
  const Outcome failed = ostia(sign, {folder, "ulimit -f 400;"});  // blocks of 512 bytes: the pictures do not
  EXPECT_EQ(failed.code, 5) << failed.err;
  EXPECT_FALSE(fs::exists(folder / "out"));
  EXPECT_TRUE(session::CaseFile::open(folder / "heart.ostia", session::OpenMode::read_only)
                  .annotations()
                  ->report.versions.empty())
      << "signed without a report";
  const Outcome made = ostia(sign, {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(Json::parse(made.out)["signed"], true);
  const auto signed_case = session::CaseFile::open(folder / "heart.ostia", session::OpenMode::read_only);
  ASSERT_EQ(signed_case.annotations()->report.versions.size(), 1U);
  EXPECT_EQ(signed_case.annotations()->report.versions[0].signer, "Dr. A");
  // The report that was made of a copy is the one of the signed case.
  const Outcome again = ostia({"report", "heart.ostia", "-o", "out", "--date", "2026-01-31"}, {folder, ""});
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.err, HasSubstr("nothing to do"));
}

TEST(ReportCommand, RefusesTextsAndScoresThatAreNone) {
  const fs::path folder = report_case_folder();
  core::write_file(folder / "empty.txt", " \n");
  core::write_file(folder / "none.json", "{\"score\": 3}");
  core::write_file(folder / "less.json", "{\"agatston\": -3}");
  core::write_file(folder / "bad.json", "{");
  const std::vector<std::string> before = names_in(folder);
  const std::vector<std::pair<std::vector<std::string>, std::string>> commands{
      {{"--impression", "empty.txt"}, "the impression is empty"},
      {{"--impression", "missing.txt"}, "missing.txt"},
      {{"--calcium", "none.json"}, "no calcium score"},
      {{"--calcium", "bad.json"}, "no calcium score"},
      {{"--calcium", "less.json"}, "0 to 20000"},
      {{"--template", "long"}, "short"},
      {{"--sign", "Dr. A"}, "give a date"},
      {{"--change", "x"}, "--sign"}};
  for (const auto& [arguments, said] : commands) {
    const Outcome done =
        ostia(std::vector<std::string>{"report", "heart.ostia", "-o", "out"} + arguments, {folder, ""});
    EXPECT_NE(done.code, 0) << said;
    EXPECT_THAT(done.err, HasSubstr(said));
  }
  EXPECT_EQ(names_in(folder), before);
}

TEST(ReportCommand, DoesWithoutAnImageAndSaysSo) {
  const fs::path folder = report_case_folder();
  const Outcome made = ostia({"report", "heart.ostia", "-o", "out", "--json"}, {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  const Json report = Json::parse(made.out);
  EXPECT_EQ(report["image"]["at_hand"], false);
  EXPECT_THAT(made.err, HasSubstr("image was not at hand"));
}

TEST(ReportCommand, RefusesBadInputAndLeavesNothing) {
  const fs::path folder = report_case_folder();
  imaging::write_image(folder / "other.nrrd", image(390));
  core::write_file(folder / "no.ostia", "not a case");
  fs::create_directory(folder / "full");
  core::write_file(folder / "full" / "mine.txt", "mine");
  const std::vector<std::string> before = names_in(folder);
  const std::vector<std::pair<std::vector<std::string>, int>> commands{
      {{"heart.ostia", "--image", "other.nrrd", "-o", "out"}, 3},
      {{"heart.ostia", "--image", "missing.nrrd", "-o", "out"}, 3},
      {{"no.ostia", "-o", "out"}, 3},
      {{"missing.ostia", "-o", "out"}, 3},
      {{"heart.ostia", "-o", "full"}, 3},
      {{"heart.ostia", "-o", "no.ostia/out"}, 3},
      {{"heart.ostia", "-o", "out", "--window", "0"}, 2},
      {{"heart.ostia"}, 2},
  };
  for (const auto& [arguments, code] : commands) {
    const Outcome done = ostia(std::vector<std::string>{"report"} + arguments, {folder, ""});
    EXPECT_EQ(done.code, code) << done.err;
    EXPECT_FALSE(done.err.empty());
  }
  EXPECT_EQ(names_in(folder), before);
}

TEST(ReportCommand, NoNameOfAFileIsWritten) {
  const fs::path folder = report_case_folder("DOE^JANE");
  const Outcome made = ostia({"report", "DOE^JANE.ostia", "--image", (folder / "DOE^JANE.nrrd").string(),
                              "-o", "out", "--log", "json"},
                             {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out + made.err, Not(HasSubstr("DOE^JANE")));
  for (const std::string& name : names_in(folder / "out")) {
    if (fs::is_directory(folder / "out" / name)) continue;
    const std::string bytes = core::read_file(folder / "out" / name);
    EXPECT_EQ(bytes.find("DOE^JANE"), std::string::npos) << name;
    EXPECT_EQ(bytes.find(folder.string()), std::string::npos) << name;
  }
  // A person's own words do appear.
  EXPECT_THAT(core::read_file(folder / "out" / "report.html"), HasSubstr("my distance"));
}

TEST(ReportCommand, AnInterruptLeavesNothing) {
  const fs::path folder = report_case_folder();
  const std::vector<std::string> before = names_in(folder);
  double seconds = 0.0;
  const Outcome done =
      interrupted({"report", "heart.ostia", "-o", "out"}, {folder, ""}, SIGINT, 0.4, seconds);
  if (done.code == 0) GTEST_SKIP() << "done before it could be interrupted";
  EXPECT_EQ(done.code, 130);
  EXPECT_EQ(names_in(folder), before);
}

}  // namespace
}  // namespace ostia::testing
