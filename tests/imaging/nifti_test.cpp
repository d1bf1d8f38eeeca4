#include "image_files.h"
#include "shared_data.h"

#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>

namespace ostia::imaging {
namespace {
using namespace testing;

struct NiftiTest : ::testing::Test {
  fs::path here = ostia::testing::temporary_folder("nifti");
  fs::path path = here / "image.nii";
  std::vector<std::int16_t> voxels = counted(24);

  LoadedImage<std::int16_t> read(const Nifti& nifti) {
    write_bytes(path, nifti.file(voxels));
    return read_image(path);
  }
  std::string refused(const Nifti& nifti) {
    return refusal([&] { read(nifti); });
  }
  static void expect_plain(const Geometry& grid) {
    EXPECT_LT((grid.origin - Vec3(10, 20, 30)).norm(), 1e-6);
    EXPECT_LT((grid.spacing - Vec3(1, 2, 3)).norm(), 1e-6);
    EXPECT_LT((grid.direction - Mat3::Identity()).norm(), 1e-6);
  }
};

TEST_F(NiftiTest, EitherVersionEitherEndianPackedOrNot) {
  for (const int version : {1, 2})
    for (const bool big : {false, true}) {
      Nifti nifti;
      nifti.version = version;
      nifti.big = big;
      const auto image = read(nifti);
      EXPECT_EQ(image.volume.voxels, voxels);
      EXPECT_EQ(image.header.format, version == 1 ? "NIfTI-1" : "NIfTI-2");
      expect_plain(image.volume.geometry);
      write_bytes(here / "image.nii.gz", packed(nifti.file(voxels)));
      EXPECT_EQ(read_image(here / "image.nii.gz").volume.voxels, voxels);
    }
}

TEST_F(NiftiTest, PairsOfHeaderAndImage) {
  for (const int version : {1, 2}) {
    Nifti nifti;
    nifti.version = version;
    nifti.pair = true;
    nifti.vox_offset = 16;
    write_bytes(here / "pair.hdr", nifti.header());
    write_bytes(here / "pair.img", std::string(16, 'x') + bytes_of(voxels));
    EXPECT_EQ(read_image(here / "pair.hdr").volume.voxels, voxels);
    EXPECT_EQ(read_image(here / "pair.img").volume.voxels, voxels);
  }
}

TEST_F(NiftiTest, EveryScalarType) {
  const auto check = [&](auto zero, int code) {
    using T = decltype(zero);
    Nifti nifti;
    nifti.datatype = code;
    nifti.bitpix = 8 * static_cast<int>(sizeof(T));
    write_bytes(path, nifti.file(counted<T>(24)));
    EXPECT_EQ(read_image(path).volume.voxels, voxels) << code;
  };
  check(std::uint8_t{}, 2);
  check(std::int32_t{}, 8);
  check(float{}, 16);
  check(double{}, 64);
  check(std::int8_t{}, 256);
  check(std::uint16_t{}, 512);
  check(std::uint32_t{}, 768);
  check(std::int64_t{}, 1024);
  check(std::uint64_t{}, 1280);
}

TEST_F(NiftiTest, QformWithAndWithoutQfac) {
  Nifti nifti;
  nifti.sform_code = 0;
  nifti.qform_code = 1;  // quaternion (0, 0, 0, 1): half a turn about z, so that RAS becomes LPS
  expect_plain(read(nifti).volume.geometry);
  nifti.pixdim[0] = -1;  // the third axis the other way: left-handed
  const auto image = read(nifti);
  ASSERT_EQ(image.header.warnings.size(), 1U);
  EXPECT_EQ(image.header.warnings[0], "left-handed axes: k reversed");
  EXPECT_EQ(image.volume(1, 2, 1), count_at({4, 3, 2}, 1, 2, 0));
  EXPECT_LT((image.volume.geometry.world({0, 0, 1}) - Vec3(10, 20, 30)).norm(), 1e-6);
}

TEST_F(NiftiTest, QformOfAnObliqueQuaternion) {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.6, Vec3(1, -2, 0.5).normalized()));
  Nifti nifti;
  nifti.version = 2;
  nifti.sform_code = 0;
  nifti.qform_code = 1;
  nifti.quatern = {q.x(), q.y(), q.z()};
  const Geometry grid = read(nifti).volume.geometry;
  const Vec3 ras = q.toRotationMatrix() * Vec3(3 * 1, 2 * 2, 1 * 3) + Vec3(-10, -20, 30);
  EXPECT_LT((grid.world({3, 2, 1}) - Vec3(-ras[0], -ras[1], ras[2])).norm(), 1e-9);
}

TEST_F(NiftiTest, SformGoesBeforeQformAndADisagreementIsSaid) {
  Nifti nifti;
  nifti.qform_code = 1;
  EXPECT_TRUE(read(nifti).header.warnings.empty());
  nifti.qoffset = {0, 0, 0};
  const auto image = read(nifti);
  expect_plain(image.volume.geometry);
  ASSERT_EQ(image.header.warnings.size(), 1U);
  EXPECT_NE(image.header.warnings[0].find("disagree"), std::string::npos);
}

TEST_F(NiftiTest, WithoutEitherFormTheOrientationIsSaidToBeUnknown) {
  Nifti nifti;
  nifti.sform_code = 0;
  const auto image = read(nifti);
  EXPECT_EQ(image.volume.geometry.spacing, Vec3(1, 2, 3));
  ASSERT_FALSE(image.header.warnings.empty());
  EXPECT_NE(image.header.warnings[0].find("unknown"), std::string::npos);
}

TEST_F(NiftiTest, UnitsBecomeMillimetres) {
  Nifti nifti;
  nifti.units = 3;  // micrometres
  for (double& v : nifti.srow) v *= 1000;
  for (int i = 1; i <= 3; ++i) nifti.pixdim[static_cast<std::size_t>(i)] *= 1000;
  expect_plain(read(nifti).volume.geometry);
  nifti.units = 1;  // metres
  for (double& v : nifti.srow) v *= 1e-6;
  for (int i = 1; i <= 3; ++i) nifti.pixdim[static_cast<std::size_t>(i)] *= 1e-6;
  expect_plain(read(nifti).volume.geometry);
  nifti.units = 5;
  EXPECT_NE(refused(nifti).find("xyzt_units"), std::string::npos);
  nifti.units = 0;
  EXPECT_EQ(read(nifti).header.warnings.size(), 1U);
}

TEST_F(NiftiTest, SlopeOfZeroMeansNone) {
  Nifti nifti;
  nifti.intercept = 100;
  EXPECT_EQ(read(nifti).volume.voxels, voxels);
  nifti.slope = 2;
  EXPECT_EQ(read(nifti).volume.voxels[3], 106);
  nifti.slope = std::nan("");
  const auto image = read(nifti);
  EXPECT_EQ(image.volume.voxels, voxels);
  EXPECT_EQ(image.header.warnings.size(), 1U);
}

TEST_F(NiftiTest, RefusalsNameTheField) {
  const auto changed_by = [&](const auto& change) {
    Nifti nifti;
    change(nifti);
    return refused(nifti);
  };
  EXPECT_NE(changed_by([](Nifti& n) { n.datatype = 128; }).find("image.nii: datatype"), std::string::npos);
  EXPECT_NE(changed_by([](Nifti& n) { n.bitpix = 8; }).find("image.nii: bitpix"), std::string::npos);
  EXPECT_NE(changed_by([](Nifti& n) { n.dim[0] = 2; }).find("image.nii: dim[0]"), std::string::npos);
  EXPECT_NE(changed_by([](Nifti& n) { n.dim[0] = 4, n.dim[4] = 3; }).find("image.nii: dim[4]"),
            std::string::npos);
  EXPECT_NE(changed_by([](Nifti& n) { n.vox_offset = 100; }).find("image.nii: vox_offset"),
            std::string::npos);
  EXPECT_NE(changed_by([](Nifti& n) {
              n.sform_code = 0, n.qform_code = 1, n.quatern = {1, 1, 1};
            }).find("quatern"),
            std::string::npos);
  EXPECT_NE(changed_by([](Nifti& n) { n.srow[0] = std::nan(""); }).find("srow"), std::string::npos);
}

TEST_F(NiftiTest, PackedPairsAreRefused) {
  Nifti nifti;
  nifti.pair = true;
  write_bytes(here / "pair.hdr", packed(nifti.header()));
  write_bytes(here / "pair.img", packed(bytes_of(voxels)));
  EXPECT_NE(refusal([&] { read_image(here / "pair.hdr"); }).find("pairs"), std::string::npos);
}

}  // namespace
}  // namespace ostia::imaging
