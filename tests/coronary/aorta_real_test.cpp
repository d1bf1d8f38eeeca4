#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/coronary/aorta.h"
#include "ostia/imaging/image_file.h"
#include "ostia/imaging/sampling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::coronary {
namespace {

TEST(AortaReal, TheAscendingOneOfADissectedAortaLiesInTheGivenMask) {
  OSTIA_REQUIRE_SHARED(ct, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  OSTIA_REQUIRE_SHARED(truth, "cta/totalsegmentator-aorta-cta/aorta.nii.gz");
  const Aorta aorta = find_aorta(imaging::read_image(ct).volume);
  const imaging::MaskVolume mask = imaging::read_mask(truth).volume;
  ASSERT_GT(aorta.stations.size(), 30U);
  std::size_t inside = 0;
  for (const AortaStation& station : aorta.stations)
    inside += imaging::sample(mask, station.centre) > 0.5 ? 1 : 0;
  EXPECT_EQ(inside, aorta.stations.size());
}

TEST(AortaReal, AHeartWithoutItsRootIsSaidToHaveNone) {
  OSTIA_REQUIRE_SHARED(ct, "cta/rider-pilot-chest-pe-cta/heart-crop.nrrd");
  try {
    find_aorta(imaging::read_image(ct).volume);
    FAIL() << "found one";
  } catch (const GeometryError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("descending"));
  }
}

}  // namespace
}  // namespace ostia::coronary
