// `ostia ffr`: pressures of a tree of lines and of a case, and what is refused.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace ostia::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::json;
namespace fs = std::filesystem;

const std::string research = "no decision on a patient may rest on them";

/// 70 mm along z of 1.6 mm radius with a throat of `least` times that at 30 mm.
double artery_radius(double z, double least) {
  const double t = (z - 30.0) / 10.0;
  return std::abs(t) < 0.5 ? 1.6 * (1.0 - (1.0 - least) * 0.5 * (1.0 + std::cos(2.0 * std::numbers::pi * t)))
                           : 1.6;
}

std::string artery_csv(double least) {
  std::string text = "x,y,z,radius\n";
  for (int i = 0; i <= 140; ++i)
    text += "0,0," + std::to_string(0.5 * i) + "," + std::to_string(artery_radius(0.5 * i, least)) + "\n";
  return text;
}

fs::path artery_folder(double least = 0.4) {
  const fs::path folder = temporary_folder("ffr");
  core::write_file(folder / "artery.csv", artery_csv(least));
  geometry::Centerline axis = geometry::straight_tube(70.0, 1.6, 0.5).tubes.front().axis;
  for (std::size_t i = 0; i < axis.size(); ++i) axis.radius[i] = artery_radius(axis.points[i].z(), least);
  geometry::complete(axis);
  geometry::VesselTree tree;
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, std::move(axis)}};
  tree.vessels = {{4, "LAD", {3}}};
  session::CaseFile::create(folder / "artery.ostia", lumen::model_of_tubes(tree), {});
  return folder;
}

Json pressures(const fs::path& folder, const std::vector<std::string>& more) {
  const Outcome made =
      ostia(std::vector<std::string>{"ffr"} + more + std::vector<std::string>{"--json"}, {folder, ""});
  EXPECT_EQ(made.code, 0) << made.err;
  return made.code == 0 ? Json::parse(made.out) : Json();
}

TEST(FfrCommand, MakesTheFolderOnce) {
  const fs::path folder = artery_folder();
  const Outcome made = ostia({"ffr", "artery.csv", "-o", "out", "--pulse"}, {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("FFR"));
  EXPECT_THAT(made.out, HasSubstr("iFR"));
  EXPECT_THAT(made.out, HasSubstr(research));
  EXPECT_THAT(names_in(folder / "out"),
              ::testing::ElementsAre("README.txt", "conditions.json", "ffr.json", "lesions.csv", "lines.vtp",
                                     "manifest.json", "outlets.csv", "pressure.html", "pressure.pdf",
                                     "stations.csv"));
  EXPECT_THAT(core::read_file(folder / "out" / "README.txt"), HasSubstr(research));
  const Outcome again = ostia({"ffr", "artery.csv", "-o", "out", "--pulse"}, {folder, ""});
  EXPECT_THAT(again.err, HasSubstr("done already"));
  EXPECT_EQ(again.out, made.out);
}

TEST(FfrCommand, ReadsANarrowingAndItsSeverity) {
  const fs::path mild = artery_folder(0.75), severe = artery_folder(0.3);
  const Json a = pressures(mild, {"artery.csv", "-o", "out"}),
             b = pressures(severe, {"artery.csv", "-o", "out"});
  ASSERT_EQ(a["lesions"].size(), 1u);
  ASSERT_EQ(b["lesions"].size(), 1u);
  EXPECT_GT(a["lesions"][0]["ffr"], 0.85);
  EXPECT_FALSE(a["lesions"][0]["significant"].get<bool>());
  EXPECT_LT(b["lesions"][0]["ffr"], 0.75);
  EXPECT_TRUE(b["lesions"][0]["significant"].get<bool>());
  EXPECT_NEAR(b["lesions"][0]["throat"]["s_mm"].get<double>(), 30.0, 0.6);
  EXPECT_EQ(a["flow"]["source"], "calibre");
}

TEST(FfrCommand, ACaseAndItsTreeOfLinesAgree) {
  const fs::path folder = artery_folder(0.5);
  const Json lines = pressures(folder, {"artery.csv", "-o", "lines"});
  const Json walls = pressures(folder, {"artery.ostia", "-o", "walls"});
  ASSERT_EQ(walls["lesions"].size(), 1u);
  EXPECT_NEAR(walls["lesions"][0]["ffr"].get<double>(), lines["lesions"][0]["ffr"].get<double>(), 0.02);
  EXPECT_EQ(walls["branches"][0]["name"], "LAD");
}

TEST(FfrCommand, TakesConditionsOfAFileAndOfItsOptions) {
  const fs::path folder = artery_folder(0.5);
  core::write_file(folder / "mine.json", R"({"venous_mmhg": 8, "systolic_mmhg": 150})");
  const Json made = pressures(folder, {"artery.csv", "-o", "out", "--conditions", "mine.json", "--systolic",
                                       "140", "--rest-flow", "90"});
  EXPECT_EQ(made["conditions"]["venous_mmhg"]["value"], 8.0);
  EXPECT_EQ(made["conditions"]["systolic_mmhg"]["value"], 140.0);
  EXPECT_NEAR(made["aortic_mmhg"].get<double>(), 80.0 + 0.4 * 60.0, 1e-9);
  EXPECT_EQ(made["flow"]["source"], "told");
  EXPECT_NEAR(made["outlets"][0]["asked_ml_min"].get<double>(), 90.0, 1e-9);
  // What a result says of its conditions can be given again.
  const Json again = pressures(folder, {"artery.csv", "-o", "again", "--conditions", "out/conditions.json"});
  EXPECT_EQ(again["lesions"], made["lesions"]);
}

TEST(FfrCommand, TellsWhatAnOpenedOrNarrowedStretchWouldGive) {
  const fs::path folder = artery_folder(0.35);
  const Json made = pressures(folder, {"artery.ostia", "-o", "out", "--open", "LAD:24-36:10"});
  EXPECT_LT(made["lesions"][0]["ffr"].get<double>(), 0.8);
  EXPECT_GT(made["what_if"]["lesions"][0]["ffr"].get<double>(), 0.9);
  EXPECT_EQ(made["what_if"]["stretches"][0]["percent"], 10.0);
  EXPECT_THAT(core::read_file(folder / "out" / "what_if_readings.csv"), HasSubstr("lesion,S1,"));
  EXPECT_THAT(core::read_file(folder / "out" / "what_if_stations.csv"), HasSubstr("ffr_what_if"));
  EXPECT_THAT(core::read_file(folder / "out" / "lines.vtp"), HasSubstr("FFRWhatIf"));
  const Json narrow = pressures(folder, {"--narrow", "LAD:45-55:70", "artery.ostia", "-o", "narrow"});
  EXPECT_LT(narrow["what_if"]["outlets"][0]["ffr"].get<double>(),
            narrow["outlets"][0]["ffr"].get<double>() - 0.02);
}

TEST(FfrCommand, TakesWhatTheCaseKeeps) {
  const fs::path folder = artery_folder(0.5);
  {
    session::CaseFile file = session::CaseFile::open(folder / "artery.ostia");
    file.annotate(session::SetPressureInputs{{{"rest_flow_ml_min", 90.0}, {"systolic_mmhg", 150.0}}});
    file.annotate(session::SetWhatIfs{{{4, 24.0, 36.0, session::WhatIfKind::open, 0.0}}});
  }
  const Json made = pressures(folder, {"artery.ostia", "-o", "out", "--systolic", "140"});
  EXPECT_EQ(made["conditions"]["rest_flow_ml_min"]["value"], 90.0);
  EXPECT_EQ(made["conditions"]["systolic_mmhg"]["value"], 140.0) << "what is told goes before";
  EXPECT_EQ(made["what_if"]["stretches"].size(), 1u);
  // Above the usual systolic pressure, but not above the case's.
  const Json high = pressures(folder, {"artery.ostia", "-o", "high", "--diastolic", "125"});
  EXPECT_EQ(high["conditions"]["diastolic_mmhg"]["value"], 125.0);
}

TEST(FfrCommand, SaysHowSureItIs) {
  const fs::path folder = artery_folder(0.45);
  const Outcome made =
      ostia({"ffr", "artery.csv", "-o", "out", "--uncertainty=64", "--rest-flow", "90"}, {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("in 95 %"));
  EXPECT_THAT(made.out, HasSubstr("; by "));
  const Json result = Json::parse(core::read_file(folder / "out" / "ffr.json"));
  const Json& ffr = result["uncertainty"]["lesions"][0]["ffr"];
  EXPECT_LT(ffr["low"], result["lesions"][0]["ffr"]);
  EXPECT_GT(ffr["high"], result["lesions"][0]["ffr"]);
  EXPECT_EQ(result["uncertainty"]["settings"]["inputs"]["rest_flow"]["sd"], 0.10);  // it was told
  // The same again by what conditions.json says, and narrower with a wall that is better known.
  const Json again = pressures(
      folder, {"artery.csv", "-o", "again", "--uncertainty", "--conditions", "out/conditions.json"});
  EXPECT_EQ(again["uncertainty"], result["uncertainty"]);
  const Json other = pressures(folder, {"artery.csv", "-o", "other", "--uncertainty", "--conditions",
                                        "out/conditions.json", "--seed", "7"});
  EXPECT_EQ(other["uncertainty"]["settings"]["seed"], 7);
  // Also the seed that is usual goes before a file's.
  const Json usual = pressures(folder, {"artery.csv", "-o", "usual", "--uncertainty", "--conditions",
                                        "other/conditions.json", "--seed", "1"});
  EXPECT_EQ(usual["uncertainty"], result["uncertainty"]);
  const Json known = pressures(folder, {"artery.csv", "-o", "known", "--uncertainty=64", "--rest-flow", "90",
                                        "--wall-spread", "0.02"});
  const Json& narrow = known["uncertainty"]["lesions"][0]["ffr"];
  EXPECT_LT(narrow["high"].get<double>() - narrow["low"].get<double>(),
            ffr["high"].get<double>() - ffr["low"].get<double>());
  EXPECT_EQ(known["uncertainty"]["settings"]["wall"]["source"], "told");
}

TEST(FfrCommand, RefusesInOneSentence) {
  const fs::path folder = artery_folder(0.5);
  core::write_file(folder / "wrong.json", R"({"venus_mmhg": 8})");
  core::write_file(folder / "flat.csv", "x,y,z,radius\n0,0,0,1\n0,0,1,0\n0,0,2,1\n");
  core::write_file(folder / "loop.csv",
                   "x1,y1,z1,radius1,x2,y2,z2,radius2\n0,0,0,1,0,0,5,1\n0,0,5,1,0,5,5,1\n0,5,5,1,0,0,0,1\n");
  const auto refused = [&](const std::vector<std::string>& arguments, int code, const std::string& says) {
    const Outcome done = ostia(std::vector<std::string>{"ffr"} + arguments, {folder, ""});
    EXPECT_EQ(done.code, code) << done.err;
    EXPECT_THAT(done.err, HasSubstr(says));
    EXPECT_FALSE(fs::exists(folder / "out"));
  };
  refused({"artery.csv", "-o", "out", "--systolic", "400"}, 3, "between 60 and 260 mmHg; --unusual");
  refused({"artery.csv", "-o", "out", "--systolic", "70"}, 3, "not below the systolic one");
  refused({"artery.csv", "-o", "out", "--rest-flow", "5000"}, 3, "between 10 and 1500");
  refused({"artery.csv", "-o", "out", "--conditions", "wrong.json"}, 3, "venus_mmhg");
  refused({"missing.csv", "-o", "out"}, 3, "no such file");
  refused({"flat.csv", "-o", "out"}, 3, "radius");
  refused({"loop.csv", "-o", "out"}, 3, "");
  refused({"artery.csv", "-o", "out", "--open", "LAD:3"}, 3, "VESSEL:FROM-TO");
  refused({"artery.ostia", "-o", "out", "--open", "OM1:3-9"}, 3, "it has LAD");
  refused({"artery.ostia", "-o", "out", "--narrow", "LAD:3-9"}, 3, "VESSEL:FROM-TO:PERCENT");
  refused({"artery.ostia", "-o", "out", "--open", "LAD:3-9:95"}, 3, "0 to 90");
  refused({"artery.csv", "-o", "out", "--behind", "100"}, 2, "--behind");
  core::write_file(folder / "spread.json", R"({"uncertainty": {"inputs": {"sistolic": 8}}})");
  refused({"artery.csv", "-o", "out", "--uncertainty=15"}, 2, "--uncertainty");
  refused({"artery.csv", "-o", "out", "--uncertainty=17"}, 3, "an even number from 16 to 10000");
  refused({"artery.csv", "-o", "out", "--wall-spread", "0.1"}, 2, "--uncertainty");
  refused({"artery.ostia", "-o", "out", "--uncertainty=16", "--image", "artery.csv", "--wall-spread", "0.1"},
          2, "--wall-spread");
  refused({"artery.csv", "-o", "out", "--uncertainty=16", "--image", "artery.csv"}, 3, "leave out --image");
  refused({"artery.csv", "-o", "out", "--uncertainty=16", "--conditions", "spread.json"}, 3, "sistolic");
  refused({"artery.csv"}, 2, "--output");
  const Outcome unusual =
      ostia({"ffr", "artery.csv", "-o", "out", "--systolic", "300", "--unusual"}, {folder, ""});
  EXPECT_EQ(unusual.code, 0) << unusual.err;
  EXPECT_THAT(unusual.err, HasSubstr("systolic_mmhg is 300 mmHg"));
}

TEST(FfrCommand, AnOcclusionIsToldAndIsNoNumber) {
  const fs::path folder = temporary_folder("ffr-occluded");
  // As a hair: CT cannot tell it, and next to nothing flows.
  core::write_file(folder / "artery.csv", artery_csv(0.003));
  const Outcome made = ostia({"ffr", "artery.csv", "-o", "out", "--json"}, {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  const Json result = Json::parse(made.out);
  EXPECT_THAT(made.err, HasSubstr("occluded"));
  EXPECT_TRUE(result["lesions"][0]["occluded"].get<bool>());
  EXPECT_TRUE(result["lesions"][0]["ffr"].is_null());
  EXPECT_TRUE(result["lesions"][0]["significant"].get<bool>());
  for (const char* file : {"ffr.json", "stations.csv", "lesions.csv", "outlets.csv", "lines.vtp"})
    EXPECT_THAT(core::read_file(folder / "out" / file), Not(HasSubstr("nan"))) << file;
}

TEST(FfrCommand, PutsPressuresOnTheWallOfACase) {
  const fs::path folder = artery_folder();
  pressures(folder, {"artery.ostia", "-o", "walls"});
  const std::string wall = core::read_file(folder / "walls" / "wall.vtp");
  for (const char* name : {"FFR", "RestingPdPa", "Pressure_mmHg", "WallShear_Pa", "Vessel", "Occluded"})
    EXPECT_THAT(wall, HasSubstr(name));
  pressures(folder, {"artery.csv", "-o", "lines"});
  EXPECT_FALSE(fs::exists(folder / "lines" / "wall.vtp"));  // a tree of lines has none
}

TEST(FfrCommand, WritesCasesOfSolversAndComputesSvzerodsAgain) {
  const fs::path folder = artery_folder();
  const Json made = pressures(folder, {"artery.csv", "-o", "out", "--export", "svzerod,svoned,openbf"});
  for (const char* name : {"svzerod.json", "svoned.in", "openbf.yaml", "openbf_inlet.dat"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  const Json again = pressures(folder, {"out/svzerod.json", "-o", "again"});
  EXPECT_EQ(again["kind"], "network-flow");
  EXPECT_THAT(again["research_use"].get<std::string>(), HasSubstr(research));
  // ml/s, and dyn/cm2 a mmHg.
  const auto& last = again["vessels"].back();
  EXPECT_NEAR(last["flow"].get<double>() * 60.0 / made["branches"][0]["hyperaemic_ml_min"].get<double>(), 1.0,
              1e-6);
  EXPECT_NEAR(
      last["pressure_out"].get<double>() / 1333.22387415 / made["branches"][0]["to_mmhg"].get<double>(), 1.0,
      1e-6);
  const Outcome words = ostia({"ffr", "out/svzerod.json", "-o", "again"}, {folder, ""});
  EXPECT_THAT(words.err, HasSubstr("done already"));
  EXPECT_THAT(words.out, HasSubstr("branch0_seg0: flow "));
  EXPECT_THAT(core::read_file(folder / "again" / "network.csv"),
              ::testing::StartsWith("name,time,flow_in,flow_out,pressure_in,pressure_out"));
  const auto refused = [&](const std::vector<std::string>& arguments, int code, const std::string& says) {
    const Outcome done = ostia(std::vector<std::string>{"ffr"} + arguments, {folder, ""});
    EXPECT_EQ(done.code, code) << done.err;
    EXPECT_THAT(done.err, HasSubstr(says));
    EXPECT_FALSE(fs::exists(folder / "no"));
  };
  refused({"artery.csv", "-o", "no", "--export", "cgns"}, 2, "--export");
  refused({"out/svzerod.json", "-o", "no", "--systolic", "120"}, 2, "its own boundaries");
  refused({"out/conditions.json", "-o", "no"}, 3, "no case of svZeroDSolver");
}

TEST(FfrCommand, NamesNobody) {
  const fs::path folder = artery_folder(0.5);
  fs::copy_file(folder / "artery.csv", folder / "DOE^JANE.csv");
  const Outcome made = ostia({"ffr", "DOE^JANE.csv", "-o", "out", "--log", "json"}, {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.err, Not(HasSubstr("DOE^JANE")));
  for (const std::string& name : names_in(folder / "out"))
    EXPECT_THAT(core::read_file(folder / "out" / name), Not(HasSubstr("DOE^JANE"))) << name;
}

TEST(FfrCommand, IsTheSameForAnyNumberOfThreads) {
  const fs::path folder = artery_folder(0.5);
  const Json one = pressures(folder, {"artery.ostia", "-o", "one", "--threads", "1"});
  const Json four = pressures(folder, {"artery.ostia", "-o", "four", "--threads", "4"});
  EXPECT_EQ(one, four);
}

}  // namespace
}  // namespace ostia::testing
