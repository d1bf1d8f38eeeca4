#include "coarse_scan.h"
#include "kept_scan.h"
#include "program.h"

#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/phantom/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

namespace ostia::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A patient in cubes of 1.5 mm.
phantom::Scan coarse_scan() {
  constexpr double voxel_mm = 1.5;
  phantom::CaseOptions options;
  options.seed = 2;
  options.preset = phantom::Preset::small;
  phantom::CasePlan plan = phantom::plan_case(options);
  make_coarse(plan.options.scan, voxel_mm);
  return kept_scan(plan);
}

TEST(SegmentAortaCommand, TheAortaOfAPatientBecomesAMaskOrASurfaceWithoutASeed) {
  const auto folder = temporary_folder("aorta");
  const phantom::Scan scan = coarse_scan();
  imaging::write_image(folder / "heart.nrrd", scan.image);
  const Setting in{folder, ""};
  const Outcome done = ostia({"segment", "heart.nrrd", "-o", "aorta.nrrd", "--aorta"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const imaging::MaskVolume mask = imaging::read_mask(folder / "aorta.nrrd").volume;
  ASSERT_TRUE(imaging::same_grid(mask.geometry, scan.image.geometry));
  double inside = 0.0, of_aorta = 0.0;
  for (std::size_t v = 0; v < mask.voxels.size(); ++v) {
    if (mask.voxels[v] == 0) continue;
    inside += 1.0;
    of_aorta += static_cast<phantom::Label>(scan.labels.voxels[v]) == phantom::Label::aorta ? 1.0 : 0.0;
  }
  const double ml = inside * mask.geometry.spacing.prod() / 1000.0;
  EXPECT_GT(ml, 30.0);
  EXPECT_GT(of_aorta / inside, 0.95);
  char told[32];
  std::snprintf(told, sizeof told, " %.1f ml,", ml);
  EXPECT_THAT(done.out, AllOf(HasSubstr("aorta: "), HasSubstr(told)));

  const Outcome drawn =
      ostia({"segment", "heart.nrrd", "-o", "aorta.stl", "--aorta", "--smooth", "5", "--quiet"}, in);
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_NEAR(geometry::volume(io::read_surface(folder / "aorta.stl").surface.mesh) / 1000.0, ml, 0.03 * ml);
}

TEST(SegmentAortaCommand, LessThanAChestHasIsToldToBeLookedAt) {
  const auto folder = temporary_folder("aorta");
  const imaging::ImageVolume heart = coarse_scan().image;
  const auto& size = heart.geometry.size;
  const Setting in{folder, ""};
  for (const std::int64_t mm : {24, 75}) {
    const auto slices = static_cast<std::int64_t>(static_cast<double>(mm) / heart.geometry.spacing[2]);
    imaging::write_image(folder / "top.nrrd",
                         imaging::cropped(heart, {{0, 0, size[2] - slices}, {size[0], size[1], size[2]}}));
    const Outcome done = ostia({"segment", "top.nrrd", "-o", "aorta.nrrd", "--aorta"}, in);
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_EQ(done.err.find("of aorta were found; look whether") != std::string::npos, mm < 40) << done.err;
  }
}

TEST(SegmentAortaCommand, WhatHasNoAortaIsRefusedByNameAndNothingIsLeft) {
  const auto folder = temporary_folder("aorta");
  imaging::ImageVolume water;
  water.geometry.size = {40, 40, 40};
  water.geometry.spacing = {2.0, 2.0, 2.0};
  water.voxels.assign(static_cast<std::size_t>(water.geometry.voxels()), 0);
  for (std::size_t v = 0; v < water.voxels.size(); ++v) water.voxels[v] = static_cast<std::int16_t>(v % 37);
  imaging::write_image(folder / "water.nrrd", water);
  imaging::MaskVolume mask{water.geometry, std::vector<std::uint8_t>(water.voxels.size(), 0)};
  mask(20, 20, 20) = 1;
  imaging::write_image(folder / "mask.nrrd", mask);
  const Setting in{folder, ""};
  const Outcome none = ostia({"segment", "water.nrrd", "-o", "out.nrrd", "--aorta"}, in);
  EXPECT_EQ(none.code, 3);
  EXPECT_THAT(none.err,
              AllOf(HasSubstr("water.nrrd"), HasSubstr("no ascending aorta"), HasSubstr("--branch")));
  const Outcome no_image = ostia({"segment", "mask.nrrd", "-o", "out.nrrd", "--aorta"}, in);
  EXPECT_EQ(no_image.code, 3);
  EXPECT_THAT(no_image.err, AllOf(HasSubstr("mask.nrrd"), HasSubstr("no CT image")));
  EXPECT_THAT(names_in(folder), ElementsAre("mask.nrrd", "water.nrrd"));
}

TEST(SegmentAortaCommand, OptionsThatItWouldNotUseAreRefused) {
  const auto folder = temporary_folder("aorta");
  const Setting in{folder, ""};
  const std::vector<std::string> aorta{"segment", "heart.nrrd", "--aorta", "-o"};
  for (const std::vector<std::string>& unused :
       {std::vector<std::string>{"out.vtp", "--branch", "0,0,0:0,0,9"},
        {"out.vtp", "--lower", "100"},
        {"out.vtp", "--levelset", "phi.nrrd"},
        {"out.nrrd", "--smooth", "3"},
        {"out.csv"}}) {
    const Outcome done = ostia(aorta + unused, in);
    EXPECT_EQ(done.code, 2) << unused.back() << done.err;
    EXPECT_THAT(done.err, ::testing::Not(::testing::IsEmpty()));
  }
  EXPECT_THAT(names_in(folder), ::testing::IsEmpty());
}

}  // namespace
}  // namespace ostia::testing
