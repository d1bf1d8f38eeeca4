// Commands joined by pipes, by a chain in a file, and for every row of a table.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <csignal>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::json;

/// A tetrahedron of edge length `size`, outward.
geometry::TriMesh tetrahedron(double size) {
  geometry::TriMesh mesh;
  mesh.points = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

double volume_of(const fs::path& file) {
  return Json::parse(ostia({"info", file.string(), "--json"}).out).at("volume_mm3").get<double>();
}

fs::path folder_with_surface(const std::string& name) {
  const fs::path folder = temporary_folder(name);
  io::write_surface(folder / "a.ply", tetrahedron(6.0));
  return folder;
}

TEST(Pipes, AResultGoesToTheNextCommandAndTheKindIsToldByItsFirstBytes) {
  const fs::path folder = folder_with_surface("pipes");
  for (const std::string kind : {"stl", "ply", "vtp"}) {
    const Outcome out = ostia({"convert", "a.ply", "-." + kind}, {folder, ""});
    ASSERT_EQ(out.code, 0) << out.err;
    core::write_file(folder / ("piped." + kind), out.out);
    EXPECT_NEAR(volume_of(folder / ("piped." + kind)), 36.0, 1e-4) << kind;
    const Outcome in = ostia({"convert", "-", "from_" + kind + ".vtp"}, {folder, "cat piped." + kind + " |"});
    ASSERT_EQ(in.code, 0) << in.err;
    EXPECT_NEAR(volume_of(folder / ("from_" + kind + ".vtp")), 36.0, 1e-4) << kind;
  }
  const Outcome both = ostia({"--threads", "1", "convert", "-", "-"}, {folder, "cat a.ply |"});
  ASSERT_EQ(both.code, 0) << both.err;
  EXPECT_THAT(both.out, HasSubstr("<VTKFile"));
  const Outcome judged = ostia({"mesh", "--check", "-"}, {folder, "cat a.ply |"});
  EXPECT_THAT(judged.out, HasSubstr("\"min_angle_deg\"")) << judged.err;
}

TEST(Pipes, WhatCannotGoThroughIsRefused) {
  const fs::path folder = folder_with_surface("bad_pipes");
  const Outcome unknown = ostia({"convert", "-", "b.stl"}, {folder, "printf 'what is this' |"});
  EXPECT_EQ(unknown.code, 3);
  EXPECT_THAT(unknown.err, HasSubstr("first bytes"));
  const Outcome empty = ostia({"convert", "-", "b.stl"}, {folder, "true |"});
  EXPECT_EQ(empty.code, 3);
  EXPECT_THAT(empty.err, HasSubstr("empty"));
  const Outcome whole_folder = ostia({"mesh", "a.ply", "-o", "-"}, {folder, ""});
  EXPECT_EQ(whole_folder.code, 2);
  EXPECT_THAT(whole_folder.err, HasSubstr("folder"));
  const Outcome faulty = ostia({"centerline", "-", "-o", "-"}, {folder, "printf 'solid x' |"});
  EXPECT_EQ(faulty.code, 3);
  EXPECT_EQ(faulty.out, "");
  // A wrong option is told before the input is read, which here would be refused, too.
  const Outcome wrong = ostia({"convert", "-", "b.stl", "--nonsense"}, {folder, "true |"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_FALSE(fs::exists(folder / "b.stl"));
}

/// a.ply to b.stl to the variable `last`.
Json two_conversions() {
  return {{"v", 1},
          {"variables", {{"last", "c.vtp"}}},
          {"steps",
           {{{"command", "convert"}, {"input", "{surface}"}, {"output", "b.stl"}},
            {{"command", "convert"},
             {"input", "b.stl"},
             {"output", "{last}"},
             {"options", {{"units", "cm"}, {"repair", true}}}}}}};
}

TEST(Chain, RunsEachStepOnWhatTheOneBeforeMade) {
  const fs::path folder = folder_with_surface("chain");
  core::write_file(folder / "pipeline.json", two_conversions().dump());
  const std::vector<std::string> words{"run", "pipeline.json", "-o", "out", "--set", "surface=a.ply"};
  const Outcome done = ostia(words, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(names_in(folder / "out"), ElementsAre("b.stl", "c.vtp", "manifest.json"));
  EXPECT_NEAR(volume_of(folder / "out/b.stl"), 36.0, 1e-4);
  EXPECT_NEAR(volume_of(folder / "out/c.vtp"), 36000.0, 0.1);

  const auto written = fs::last_write_time(folder / "out/c.vtp");
  const Outcome again = ostia(words, {folder, ""});
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.err, HasSubstr("done already"));
  EXPECT_EQ(fs::last_write_time(folder / "out/c.vtp"), written);
  io::write_surface(folder / "a.ply", tetrahedron(12.0));
  ASSERT_EQ(ostia(words, {folder, ""}).code, 0);
  EXPECT_NEAR(volume_of(folder / "out/b.stl"), 288.0, 1e-3);
}

TEST(Chain, AnotherValueOfAnyVariableIsAnotherJob) {
  const fs::path folder = folder_with_surface("variables");
  fs::rename(folder / "a.ply", folder / "cm.ply");  // both values stand in the input's name
  Json chain = two_conversions();
  chain["steps"][1]["options"]["units"] = "{unit}";
  core::write_file(folder / "pipeline.json", chain.dump());
  const auto volume = [&](const std::string& unit) {
    const Outcome done =
        ostia({"run", "pipeline.json", "-o", "out", "--set", "surface=cm.ply", "--set", "unit=" + unit},
              {folder, ""});
    EXPECT_EQ(done.code, 0) << done.err;
    return volume_of(folder / "out/c.vtp");
  };
  EXPECT_NEAR(volume("cm"), 36000.0, 0.1);
  EXPECT_NEAR(volume("m") / 36e9, 1.0, 1e-5);
  // What an input is called does not matter, what it holds does.
  fs::copy_file(folder / "cm.ply", folder / "other.ply");
  const Outcome same = ostia(
      {"run", "pipeline.json", "-o", "out", "--set", "surface=other.ply", "--set", "unit=m"}, {folder, ""});
  EXPECT_THAT(same.err, HasSubstr("done already"));
}

/// The chain is refused with `what`, and leaves nothing.
void expect_refused(const fs::path& folder, const Json& chain, const std::vector<std::string>& more,
                    const std::vector<std::string>& what, int code = 3) {
  core::write_file(folder / "bad.json", chain.is_string() ? chain.get<std::string>() : chain.dump());
  const Outcome done = ostia(std::vector<std::string>{"run", "bad.json", "-o", "bad"} + more, {folder, ""});
  EXPECT_EQ(done.code, code) << done.err;
  for (const std::string& one : what) EXPECT_THAT(done.err, HasSubstr(one));
  EXPECT_FALSE(fs::exists(folder / "bad"));
}

TEST(Chain, RefusesWithTheStepBeforeAnythingRuns) {
  const fs::path folder = folder_with_surface("bad_chain");
  const std::vector<std::string> set{"--set", "surface=a.ply"};
  expect_refused(folder, "{ no", set, {"bad.json", "no JSON object"});
  expect_refused(folder, {{"steps", Json::array()}}, set, {"no \"steps\""});
  expect_refused(folder, two_conversions(), {}, {"step 1 (convert)", "{surface}", "--set surface="});
  // What is given may be a path, which messages do not repeat: they name the variable.
  for (const std::string missing : {"b.ply", "/no/where/b.ply"})
    expect_refused(folder, two_conversions(), {"--set", "surface=" + missing},
                   {"step 1", "{surface}", "is no file", "give --set surface=FILE"});
  expect_refused(folder, two_conversions(), set + std::vector<std::string>{"--set", "sruface=a.ply"},
                 {"no variable {sruface}"});
  expect_refused(folder, two_conversions(), {"--set", "surface"}, {"name=value"}, 2);
  Json chain = two_conversions();
  chain["steps"][1]["out"] = "c.vtp";
  expect_refused(folder, chain, set, {"step 2", "unknown member \"out\""});
  chain = two_conversions();
  chain["steps"][1]["input"] = "typo.stl";
  expect_refused(folder, chain, set, {"step 2", "\"typo.stl\"", "is no file", "outputs of steps before"});
  chain = two_conversions();
  chain["steps"][1]["output"] = "../c.vtp";
  expect_refused(folder, chain, set, {"step 2", "within the folder"});
  chain["steps"][1]["output"] = "b.stl";
  expect_refused(folder, chain, set, {"step 2", "made by an earlier step"});
  chain["steps"][1]["command"] = "run";
  expect_refused(folder, chain, set, {"step 2", "cannot start another"});
  EXPECT_THAT(names_in(folder), ElementsAre("a.ply", "bad.json"));
}

TEST(Chain, AStepsRefusalHasItsNameAndItsExitCode) {
  const fs::path folder = folder_with_surface("refused_step");
  Json chain = two_conversions();
  chain["steps"][1]["options"]["nonsense"] = 1;
  expect_refused(folder, chain, {"--set", "surface=a.ply"}, {"step 2 (convert)"}, 2);
  chain = two_conversions();
  chain["steps"][1]["command"] = "import";
  expect_refused(folder, chain, {"--set", "surface=a.ply"}, {"step 2 (import)"}, 2);
}

TEST(Chain, AStepsRefusedOptionIsTold) {
  const fs::path folder = folder_with_surface("refused_option");
  Json chain = two_conversions();
  chain["steps"][1]["options"]["nonsense"] = 1;
  expect_refused(folder, chain, {"--set", "surface=a.ply"}, {"step 2 (convert): ", "--nonsense=1"}, 2);
  chain = two_conversions();
  chain["steps"][0]["options"]["units"] = "feet";
  expect_refused(folder, chain, {"--set", "surface=a.ply"}, {"step 1 (convert): ", "--units", "feet"}, 2);
}

/// b.stl, then what the shell makes of `second`.
Json conversion_and(const Json& second) {
  Json chain = two_conversions();
  chain["steps"][1] = second;
  chain["variables"] = Json::object();
  return chain;
}

TEST(Chain, StepsThatAreDoneAreKeptForTheNextRun) {
  const fs::path folder = folder_with_surface("kept_steps");
  const std::vector<std::string> words{"run", "pipeline.json", "-o", "out", "--set", "surface=a.ply"};
  const auto run_with = [&](const Json& second) {
    core::write_file(folder / "pipeline.json", conversion_and(second).dump());
    return ostia(words, {folder, ""});
  };
  const Outcome refused = run_with({{"command", "convert"}, {"input", "b.stl"}, {"output", "c.nothing"}});
  EXPECT_EQ(refused.code, 3) << refused.err;
  EXPECT_FALSE(fs::exists(folder / "out"));
  ASSERT_TRUE(fs::exists(folder / ".kept-out/result/b.stl"));
  const auto written = fs::last_write_time(folder / ".kept-out/result/b.stl");

  const Outcome mended = run_with({{"command", "convert"}, {"input", "b.stl"}, {"output", "c.ply"}});
  EXPECT_EQ(mended.code, 0) << mended.err;
  EXPECT_THAT(mended.err, HasSubstr("step 1 (convert): done by an earlier run"));
  EXPECT_EQ(fs::last_write_time(folder / "out/b.stl"), written);
  EXPECT_THAT(names_in(folder / "out"), ElementsAre("b.stl", "c.ply", "manifest.json"));
  EXPECT_FALSE(fs::exists(folder / ".kept-out"));

  // Another second step: the first one's result comes from the folder that is there.
  const Outcome other = run_with({{"command", "convert"}, {"input", "b.stl"}, {"output", "d.vtp"}});
  EXPECT_EQ(other.code, 0) << other.err;
  EXPECT_THAT(other.err, HasSubstr("step 1 (convert): done by an earlier run"));
  EXPECT_THAT(names_in(folder / "out"), ElementsAre("b.stl", "d.vtp", "manifest.json"));
  EXPECT_NEAR(volume_of(folder / "out/d.vtp"), 36.0, 1e-4);

  // Another input: nothing of before fits.
  io::write_surface(folder / "a.ply", tetrahedron(12.0));
  const Outcome anew = run_with({{"command", "convert"}, {"input", "b.stl"}, {"output", "d.vtp"}});
  EXPECT_THAT(anew.err, Not(HasSubstr("earlier run")));
  EXPECT_NEAR(volume_of(folder / "out/d.vtp"), 288.0, 1e-3);
  const Json steps = Json::parse(core::read_file(folder / "out/manifest.json")).at("quality").at("steps");
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[1].at("title"), "convert");
  EXPECT_GT(steps[1].at("peak_mb").get<double>(), 1.0);
}

TEST(Chain, AKeptStepThatWasTamperedWithIsDoneAgain) {
  const fs::path folder = folder_with_surface("tampered");
  const std::vector<std::string> words{"run", "pipeline.json", "-o", "out", "--set", "surface=a.ply"};
  core::write_file(
      folder / "pipeline.json",
      conversion_and({{"command", "convert"}, {"input", "b.stl"}, {"output", "c.nothing"}}).dump());
  EXPECT_EQ(ostia(words, {folder, ""}).code, 3);
  io::write_surface(folder / ".kept-out/result/b.stl", tetrahedron(1.0));
  core::write_file(folder / ".kept-out/result/leftover", "of nobody");
  core::write_file(folder / "pipeline.json",
                   conversion_and({{"command", "convert"}, {"input", "b.stl"}, {"output", "c.ply"}}).dump());
  const Outcome done = ostia(words, {folder, ""});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NEAR(volume_of(folder / "out/c.ply"), 36.0, 1e-4);
  EXPECT_THAT(names_in(folder / "out"), ElementsAre("b.stl", "c.ply", "manifest.json"));
}

TEST(Chain, AStepReadsAFileOfAFolderThatAnEarlierOneMade) {
  const fs::path folder = folder_with_surface("folder_step");
  const Json chain{{"steps",
                    {{{"command", "measure"}, {"input", "tree.csv"}, {"output", "measures"}},
                     {{"command", "convert"}, {"input", "measures/tree.vtp"}, {"output", "again.vtp"}}}}};
  core::write_file(folder / "tree.csv",
                   "id,parent,x,y,z,radius\n1,-1,0,0,0,1\n2,1,0,0,10,1\n3,2,0,5,15,0.8\n4,2,0,-5,15,0.7\n");
  core::write_file(folder / "pipeline.json", chain.dump());
  const Outcome done = ostia({"run", "pipeline.json", "-o", "out"}, {folder, ""});
  // Which files `measure` makes is its own matter: what counts is where the second step looks.
  EXPECT_THAT(done.err, Not(HasSubstr("no earlier step makes it"))) << done.err;
}

TEST(Chain, FailedQualityIsTheChainsExitCode) {
  const fs::path folder = folder_with_surface("quality");
  geometry::TriMesh open = tetrahedron(6.0);
  open.triangles.pop_back();
  io::write_surface(folder / "open.stl", open);
  const Json chain{{"steps", {{{"command", "mesh"}, {"inputs", {{"check", "open.stl"}}}}}}};
  core::write_file(folder / "pipeline.json", chain.dump());
  const Outcome done = ostia({"run", "pipeline.json"}, {folder, ""});
  EXPECT_EQ(done.code, 4) << done.err;
  const Json manifest = Json::parse(core::read_file(folder / "pipeline/manifest.json"));
  EXPECT_EQ(manifest.at("exit_code"), 4);
  EXPECT_THAT(manifest.at("warnings").at(0).get<std::string>(), HasSubstr("step 1 (mesh)"));
}

TEST(Batch, OneBadCaseStopsNoOtherAndWholeOnesAreLeftAlone) {
  const fs::path folder = folder_with_surface("batch");
  core::write_file(folder / "pipeline.json", two_conversions().dump());
  core::write_file(folder / "broken.ply", "ply\nnothing");
  core::write_file(
      folder / "table.csv",
      "case,surface,last\r\np1,a.ply,one.vtp\r\np2,broken.ply,two.vtp\r\np3,\"a.ply\",\"x,y.vtp\"\r\n");
  const std::vector<std::string> words{"batch", "table.csv", "--pipeline", "pipeline.json",
                                       "-o",    "out",       "--jobs",     "2"};
  const Outcome done = ostia(words, {folder, ""});
  EXPECT_EQ(done.code, 4) << done.err;
  EXPECT_THAT(done.out, StartsWith("2 of 3"));
  EXPECT_TRUE(fs::exists(folder / "out/p1/one.vtp"));
  EXPECT_TRUE(fs::exists(folder / "out/p3/x,y.vtp"));
  EXPECT_FALSE(fs::exists(folder / "out/p2"));
  const std::string results = core::read_file(folder / "out/results.csv");
  EXPECT_THAT(results, StartsWith("case,status,exit_code,seconds,message,peak_mb\np1,ok,0,"));
  EXPECT_THAT(results, HasSubstr("\np2,failed,3,"));
  EXPECT_THAT(results, HasSubstr("step 1 (convert)"));
  EXPECT_THAT(results, HasSubstr("\np3,ok,0,"));
  EXPECT_THAT(results, Not(HasSubstr(folder.string())));  // no path is kept

  const auto written = fs::last_write_time(folder / "out/p1/one.vtp");
  fs::copy_file(folder / "a.ply", folder / "broken.ply", fs::copy_options::overwrite_existing);
  const Outcome again = ostia(words, {folder, ""});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(fs::last_write_time(folder / "out/p1/one.vtp"), written);
  EXPECT_TRUE(fs::exists(folder / "out/p2/two.vtp"));
}

TEST(Batch, RefusesATableBeforeAnythingRuns) {
  const fs::path folder = folder_with_surface("bad_table");
  core::write_file(folder / "pipeline.json", two_conversions().dump());
  const auto refused = [&](const std::string& table, const std::string& what) {
    core::write_file(folder / "table.csv", table);
    const Outcome done =
        ostia({"batch", "table.csv", "--pipeline", "pipeline.json", "-o", "out"}, {folder, ""});
    EXPECT_EQ(done.code, 3) << table;
    EXPECT_THAT(done.err, HasSubstr(what)) << table;
    EXPECT_THAT(done.err, HasSubstr("table.csv")) << table;
    EXPECT_FALSE(fs::exists(folder / "out")) << table;
  };
  refused("case,surface\n", "at least one row");
  refused("surface\na.ply\n", "column `case`");
  refused("case,surface\np1,a.ply\n\np2,a.ply,1\n", "line 4 has 3 cells for 2 columns");
  refused("case,surface\n../p1,a.ply\n", "line 2");
  refused("case,surface\np1,a.ply\np1,a.ply\n", "line 3: the case p1 is there twice");
  refused("case,surface\np1,\"a.ply\n", "line 2 does not end");
  refused("case,surface,surface\np1,a.ply,b.ply\n", "each another one");
}

}  // namespace
}  // namespace ostia::testing
