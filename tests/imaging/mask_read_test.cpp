// Masks whose ones are no ones, probabilities, and labels beyond 255.

#include "image_files.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/imaging/image_file.h"

#include <gmock/gmock.h>

namespace ostia::imaging {
namespace {
using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// 10 x 10 x 10 voxels of 0, the first three with these values.
fs::path file_of(const std::vector<float>& first) {
  FloatVolume image;
  image.geometry = oblique_grid(10, 10, 10);
  image.voxels.assign(1000, 0.0F);
  std::ranges::copy(first, image.voxels.begin());
  const fs::path path = ostia::testing::temporary_folder("mask_read") / "m.nrrd";
  write_image(path, image);
  return path;
}

std::vector<int> first_of(const LoadedImage<std::uint8_t>& image) {
  return {image.volume.voxels[0], image.volume.voxels[1], image.volume.voxels[2], image.volume.voxels[3]};
}

TEST(ReadMask, OneValueBesideZeroIsAMaskWhateverItIs) {
  for (const float one : {100.0F * 0.01F, 0.99999994F, 0.3F, 0.7F, 1234.5F, 255.0F}) {
    const fs::path path = file_of({one, 0.0F, one});
    EXPECT_TRUE(looks_like_mask(path)) << one;
    EXPECT_THAT(first_of(read_mask(path)), ElementsAre(1, 0, 1, 0)) << one;
    if (one < 2.0F) {
      EXPECT_THAT(first_of(read_labels(path)), ElementsAre(1, 0, 1, 0)) << one;
    }
  }
  EXPECT_FALSE(looks_like_mask(file_of({0.3F, 0.6F}))) << "three values that are not whole";
}

TEST(ReadMask, ProbabilitiesAreCutAtOneHalfAndThisIsTold) {
  std::vector<float> values{0.9F, 0.49F, 0.5F};
  for (int i = 0; i < 40; ++i) values.push_back(0.01F * static_cast<float>(i));
  const fs::path path = file_of(values);
  EXPECT_TRUE(looks_like_probabilities(path));
  const auto mask = read_mask(path);
  EXPECT_THAT(first_of(mask), ElementsAre(1, 0, 1, 0));
  EXPECT_THAT(mask.header.warnings, ElementsAre(HasSubstr("probabilities")));
  EXPECT_THAT(read_labels(path).header.warnings, ElementsAre(HasSubstr("probabilities")));
  values.back() = 1.2F;
  EXPECT_FALSE(looks_like_probabilities(file_of(values)));
  EXPECT_FALSE(looks_like_probabilities(file_of({1.0F}))) << "zeros and ones are a mask";
  EXPECT_FALSE(looks_like_probabilities(file_of(std::vector<float>(900, 0.6F)))) << "most are next to 0";
}

TEST(ReadLabels, LabelsBeyond255AreCountedUpAndKnownByTheFilesNumbers) {
  const auto read = read_labels(file_of({700.0F, 3.0F, 70000.0F}));
  EXPECT_THAT(first_of(read), ElementsAre(2, 1, 3, 0));
  EXPECT_THAT(read.header.file_labels, ElementsAre(0, 3, 700, 70000));
  EXPECT_THAT(read.header.warnings, ElementsAre(HasSubstr("up to 70000")));
  EXPECT_TRUE(read_labels(file_of({7.0F, 255.0F})).header.file_labels.empty());
}

TEST(ReadLabels, AnImageIsNoSetOfLabels) {
  std::vector<float> many;
  for (int i = 0; i < 256; ++i) many.push_back(static_cast<float>(10 * i + 1));
  for (const std::vector<float>& values : {many, std::vector<float>{700.5F, 3.0F}}) {
    const fs::path path = file_of(values);
    try {
      read_labels(path);
      ADD_FAILURE() << "taken";
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr("an image, not a mask"));
      EXPECT_THAT(error.what(), HasSubstr("m.nrrd"));
    }
  }
}

}  // namespace
}  // namespace ostia::imaging
