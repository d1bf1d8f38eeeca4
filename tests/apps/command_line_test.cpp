// Wrong usage, help, configuration, what goes to which stream, places that cannot be written.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace ostia::testing {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::json;

geometry::TriMesh tetrahedron() {
  return {{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

class EveryCommand : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(CommandLine, EveryCommand,
                         ::testing::Values("info", "import", "segment", "centerline", "mesh", "convert",
                                           "model", "lumen", "replay", "filter"));

TEST_P(EveryCommand, ExplainsItselfWithAnExample) {
  const Outcome done = ostia({GetParam(), "--help"});
  EXPECT_EQ(done.code, 0);
  EXPECT_THAT(done.out, HasSubstr("Example:\n  ostia " + std::string(GetParam()) + " "));
  EXPECT_THAT(done.err, IsEmpty());
}

TEST_P(EveryCommand, RefusesUnknownOptions) {
  const Outcome done = ostia({GetParam(), "x.nrrd", "--no-such-option"});
  EXPECT_EQ(done.code, 2);
  EXPECT_THAT(done.out, IsEmpty());
  EXPECT_THAT(done.err, Not(IsEmpty()));
}

TEST(CommandLine, SaysItsVersion) {
  const Outcome done = ostia({"--version"});
  EXPECT_EQ(done.code, 0);
  EXPECT_THAT(done.out, ::testing::MatchesRegex("ostia [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(CommandLine, WrongUsageIsTwo) {
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{},
                                                {"nothing"},
                                                {"model", "-o", "x"},
                                                {"model", "a.nrrd", "--builtin", "-o", "x"},
                                                {"mesh"},
                                                {"info", "a.nrrd", "--threads", "-1"},
                                                {"info", "a.nrrd", "--coords", "mni"}}) {
    EXPECT_EQ(ostia(wrong).code, 2) << ::testing::PrintToString(wrong);
  }
}

TEST(CommandLine, BadInputIsThree) {
  const auto folder = temporary_folder("bad");
  core::write_file(folder / "a.nrrd", "");
  core::write_file(folder / "a.stl", "hello");
  core::write_file(folder / "a.txt", "hello");
  for (const char* file : {"a.nrrd", "a.stl", "a.txt", "missing.nrrd"}) {
    const Outcome done = ostia({"info", file}, {folder, ""});
    EXPECT_EQ(done.code, 3) << file;
    EXPECT_THAT(done.out, IsEmpty()) << file;
    EXPECT_THAT(done.err, HasSubstr(file)) << file;
  }
  EXPECT_THAT(names_in(folder), ::testing::ElementsAre("a.nrrd", "a.stl", "a.txt"));
}

TEST(CommandLine, AsksForTheBranchesOfAnImage) {
  const SmallCase small = small_case();
  const Outcome done = ostia({"model", small.image.string(), "-o", "out"}, {small.folder, ""});
  EXPECT_EQ(done.code, 3);
  EXPECT_THAT(done.err, HasSubstr("--branch"));
  EXPECT_EQ(
      ostia({"model", small.image.string(), "-o", "out", "--branch", "1,2:3,4"}, {small.folder, ""}).code, 3);
  EXPECT_EQ(names_in(small.folder).size(), 1u);
}

TEST(CommandLine, JsonIsOneObjectOnStandardOutput) {
  const auto folder = temporary_folder("json");
  io::write_surface(folder / "a.stl", tetrahedron());
  const Outcome done = ostia({"info", "a.stl", "--json"}, {folder, ""});
  EXPECT_EQ(done.code, 0);
  const Json info = Json::parse(done.out);
  EXPECT_EQ(info["triangles"], 4);
  EXPECT_EQ(info["open_edges"], 0);
}

TEST(CommandLine, JsonLogIsAnObjectALine) {
  const Outcome done = ostia({"info", "missing.nrrd", "--log", "json"});
  EXPECT_EQ(done.code, 3);
  const Json line = Json::parse(done.err);
  EXPECT_EQ(line["level"], "error");
}

TEST(CommandLine, TakesOptionsFromAFileAndPrefersItsOwn) {
  const auto folder = temporary_folder("config");
  io::write_surface(folder / "a.stl", tetrahedron());
  core::write_file(folder / "c.json", R"({"v": 1, "units": "cm", "quiet": true})");
  const auto width = [&](const std::vector<std::string>& more) {
    EXPECT_EQ(ostia(std::vector<std::string>{"convert", "a.stl", "b.stl"} + more, {folder, ""}).code, 0);
    return Json::parse(ostia({"info", "b.stl", "--json"}, {folder, ""}).out)["box_mm"][1][0].get<double>();
  };
  EXPECT_DOUBLE_EQ(width({}), 10.0);
  EXPECT_DOUBLE_EQ(width({"--config", "c.json"}), 100.0);
  EXPECT_DOUBLE_EQ(width({"--config=c.json", "--units", "mm"}), 10.0);
}

TEST(CommandLine, RefusesABadConfiguration) {
  const auto folder = temporary_folder("config");
  io::write_surface(folder / "a.stl", tetrahedron());
  core::write_file(folder / "broken.json", "{");
  core::write_file(folder / "deep.json", R"({"units": {"a": 1}})");
  core::write_file(folder / "unknown.json", R"({"colour": "red"})");
  EXPECT_EQ(ostia({"info", "a.stl", "--config", "broken.json"}, {folder, ""}).code, 3);
  EXPECT_EQ(ostia({"info", "a.stl", "--config", "deep.json"}, {folder, ""}).code, 3);
  EXPECT_EQ(ostia({"info", "a.stl", "--config", "missing.json"}, {folder, ""}).code, 3);
  EXPECT_EQ(ostia({"info", "a.stl", "--config", "unknown.json"}, {folder, ""}).code, 2);
}

TEST(CommandLine, RefusesPlacesItCannotWriteBeforeItWorks) {
  const auto folder = temporary_folder("places");
  core::write_file(folder / "file", "mine");
  for (const char* place : {"file/x", "file", "/proc/x"}) {
    const Outcome done = ostia({"model", "--builtin", "-o", place, "--progress", "plain"}, {folder, ""});
    EXPECT_EQ(done.code, 3) << place;
    EXPECT_THAT(done.err, HasSubstr("cannot write")) << place;
    EXPECT_THAT(done.err, Not(HasSubstr("level set"))) << place;
  }
  EXPECT_THAT(names_in(folder), ::testing::ElementsAre("file"));
  EXPECT_EQ(core::read_file(folder / "file"), "mine");
}

TEST(CommandLine, NeverReplacesAFolderThatIsNotItsOwn) {
  const auto folder = temporary_folder("mine");
  std::filesystem::create_directory(folder / "letters");
  core::write_file(folder / "letters" / "a.txt", "mine");
  core::write_file(folder / "letters" / "manifest.json", "{}");
  const Outcome done = ostia({"model", "--builtin", "-o", "letters"}, {folder, ""});
  EXPECT_EQ(done.code, 3);
  EXPECT_THAT(done.err, HasSubstr("letters"));
  EXPECT_EQ(core::read_file(folder / "letters" / "a.txt"), "mine");
}

TEST(CommandLine, AnyPathIsTaken) {
  const auto folder = temporary_folder("paths") / "Jahr 2024 Bäßler 心臓 'x'";
  std::filesystem::create_directory(folder);
  const std::string long_name = std::string(240, 'l') + ".stl";
  io::write_surface(folder / "a b.stl", tetrahedron());
  EXPECT_EQ(ostia({"convert", "a b.stl", long_name}, {folder, ""}).code, 0);
  EXPECT_EQ(core::read_file(folder / "a b.stl"), core::read_file(folder / long_name));
  EXPECT_EQ(ostia({"convert", (folder / long_name).string(), (folder / "ö.vtp").string()}).code, 0);
  EXPECT_EQ(ostia({"info", (folder / "ö.vtp").string()}).code, 0);
}

TEST(CommandLine, AGermanLocaleChangesNothing) {
  if (std::system("locale -a 2>/dev/null | grep -qi '^de_DE.utf-*8$'") != 0)
    GTEST_SKIP() << "needs the locale de_DE.UTF-8";
  const auto folder = temporary_folder("locale");
  geometry::TriMesh mesh = tetrahedron();
  mesh.points[1].x() = 10.5;
  io::write_surface(folder / "a.stl", mesh);
  for (const char* to : {"b.vtp", "b.ply", "b.stl"}) {
    EXPECT_EQ(ostia({"convert", "a.stl", std::string("c-") + to}, {folder, ""}).code, 0);
    EXPECT_EQ(ostia({"convert", "a.stl", to}, {folder, "LC_ALL=de_DE.UTF-8"}).code, 0);
    EXPECT_EQ(core::read_file(folder / to), core::read_file(folder / (std::string("c-") + to)));
  }
}

}  // namespace
}  // namespace ostia::testing
