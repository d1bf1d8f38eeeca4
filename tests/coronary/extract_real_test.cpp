#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/coronary/extract.h"
#include "ostia/imaging/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>

namespace ostia::coronary {
namespace {

/// 1.5 mm voxels: an artery is two of them wide. What is found is little, and is told.
TEST(ExtractReal, AnAorticAngiogramGivesLittleAndSaysSo) {
  OSTIA_REQUIRE_SHARED(ct, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  try {
    const Extraction found = extract(imaging::read_image(ct).volume);
    EXPECT_EQ(geometry::find_fault(found.vessels.tree).value_or("none"), "none");
    EXPECT_FALSE(found.warnings.empty());
    for (const geometry::Vessel& vessel : found.vessels.tree.vessels)
      std::printf("%s: %.0f mm\n", vessel.name.c_str(),
                  geometry::vessel_axis(found.vessels.tree, vessel).abscissa.back());
    for (const std::string& warning : found.warnings) std::printf("%s\n", warning.c_str());
  } catch (const GeometryError& error) {
    std::printf("%s\n", error.what());
    EXPECT_THAT(error.what(), ::testing::HasSubstr("draw a first vessel by its two ends"));
  }
}

/// What is said where nothing is found; empty where something is.
std::string refusal_of(const imaging::ImageVolume& image) {
  try {
    extract(image);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::bad_input) << error.what();
    return error.what();
  }
  return "";
}

TEST(ExtractReal, AHeartWithoutItsRootIsSaidToHaveNone) {
  OSTIA_REQUIRE_SHARED(ct, "cta/rider-pilot-chest-pe-cta/heart-crop.nrrd");
  EXPECT_THAT(refusal_of(imaging::read_image(ct).volume),
              ::testing::AllOf(::testing::HasSubstr("descending"), ::testing::HasSubstr("may be cut off")));
}

TEST(ExtractReal, AnAngiogramThatCannotBeUsedIsRefusedWithTheReason) {
  OSTIA_REQUIRE_SHARED(ct, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  const imaging::ImageVolume image = imaging::read_image(ct).volume;
  const auto [x, y, z] = image.geometry.size;
  imaging::ImageVolume raw = image, native = image, upside_down = image;
  for (std::int16_t& voxel : raw.voxels) voxel = static_cast<std::int16_t>(voxel + 1024);
  EXPECT_THAT(refusal_of(raw), ::testing::HasSubstr("1024 may not have been subtracted"));
  for (std::int16_t& voxel : native.voxels)
    if (voxel > 130) voxel = static_cast<std::int16_t>(60 + (voxel - 60) / 33);
  EXPECT_THAT(refusal_of(native), ::testing::HasSubstr("as blood without contrast agent"));
  const auto plane = static_cast<std::ptrdiff_t>(x * y);
  for (std::ptrdiff_t k = 0; k < z; ++k)
    std::copy_n(image.voxels.begin() + (z - 1 - k) * plane, plane, upside_down.voxels.begin() + k * plane);
  EXPECT_THAT(refusal_of(upside_down), ::testing::HasSubstr("stands on its head"));
  // From the middle of the ascending aorta upwards: the vessels that leave the arch are no coronary arteries.
  EXPECT_THAT(refusal_of(imaging::cropped(image, {{0, 0, z * 7 / 10}, {x, y, z}})),
              ::testing::HasSubstr("draw a first vessel by its two ends"));
}

}  // namespace
}  // namespace ostia::coronary
