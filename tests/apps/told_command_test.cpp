// What commands say and leave behind beside their results.

#include "program.h"

#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

constexpr const char* told_fork_swc = "1 2 0 0 0 2 -1\n2 2 0 0 12 2 1\n3 2 3 2 22 1.5 2\n4 2 -3 2 22 1.5 2\n";

/// A closed surface about a fork, `wall.vtp`, and the fork itself, `tree.swc`.
fs::path fork_folder() {
  const fs::path folder = temporary_folder("told");
  core::write_file(folder / "tree.swc", told_fork_swc);
  EXPECT_EQ(ostia({"reconstruct", "tree.swc", "-o", "wall.vtp", "--level", "1"}, {folder, ""}).code, 0);
  return folder;
}

TEST(ToldCommand, FoldersAboveAnOutputAreMade) {
  const fs::path folder = fork_folder();
  const Setting in{folder, ""};
  EXPECT_EQ(ostia({"convert", "tree.swc", "a/b/c.vtp"}, in).code, 0);
  EXPECT_EQ(ostia({"measure", "tree.swc", "-o", "d/e/measures"}, in).code, 0);
  EXPECT_EQ(ostia({"lumen", "tree.swc", "-o", "f/wall.stl", "--case", "g/h/fork.ostia"}, in).code, 0);
  for (const char* made : {"a/b/c.vtp", "d/e/measures/manifest.json", "f/wall.stl", "g/h/fork.ostia"})
    EXPECT_TRUE(fs::exists(folder / made)) << made;
  EXPECT_EQ(ostia({"convert", "missing.stl", "i/j/c.vtp"}, in).code, 3);
  EXPECT_FALSE(fs::exists(folder / "i")) << "nothing was written into it";
}

TEST(ToldCommand, WarningsAreInTheManifestWithoutANameOfTheUsers) {
  const fs::path folder = fork_folder();
  fs::create_directory(folder / "DOE");
  // A hole and a loose triangle: mended, and told.
  core::write_file(folder / "DOE" / "DOE^JANE.obj",
                   "v 0 0 0\nv 6 0 0\nv 6 6 0\nv 0 6 0\nv 0 0 30\nv 6 0 30\nv 6 6 30\nv 0 6 30\n"
                   "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const Outcome done = ostia({"mesh", "DOE/DOE^JANE.obj", "-o", "mesh", "--edge-ratio", "1"}, {folder, ""});
  ASSERT_TRUE(done.code == 0 || done.code == 4) << done.err;
  const std::string text = core::read_file(folder / "mesh" / "manifest.json");
  const Json warnings = Json::parse(text)["warnings"];
  std::size_t told = 0;
  for (std::size_t at = done.err.find("warning: "); at != std::string::npos;
       at = done.err.find("warning: ", at + 1))
    ++told;
  EXPECT_GT(told, 0u) << "the test needs a run that warns";
  EXPECT_GE(warnings.size() + 1, told) << "all but the verdict, which is in the quality: " << done.err;
  EXPECT_THAT(text, Not(HasSubstr("DOE")));
}

TEST(ToldCommand, TheLogKeepsOrdinaryWords) {
  const fs::path folder = fork_folder();
  fs::create_directory(folder / "out");
  const Outcome text = ostia({"info", "out"}, {folder, ""});
  EXPECT_EQ(text.code, 3);
  EXPECT_THAT(text.err, HasSubstr("out")) << "a folder of that name";
  const Outcome log =
      ostia({"mesh", "wall.vtp", "-o", "surface", "--edge-ratio", "1", "--log", "json"}, {folder, ""});
  EXPECT_THAT(log.err, Not(HasSubstr("OUTPUT"))) << "`surface` is a word of the messages";
}

TEST(ToldCommand, OneLineSaysWhatWasMade) {
  const fs::path folder = fork_folder();
  const Setting in{folder, ""};
  const Outcome lines = ostia({"centerline", "wall.vtp", "-o", "lines.vtp", "--source", "0,0,1", "--target",
                               "3,2,21", "--target", "-3,2,21"},
                              in);
  ASSERT_EQ(lines.code, 0) << lines.err;
  EXPECT_THAT(lines.out, ::testing::StartsWith("2 vessels: "));
  EXPECT_EQ(std::count(lines.out.begin(), lines.out.end(), '\n'), 1);
  const Outcome mesh = ostia({"mesh", "wall.vtp", "-o", "mesh", "--edge-ratio", "0.8"}, in);
  EXPECT_THAT(mesh.out, HasSubstr(" tetrahedra (least dihedral "));
  EXPECT_THAT(mesh.out, HasSubstr("quality control "));
  EXPECT_EQ(std::count(mesh.out.begin(), mesh.out.end(), '\n'), 1);
  EXPECT_EQ(ostia({"mesh", "wall.vtp", "-o", "mesh", "--edge-ratio", "0.8"}, in).out, mesh.out)
      << "also when it was done already";
}

TEST(ToldCommand, HelpShowsDefaultsOnce) {
  const std::string help = ostia({"skeleton", "--help"}).out;
  EXPECT_THAT(help, HasSubstr("Gaps up to this are closed, mm; default 2"));
  EXPECT_THAT(help, HasSubstr("or ras (mm), ijk (voxels); default lps"));
  const std::string mesh = ostia({"mesh", "--help"}).out;
  EXPECT_THAT(mesh, HasSubstr("0.02 to 2; default 0.4"));
  EXPECT_THAT(mesh, Not(HasSubstr("default 0.25; default")));
  EXPECT_THAT(mesh, Not(HasSubstr("none; default 0\n"))) << "which its text says in other words";
}

TEST(ToldCommand, WhatWasMadeBeforeAFailureIsKeptAndNamed) {
  const fs::path folder = fork_folder();
  const Setting in{folder, ""};
  // A plane that lies nowhere in the lumen: the axes are there, and cutting fails.
  const std::vector<std::string> command{"mesh", "wall.vtp", "-o",
                                         "mesh", "--plane",  "outlet_nowhere=0,0,5:0,0,1"};
  const Outcome hidden = ostia(command, in);
  ASSERT_EQ(hidden.code, 3) << hidden.err;
  EXPECT_THAT(hidden.err, HasSubstr(".unfinished-mesh: centerlines.vtp"));
  EXPECT_TRUE(fs::exists(folder / ".unfinished-mesh" / "centerlines.vtp"));
  const Outcome named = ostia(command + std::vector<std::string>{"--keep", "kept"}, in);
  ASSERT_EQ(named.code, 3) << named.err;
  EXPECT_THAT(named.err, HasSubstr("kept: centerlines.vtp"));
  EXPECT_EQ(ostia({"measure", "kept/centerlines.vtp", "-o", "measures"}, in).code, 0);
  const Outcome done = ostia({"mesh", "wall.vtp", "-o", "mesh", "--edge-ratio", "0.8"}, in);
  ASSERT_TRUE(done.code == 0 || done.code == 4) << done.err;
  EXPECT_FALSE(fs::exists(folder / ".unfinished-mesh")) << "of no use any more";
  EXPECT_TRUE(fs::exists(folder / "kept"));
}

}  // namespace
}  // namespace ostia::testing
