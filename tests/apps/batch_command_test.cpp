// Many patients in one folder: locks, logs, what is kept and what is swept.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/core/folder_lock.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/phantom/builtin_case.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <thread>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::json;

const std::vector<std::string> batch_words{"batch", "table.csv", "--pipeline", "pipeline.json", "-o", "out"};

void write_tetrahedron(const fs::path& file, double size) {
  geometry::TriMesh mesh;
  mesh.points = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  io::write_surface(file, mesh);
}

/// a.ply to b.stl, b.stl to c.vtp in the unit that the table says.
fs::path batch_folder(const std::string& name, const std::string& table) {
  const fs::path folder = temporary_folder(name);
  write_tetrahedron(folder / "a.ply", 6.0);
  const Json chain{{"steps",
                    {{{"command", "convert"}, {"input", "{surface}"}, {"output", "b.stl"}},
                     {{"command", "convert"},
                      {"input", "b.stl"},
                      {"output", "c.vtp"},
                      {"options", {{"units", "{unit}"}}}}}}};
  core::write_file(folder / "pipeline.json", chain.dump());
  core::write_file(folder / "table.csv", table);
  return folder;
}

std::string results_of(const fs::path& folder) {
  return core::read_file(folder / "out/results.csv");
}

/// The line of a case.
std::string line_of(const fs::path& folder, const std::string& name) {
  const std::string text = results_of(folder);
  const std::size_t at = text.find("\n" + name + ",");
  return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
}

TEST(BatchRuns, ASecondOneInTheSameFolderIsRefusedOrWaits) {
  const fs::path folder = batch_folder("batch_lock", "case,surface,unit\np1,a.ply,mm\n");
  fs::create_directory(folder / "out");
  auto first = std::make_unique<core::FolderLock>(folder / "out", "out", "");
  const Outcome refused = ostia(batch_words, {folder, ""});
  EXPECT_EQ(refused.code, 5);
  EXPECT_THAT(refused.err, HasSubstr("another run (process " + std::to_string(::getpid()) + ")"));
  EXPECT_THAT(refused.err, HasSubstr("--wait"));
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  EXPECT_FALSE(fs::exists(folder / "out/p1"));
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    EXPECT_FALSE(fs::exists(folder / "out/p1"));
    first.reset();
  });
  const Outcome waited = ostia(batch_words + std::vector<std::string>{"--wait"}, {folder, ""});
  later.join();
  EXPECT_EQ(waited.code, 0) << waited.err;
  EXPECT_TRUE(fs::exists(folder / "out/p1/c.vtp"));
  EXPECT_FALSE(fs::exists(folder / "out/.ostia-lock"));
}

TEST(BatchRuns, EachCaseHasALogAndTheReasonOfARefusedOption) {
  const fs::path folder =
      batch_folder("batch_logs", "case,surface,unit\np1,a.ply,mm\np2,a.ply,feet\np3,b.ply,mm\n");
  const Outcome done = ostia(batch_words, {folder, ""});
  EXPECT_EQ(done.code, 4);
  EXPECT_THAT(done.out, StartsWith("1 of 3"));
  EXPECT_THAT(line_of(folder, "p2"), StartsWith("p2,failed,2,"));
  EXPECT_THAT(line_of(folder, "p2"), HasSubstr("step 2 (convert): --units: "));
  EXPECT_THAT(line_of(folder, "p2"), HasSubstr("not in {m,cm,mm}"));
  EXPECT_THAT(line_of(folder, "p3"), HasSubstr("no file"));
  for (const std::string name : {"p1", "p2", "p3"}) {
    const std::string log = core::read_file(folder / "out/logs" / (name + ".log"));
    EXPECT_THAT(log, HasSubstr(name == "p3" ? "\"level\":\"error\"" : "step 1 (convert)")) << log;
    EXPECT_THAT(log, Not(HasSubstr(folder.string()))) << log;
  }
  EXPECT_THAT(results_of(folder), Not(HasSubstr(folder.string())));
}

TEST(BatchRuns, StepsAreKeptAndFiguresStayOnReruns) {
  const fs::path folder = batch_folder("batch_rerun", "case,surface,unit\np1,a.ply,mm\np2,a.ply,feet\n");
  EXPECT_EQ(ostia(batch_words, {folder, ""}).code, 4);
  const std::string first = line_of(folder, "p1");
  EXPECT_THAT(first, StartsWith("p1,ok,0,"));
  EXPECT_FALSE(first.ends_with(",0")) << first;  // memory is known
  ASSERT_TRUE(fs::exists(folder / "out/.kept-p2/result/b.stl"));
  const auto written = fs::last_write_time(folder / "out/.kept-p2/result/b.stl");

  // Time and memory that nobody would measure again.
  Json manifest = Json::parse(core::read_file(folder / "out/p1/manifest.json"));
  manifest["seconds"] = 123.4;
  manifest["peak_mb"] = 4321.0;
  core::write_file(folder / "out/p1/manifest.json", manifest.dump());
  core::write_file(folder / "table.csv", "case,surface,unit\np2,a.ply,cm\np1,a.ply,mm\n");
  EXPECT_EQ(ostia(batch_words, {folder, ""}).code, 0);
  EXPECT_EQ(line_of(folder, "p1"), "p1,ok,0,123.4,,4321");
  EXPECT_EQ(fs::last_write_time(folder / "out/p2/b.stl"), written);
  EXPECT_FALSE(fs::exists(folder / "out/.kept-p2"));
  EXPECT_THAT(core::read_file(folder / "out/logs/p2.log"), HasSubstr("done by an earlier run, kept"));

  // A shorter table does not forget the other case.
  core::write_file(folder / "table.csv", "case,surface,unit\np2,a.ply,cm\n");
  const Outcome shorter = ostia(batch_words, {folder, ""});
  EXPECT_THAT(shorter.out, StartsWith("1 of 1"));
  EXPECT_EQ(line_of(folder, "p1"), "p1,ok,0,123.4,,4321");
}

TEST(BatchRuns, WhatAKilledOneLeftIsSweptAndItsStepsAreKept) {
  const fs::path folder = batch_folder("batch_killed", "case,surface,unit\np1,a.ply,mm\n");
  // The second step takes seconds, so that the batch can be killed in it.
  const Json chain{{"steps",
                    {{{"command", "convert"}, {"input", "{surface}"}, {"output", "b.stl"}},
                     {{"command", "phantom"}, {"options", {{"preset", "small"}}}, {"output", "suite"}},
                     {{"command", "convert"},
                      {"input", "b.stl"},
                      {"output", "c.vtp"},
                      {"options", {{"units", "{unit}"}}}}}}};
  core::write_file(folder / "pipeline.json", chain.dump());
  double ended = 0.0;
  const Outcome killed = interrupted(batch_words, {folder, ""}, SIGKILL, 1.5, ended);
  EXPECT_EQ(killed.code, 128 + SIGKILL);
  ASSERT_TRUE(fs::exists(folder / "out/.kept-p1/result/b.stl"));
  ASSERT_FALSE(fs::exists(folder / "out/p1"));
  const auto written = fs::last_write_time(folder / "out/.kept-p1/result/b.stl");
  // Of a process that is gone for sure: its number is beyond what the system gives.
  fs::create_directory(folder / "out/.part-2147483000-0-p7");
  core::write_file(folder / "out/.part-2147483000-1-results.csv", "half");
  core::write_file(folder / "out/.part-nobodys", "not ours");

  Json shorter = chain;
  shorter["steps"].erase(1);
  core::write_file(folder / "pipeline.json", shorter.dump());
  const Outcome again = ostia(batch_words, {folder, ""});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("2 leftovers"));
  EXPECT_EQ(fs::last_write_time(folder / "out/p1/b.stl"), written);
  EXPECT_THAT(names_in(folder / "out"),
              ::testing::ElementsAre(".part-nobodys", "logs", "logs/p1.log", "p1", "p1/b.stl", "p1/c.vtp",
                                     "p1/manifest.json", "results.csv"));
}

TEST(BatchRuns, TheBatchsOwnNamesAreNoCases) {
  for (const std::string name : {"logs", "results.csv"}) {
    const fs::path folder = batch_folder("batch_names", "case,surface,unit\n" + name + ",a.ply,mm\n");
    const Outcome refused = ostia(batch_words, {folder, ""});
    EXPECT_EQ(refused.code, 3);
    EXPECT_THAT(refused.err, HasSubstr("line 2: the name " + name));
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
}

/// The built-in case whose side branch is closed by fat for 5 mm, with the seeds of both vessels.
struct OccludedCase {
  fs::path folder;
  std::vector<std::string> main_branch, side_branch;
};
OccludedCase occluded_case() {
  phantom::BuiltinOptions options;
  options.spacing_mm = 0.6;
  phantom::BuiltinCase made = phantom::make_builtin_case(options);
  const auto on_axis = [&](std::size_t tube, double part) {
    const auto& points = made.truth.tubes[tube].axis.points;
    return points[static_cast<std::size_t>(part * static_cast<double>(points.size() - 1))];
  };
  const geometry::Vec3 plug = on_axis(1, 0.6);
  const imaging::Geometry& grid = made.image.geometry;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i)
        if ((grid.world(geometry::Vec3(i, j, k)) - plug).norm() < 2.5) made.image(i, j, k) = -80;
  OccludedCase out;
  out.folder = temporary_folder("occluded");
  imaging::write_image(out.folder / "heart.nrrd", made.image);
  const auto text = [](const geometry::Vec3& p) {
    return std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(p.z());
  };
  out.main_branch = {"--branch", text(on_axis(0, 0.06)) + ":" + text(on_axis(0, 0.9))};
  out.side_branch = {"--branch", text(on_axis(0, 0.06)) + ":" + text(on_axis(1, 0.9))};
  return out;
}

TEST(OccludedVessel, DoesNotLoseTheOthersInSegmentAndModel) {
  const OccludedCase made = occluded_case();
  const std::vector<std::string> segment{"segment", "heart.nrrd", "-o"};
  const Outcome alone =
      ostia(segment + std::vector<std::string>{"alone.stl"} + made.main_branch, {made.folder, ""});
  ASSERT_EQ(alone.code, 0) << alone.err;
  for (const auto& branches : {made.main_branch + made.side_branch, made.side_branch + made.main_branch}) {
    const Outcome both = ostia(segment + std::vector<std::string>{"both.stl"} + branches, {made.folder, ""});
    EXPECT_EQ(both.code, 4) << both.err;
    EXPECT_THAT(both.err, HasSubstr("left out: branch "));
    EXPECT_THAT(both.err, HasSubstr("never meet"));
    EXPECT_EQ(core::read_file(made.folder / "alone.stl"), core::read_file(made.folder / "both.stl"));
  }
  const Outcome none =
      ostia(segment + std::vector<std::string>{"none.stl"} + made.side_branch, {made.folder, ""});
  EXPECT_EQ(none.code, 3) << none.err;
  EXPECT_FALSE(fs::exists(made.folder / "none.stl"));

  const Outcome model = ostia(
      std::vector<std::string>{"model", "heart.nrrd", "-o", "model"} + made.main_branch + made.side_branch,
      {made.folder, ""});
  EXPECT_EQ(model.code, 4) << model.err;
  const Json manifest = Json::parse(core::read_file(made.folder / "model/manifest.json"));
  EXPECT_EQ(manifest.at("exit_code"), 4);
  EXPECT_THAT(manifest.at("quality").at("verdict").at("reasons").dump(), HasSubstr("left out: branch 2"));
  EXPECT_TRUE(fs::exists(made.folder / "model/mesh.vtu"));
}

TEST(OccludedVessel, ASeedOutsideOfTheImageIsRefused) {
  const OccludedCase made = occluded_case();
  const Outcome wrong = ostia(std::vector<std::string>{"segment", "heart.nrrd", "-o", "a.stl"} +
                                  made.main_branch + std::vector<std::string>{"--branch", "900,0,0:901,0,0"},
                              {made.folder, ""});
  EXPECT_EQ(wrong.code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("branch 2: seed"));
}

}  // namespace
}  // namespace ostia::testing
