#include "image_files.h"
#include "shared_data.h"

#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::imaging {
namespace {
using namespace testing;

struct ReadTest : ::testing::Test {
  fs::path path = ostia::testing::temporary_folder("read") / "image.nii";
  template <class T>
  void write(int datatype, std::vector<T> voxels, double slope = 0, double intercept = 0) {
    Nifti nifti;
    nifti.datatype = datatype;
    nifti.bitpix = 8 * static_cast<int>(sizeof(T));
    nifti.slope = slope;
    nifti.intercept = intercept;
    voxels.resize(24);
    write_bytes(path, nifti.file(voxels));
  }
  static std::string warning(const ImageHeader& header) {
    return header.warnings.size() == 1 ? header.warnings[0] : "not one warning";
  }
};

TEST_F(ReadTest, ImageIsRoundedToTheNearestHounsfieldUnit) {
  write<float>(16, {0.49F, 0.51F, -0.49F, -0.51F, 100.4F, -1000.6F});
  const auto image = read_image(path);
  EXPECT_EQ(std::vector<std::int16_t>(image.volume.voxels.begin(), image.volume.voxels.begin() + 6),
            (std::vector<std::int16_t>{0, 1, 0, -1, 100, -1001}));
  EXPECT_TRUE(image.header.warnings.empty());
}

TEST_F(ReadTest, SlopeAndInterceptGiveHounsfieldUnits) {
  write<std::uint16_t>(512, {0, 1024, 4095}, 0.5, -1024);
  const auto image = read_image(path);
  EXPECT_EQ(image.volume.voxels[0], -1024);
  EXPECT_EQ(image.volume.voxels[1], -512);
  EXPECT_EQ(image.volume.voxels[2], 1024);  // 1023.5
  EXPECT_EQ(image.header.slope, 0.5);
  EXPECT_EQ(image.header.intercept, -1024);
}

TEST_F(ReadTest, WhatDoesNotFitIsClampedAndCounted) {
  write<std::int32_t>(8, {40000, -40000, 32767, -32768, 7});
  const auto image = read_image(path);
  EXPECT_EQ(image.volume.voxels[0], 32767);
  EXPECT_EQ(image.volume.voxels[1], -32768);
  EXPECT_EQ(image.volume.voxels[2], 32767);
  EXPECT_EQ(warning(image.header), "2 voxels beyond -32768..32767 HU were clamped");
}

TEST_F(ReadTest, ImageSetsVoxelsThatAreNoNumbersToAirAndSaysSo) {
  write<float>(16, {std::numeric_limits<float>::quiet_NaN(), 5.0F});
  const auto image = read_image(path);
  EXPECT_EQ(image.volume.voxels[0], -1024);
  EXPECT_EQ(image.volume.voxels[1], 5);
  EXPECT_EQ(warning(image.header), "1 voxels that are not numbers were set to -1024 HU");
}

TEST_F(ReadTest, FloatImageKeepsTrueValuesAndRefusesNaN) {
  write<std::int16_t>(4, {3, -7}, 0.25, 1.0);
  const auto image = read_float_image(path);
  EXPECT_EQ(image.volume.voxels[0], 1.75F);
  EXPECT_EQ(image.volume.voxels[1], -0.75F);
  write<float>(16, {1.0F, std::numeric_limits<float>::infinity()});
  EXPECT_NE(refusal([&] { read_float_image(path); }).find("voxel 1"), std::string::npos);
}

TEST_F(ReadTest, ALabelMapIsToldFromHounsfieldUnits) {
  const auto write_cube = [&](std::int16_t shift, int values) {
    Nifti nifti;
    nifti.datatype = 4;
    nifti.bitpix = 16;
    for (int a = 0; a < 3; ++a) nifti.dim[static_cast<std::size_t>(a) + 1] = 20;
    std::vector<std::int16_t> voxels(8000);
    for (std::size_t i = 0; i < voxels.size(); ++i)
      voxels[i] = static_cast<std::int16_t>(static_cast<int>(i) % values + shift);
    write_bytes(path, nifti.file(voxels));
  };
  write_cube(0, 118);
  EXPECT_NE(warning(read_image(path).header).find("only 118 different values"), std::string::npos);
  write_cube(-1, 118);
  EXPECT_TRUE(read_image(path).header.warnings.empty());
  write_cube(0, 257);
  EXPECT_TRUE(read_image(path).header.warnings.empty());
}

TEST_F(ReadTest, MaskMakesEveryLabelOne) {
  write<std::int16_t>(4, {0, 1, 5, -3, 0});
  const auto mask = read_mask(path);
  EXPECT_EQ(std::vector<std::uint8_t>(mask.volume.voxels.begin(), mask.volume.voxels.begin() + 5),
            (std::vector<std::uint8_t>{0, 1, 1, 1, 0}));
}

TEST_F(ReadTest, MaskOfSixteenValuesIsOneAndOfSeventeenIsNot) {
  std::vector<std::int16_t> voxels(24, 0);
  for (std::size_t i = 0; i < 16; ++i) voxels[i] = static_cast<std::int16_t>(i);
  write(4, voxels);
  EXPECT_NO_THROW(read_mask(path));
  EXPECT_TRUE(looks_like_mask(path));
  voxels[20] = 16;
  write(4, voxels);
  EXPECT_NE(refusal([&] { read_mask(path); }).find("not a mask"), std::string::npos);
  EXPECT_FALSE(looks_like_mask(path));
}

TEST_F(ReadTest, LooksLikeMaskWantsWholeNumbersAndAZeroOrTwoValues) {
  write<float>(16, {0.0F, 1.0F});
  EXPECT_TRUE(looks_like_mask(path));
  write<float>(16, {0.0F, 0.5F});  // two values part the image in two, whatever they are
  EXPECT_TRUE(looks_like_mask(path));
  write<float>(16, {0.0F, 0.25F, 0.5F});
  EXPECT_FALSE(looks_like_mask(path));
  write<std::int16_t>(4, std::vector<std::int16_t>(24, 7));
  EXPECT_FALSE(looks_like_mask(path));
  write<std::int16_t>(4, std::vector<std::int16_t>(24, 7), 1.0, -7.0);
  EXPECT_TRUE(looks_like_mask(path));
}

TEST_F(ReadTest, ReportsProgressAndCanBeCancelled) {
  write<std::int16_t>(4, {1, 2, 3});
  const core::TaskContext task;
  read_image(path, task);
  EXPECT_GE(task.progress(), 0.9);
  task.cancel();
  EXPECT_THROW(read_image(path, task), Cancelled);
  EXPECT_THROW(read_mask(path, task), Cancelled);
  EXPECT_THROW(read_float_image(path, task), Cancelled);
}

}  // namespace
}  // namespace ostia::imaging
