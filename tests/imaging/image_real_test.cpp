#include "image_files.h"
#include "shared_data.h"

#include "ostia/imaging/image_file.h"
#include "ostia/imaging/sampling.h"

#include <gtest/gtest.h>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

constexpr const char* cta = "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz";
constexpr const char* true_lumen = "cta/totalsegmentator-aorta-cta/aorta_true_lumen.nii.gz";
constexpr const char* heart = "cta/rider-pilot-chest-pe-cta/heart-crop.nrrd";
const Vec3 ascending_aorta(8.5, -187.6, 675.2);  // LPS

TEST(RealCta, LiesWhereItsLandmarkSays) {
  OSTIA_REQUIRE_SHARED(path, cta);
  const auto image = read_image(path);
  EXPECT_EQ(image.header.format, "NIfTI-1");
  EXPECT_EQ(image.volume.geometry.size, (std::array<std::int64_t, 3>{120, 126, 164}));
  EXPECT_LT((image.volume.geometry.spacing - Vec3::Constant(1.5)).norm(), 1e-6);
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, -3, 0), Vec3(0, 0, 6)})
    EXPECT_GT(sample(image.volume, Vec3(ascending_aorta + offset)), 250.0);
  // The chest stands upright: lungs are dark, so low values must be there, and bone is bright.
  EXPECT_LT(*std::min_element(image.volume.voxels.begin(), image.volume.voxels.end()), -700);
  EXPECT_GT(*std::max_element(image.volume.voxels.begin(), image.volume.voxels.end()), 500);
}

TEST(RealCta, MaskIsOnTheSameGridAndEnhanced) {
  OSTIA_REQUIRE_SHARED(path, cta);
  OSTIA_REQUIRE_SHARED(mask_path, true_lumen);
  EXPECT_FALSE(looks_like_mask(path));
  EXPECT_TRUE(looks_like_mask(mask_path));
  const auto image = read_image(path);
  const auto mask = read_mask(mask_path);
  ASSERT_TRUE(same_grid(image.volume.geometry, mask.volume.geometry));
  EXPECT_EQ(sample(mask.volume, ascending_aorta, Interpolation::nearest), 1.0);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < mask.volume.voxels.size(); ++i)
    if (mask.volume.voxels[i]) sum += image.volume.voxels[i], ++count;
  ASSERT_GT(count, 1000U);
  EXPECT_GT(sum / static_cast<double>(count), 250.0);
  EXPECT_THROW(read_mask(path), InvalidInput);
}

TEST(RealCta, EveryMaskOfTheFolderLooksLikeOne) {
  OSTIA_REQUIRE_SHARED(path, cta);
  const ImageHeader reference = read_image_header(path);
  std::size_t masks = 0;
  for (const auto& entry : fs::directory_iterator(path.parent_path())) {
    if (entry.path().extension() != ".gz" || entry.path() == path) continue;
    EXPECT_TRUE(same_grid(read_image_header(entry.path()).geometry, reference.geometry)) << entry.path();
    EXPECT_NO_THROW(read_mask(entry.path())) << entry.path();
    ++masks;
  }
  EXPECT_GE(masks, 15U);
}

TEST(RealHeart, ReadsAndComesBackThroughEveryFormat) {
  OSTIA_REQUIRE_SHARED(path, heart);
  const auto image = read_image(path);
  EXPECT_EQ(image.volume.geometry.size, (std::array<std::int64_t, 3>{290, 250, 77}));
  EXPECT_LT((image.volume.geometry.spacing - Vec3(0.644531, 0.644531, 0.8)).norm(), 1e-12);
  EXPECT_TRUE(image.header.warnings.empty());
  const fs::path here = ostia::testing::temporary_folder("heart");
  for (const char* name : {"a.nrrd", "a.mhd", "a.mha"}) {
    write_image(here / name, image.volume);
    const auto again = read_image(here / name);
    EXPECT_EQ(again.volume.voxels, image.volume.voxels) << name;
    EXPECT_EQ(again.volume.geometry.origin, image.volume.geometry.origin) << name;
    EXPECT_EQ(again.volume.geometry.spacing, image.volume.geometry.spacing) << name;
  }
}

}  // namespace
}  // namespace ostia::imaging
