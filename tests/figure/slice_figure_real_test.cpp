#include "shared_data.h"

#include "ostia/figure/slice_figure.h"
#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::figure {
namespace {

TEST(SliceFigureReal, TheHeartOfACtAngiogramIsLegibleAtTheDefaults) {
  OSTIA_REQUIRE_SHARED(path, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  const auto volume = imaging::read_image(path).volume;
  const auto& grid = volume.geometry;
  const Vec3 middle = grid.world(0.5 * Vec3(grid.size[0] - 1.0, grid.size[1] - 1.0, grid.size[2] - 1.0));
  const reformat::Plane plane = reformat::axial_plane(grid, middle);
  const Raster grey = grey_raster(reformat::slice(volume, plane), 250.0, 900.0);
  std::size_t black = 0;
  std::size_t white = 0;
  for (std::size_t i = 0; i < grey.rgba.size(); i += 4) {
    black += grey.rgba[i] == 0;
    white += grey.rgba[i] == 255;
  }
  const double pixels = static_cast<double>(grey.rgba.size()) / 4.0;
  // Lung is black, bone and dense contrast white; most of the mediastinum lies between.
  EXPECT_LT(static_cast<double>(white) / pixels, 0.10);
  EXPECT_LT(static_cast<double>(black) / pixels, 0.70);
  EXPECT_GT(static_cast<double>(black) / pixels, 0.10);
  const Picture picture = three_planes(volume, middle, {});
  EXPECT_GT(picture.png().size(), 100000U);
}

}  // namespace
}  // namespace ostia::figure
