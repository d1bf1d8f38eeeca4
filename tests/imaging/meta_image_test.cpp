#include "image_files.h"
#include "shared_data.h"

#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>

namespace ostia::imaging {
namespace {
using namespace testing;
using Changes = std::map<std::string, std::string>;

struct MetaImageTest : ::testing::Test {
  fs::path here = ostia::testing::temporary_folder("meta");
  std::vector<std::int16_t> voxels = counted(24);

  LoadedImage<std::int16_t> read(const Changes& changes, const std::string& data) {
    write_bytes(here / "image.mhd", meta_header(changes));
    write_bytes(here / "image.raw", data);
    return read_image(here / "image.mhd");
  }
  std::string refused(const Changes& changes) {
    return refusal([&] { read(changes, bytes_of(voxels)); });
  }
};

TEST_F(MetaImageTest, RawInItsOwnFileEitherEndian) {
  EXPECT_EQ(read({}, bytes_of(voxels)).volume.voxels, voxels);
  EXPECT_EQ(read({{"BinaryDataByteOrderMSB", "True"}}, bytes_of(voxels, true)).volume.voxels, voxels);
  EXPECT_EQ(read({{"BinaryDataByteOrderMSB", ""}, {"ElementByteOrderMSB", "True"}}, bytes_of(voxels, true))
                .volume.voxels,
            voxels);
}

TEST_F(MetaImageTest, DataAfterTheHeader) {
  const fs::path path = here / "image.mha";
  write_bytes(path, meta_header({{"ElementDataFile", "LOCAL"}}) + bytes_of(voxels));
  EXPECT_EQ(read_image(path).volume.voxels, voxels);
  write_bytes(path, meta_header({{"ElementDataFile", "LOCAL"}, {"CompressedData", "True"}}) +
                        packed(bytes_of(voxels), false));
  EXPECT_EQ(read_image(path).volume.voxels, voxels);
}

TEST_F(MetaImageTest, CompressedAndTextData) {
  EXPECT_EQ(read({{"CompressedData", "True"}, {"CompressedDataSize", "99"}}, packed(bytes_of(voxels), false))
                .volume.voxels,
            voxels);
  std::string text;
  for (const std::int16_t v : voxels) text += std::to_string(v) + " ";
  EXPECT_EQ(read({{"BinaryData", "False"}}, text).volume.voxels, voxels);
}

TEST_F(MetaImageTest, HeaderSizeSkipsBytes) {
  EXPECT_EQ(read({{"HeaderSize", "7"}}, "1234567" + bytes_of(voxels)).volume.voxels, voxels);
  EXPECT_EQ(read({{"HeaderSize", "-1"}}, "1234567" + bytes_of(voxels)).volume.voxels, voxels);
}

TEST_F(MetaImageTest, EveryElementType) {
  const auto check = [&](auto zero, const char* name) {
    EXPECT_EQ(read({{"ElementType", name}}, bytes_of(counted<decltype(zero)>(24))).volume.voxels, voxels)
        << name;
  };
  check(std::int8_t{}, "MET_CHAR");
  check(std::uint8_t{}, "MET_UCHAR");
  check(std::uint16_t{}, "MET_USHORT");
  check(std::int32_t{}, "MET_INT");
  check(std::uint32_t{}, "MET_UINT");
  check(std::int32_t{}, "MET_LONG");
  check(std::int64_t{}, "MET_LONG_LONG");
  check(std::uint64_t{}, "MET_ULONG_LONG");
  check(float{}, "MET_FLOAT");
  check(double{}, "MET_DOUBLE");
}

TEST_F(MetaImageTest, EachRowOfTheMatrixIsOneAxis) {
  // Axis i points to +y, axis j to -x.
  const auto image = read({{"TransformMatrix", "0 1 0 -1 0 0 0 0 1"}}, bytes_of(voxels));
  EXPECT_LT((image.volume.geometry.world({1, 0, 0}) - Vec3(10, 21, 30)).norm(), 1e-12);
  EXPECT_LT((image.volume.geometry.world({0, 1, 0}) - Vec3(8, 20, 30)).norm(), 1e-12);
  EXPECT_TRUE(image.header.warnings.empty());
  for (const char* name : {"Rotation", "Orientation"})
    EXPECT_EQ(read({{"TransformMatrix", ""}, {name, "0 1 0 -1 0 0 0 0 1"}}, bytes_of(voxels))
                  .volume.geometry.direction,
              image.volume.geometry.direction);
}

TEST_F(MetaImageTest, OriginUnderAnyOfItsNames) {
  for (const char* name : {"Position", "Origin"})
    EXPECT_EQ(read({{"Offset", ""}, {name, "1 2 3"}}, bytes_of(voxels)).volume.geometry.origin,
              Vec3(1, 2, 3));
  const auto without = read({{"Offset", ""}}, bytes_of(voxels));
  EXPECT_EQ(without.volume.geometry.origin, Vec3(0, 0, 0));
  EXPECT_EQ(without.header.warnings.size(), 1U);
}

TEST_F(MetaImageTest, IntensityFunctionGivesTheValues) {
  const auto image =
      read({{"ElementToIntensityFunctionSlope", "2"}, {"ElementToIntensityFunctionOffset", "-1024"}},
           bytes_of(voxels));
  EXPECT_EQ(image.volume.voxels[5], -1014);
}

TEST_F(MetaImageTest, RefusalsNameTheField) {
  const std::pair<Changes, const char*> cases[] = {
      {{{"ObjectType", "Mesh"}}, "ObjectType"},
      {{{"NDims", "2"}}, "NDims"},
      {{{"NDims", "4"}, {"DimSize", "4 3 2 5"}}, "DimSize"},
      {{{"ElementType", "MET_STRING"}}, "ElementType"},
      {{{"ElementNumberOfChannels", "3"}}, "ElementNumberOfChannels"},
      {{{"ElementSpacing", ""}}, "ElementSpacing"},
      {{{"ElementSpacing", "0,5 1 1"}}, "ElementSpacing"},
      {{{"TransformMatrix", "1 0 0 0 1 0 0 0 0"}}, "TransformMatrix"},
      {{{"DistanceUnits", "inch"}}, "DistanceUnits"},
      {{{"CompressedData", "perhaps"}}, "CompressedData"},
      {{{"ElementDataFile", "LIST"}}, "ElementDataFile"},
      {{{"ElementDataFile", "slice%03d.raw 1 3 1"}}, "ElementDataFile"},
      {{{"ElementDataFile", "none.raw"}}, "ElementDataFile"},
      {{{"ElementDataFile", ""}}, "ElementDataFile"},
      {{{"HeaderSize", "-3"}}, "HeaderSize"},
  };
  for (const auto& [changes, field] : cases) {
    const std::string message = refused(changes);
    EXPECT_NE(message.find(std::string("image.mhd: ") + field), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace ostia::imaging
