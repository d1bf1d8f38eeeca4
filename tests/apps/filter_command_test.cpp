// `ostia filter`.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>

namespace ostia::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::json;
namespace fs = std::filesystem;

/// Two boxes of 300 HU in 0, one of them small.
fs::path boxes_folder(std::int64_t edge = 20) {
  const fs::path folder = temporary_folder("filter");
  imaging::ImageVolume image;
  image.geometry.size = {edge, edge, edge};
  image.geometry.spacing = {0.5, 0.5, 0.5};
  image.voxels.assign(static_cast<std::size_t>(edge * edge * edge), 0);
  for (int k = 4; k < 10; ++k)
    for (int j = 4; j < 10; ++j)
      for (int i = 4; i < 10; ++i) image(i, j, k) = 300;
  image(15, 15, 15) = 300;
  imaging::write_image(folder / "scan.nrrd", image);
  return folder;
}

TEST(FilterCommand, RunsAChainAndTellsWhatItMade) {
  const Setting in{boxes_folder(), ""};
  const Outcome done = ostia({"filter", "scan.nrrd", "-o", "parts.nii.gz", "--with", "threshold:lower=200",
                              "--with", "components:least_voxels=10", "--json"},
                             in);
  ASSERT_EQ(done.code, 0) << done.err;
  const Json told = Json::parse(done.out);
  EXPECT_EQ(told["kind"], "filter");
  EXPECT_EQ(told["values"], "labels");
  EXPECT_EQ(told["type"], "uint8");
  EXPECT_EQ(told["largest"], 1.0);
  EXPECT_EQ(told["steps"][1], "components:least_voxels=10,most=255,corners=no");
  const auto parts = imaging::read_labels(in.folder / "parts.nii.gz").volume;
  EXPECT_EQ(parts(5, 5, 5), 1);
  EXPECT_EQ(parts(15, 15, 15), 0);
}

TEST(FilterCommand, KeepsTheTypeOfACtAndGivesFloatsOfAnotherUnit) {
  const Setting in{boxes_folder(), ""};
  const auto type_of = [&](const std::vector<std::string>& more) {
    const Outcome done =
        ostia(std::vector<std::string>{"filter", "scan.nrrd", "-o", "out.nrrd", "--json"} + more, in);
    EXPECT_EQ(done.code, 0) << done.err;
    return Json::parse(done.out)["type"].get<std::string>();
  };
  EXPECT_EQ(type_of({"--with", "gaussian:sigma_mm=1"}), "int16");
  EXPECT_EQ(type_of({"--with", "gradient-magnitude"}), "float32");
  EXPECT_EQ(type_of({"--with", "threshold:lower=100"}), "uint8");
  EXPECT_EQ(type_of({"--with", "gaussian:sigma_mm=1", "--type", "float32"}), "float32");
  EXPECT_EQ(type_of({"--with", "median", "--type", "uint8"}), "uint8");  // 300 becomes 255, and that is told
}

TEST(FilterCommand, ListsWhatThereIs) {
  const Outcome text = ostia({"filter", "--list"});
  EXPECT_EQ(text.code, 0);
  EXPECT_THAT(text.out, HasSubstr("n4: Takes the coil's shading"));
  EXPECT_THAT(text.out, HasSubstr("  sigma_mm: Standard deviation; 0.05 to 50 mm, default 0.5\n"));
  const Json all = Json::parse(ostia({"filter", "--list", "--json"}).out);
  EXPECT_EQ(all["kind"], "filters");
  EXPECT_GE(all["filters"].size(), 20u);
  EXPECT_EQ(all["filters"][0]["parameters"][0]["most"], 50.0);
}

TEST(FilterCommand, RefusesInASentenceAndLeavesNothing) {
  const Setting in{boxes_folder(), ""};
  core::write_file(in.folder / "wall.stl", "solid\nendsolid\n");
  const auto refused = [&](const std::vector<std::string>& arguments, int code) {
    const Outcome done = ostia(std::vector<std::string>{"filter"} + arguments, in);
    EXPECT_EQ(done.code, code) << done.err;
    return done.err;
  };
  EXPECT_THAT(refused({"scan.nrrd", "-o", "o.nrrd", "--with", "medain"}, 2),
              HasSubstr("the nearest name is \"median\""));
  EXPECT_THAT(refused({"scan.nrrd", "-o", "o.nrrd", "--with", "median:radius=1"}, 2), HasSubstr("radius_mm"));
  EXPECT_THAT(refused({"scan.nrrd", "-o", "o.nrrd", "--with", "median:radius_mm=99"}, 2),
              HasSubstr("0 to 5"));
  EXPECT_THAT(refused({"scan.nrrd", "-o", "o.nrrd"}, 2), HasSubstr("--list"));
  EXPECT_THAT(refused({"scan.nrrd", "--with", "median"}, 2), HasSubstr("-o"));
  EXPECT_THAT(refused({"scan.nrrd", "-o", "o.stl", "--with", "median"}, 2), HasSubstr(".nrrd"));
  EXPECT_THAT(refused({"--list", "--with", "median"}, 2), HasSubstr("--list goes alone"));
  EXPECT_THAT(refused({"scan.nrrd", "-o", "o.nrrd", "--with", "match-histogram"}, 3),
              HasSubstr("--reference"));
  EXPECT_THAT(refused({"scan.nrrd", "-o", "o.nrrd", "--with", "median", "--mask", "scan.nrrd"}, 3),
              HasSubstr("n4"));
  EXPECT_THAT(refused({"missing.nrrd", "-o", "o.nrrd", "--with", "median"}, 3), HasSubstr("missing.nrrd"));
  EXPECT_THAT(refused({"wall.stl", "-o", "o.nrrd", "--with", "median"}, 3), HasSubstr("wall.stl"));
  EXPECT_THAT(names_in(in.folder), ElementsAre("scan.nrrd", "wall.stl"));
}

TEST(FilterCommand, AnInterruptLeavesNothing) {
  const Setting in{boxes_folder(160), ""};
  double seconds = 0.0;
  const Outcome done =
      interrupted({"filter", "scan.nrrd", "-o", "o.nrrd", "--with", "curvature-diffusion:steps=1000"}, in,
                  SIGINT, 1.5, seconds);
  EXPECT_EQ(done.code, 130) << done.err;
  EXPECT_THAT(names_in(in.folder), ElementsAre("scan.nrrd"));
}

TEST(FilterCommand, IsAStepOfAChain) {
  const Setting in{boxes_folder(), ""};
  core::write_file(in.folder / "p.json", R"({"v": 1, "steps": [
    {"command": "filter", "input": "{ct}", "output": "mask.nrrd", "options": {"with": ["median", "threshold:lower={least}"]}},
    {"command": "filter", "input": "mask.nrrd", "output": "map.nrrd", "options": {"with": "distance"}}]})");
  const Outcome done =
      ostia({"run", "p.json", "-o", "out", "--set", "ct=scan.nrrd", "--set", "least=150"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const auto map = imaging::read_float_image(in.folder / "out" / "map.nrrd").volume;
  EXPECT_LT(map(7, 7, 7), 0.0F);
  EXPECT_GT(map(15, 15, 15), 0.0F) << "the median took the lone voxel away";
}

}  // namespace
}  // namespace ostia::testing
