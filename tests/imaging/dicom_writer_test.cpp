#include "ostia/imaging/dicom_writer.h"

#include "image_files.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/imaging/dicom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

namespace ostia::imaging {
namespace {

namespace fs = std::filesystem;

ImageVolume oblique_image(std::int16_t lowest = -1024) {
  ImageVolume image;
  image.geometry.size = {7, 6, 5};
  image.geometry.spacing = Vec3(0.351, 0.4497, 0.625);
  image.geometry.origin = Vec3(-123.456789, 87.654321, -1010.123);
  image.geometry.direction = Eigen::AngleAxisd(0.7, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  for (std::int64_t n = 0; n < image.geometry.voxels(); ++n)
    image.voxels.push_back(static_cast<std::int16_t>(lowest + (n * 7919) % 4096));
  return image;
}

fs::path written(const ImageVolume& image, const DicomSeriesOptions& options = {}) {
  const fs::path folder = ostia::testing::temporary_folder("dicom") / "series";
  write_dicom_series(folder, image, options);
  return folder;
}

/// Elements of an explicit little endian file, in their order; the data set's alone where `meta` is false.
std::vector<std::pair<std::uint32_t, std::string>> elements_of(const fs::path& file) {
  const std::string bytes = testing::read_bytes(file);
  EXPECT_EQ(bytes.substr(128, 4), "DICM");
  std::vector<std::pair<std::uint32_t, std::string>> result;
  const auto number = [&](std::size_t at, int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i)
      value |=
          static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i))))
          << (8 * i);
    return value;
  };
  for (std::size_t at = 132; at < bytes.size();) {
    const std::uint32_t tag = number(at, 2) << 16 | number(at + 2, 2);
    const std::string vr = bytes.substr(at + 4, 2);
    const bool wide = vr == "OB" || vr == "OW";
    const std::size_t length = wide ? number(at + 8, 4) : number(at + 6, 2);
    at += wide ? 12 : 8;
    EXPECT_EQ(length % 2, 0u);
    EXPECT_LE(at + length, bytes.size());
    result.emplace_back(tag, bytes.substr(at, length));
    at += length;
  }
  return result;
}

std::map<std::uint32_t, std::string> attributes_of(const fs::path& file) {
  std::map<std::uint32_t, std::string> result;
  for (auto& [tag, value] : elements_of(file)) {
    while (!value.empty() && (value.back() == ' ' || value.back() == '\0')) value.pop_back();
    result[tag] = value;
  }
  return result;
}

TEST(DicomSeriesWriter, HasTheMandatoryAttributesOfACtImageInOrder) {
  const fs::path folder = written(oblique_image());
  const auto elements = elements_of(folder / "CT0001.dcm");
  for (std::size_t i = 1; i < elements.size(); ++i) EXPECT_LT(elements[i - 1].first, elements[i].first);
  std::map<std::uint32_t, std::string> found(elements.begin(), elements.end());
  // PS3.3: type 1 must have a value; type 2 must be there.
  const std::vector<std::uint32_t> type1 = {
      0x00020001, 0x00020002, 0x00020003, 0x00020010, 0x00020012, 0x00080008, 0x00080016,
      0x00080018, 0x00080060, 0x0020000D, 0x0020000E, 0x00200032, 0x00200037, 0x00200052,
      0x00280002, 0x00280004, 0x00280010, 0x00280011, 0x00280030, 0x00280100, 0x00280101,
      0x00280102, 0x00280103, 0x00281052, 0x00281053, 0x7FE00010};
  const std::vector<std::uint32_t> type2 = {0x00080020, 0x00080030, 0x00080050, 0x00080070, 0x00080090,
                                            0x00100010, 0x00100020, 0x00100030, 0x00100040, 0x00180010,
                                            0x00180050, 0x00180060, 0x00185100, 0x00200010, 0x00200011,
                                            0x00200012, 0x00200013, 0x00201040};
  for (const std::uint32_t tag : type1) {
    ASSERT_TRUE(found.count(tag)) << std::hex << tag;
    EXPECT_FALSE(found[tag].empty()) << std::hex << tag;
  }
  for (const std::uint32_t tag : type2) EXPECT_TRUE(found.count(tag)) << std::hex << tag;
  // The group length is that of the rest of the meta information.
  std::size_t meta = 0;
  for (const auto& [tag, value] : elements)
    if (tag >> 16 == 2 && tag != 0x00020000u) meta += value.size() + (tag == 0x00020001u ? 12 : 8);
  EXPECT_EQ(static_cast<unsigned char>(found[0x00020000u][0]), meta);
}

TEST(DicomSeriesWriter, UidsAreValidAndEachInstanceHasItsOwn) {
  const fs::path folder = written(oblique_image());
  std::set<std::string> instances, series;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto found = attributes_of(entry.path());
    for (const std::uint32_t tag : {0x00080018u, 0x0020000Du, 0x0020000Eu, 0x00200052u, 0x00020012u}) {
      const std::string& uid = found.at(tag);
      EXPECT_EQ(uid.substr(0, 5), "2.25.");
      EXPECT_LE(uid.size(), 44u);
      EXPECT_EQ(uid.find_first_not_of("0123456789", 5), std::string::npos);
      EXPECT_NE(uid[5], '0');
    }
    EXPECT_EQ(found.at(0x00080018u), found.at(0x00020003u));
    instances.insert(found.at(0x00080018u));
    series.insert(found.at(0x0020000Eu));
  }
  EXPECT_EQ(instances.size(), 5u);
  EXPECT_EQ(series.size(), 1u);
}

TEST(DicomSeriesWriter, TheSameSeedGivesTheSameBytesAndAnotherOthers) {
  DicomSeriesOptions options;
  options.uid_seed = "case 7";
  const std::string a = testing::read_bytes(written(oblique_image(), options) / "CT0003.dcm");
  const std::string b = testing::read_bytes(written(oblique_image(), options) / "CT0003.dcm");
  EXPECT_EQ(a, b);
  options.uid_seed = "case 8";
  EXPECT_NE(testing::read_bytes(written(oblique_image(), options) / "CT0003.dcm"), a);
  // Without a seed the image itself decides.
  options.uid_seed.clear();
  EXPECT_EQ(testing::read_bytes(written(oblique_image(), options) / "CT0003.dcm"),
            testing::read_bytes(written(oblique_image(), options) / "CT0003.dcm"));
  EXPECT_NE(attributes_of(written(oblique_image(), options) / "CT0003.dcm").at(0x0020000Eu),
            attributes_of(written(oblique_image(-1000), options) / "CT0003.dcm").at(0x0020000Eu));
}

TEST(DicomSeriesWriter, SeriesOfOneStudySaySo) {
  DicomSeriesOptions a, b;
  a.uid_seed = "beat/35";
  b.uid_seed = "beat/75";
  a.study_seed = b.study_seed = "beat";
  const auto first = attributes_of(written(oblique_image(), a) / "CT0001.dcm");
  const auto second = attributes_of(written(oblique_image(), b) / "CT0001.dcm");
  for (const std::uint32_t tag : {0x0020000Du, 0x00200052u}) EXPECT_EQ(first.at(tag), second.at(tag)) << tag;
  for (const std::uint32_t tag : {0x0020000Eu, 0x00080018u}) EXPECT_NE(first.at(tag), second.at(tag)) << tag;
}

TEST(DicomSeriesWriter, RefusesWhatDicomCannotHold) {
  const fs::path folder = ostia::testing::temporary_folder("dicom") / "refused";
  ImageVolume image = oblique_image();
  image.geometry.direction.col(2) *= -1.0;
  EXPECT_THROW(write_dicom_series(folder, image), InvalidInput);
  EXPECT_THROW(write_dicom_series(folder, ImageVolume{}), InvalidInput);
  ImageVolume wide;
  wide.geometry.size = {65536, 1, 1};
  wide.voxels.resize(65536);
  EXPECT_THROW(write_dicom_series(folder, wide), InvalidInput);
  image = oblique_image();
  image.voxels.pop_back();
  EXPECT_THROW(write_dicom_series(folder, image), InvalidInput);
  image = oblique_image();
  image.geometry.spacing.z() = 0.0;
  EXPECT_THROW(write_dicom_series(folder, image), InvalidInput);
  DicomSeriesOptions options;
  options.series_description = "a\\b";
  EXPECT_THROW(write_dicom_series(folder, oblique_image(), options), InvalidInput);
  options = {};
  options.patient_id = std::string(65, 'x');
  EXPECT_THROW(write_dicom_series(folder, oblique_image(), options), InvalidInput);
  options = {};
  options.cardiac_phase_percent = 101.0;
  EXPECT_THROW(write_dicom_series(folder, oblique_image(), options), InvalidInput);
  EXPECT_FALSE(fs::exists(folder));
}

TEST(DicomSeriesWriter, LeavesAFolderWithFilesAloneAndNothingBehindWhenCancelled) {
  const fs::path parent = ostia::testing::temporary_folder("dicom"), folder = parent / "series";
  fs::create_directory(folder);
  write_dicom_series(folder, oblique_image());  // empty: may be filled
  EXPECT_THROW(write_dicom_series(folder, oblique_image()), IoError);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(write_dicom_series(parent / "other", oblique_image(), {}, task), Cancelled);
  EXPECT_EQ(std::distance(fs::directory_iterator(parent), fs::directory_iterator()), 1);
}

TEST(DicomSeriesWriter, TheScanFindsTheSeriesWithItsGeometryAndPhase) {
  DicomSeriesOptions options;
  options.cardiac_phase_percent = 75.0;
  const ImageVolume image = oblique_image();
  const DicomFolder found = scan_dicom(written(image, options));
  ASSERT_EQ(found.series.size(), 1u);
  EXPECT_EQ(found.skipped, 0u);
  const DicomSeries& series = found.series[0];
  EXPECT_EQ(series.modality, "CT");
  EXPECT_EQ(series.description, "Synthetic coronary CTA");
  EXPECT_TRUE(series.faults.empty());
  EXPECT_TRUE(series.warnings.empty());
  EXPECT_TRUE(same_grid(series.geometry, image.geometry, 1e-6));
}

}  // namespace
}  // namespace ostia::imaging
