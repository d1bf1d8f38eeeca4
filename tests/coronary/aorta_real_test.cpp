#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/coronary/aorta.h"
#include "ostia/coronary/aorta_mask.h"
#include "ostia/imaging/image_file.h"
#include "ostia/imaging/sampling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

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

/// Planes of the annulus and of the end of the arch ("proximal desc. aorta"), as the data set's report has
/// them: the ends of two diameters across each other, here in LPS.
struct Landmark {
  Vec3 centre, normal;  ///< away from the heart
};
Landmark landmark(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& ahead) {
  Vec3 normal = (b - a).cross(d - c).normalized();
  if (normal.dot(ahead) < 0.0) normal = -normal;
  return {0.25 * (a + b + c + d), normal};
}

TEST(AortaReal, TheMaskOfAscendingAortaAndArchAgreesWithTheGivenTrueLumen) {
  OSTIA_REQUIRE_SHARED(ct, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  OSTIA_REQUIRE_SHARED(given, "cta/totalsegmentator-aorta-cta/aorta_true_lumen.nii.gz");
  const Landmark annulus =
      landmark({25.1193, -181.9884, 668.8093}, {2.4558, -183.6815, 653.3386}, {16.1809, -195.6315, 658.3684},
               {9.6823, -173.6885, 661.433}, Vec3::UnitZ());
  const Landmark arch_end =
      landmark({28.4802, -160.8914, 758.47}, {8.7596, -152.2023, 733.383}, {27.9183, -154.179, 732.8937},
               {6.3573, -156.8534, 752.2837}, Vec3::UnitY());
  const imaging::ImageVolume image = imaging::read_image(ct).volume;
  const imaging::MaskVolume truth = imaging::read_mask(given).volume;
  const Aorta aorta = find_aorta(image);
  const imaging::MaskVolume mask = aorta_mask(image, aorta);
  ASSERT_TRUE(imaging::same_grid(mask.geometry, truth.geometry));
  double both = 0.0, found = 0.0, asked = 0.0;
  const imaging::Geometry& grid = truth.geometry;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        const Vec3 at =
            grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        if ((at - annulus.centre).dot(annulus.normal) < 0.0 ||
            (at - arch_end.centre).dot(arch_end.normal) > 0.0)
          continue;
        const bool t = truth(i, j, k) != 0, m = mask(i, j, k) != 0;
        both += t && m ? 1.0 : 0.0;
        found += m ? 1.0 : 0.0;
        asked += t ? 1.0 : 0.0;
      }
  const double dice = 2.0 * both / (found + asked), ml = grid.spacing.prod() / 1000.0;
  std::printf("ascending aorta and arch: Dice %.3f; given %.1f ml, found %.1f ml\n", dice, ml * asked,
              ml * found);
  EXPECT_NEAR(ml * asked, 62.2, 8.0) << "the report has 43.5 ml and 18.7 ml";
  EXPECT_GE(dice, 0.93);
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
