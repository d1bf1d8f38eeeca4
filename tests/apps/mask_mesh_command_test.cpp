#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/polyline.h"
#include "ostia/imaging/image_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace ostia::testing {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

void paint_line(imaging::MaskVolume& mask, const std::vector<Vec3>& line, double radius_mm,
                std::uint8_t value) {
  const auto& size = mask.geometry.size;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const Vec3 at =
            mask.geometry.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        if ((geometry::closest(line, at).point - at).norm() < radius_mm) mask(i, j, k) = value;
      }
}

imaging::MaskVolume empty_grid() {
  imaging::MaskVolume mask;
  mask.geometry.size = {60, 40, 90};
  mask.geometry.spacing = {0.6, 0.6, 0.6};
  mask.geometry.origin = {-8.0, -12.0, -6.0};
  mask.voxels.assign(static_cast<std::size_t>(mask.geometry.voxels()), 0);
  return mask;
}

/// A vessel of label 1 with a branch of label 2; the same with specks; masks without a vessel.
const fs::path& painted_masks() {
  static const fs::path folder = [] {
    const fs::path made = temporary_folder("painted");
    imaging::MaskVolume mask = empty_grid();
    paint_line(mask, {{0, 0, 0}, {0, 0, 20}, {2, 0, 40}}, 1.9, 1);
    paint_line(mask, {{0, 0, 14}, {8, 0, 24}, {17, 0, 28}}, 1.4, 2);
    imaging::write_image(made / "two.nrrd", mask);
    for (std::int64_t n = 0; n < 5; ++n) mask(5 + 3 * n, 3, 10) = 1;
    imaging::write_image(made / "specks_too.nii.gz", mask);
    imaging::MaskVolume empty = empty_grid(), full = empty_grid(), specks = empty_grid();
    std::fill(full.voxels.begin(), full.voxels.end(), std::uint8_t{1});
    for (std::int64_t n = 0; n < 20; ++n) specks(5 + 2 * n, 10, 10) = 1;
    imaging::write_image(made / "empty.nrrd", empty);
    imaging::write_image(made / "full.nrrd", full);
    imaging::write_image(made / "specks.nrrd", specks);
    imaging::MaskVolume sponge = empty_grid();  // a third of the voxels in a part of it, at random
    std::uint32_t random = 1;
    for (std::size_t v = 0; v < 50000; ++v)
      sponge.voxels[v] = (random = random * 1664525u + 1013904223u) >> 24 < 85u ? 1 : 0;
    imaging::write_image(made / "sponge.nrrd", sponge);
    return made;
  }();
  return folder;
}

double mask_mm3(const fs::path& file) {
  const imaging::MaskVolume mask = imaging::read_mask(file).volume;
  return mask.geometry.spacing.prod() *
         static_cast<double>(std::count_if(mask.voxels.begin(), mask.voxels.end(), [](auto v) { return v; }));
}

TEST(MaskMeshCommands, AMaskBecomesAMeshWithLayersByOneCommand) {
  const Setting in{painted_masks(), ""};
  const Outcome done = ostia({"mesh", "two.nrrd", "-o", "meshed", "--layers", "3", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const auto quality = nlohmann::json::parse(done.out);
  EXPECT_TRUE(quality["verdict"]["passed"].get<bool>());
  EXPECT_GT(quality["volume"]["prisms"].get<int>(), 1000);
  // Ends are cut a radius inside the mask's.
  const double mm3 = mask_mm3(in.folder / "two.nrrd");
  EXPECT_NEAR(quality["volume"]["volume_mm3"].get<double>(), mm3, 0.12 * mm3);
  EXPECT_TRUE(fs::exists(in.folder / "meshed/mesh.vtu"));
  const Outcome again = ostia({"mesh", "two.nrrd", "-o", "meshed", "--layers", "3"}, in);
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.err, HasSubstr("done already"));
}

TEST(MaskMeshCommands, ModelTakesTheSameMaskAndMakesTheSameMesh) {
  const Setting in{painted_masks(), ""};
  const Outcome done = ostia({"model", "two.nrrd", "-o", "modelled", "--edge-ratio", "0.8"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const Outcome meshed = ostia({"mesh", "two.nrrd", "-o", "coarse", "--edge-ratio", "0.8"}, in);
  ASSERT_EQ(meshed.code, 0) << meshed.err;
  EXPECT_EQ(core::read_file(in.folder / "modelled/quality.json"),
            core::read_file(in.folder / "coarse/quality.json"));
}

TEST(MaskMeshCommands, WhatIsLeftOutIsToldAndInTheManifest) {
  const Setting in{painted_masks(), ""};
  const Outcome done = ostia({"mesh", "specks_too.nii.gz", "-o", "left", "--edge-ratio", "0.8"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const auto manifest = nlohmann::json::parse(core::read_file(in.folder / "left/manifest.json"));
  std::string warnings;
  for (const auto& warning : manifest["warnings"]) warnings += warning.get<std::string>() + "\n";
  for (const std::string& told : {done.err, warnings}) EXPECT_THAT(told, HasSubstr("5 specks"));
}

TEST(MaskMeshCommands, ALabelAloneMayBeTheVessel) {
  const Setting in{painted_masks(), ""};
  const Outcome done =
      ostia({"mesh", "two.nrrd", "-o", "one", "--label", "1", "--edge-ratio", "0.8", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const auto quality = nlohmann::json::parse(done.out);
  EXPECT_LT(quality["volume"]["volume_mm3"].get<double>(), 0.8 * mask_mm3(in.folder / "two.nrrd"));
}

TEST(MaskMeshCommands, MasksWithoutVesselsAreRefusedByBothCommandsAndLeaveNoFolder) {
  const Setting in{painted_masks(), ""};
  const auto refused = [&](const std::string& file, const std::vector<std::string>& more,
                           const std::string& what, int code = 3) {
    for (const char* command : {"mesh", "model"}) {
      const Outcome done = ostia(std::vector<std::string>{command, file, "-o", "none"} + more, in);
      EXPECT_EQ(done.code, code) << command << " " << done.err;
      EXPECT_THAT(done.err, HasSubstr(what)) << command;
      EXPECT_FALSE(fs::exists(in.folder / "none")) << command;
    }
  };
  refused("empty.nrrd", {}, "empty.nrrd: the mask is empty");
  refused("full.nrrd", {}, "full");
  refused("specks.nrrd", {}, "specks");
  refused("sponge.nrrd", {}, "--with median");
  refused("two.nrrd", {"--label", "9"}, "has no voxel of label 9; its labels are");
  refused("two.nrrd", {"--size-array", "edges"}, "--size-array", 2);
  EXPECT_EQ(ostia({"mesh", "two.nrrd", "-o", "none", "--source", "0,0,0"}, in).code, 2);
  EXPECT_EQ(ostia({"model", "two.nrrd", "-o", "none", "--label", "1", "--source", "0,0,0"}, in).code, 2);
}

}  // namespace
}  // namespace ostia::testing
