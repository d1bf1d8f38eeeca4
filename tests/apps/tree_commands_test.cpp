// Trees of vessels: what they are, from one format to another, and mended.

#include "program.h"

#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace ostia::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// A trunk of 5 mm that forks into ends of 12 and 3 mm.
constexpr const char* sound_swc = "1 0 0 0 0 2 -1\n2 0 3 4 0 2 1\n3 0 3 4 12 1.5 2\n4 0 3 7 0 0.5 2\n";
/// The same with a part of its own, a segment without length and a radius that is none.
constexpr const char* faulty_swc =
    "1 0 0 0 0 2 -1\n2 0 3 4 0 2 1\n3 0 3 4 12 1.5 2\n4 0 3 7 0 -1 2\n5 0 3 7 0 0.5 4\n6 0 50 0 0 1 -1\n7 0 "
    "50 1 0 1 6\n";

struct TreeCommandsFolder {
  explicit TreeCommandsFolder(const char* swc) { core::write_file(path / "tree.swc", swc); }
  Outcome run(const std::vector<std::string>& command) const { return ostia(command, {path, ""}); }
  Json info(const std::string& file) const { return Json::parse(run({"info", file, "--json"}).out); }
  std::filesystem::path path = temporary_folder("tree");
};

TEST(TreeCommands, InfoAsTextAndAsJson) {
  const TreeCommandsFolder folder(sound_swc);
  const Outcome text = folder.run({"info", "tree.swc"});
  EXPECT_EQ(text.code, 0) << text.err;
  for (const char* row :
       {"kind          tree", "segments      3", "branches      3", "roots         1", "ends          2",
        "forks         1", "length        20 mm", "radius        0.5 to 2 mm", "faults        none"})
    EXPECT_THAT(text.out, HasSubstr(row));
  const Json info = folder.info("tree.swc");
  EXPECT_EQ(info["kind"], "tree");
  EXPECT_EQ(info["points"], 4);
  EXPECT_EQ(info["length_mm"], 20.0);
  EXPECT_EQ(info["is_tree"], true);
  EXPECT_TRUE(info["faults"].empty());
}

TEST(TreeCommands, InfoNamesFaultsByTheirLines) {
  const TreeCommandsFolder folder(faulty_swc);
  EXPECT_THAT(folder.run({"info", "tree.swc"}).out,
              HasSubstr("fault         1 segment has no length (line 5)"));
  const Json info = folder.info("tree.swc");
  EXPECT_EQ(info["parts"], 2);
  EXPECT_EQ(info["is_tree"], false);
  EXPECT_EQ(info["faults"][0]["what"], "zero_length");
  EXPECT_EQ(info["faults"][0]["first"], Json::parse("[5]"));
  for (const Json& fault : info["faults"])
    EXPECT_THAT(fault["text"].get<std::string>(), HasSubstr("line ")) << fault.dump();
}

TEST(TreeCommands, ConvertsBetweenFormats) {
  const TreeCommandsFolder folder(sound_swc);
  std::string from = "tree.swc";
  for (const std::string to : {"a.vtp", "b.csv", "c.vtp", "d.swc"}) {
    const Outcome done = folder.run({"convert", from, to});
    ASSERT_EQ(done.code, 0) << to << done.err;
    const Json info = folder.info(to);
    EXPECT_EQ(info["length_mm"], 20.0) << to;
    EXPECT_EQ(info["least_radius_mm"], 0.5) << to;
    from = to;
  }
}

TEST(TreeCommands, RepairsAndTells) {
  const TreeCommandsFolder folder(faulty_swc);
  const Outcome done = folder.run({"convert", "tree.swc", "mended.csv", "--repair", "--json"});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json told = Json::parse(done.out);
  EXPECT_EQ(told["segments"], 4);
  EXPECT_EQ(told["repair"]["steps"][0]["what"], "points_joined");
  const Json info = folder.info("mended.csv");
  EXPECT_EQ(info["faults"].size(), 1u) << info["faults"];
  EXPECT_EQ(info["faults"][0]["what"], "several_parts");
  EXPECT_EQ(info["least_radius_mm"], 0.5);
}

TEST(TreeCommands, TurnsFromAGivenRoot) {
  const TreeCommandsFolder folder(sound_swc);
  ASSERT_EQ(folder.run({"convert", "tree.swc", "turned.csv", "--repair", "--root", "3,4,12"}).code, 0);
  std::ifstream in(folder.path / "turned.csv");
  std::string header, first;
  std::getline(in, header);
  std::getline(in, first);
  EXPECT_EQ(first, "3,4,12,1.5,3,4,0,2,3");
}

// Places in metres, radii in millimetres: told, and settled by the user.
TEST(TreeCommands, RadiiInAnotherUnit) {
  const TreeCommandsFolder folder("1 0 0 0 0 2 -1\n2 0 0.003 0.004 0 1.5 1\n");
  EXPECT_THAT(folder.run({"info", "tree.swc"}).out, HasSubstr("different units"));
  ASSERT_EQ(folder.run({"convert", "tree.swc", "a.swc", "--units", "m", "--radius-units", "mm"}).code, 0);
  const Json info = folder.info("a.swc");
  EXPECT_DOUBLE_EQ(info["length_mm"].get<double>(), 5.0);
  EXPECT_EQ(info["least_radius_mm"], 1.5);
  EXPECT_TRUE(info["warnings"].empty());
}

TEST(TreeCommands, RefusesWhatMakesNoSense) {
  const TreeCommandsFolder folder(sound_swc);
  EXPECT_EQ(folder.run({"convert", "tree.swc", "a.csv", "--root", "0,0,0"}).code, 2);
  EXPECT_EQ(folder.run({"convert", "tree.swc", "a.csv", "--smooth", "3"}).code, 2);
  EXPECT_EQ(folder.run({"convert", "tree.swc", "a.stl"}).code, 3);
  core::write_file(folder.path / "cut.swc", "1 0 0 0 0 2 -1\n2 0 3 4");
  const Outcome cut = folder.run({"info", "cut.swc"});
  EXPECT_EQ(cut.code, 3);
  EXPECT_THAT(cut.err, HasSubstr("line 2: the file ends within it"));
  EXPECT_EQ(names_in(folder.path).size(), 2u);
}

// A table of points along vessels stays one of centerlines between the formats of centerlines.
TEST(TreeCommands, CenterlinesKeepTheirNames) {
  const TreeCommandsFolder folder(sound_swc);
  core::write_file(folder.path / "lines.csv", "vessel,x,y,z,radius\nLAD,0,0,0,1\nLAD,1,0,0,1\nLAD,2,0,0,1\n");
  ASSERT_EQ(folder.run({"convert", "lines.csv", "lines.vtp"}).code, 0);
  ASSERT_EQ(folder.run({"convert", "lines.vtp", "again.csv"}).code, 0);
  EXPECT_THAT(core::read_file(folder.path / "again.csv"), HasSubstr("LAD,2,0,0,1,2"));
  EXPECT_EQ(folder.info("lines.vtp")["segments"], 2);
}

}  // namespace
}  // namespace ostia::testing
