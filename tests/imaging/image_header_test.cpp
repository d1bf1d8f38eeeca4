#include "image_files.h"
#include "image_source.h"
#include "shared_data.h"

#include "ostia/core/text.h"
#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>

namespace ostia::imaging {
namespace {
using namespace testing;

fs::path folder() {
  return ostia::testing::temporary_folder("header");
}

TEST(ReadImageHeader, SaysTheSameOfTheSameImageInAnyFormat) {
  const fs::path here = folder();
  const auto voxels = counted(24);
  write_bytes(here / "a.nrrd", nrrd_header() + bytes_of(voxels));
  write_bytes(here / "a.mhd", meta_header());
  write_bytes(here / "image.raw", bytes_of(voxels));
  write_bytes(here / "a.nii", Nifti{}.file(voxels));
  const std::pair<const char*, const char*> files[] = {
      {"a.nrrd", "NRRD"}, {"a.mhd", "MetaImage"}, {"a.nii", "NIfTI-1"}};
  for (const auto& [name, format] : files) {
    const ImageHeader header = read_image_header(here / name);
    EXPECT_EQ(header.format, format);
    EXPECT_EQ(header.geometry.size, (std::array<std::int64_t, 3>{4, 3, 2})) << name;
    EXPECT_EQ(header.geometry.spacing, Vec3(1, 2, 3)) << name;
    EXPECT_EQ(header.geometry.origin, Vec3(10, 20, 30)) << name;
    EXPECT_EQ(header.geometry.direction, Mat3(Mat3::Identity())) << name;
    EXPECT_EQ(header.pixel_type, PixelType::int16) << name;
    EXPECT_TRUE(header.warnings.empty())
        << name << ": " << (header.warnings.empty() ? "" : header.warnings[0]);
  }
}

TEST(ReadImageHeader, GoesByContentNotByExtension) {
  const fs::path here = folder();
  write_bytes(here / "a.dat", nrrd_header() + bytes_of(counted(24)));
  EXPECT_EQ(read_image_header(here / "a.dat").format, "NRRD");
  write_bytes(here / "b.nrrd", packed(Nifti{}.file(counted(24))));
  EXPECT_EQ(read_image_header(here / "b.nrrd").format, "NIfTI-1");
}

TEST(ReadImageHeader, MissingFileAndFolderAreIoErrors) {
  const fs::path here = folder();
  EXPECT_THROW(read_image_header(here / "none.nrrd"), IoError);
  EXPECT_THROW(read_image_header(here), IoError);
}

TEST(ReadImageHeader, UnknownFormatsAndDicomAreToldApart) {
  const fs::path here = folder();
  write_bytes(here / "a.txt", "hello, world");
  EXPECT_NE(refusal([&] { read_image_header(here / "a.txt"); }).find("a.txt: format: neither NRRD"),
            std::string::npos);
  std::string dicom(200, '\0');
  dicom.replace(128, 4, "DICM");
  write_bytes(here / "a.dcm", dicom);
  EXPECT_NE(refusal([&] { read_image_header(here / "a.dcm"); }).find("DICOM"), std::string::npos);
}

TEST(HeaderNumbers, AreWholeTextsOrNothing) {
  EXPECT_EQ(to_double("1.5"), 1.5);
  EXPECT_EQ(to_double("+1.5e2"), 150.0);
  EXPECT_TRUE(std::isnan(*to_double("nan")));
  for (const char* bad : {"", "1,5", "1.5x", "+-1", "0x", " 1"}) EXPECT_FALSE(to_double(bad)) << bad;
  EXPECT_EQ(to_integer("-12"), -12);
  for (const char* bad : {"", "1.5", "99999999999999999999"}) EXPECT_FALSE(to_integer(bad)) << bad;
}

TEST(HeaderNumbers, ShortestTextReadsBackAsTheSameBits) {
  for (const double value : {0.1, 1.0 / 3.0, -1e-300, 675.2, 1e22})
    EXPECT_EQ(to_double(core::shortest_text(value)), value);
}

}  // namespace
}  // namespace ostia::imaging
