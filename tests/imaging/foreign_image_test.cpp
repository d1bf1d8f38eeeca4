// Images that ITK reads in the worker, written byte by byte.

#include "ostia/imaging/foreign_image.h"

#include "image_files.h"
#include "shared_data.h"

#include "ostia/imaging/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace ostia::imaging::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::vector<std::int16_t> foreign_values() {
  std::vector<std::int16_t> values(24);  // 4 x 3 x 2
  std::iota(values.begin(), values.end(), std::int16_t{-5});
  return values;
}

fs::path foreign_folder() {
  return ostia::testing::temporary_folder("foreign");
}

std::string foreign_refusal(const fs::path& file) {
  try {
    read_image(file);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

/// The Guy's Image Processing Lab's format: a header of 256 bytes, all big-endian.
std::string gipl_bytes(const std::vector<std::int16_t>& values, std::uint16_t type = 15) {
  const auto words = [](std::initializer_list<std::uint16_t> list) {
    return bytes_of(std::vector<std::uint16_t>(list), true);
  };
  std::string head = words({4, 3, 2, 1, type});  // sizes, type of the voxels (15: short)
  head += bytes_of(std::vector<float>{0.5F, 0.75F, 1.5F, 1.0F}, true);  // mm
  head.resize(204, '\0');
  head += bytes_of(std::vector<double>{10.0, 20.0, 30.0, 0.0}, true);  // origin
  head.resize(252, '\0');
  head += bytes_of(std::vector<std::uint32_t>{4026526128U}, true);
  return head + bytes_of(values, true);
}

TEST(ForeignImage, GiplIsReadInFull) {
  const fs::path file = foreign_folder() / "scan.gipl";
  write_bytes(file, gipl_bytes(foreign_values()));
  EXPECT_EQ(foreign_image_format(file), "GIPL");
  const auto loaded = read_image(file);
  EXPECT_EQ(loaded.header.format, "GIPL");
  EXPECT_EQ(loaded.volume.geometry.size, (std::array<std::int64_t, 3>{4, 3, 2}));
  EXPECT_EQ(loaded.volume.geometry.spacing, Vec3(0.5, 0.75, 1.5));
  EXPECT_EQ(loaded.volume.geometry.origin, Vec3(10, 20, 30));
  EXPECT_EQ(loaded.volume.voxels, foreign_values());
  ASSERT_EQ(loaded.header.warnings.size(), 1u);
  EXPECT_THAT(loaded.header.warnings[0], HasSubstr("does not say how its axes run"));
}

TEST(ForeignImage, VtkStructuredPointsAreRead) {
  const fs::path file = foreign_folder() / "scan.vtk";
  std::string text =
      "# vtk DataFile Version 3.0\nan image\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 4 3 2\n"
      "SPACING 0.5 0.75 1.5\nORIGIN 10 20 30\nPOINT_DATA 24\nSCALARS values short 1\nLOOKUP_TABLE default\n";
  for (const std::int16_t v : foreign_values()) text += std::to_string(v) + " ";
  write_bytes(file, text + "\n");
  const auto loaded = read_image(file);
  EXPECT_EQ(loaded.header.format, "VTK image");
  EXPECT_EQ(loaded.volume.geometry.spacing, Vec3(0.5, 0.75, 1.5));
  EXPECT_EQ(loaded.volume.geometry.origin, Vec3(10, 20, 30));
  EXPECT_EQ(loaded.volume.voxels, foreign_values());
  EXPECT_EQ(read_float_image(file).volume.voxels.back(), 18.0F);
}

/// Pages of 4 x 3 pixels, one strip each, uncompressed.
std::string tiff_bytes(const std::vector<std::uint16_t>& values, std::size_t pages,
                       std::uint16_t samples = 1) {
  std::string file("II*\0", 4);
  file += bytes_of(std::vector<std::uint32_t>{8});
  for (std::size_t p = 0; p < pages; ++p) {
    const auto tag = [&](std::uint16_t id, std::uint16_t type, std::uint32_t value) {
      return bytes_of(std::vector<std::uint16_t>{id, type}) + bytes_of(std::vector<std::uint32_t>{1, value});
    };
    const auto at = static_cast<std::uint32_t>(file.size());
    constexpr std::uint32_t directory = 2 + 10 * 12 + 4, strip = 4 * 3 * 2;
    const std::uint32_t bytes = strip * samples, data = at + directory;
    file += bytes_of(std::vector<std::uint16_t>{10});
    file += tag(256, 4, 4) + tag(257, 4, 3) + tag(258, 3, 16) + tag(259, 3, 1) +
            tag(262, 3, samples == 1 ? 1 : 2) + tag(273, 4, data) + tag(277, 3, samples) + tag(278, 4, 3) +
            tag(279, 4, bytes) + tag(284, 3, 1);
    file += bytes_of(std::vector<std::uint32_t>{p + 1 == pages ? 0U : data + bytes});
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(p * 12 * samples);
    file += bytes_of(std::vector<std::uint16_t>(first, first + 12 * samples));
  }
  return file;
}

TEST(ForeignImage, ATiffStackIsAVolumeAndItsSpacingIsDoubted) {
  std::vector<std::uint16_t> values(24);
  std::iota(values.begin(), values.end(), std::uint16_t{100});
  const fs::path file = foreign_folder() / "stack.tif";
  write_bytes(file, tiff_bytes(values, 2));
  const auto loaded = read_image(file);
  EXPECT_EQ(loaded.header.format, "TIFF");
  EXPECT_EQ(loaded.volume.geometry.size, (std::array<std::int64_t, 3>{4, 3, 2}));
  EXPECT_EQ(loaded.volume.voxels, std::vector<std::int16_t>(values.begin(), values.end()));
  EXPECT_THAT(loaded.header.warnings.at(0), HasSubstr("does not say how far apart its slices are"));
}

TEST(ForeignImage, WhatIsNoImageOfOneValueAVoxelIsRefused) {
  const fs::path folder = foreign_folder();
  write_bytes(folder / "colours.tif", tiff_bytes(std::vector<std::uint16_t>(36, 7), 1, 3));
  EXPECT_THAT(foreign_refusal(folder / "colours.tif"),
              HasSubstr("colours.tif: format: cannot read this TIFF file"));
  write_bytes(folder / "type.gipl", gipl_bytes(foreign_values(), 999));
  EXPECT_THAT(foreign_refusal(folder / "type.gipl"), HasSubstr("type.gipl: "));
  write_bytes(
      folder / "huge.vtk",
      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 90000 90000 90000\n"
      "SPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA 729000000000000\nSCALARS v short 1\nLOOKUP_TABLE "
      "default\n1\n");
  EXPECT_THAT(foreign_refusal(folder / "huge.vtk"), HasSubstr("more than 2147483648 voxels"));
  write_bytes(folder / "flat.vtk",
              "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 1 1\n"
              "SPACING 0 1 1\nORIGIN 0 0 0\nPOINT_DATA 2\nSCALARS v short 1\nLOOKUP_TABLE default\n1 2\n");
  EXPECT_THAT(foreign_refusal(folder / "flat.vtk"), HasSubstr("flat.vtk: "));
}

/// Analyze 7.5: a header of 348 bytes and the voxels in a file of their own.
void write_analyze(const fs::path& folder, const std::string& voxels) {
  std::string head(348, '\0');
  const auto put = [&](std::size_t at, const std::string& bytes) { head.replace(at, bytes.size(), bytes); };
  put(0, bytes_of(std::vector<std::int32_t>{348}));
  put(38, "r");
  put(40, bytes_of(std::vector<std::int16_t>{3, 4, 3, 2, 1}));
  put(70, bytes_of(std::vector<std::int16_t>{4, 16}));
  put(76, bytes_of(std::vector<float>{0.0F, 0.5F, 0.75F, 1.5F}));
  write_bytes(folder / "scan.hdr", head);
  write_bytes(folder / "scan.img", voxels);
}

TEST(ForeignImage, AnalyzeIsReadByEitherOfItsFiles) {
  const fs::path folder = foreign_folder();
  write_analyze(folder, bytes_of(foreign_values()));
  for (const char* name : {"scan.hdr", "scan.img"}) {
    EXPECT_EQ(foreign_image_format(folder / name), "Analyze") << name;
    const auto loaded = read_image(folder / name);
    EXPECT_EQ(loaded.volume.geometry.size, (std::array<std::int64_t, 3>{4, 3, 2})) << name;
    EXPECT_EQ(loaded.volume.voxels, foreign_values()) << name;
    EXPECT_THAT(loaded.header.warnings.at(0), HasSubstr("which side is left")) << name;
  }
}

TEST(ForeignImage, WhatIsCutShortIsRefusedAndNotFilled) {
  const fs::path folder = foreign_folder();
  const auto expect_cut = [&](const char* name, const std::string& said) {
    EXPECT_THAT(foreign_refusal(folder / name), AllOf(HasSubstr(said), HasSubstr("it is cut short"))) << name;
  };
  write_bytes(folder / "cut.gipl", gipl_bytes(foreign_values()).substr(0, 280));
  expect_cut("cut.gipl", "24 of 48 bytes");
  write_analyze(folder, bytes_of(foreign_values()).substr(0, 30));
  expect_cut("scan.hdr", "30 of 48 bytes");
  write_bytes(
      folder / "cut.vtk",
      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 4 3 2\nSPACING 1 1 1\n"
      "ORIGIN 0 0 0\nPOINT_DATA 24\nSCALARS v short 1\nLOOKUP_TABLE default\n1 2 3\n");
  expect_cut("cut.vtk", "3 of 24 values");
  const std::string stack = tiff_bytes(std::vector<std::uint16_t>(24, 7), 2);
  write_bytes(folder / "cut.tif", stack.substr(0, stack.size() - 5));
  expect_cut("cut.tif", "bytes are there");
}

TEST(ForeignImage, FilesOfOtherKindsAreNone) {
  const fs::path folder = foreign_folder();
  write_bytes(folder / "a.txt", "hello");
  std::string both("II*\0", 4);
  both.resize(128, '\0');
  write_bytes(folder / "both.dcm", both + "DICM" + std::string(100, '\0'));
  write_bytes(folder / "mesh.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n");
  for (const char* name : {"a.txt", "both.dcm", "mesh.vtk", "missing.gipl"})
    EXPECT_EQ(foreign_image_format(folder / name), "") << name;
  EXPECT_EQ(foreign_image_format(folder), "");
}

}  // namespace
}  // namespace ostia::imaging::testing
