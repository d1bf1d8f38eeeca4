#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/coronary/extract.h"
#include "ostia/imaging/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

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

TEST(ExtractReal, AHeartWithoutItsRootIsSaidToHaveNone) {
  OSTIA_REQUIRE_SHARED(ct, "cta/rider-pilot-chest-pe-cta/heart-crop.nrrd");
  EXPECT_THROW(extract(imaging::read_image(ct).volume), GeometryError);
}

}  // namespace
}  // namespace ostia::coronary
