// `ostia evaluate`: surfaces and suites, requirements, refusals.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/io/contour_file.h"
#include "ostia/io/rotterdam_file.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

void write_tube(const fs::path& path, double radius_mm, double scale = 1.0) {
  const auto shape = geometry::straight_tube(20.0, radius_mm);
  geometry::TriMesh mesh = geometry::structured_surface(shape.tubes.front(), 96, 0.4);
  for (auto& p : mesh.points) p = scale * (p + geometry::Vec3(30.0, 50.0, 70.0));
  io::write_surface(path, mesh);
}

TEST(EvaluateCommand, SurfaceOfConcentricTubes) {
  const fs::path folder = temporary_folder("evaluate");
  write_tube(folder / "a.vtp", 1.5);
  write_tube(folder / "b.vtp", 1.6);
  const Outcome done = ostia({"evaluate", "surface", "a.vtp", "b.vtp", "--json"}, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json out = Json::parse(done.out);
  EXPECT_EQ(out["v"], 1);
  EXPECT_NEAR(out["msd_mm"].get<double>(), 0.1, 0.002);
  EXPECT_NEAR(out["hausdorff_mm"].get<double>(), 0.1, 0.004);
  EXPECT_EQ(out["result"]["open_edges"], 192);
  const Outcome text = ostia({"evaluate", "surface", "a.vtp", "b.vtp"}, {folder, ""});
  EXPECT_THAT(text.out, HasSubstr("msd_mm"));
}

TEST(EvaluateCommand, RequirementsDecideTheExitCode) {
  const fs::path folder = temporary_folder("evaluate");
  write_tube(folder / "a.vtp", 1.5);
  write_tube(folder / "b.vtp", 1.6);
  const std::vector<std::string> base{"evaluate", "surface", "a.vtp", "b.vtp", "--require"};
  EXPECT_EQ(ostia(base + std::vector<std::string>{"msd_mm<=0.2"}, {folder, ""}).code, 0);
  EXPECT_EQ(ostia(base + std::vector<std::string>{"reference.triangles>=100"}, {folder, ""}).code, 0);
  const Outcome failed = ostia(base + std::vector<std::string>{"msd_mm<=0.05"}, {folder, ""});
  EXPECT_EQ(failed.code, 4);
  EXPECT_THAT(failed.err, HasSubstr("msd_mm<=0.05"));
  EXPECT_THAT(failed.out, HasSubstr("msd_mm")) << "the figures are printed all the same";
  EXPECT_EQ(ostia(base + std::vector<std::string>{"msd<=0.05"}, {folder, ""}).code, 2);
  EXPECT_EQ(ostia(base + std::vector<std::string>{"msd_mm=0.05"}, {folder, ""}).code, 2);
  EXPECT_EQ(ostia(base + std::vector<std::string>{"msd_mm<=a"}, {folder, ""}).code, 2);
}

TEST(EvaluateCommand, UnitsAreNotGuessedAt) {
  const fs::path folder = temporary_folder("evaluate");
  write_tube(folder / "a.vtp", 1.5, 0.001);
  write_tube(folder / "b.vtp", 1.6, 0.001);
  const Outcome guess = ostia({"evaluate", "surface", "a.vtp", "b.vtp"}, {folder, ""});
  EXPECT_EQ(guess.code, 3);
  EXPECT_THAT(guess.err, HasSubstr("--units"));
  EXPECT_THAT(guess.out, IsEmpty());
  const Outcome told =
      ostia({"evaluate", "surface", "a.vtp", "b.vtp", "--units", "m", "--json"}, {folder, ""});
  ASSERT_EQ(told.code, 0) << told.err;
  EXPECT_NEAR(Json::parse(told.out)["msd_mm"].get<double>(), 0.1, 0.002);
}

TEST(EvaluateCommand, OtherAxesAreSaid) {
  const fs::path folder = temporary_folder("evaluate");
  write_tube(folder / "a.vtp", 1.5);
  geometry::TriMesh mesh = io::read_surface(folder / "a.vtp").surface.mesh;
  for (auto& p : mesh.points) p = geometry::Vec3(-p.x(), -p.y(), p.z());
  io::write_surface(folder / "b.vtp", mesh);
  const Outcome done = ostia({"evaluate", "surface", "a.vtp", "b.vtp", "--json"}, {folder, ""});
  EXPECT_EQ(done.code, 0);
  EXPECT_THAT(Json::parse(done.out)["warnings"].dump(), HasSubstr("RAS"));
}

TEST(EvaluateCommand, BadInputIsThreeAndNamed) {
  const fs::path folder = temporary_folder("evaluate");
  write_tube(folder / "a.vtp", 1.5);
  core::write_file(folder / "empty.vtp", "");
  fs::create_directory(folder / "nothing");
  const Outcome empty = ostia({"evaluate", "surface", "a.vtp", "empty.vtp"}, {folder, ""});
  EXPECT_EQ(empty.code, 3);
  EXPECT_THAT(empty.err, HasSubstr("empty.vtp"));
  EXPECT_EQ(ostia({"evaluate", "surface", "a.vtp", "none.vtp"}, {folder, ""}).code, 3);
  EXPECT_EQ(ostia({"evaluate", "surface", "a.vtp", "nothing"}, {folder, ""}).code, 3);
  EXPECT_EQ(ostia({"evaluate", "surface", "a.vtp"}, {folder, ""}).code, 2);
  EXPECT_EQ(ostia({"evaluate"}, {folder, ""}).code, 2);
  EXPECT_EQ(ostia({"evaluate", "suite", "nothing", "nothing"}, {folder, ""}).code, 3);
}

// A reference of 31 points, one of them twice; the line goes on beyond its end by 10 points, one of them
// twice.
TEST(EvaluateCommand, CenterlinesByEitherRulesWithRepeatedPoints) {
  const fs::path folder = temporary_folder("evaluate");
  std::string reference, result;
  for (int i = 0; i <= 40; ++i) {
    const std::string point = "0 0 " + std::to_string(i) + ".0";
    result += point + "\n" + (i == 35 ? point + "\n" : "");
    if (i <= 30) reference += point + " 1.5 0.2\n" + (i == 7 ? point + " 1.5 0.2\n" : "");
  }
  core::write_file(folder / "reference.txt", reference);
  core::write_file(folder / "result.txt", result);
  const std::vector<std::string> base{"evaluate", "centerline", "reference.txt", "result.txt", "--json"};
  const Outcome done = ostia(base, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("the result has 1 point that repeats the one before"));
  const Json challenge = Json::parse(done.out);
  EXPECT_EQ(challenge["rules"], "challenge");
  EXPECT_EQ(challenge["vessels"][0]["reference_repeated"], 1);
  EXPECT_EQ(challenge["vessels"][0]["result_repeated"], 1);
  EXPECT_DOUBLE_EQ(challenge["vessels"][0]["of"].get<double>(), 31.0 / 32.0);
  EXPECT_EQ(challenge["vessels"][0]["ot"], 1.0);
  const Json paper =
      Json::parse(ostia(base + std::vector<std::string>{"--rules", "paper"}, {folder, ""}).out);
  EXPECT_EQ(paper["rules"], "paper");
  EXPECT_EQ(paper["vessels"][0]["of"], 1.0);
  EXPECT_EQ(paper["vessels"][0]["ot"], paper["vessels"][0]["ov"]);
  EXPECT_EQ(paper["vessels"][0]["ov"], challenge["vessels"][0]["ov"]);
  EXPECT_EQ(ostia(base + std::vector<std::string>{"--rules", "other"}, {folder, ""}).code, 2);
}

TEST(EvaluateCommand, SuiteFindsARegressionAndWritesAReport) {
  const fs::path folder = temporary_folder("evaluate");
  for (const char* run : {"golden", "new"}) {
    fs::create_directories(folder / run / "dataset00");
    core::write_file(folder / run / "dataset00" / "lumen.json", R"({"v":1,"dice":0.95,"msd_mm":0.1})");
    write_tube(folder / run / "dataset00" / "lumen.vtp", 1.5);
  }
  const Outcome same = ostia({"evaluate", "suite", "golden", "new"}, {folder, ""});
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("; passed"));

  write_tube(folder / "new" / "dataset00" / "lumen.vtp", 1.9);
  core::write_file(folder / "new" / "dataset00" / "lumen.json", R"({"v":1,"dice":0.80,"msd_mm":0.1})");
  const Outcome worse = ostia({"evaluate", "suite", "golden", "new", "--json", "-o", "report"}, {folder, ""});
  EXPECT_EQ(worse.code, 4);
  const Json out = Json::parse(worse.out);
  EXPECT_EQ(out["passed"], false);
  EXPECT_EQ(out["counts"]["regression"], 3);
  EXPECT_EQ(Json::parse(core::read_file(folder / "report" / "suite.json")), out);
  EXPECT_THAT(core::read_file(folder / "report" / "report.html"), HasSubstr("dataset00/lumen.vtp"));

  core::write_file(folder / "F.json", R"({"v":1,"figures":[{"key":"dice","absolute":0.2}],
                                          "surfaces":[{"mean_mm":0.5,"max_mm":0.5}]})");
  EXPECT_EQ(ostia({"evaluate", "suite", "golden", "new", "--tolerance", "F.json"}, {folder, ""}).code, 0);
  core::write_file(folder / "F.json", R"({"v":1,"figures":[{"key":"dice","absolute":-0.2}]})");
  const Outcome wrong = ostia({"evaluate", "suite", "golden", "new", "--tolerance", "F.json"}, {folder, ""});
  EXPECT_EQ(wrong.code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("figures[0].absolute"));
  EXPECT_EQ(ostia({"evaluate", "suite", "golden", "new", "-o", "golden"}, {folder, ""}).code, 2)
      << "a report does not replace a folder that holds something else";
  EXPECT_TRUE(fs::exists(folder / "golden" / "dataset00" / "lumen.vtp"));
}

/// A data set: one vessel along +z with a reference line, an observer's line and one section of contours.
void write_data_set(const fs::path& folder, double radius_mm) {
  fs::create_directories(folder / "vessel1");
  io::RotterdamReference reference;
  std::vector<geometry::Vec3> observer;
  for (int i = 0; i <= 500; ++i) {
    reference.points.emplace_back(30.0, 50.0, 70.5 + 0.03 * i);
    reference.radius.push_back(radius_mm);
    reference.observer_spread.push_back(0.2);
    observer.emplace_back(30.2, 50.0, 70.5 + 0.03 * i);
  }
  io::write_rotterdam_reference(folder / "vessel1" / "reference.txt", reference);
  io::write_rotterdam_line(folder / "vessel1" / "observer1.txt", observer);
  geometry::ContourSet set;
  for (const char* name : {"truth", "observer1"}) {
    geometry::ContourSection section;
    section.section = "s01";
    section.vessel = "LAD";
    section.observer = name;
    const double drawn = section.observer == "truth" ? radius_mm : radius_mm + 0.1;
    for (int k = 0; k <= 20; ++k) {
      geometry::Contour contour{0.5 * k, {}};
      for (int i = 0; i < 64; ++i) {
        const double a = -2.0 * std::numbers::pi * i / 64;
        contour.points.emplace_back(30.0 + drawn * std::cos(a), 50.0 + drawn * std::sin(a), 75.0 + 0.5 * k);
      }
      section.contours.push_back(contour);
    }
    set.sections.push_back(section);
  }
  io::write_contours(folder / "contours.json", set);
}

TEST(EvaluateCommand, CenterlineOfADataSet) {
  const fs::path folder = temporary_folder("evaluate");
  write_data_set(folder / "dataset00", 1.5);
  fs::create_directories(folder / "out");
  core::write_file(folder / "out" / "centerlines.csv",
                   "x,y,z,radius\n30,50.3,70,1.5\n30,50.3,80,1.5\n30,50.3,90,1.5\n");
  const Outcome done =
      ostia({"evaluate", "centerline", "dataset00", "out", "--json", "-o", "lines.html"}, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json row = Json::parse(done.out)["vessels"][0];
  EXPECT_EQ(row["vessel"], "vessel1");
  EXPECT_GT(row["ov"].get<double>(), 0.9);
  EXPECT_NEAR(row["ai_mm"].get<double>(), 0.3, 0.05) << "the end beyond the reference's is within its radius";
  EXPECT_EQ(row["observer_ov"], 1.0);
  EXPECT_TRUE(fs::exists(folder / "lines.html"));
  // A result elsewhere is counted as missed, not left out.
  core::write_file(folder / "out" / "centerlines.csv", "x,y,z,radius\n0,0,0,1\n0,0,9,1\n");
  const Outcome missed = ostia({"evaluate", "centerline", "dataset00", "out", "--json"}, {folder, ""});
  EXPECT_EQ(missed.code, 0);
  EXPECT_EQ(Json::parse(missed.out)["mean"]["missing"], 1);
  EXPECT_EQ(Json::parse(missed.out)["mean"]["ov"], 0.0);
}

TEST(EvaluateCommand, LumenOfADataSetAndOfASuite) {
  const fs::path folder = temporary_folder("evaluate");
  write_data_set(folder / "suite" / "dataset00", 1.5);
  write_data_set(folder / "suite" / "dataset01", 1.5);
  fs::create_directories(folder / "out" / "dataset00");
  write_tube(folder / "out" / "dataset00" / "lumen.vtp", 1.6);
  const Outcome one = ostia(
      {"evaluate", "lumen", "suite/dataset00", "out/dataset00", "--json", "--stenoses", "-o", "lumen.html"},
      {folder, ""});
  ASSERT_EQ(one.code, 0) << one.err;
  const Json out = Json::parse(one.out);
  ASSERT_EQ(out["sections"].size(), 2u);
  EXPECT_NEAR(out["sections"][0]["msd_mm"].get<double>(), 0.1, 0.003);
  EXPECT_NEAR(out["sections"][1]["msd_mm"].get<double>(), 0.0, 0.003)
      << "the observer's radius is the result's";
  ASSERT_EQ(out["summary"].size(), 3u) << "result with both, observer with truth";
  EXPECT_EQ(out["summary"][0]["compared"], "observer - truth");
  EXPECT_NEAR(out["summary"][0]["max_sd_mm"].get<double>(), 0.1, 0.003) << "the ends count as no surface";
  EXPECT_NEAR(out["summary"][0]["dice"].get<double>(), 2 * 1.5 * 1.5 / (1.5 * 1.5 + 1.6 * 1.6), 0.003);
  EXPECT_EQ(out["stenoses"]["true_negative"], 1);
  EXPECT_THAT(core::read_file(folder / "lumen.html"), HasSubstr("Bland-Altman"));

  const Outcome both = ostia({"evaluate", "lumen", "suite", "out", "--json"}, {folder, ""});
  ASSERT_EQ(both.code, 0) << both.err;
  EXPECT_THAT(both.err, HasSubstr("dataset01"));
  EXPECT_EQ(Json::parse(both.out)["sections"].size(), 4u) << "the case without a result counts";
  EXPECT_EQ(Json::parse(both.out)["sections"][2]["dice"], 0.0);
  const Outcome graded = ostia({"evaluate", "lumen", "suite", "out", "--json", "--stenoses"}, {folder, ""});
  ASSERT_EQ(graded.code, 0) << graded.err;
  const Json places = Json::parse(graded.out)["stenoses"]["sections"];
  ASSERT_EQ(places.size(), 2u) << "what the missing case should have found is graded too";
  EXPECT_EQ(places[1]["case"], "dataset01");
  EXPECT_EQ(places[1]["result"], 0.0);
  EXPECT_EQ(ostia({"evaluate", "lumen", "suite", "suite/dataset00"}, {folder, ""}).code, 3);
  const Outcome floor = ostia({"evaluate", "lumen", "--floor", "--json"}, {folder, ""});
  ASSERT_EQ(floor.code, 0) << floor.err;
  for (const Json& row : Json::parse(floor.out)["rows"]) {
    if (row["spacing_mm"] == 0.5 && row["points"] == 64) {
      EXPECT_LE(row["mean_mm"].get<double>(), 0.02);
    }
  }
}

TEST(EvaluateCommand, VolumeAndMotion) {
  const fs::path folder = temporary_folder("evaluate");
  write_tube(folder / "open.vtp", 1.5);
  EXPECT_EQ(ostia({"evaluate", "volume", "open.vtp", "open.vtp"}, {folder, ""}).code, 3)
      << "encloses nothing";
  const auto shape = geometry::straight_tube(10.0, 1.5);
  io::write_surface(folder / "closed.vtp", geometry::surface_of(shape, 0.3, false));
  const Outcome same = ostia({"evaluate", "volume", "closed.vtp", "closed.vtp", "--json"}, {folder, ""});
  ASSERT_EQ(same.code, 0) << same.err;
  EXPECT_DOUBLE_EQ(Json::parse(same.out)["dice"].get<double>(), 1.0);
  const std::string head = R"({"v":1,"unit":"mm","axes":"LPS","phases":[{"percent":0,"points":[[0,0,0]]},)";
  core::write_file(folder / "a.json", head + R"({"percent":50,"points":[[0,0,8]]}]})");
  core::write_file(folder / "b.json", head + R"({"percent":50,"points":[[0,3,8]]}]})");
  const Outcome motion = ostia({"evaluate", "motion", "a.json", "b.json", "--json"}, {folder, ""});
  ASSERT_EQ(motion.code, 0) << motion.err;
  EXPECT_DOUBLE_EQ(Json::parse(motion.out)["max_mm"].get<double>(), 3.0);
  core::write_file(folder / "b.json", R"({"v":1})");
  EXPECT_EQ(ostia({"evaluate", "motion", "a.json", "b.json"}, {folder, ""}).code, 3);
}

TEST(EvaluateCommand, MotionOfSurfacesInFolders) {
  const fs::path folder = temporary_folder("evaluate");
  fs::create_directories(folder / "truth");
  fs::create_directories(folder / "result");
  for (const int phase : {2, 10, 1}) {
    write_tube(folder / "truth" / ("phase" + std::to_string(phase) + ".vtp"), 1.5);
    write_tube(folder / "result" / ("t0" + std::to_string(phase) + ".vtp"), 1.5 + 0.01 * phase);
  }
  const Outcome done = ostia({"evaluate", "motion", "truth", "result", "--json"}, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json out = Json::parse(done.out);
  ASSERT_EQ(out["phases"].size(), 3u);
  EXPECT_EQ(out["phases"][1]["phase"], "2") << "as people count";
  EXPECT_NEAR(out["phases"][2]["msd_mm"].get<double>(), 0.1, 0.002);
  EXPECT_NEAR(out["phases"][2]["displacement_mm"].get<double>(), 0.1, 1e-6);
  fs::remove(folder / "result" / "t02.vtp");
  const Outcome missing = ostia({"evaluate", "motion", "truth", "result"}, {folder, ""});
  EXPECT_EQ(missing.code, 3);
  EXPECT_THAT(missing.err, HasSubstr("no phase 2"));
  EXPECT_EQ(ostia({"evaluate", "motion", "truth", "result/t01.vtp"}, {folder, ""}).code, 3);
}

}  // namespace
}  // namespace ostia::testing
