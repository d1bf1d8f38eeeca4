#include "image_files.h"
#include "shared_data.h"

#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>

namespace ostia::imaging {
namespace {
using namespace testing;
using NrrdChanges = std::map<std::string, std::string>;

struct NrrdTest : ::testing::Test {
  fs::path here = ostia::testing::temporary_folder("nrrd");
  fs::path path = here / "image.nrrd";
  std::vector<std::int16_t> voxels = counted(24);

  LoadedImage<std::int16_t> read(const NrrdChanges& changes, const std::string& data) {
    write_bytes(path, nrrd_header(changes) + data);
    return read_image(path);
  }
  std::string refused(const NrrdChanges& changes) {
    write_bytes(path, nrrd_header(changes) + bytes_of(voxels));
    return refusal([&] { read_image(path); });
  }
};

TEST_F(NrrdTest, RawLittleAndBigEndian) {
  EXPECT_EQ(read({}, bytes_of(voxels)).volume.voxels, voxels);
  EXPECT_EQ(read({{"endian", "big"}}, bytes_of(voxels, true)).volume.voxels, voxels);
}

TEST_F(NrrdTest, GzipAndText) {
  EXPECT_EQ(read({{"encoding", "gzip"}}, packed(bytes_of(voxels))).volume.voxels, voxels);
  std::string text;
  for (const std::int16_t v : voxels) text += std::to_string(v) + (v % 5 ? " " : "\n");
  EXPECT_EQ(read({{"encoding", "ascii"}, {"endian", ""}}, text).volume.voxels, voxels);
}

TEST_F(NrrdTest, EveryScalarType) {
  const auto check = [&](auto zero, const std::vector<std::string>& names) {
    using T = decltype(zero);
    for (const std::string& name : names)
      EXPECT_EQ(read({{"type", name}, {"endian", "big"}}, bytes_of(counted<T>(24), true)).volume.voxels,
                voxels)
          << name;
  };
  check(std::int8_t{}, {"signed char", "int8"});
  check(std::uint8_t{}, {"uchar", "unsigned char", "uint8_t"});
  check(std::int16_t{}, {"short", "signed short int"});
  check(std::uint16_t{}, {"ushort", "unsigned short"});
  check(std::int32_t{}, {"int", "int32"});
  check(std::uint32_t{}, {"uint", "unsigned int"});
  check(std::int64_t{}, {"longlong", "long long int"});
  check(std::uint64_t{}, {"ulonglong", "uint64"});
  check(float{}, {"float"});
  check(double{}, {"double"});
}

TEST_F(NrrdTest, SpacesBecomeLps) {
  const NrrdChanges turned = {{"space directions", "(-1,0,0) (0,-2,0) (0,0,3)"},
                              {"space origin", "(-10,-20,30)"}};
  for (const char* space : {"right-anterior-superior", "RAS"}) {
    NrrdChanges changes = turned;
    changes["space"] = space;
    const auto image = read(changes, bytes_of(voxels));
    EXPECT_EQ(image.volume.geometry.origin, Vec3(10, 20, 30));
    EXPECT_EQ(image.volume.geometry.direction, Mat3(Mat3::Identity()));
  }
  const auto las = read({{"space", "left-anterior-superior"},
                         {"space directions", "(1,0,0) (0,-2,0) (0,0,3)"},
                         {"space origin", "(10,-20,30)"}},
                        bytes_of(voxels));
  EXPECT_EQ(las.volume.geometry.origin, Vec3(10, 20, 30));
  EXPECT_EQ(las.volume.geometry.direction, Mat3(Mat3::Identity()));
  EXPECT_TRUE(las.header.warnings.empty());
}

TEST_F(NrrdTest, SpacingsWithoutDirectionsAndOriginAreSaidSo) {
  const auto image =
      read({{"space", ""}, {"space directions", ""}, {"space origin", ""}, {"spacings", "1 2 3"}},
           bytes_of(voxels));
  EXPECT_EQ(image.volume.geometry.spacing, Vec3(1, 2, 3));
  EXPECT_EQ(image.header.warnings.size(), 2U);
}

TEST_F(NrrdTest, UnitsBecomeMillimetres) {
  const auto image = read(
      {{"space units", "\"um\" \"um\" \"um\""}, {"space directions", "(1000,0,0) (0,2000,0) (0,0,3000)"}},
      bytes_of(voxels));
  EXPECT_LT((image.volume.geometry.spacing - Vec3(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((image.volume.geometry.origin - Vec3(0.01, 0.02, 0.03)).norm(), 1e-12);
  EXPECT_NE(refused({{"space units", "\"parsec\" \"parsec\" \"parsec\""}}).find("space units"),
            std::string::npos);
}

TEST_F(NrrdTest, DetachedDataInTheSameFolder) {
  write_bytes(here / "image data.raw", bytes_of(voxels));
  write_bytes(here / "image.nhdr", nrrd_header({{"data file", "image data.raw"}}));
  EXPECT_EQ(read_image(here / "image.nhdr").volume.voxels, voxels);
  write_bytes(here / "image.nhdr", nrrd_header({{"data file", "./image data.raw"}}));
  EXPECT_EQ(read_image(here / "image.nhdr").volume.voxels, voxels);
}

TEST_F(NrrdTest, SkipsLinesAndBytes) {
  const std::string junk = "one\ntwo\nABC";
  EXPECT_EQ(read({{"line skip", "2"}, {"byte skip", "3"}}, junk + bytes_of(voxels)).volume.voxels, voxels);
  EXPECT_EQ(read({{"byte skip", "-1"}}, junk + bytes_of(voxels)).volume.voxels, voxels);
  EXPECT_EQ(read({{"encoding", "gzip"}, {"byte skip", "3"}}, packed("ABC" + bytes_of(voxels))).volume.voxels,
            voxels);
}

TEST_F(NrrdTest, AFourthAxisOfOneSampleIsTolerated) {
  const auto image = read({{"dimension", "4"},
                           {"sizes", "1 4 3 2"},
                           {"space directions", "none (1,0,0) (0,2,0) (0,0,3)"},
                           {"kinds", "vector domain domain domain"}},
                          bytes_of(voxels));
  EXPECT_EQ(image.volume.geometry.size, (std::array<std::int64_t, 3>{4, 3, 2}));
  EXPECT_EQ(image.volume.voxels, voxels);
  EXPECT_NE(
      refused(
          {{"dimension", "4"}, {"sizes", "3 4 3 2"}, {"space directions", "none (1,0,0) (0,2,0) (0,0,3)"}})
          .find("space directions"),
      std::string::npos);
}

TEST_F(NrrdTest, LineEndsOfWindowsAreRead) {
  std::string header = nrrd_header();
  for (std::size_t at = 0; (at = header.find('\n', at)) != std::string::npos; at += 2)
    header.insert(at, "\r");
  write_bytes(path, header + bytes_of(voxels));
  EXPECT_EQ(read_image(path).volume.voxels, voxels);
}

TEST_F(NrrdTest, RefusalsNameTheField) {
  const std::pair<NrrdChanges, const char*> cases[] = {
      {{{"dimension", "2"}}, "dimension"},
      {{{"type", "block"}}, "type"},
      {{{"type", ""}}, "type"},
      {{{"sizes", "4 3"}}, "sizes"},
      {{{"sizes", "4 3 x"}}, "sizes"},
      {{{"encoding", "bzip2"}}, "encoding"},
      {{{"endian", ""}}, "endian"},
      {{{"space", "3D-left-handed"}}, "space"},
      {{{"space directions", "(1,0,0) (0,2,0)"}}, "space directions"},
      {{{"space directions", "(1,0,0) (0,2,0) (0,0)"}}, "space directions"},
      {{{"space directions", "(1,0,0) (0,2,0) (0,0,3"}}, "space directions"},
      {{{"space directions", "(1,0,0) (0,2,0) none"}}, "space directions"},
      {{{"space directions", ""}}, "spacings"},
      {{{"kinds", "domain domain RGB-color"}}, "kinds"},
      {{{"byte skip", "-2"}}, "byte skip"},
      {{{"data file", "LIST"}}, "data file"},
      {{{"data file", "im%03d.raw 1 9 1"}}, "data file"},
  };
  for (const auto& [changes, field] : cases) {
    const std::string message = refused(changes);
    EXPECT_NE(message.find(std::string("image.nrrd: ") + field), std::string::npos) << message;
  }
  write_bytes(path, "NRRD0004\ntype: short\ntype: int\n\n");
  EXPECT_NE(refusal([&] { read_image(path); }).find("type: given twice"), std::string::npos);
  write_bytes(path, "NRRD0099\ntype: short\n\n");
  EXPECT_NE(refusal([&] { read_image(path); }).find("magic"), std::string::npos);
}

}  // namespace
}  // namespace ostia::imaging
