#include "shared_data.h"

#include "ostia/imaging/dicom.h"
#include "ostia/imaging/dicom_writer.h"

#include <gtest/gtest.h>

namespace ostia::imaging {
namespace {

/// Values in [lowest, lowest + range).
ImageVolume oblique_image(int lowest, int range) {
  ImageVolume image;
  image.geometry.size = {33, 27, 12};
  image.geometry.spacing = Vec3(0.35, 0.41, 0.45);
  image.geometry.origin = Vec3(-123.456789, 87.654321, -1010.123);
  image.geometry.direction = Eigen::AngleAxisd(-1.1, Vec3(0.3, 0.9, 0.2).normalized()).toRotationMatrix();
  for (std::int64_t n = 0; n < image.geometry.voxels(); ++n)
    image.voxels.push_back(static_cast<std::int16_t>(lowest + (n * 104729) % range));
  return image;
}

TEST(DicomRoundTrip, VoxelsComeBackBitForBitOnTheSameGrid) {
  for (const auto& [lowest, range] : {std::pair{-1024, 4096}, std::pair{-32768, 65536}}) {
    const ImageVolume image = oblique_image(lowest, range);
    const auto folder = ostia::testing::temporary_folder("dicom") / "series";
    write_dicom_series(folder, image);
    const auto back = read_dicom(folder);
    EXPECT_EQ(back.volume.voxels, image.voxels) << lowest;
    EXPECT_TRUE(same_grid(back.volume.geometry, image.geometry, 1e-6)) << lowest;
    EXPECT_TRUE(back.header.warnings.empty()) << lowest;
  }
}

}  // namespace
}  // namespace ostia::imaging
