#include "dicom_decode.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/imaging/dicom.h"
#include "ostia/imaging/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace ostia::imaging {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusal(const fs::path& path, const DicomReadOptions& options = {}) {
  try {
    read_dicom(path, options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "read, and not refused";
}

std::vector<std::int32_t> decoded(const fs::path& path) {
  auto file = parse_dicom(path);
  if (!file) throw InvalidInput("'" + path.string() + "' is not DICOM");
  return decode_frame(*file, 0);
}

TEST(DicomReal, ChestAngiogramIsTheSameAsItsHeartInNrrd) {
  OSTIA_REQUIRE_SHARED(zip, "cta/rider-pilot-chest-pe-cta/dicom-series-95.zip");
  OSTIA_REQUIRE_SHARED(nrrd, "cta/rider-pilot-chest-pe-cta/heart-crop.nrrd");
  const auto image = read_dicom(ostia::testing::unpacked(zip));
  EXPECT_EQ(image.volume.geometry.size, (std::array<std::int64_t, 3>{512, 512, 95}));
  EXPECT_NEAR(image.volume.geometry.spacing[0], 0.64453125, 1e-6);
  EXPECT_NEAR(image.volume.geometry.spacing[2], 0.8, 1e-6);
  const auto heart = read_image(nrrd);
  const Geometry &g = image.volume.geometry, &h = heart.volume.geometry;
  std::size_t different = 0;
  for (std::int64_t k = 0; k < h.size[2]; ++k) {
    const Vec3 corner = g.index(h.world(Vec3(0, 0, static_cast<double>(k))));
    for (int axis = 0; axis < 3; ++axis) ASSERT_NEAR(corner[axis], std::round(corner[axis]), 1e-2);
    const std::int64_t i0 = std::lround(corner[0]), j0 = std::lround(corner[1]), k0 = std::lround(corner[2]);
    ASSERT_TRUE(i0 >= 0 && j0 >= 0 && k0 >= 0 && i0 + h.size[0] <= 512 && j0 + h.size[1] <= 512 && k0 < 95);
    for (std::int64_t j = 0; j < h.size[1]; ++j) {
      for (std::int64_t i = 0; i < h.size[0]; ++i) {
        different += image.volume(i0 + i, j0 + j, k0) == heart.volume(i, j, k) ? 0 : 1;
      }
    }
  }
  EXPECT_EQ(different, 0u);
}

TEST(DicomReal, JpegTwoThousandSeries) {
  OSTIA_REQUIRE_SHARED(folder, "cta/totalsegmentator-ct-dicom-20");
  const auto image = read_dicom(folder);
  EXPECT_EQ(image.volume.geometry.size, (std::array<std::int64_t, 3>{512, 512, 20}));
  EXPECT_NEAR(image.volume.geometry.spacing[2], 2.0, 1e-6);
  const auto [low, high] = std::minmax_element(image.volume.voxels.begin(), image.volume.voxels.end());
  EXPECT_EQ(*low, -1024);
  EXPECT_GT(*high, 1000);
}

TEST(DicomReal, TiltedGantryWithUnevenSlices) {
  OSTIA_REQUIRE_SHARED(zip, "dicom/ge-gantry-tilt-variable-spacing/ge-28.zip");
  const fs::path folder = ostia::testing::unpacked(zip);
  EXPECT_THAT(refusal(folder), AllOf(HasSubstr("unevenly"), HasSubstr("--resample")));
  const DicomFolder found = scan_dicom(folder);
  ASSERT_EQ(found.series.size(), 1u);
  const DicomSeries& series = found.series.front();
  EXPECT_EQ(series.files.size(), 28u);
  const auto first = parse_dicom(series.files.front());
  ASSERT_TRUE(first && first->header.gantry_tilt_deg);
  EXPECT_NEAR(series.gantry_tilt_deg, std::abs(*first->header.gantry_tilt_deg), 0.1);

  DicomReadOptions options;
  options.resample_uneven = true;
  const auto image = read_dicom(folder, options);
  const Geometry& g = image.volume.geometry;
  EXPECT_EQ(g.size[0], 512);
  EXPECT_GT(g.size[1], 512 + 90);  // 48 mm of shear at 0.488 mm
  // The first slice is not shifted: its voxels are the file's, moved by whole pixels into the larger plane.
  const auto stored = decoded(series.files.front());
  const double intercept = *first->header.frames[0].intercept;
  const Vec3 corner = g.index(*first->header.frames[0].position);
  const std::int64_t j0 = std::lround(corner[1]);
  EXPECT_NEAR(corner[1], static_cast<double>(j0), 1e-6);
  std::size_t different = 0;
  for (std::int64_t j = 0; j < 512; ++j) {
    for (std::int64_t i = 0; i < 512; ++i) {
      different +=
          image.volume(i, j + j0, 0) == stored[static_cast<std::size_t>(i + 512 * j)] + intercept ? 0 : 1;
    }
  }
  EXPECT_EQ(different, 0u);
}

TEST(DicomReal, TruncatedLastSliceIsRefusedByName) {
  OSTIA_REQUIRE_SHARED(folder, "dicom/truncated-last-slice");
  EXPECT_THAT(refusal(folder), AllOf(HasSubstr("000275.dcm"), HasSubstr("cut short")));
}

TEST(DicomReal, CineIsTakenApartByTriggerTime) {
  OSTIA_REQUIRE_SHARED(zip, "dicom/cine-mr-4d/cine-2slices-25phases.zip");
  const DicomFolder found = scan_dicom(ostia::testing::unpacked(zip));
  std::map<std::string, int> phases;  // by the UID without its number
  for (const DicomSeries& series : found.series) {
    EXPECT_THAT(series.phase, HasSubstr("trigger time"));
    ++phases[series.uid.substr(0, series.uid.find('#'))];
  }
  ASSERT_EQ(phases.size(), 2u);
  for (const auto& [uid, count] : phases) EXPECT_EQ(count, 25);
  // One slice a phase is no volume.
  EXPECT_THAT(refusal(ostia::testing::unpacked(zip)), HasSubstr("single slice"));
}

TEST(DicomReal, OneImageInEverySyntaxIsOneImage) {
  OSTIA_REQUIRE_SHARED(folder, "dicom/pydicom");
  const auto truth = decoded(folder / "MR_small.dcm");
  for (const char* name :
       {"MR_small_bigendian.dcm", "MR_small_expb.dcm", "MR_small_implicit.dcm", "MR_small_padded.dcm",
        "MR_small_RLE.dcm", "MR_small_jpeg_ls_lossless.dcm", "MR_small_jp2klossless.dcm"}) {
    EXPECT_EQ(decoded(folder / name), truth) << name;
  }
}

TEST(DicomReal, StreamsThatContradictTheirHeaders) {
  OSTIA_REQUIRE_SHARED(folder, "dicom/pydicom");
  // Signed in the header, unsigned 13 bits in the stream: air and the padding around it must come out
  // negative.
  const auto voxels = decoded(folder / "J2K_pixelrep_mismatch.dcm");
  EXPECT_EQ(*std::min_element(voxels.begin(), voxels.end()), -2000);
  EXPECT_LT(*std::max_element(voxels.begin(), voxels.end()), 4096);
  EXPECT_EQ(decoded(folder / "JPGExtended.dcm").size(), 1024u * 256u);
  EXPECT_THROW(decoded(folder / "JPEG2000-embedded-sequence-delimiter.dcm"), InvalidInput);
  EXPECT_THROW(decoded(folder / "MR_truncated.dcm"), InvalidInput);
  EXPECT_EQ(decoded(folder / "image_dfl.dcm").size(), 512u * 512u);
}

TEST(DicomReal, EveryOddFileIsReadOrRefusedWithAMessage) {
  OSTIA_REQUIRE_SHARED(folder, "dicom/pydicom");
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const fs::path alone = ostia::testing::temporary_folder("alone");
    fs::copy_file(entry.path(), alone / "file");
    try {
      read_dicom(alone);
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::bad_input) << entry.path() << ": " << error.what();
      EXPECT_GT(std::string(error.what()).size(), 20u) << entry.path();
    }
  }
  EXPECT_GT(files, 80u);
  // All of them in one folder, as well.
  EXPECT_GT(scan_dicom(folder).series.size(), 20u);
}

TEST(DicomReal, EveryOddFileIsDecodedByTheChildOrRefused) {
  OSTIA_REQUIRE_SHARED(folder, "dicom/pydicom");
  const fs::path work = ostia::testing::temporary_folder("decode");
  std::size_t decoded_files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    write_decode_list(work / "list", {{entry.path(), 0}});
    const int code = decode_dicom_files(work / "list", work / "out");
    EXPECT_TRUE(code == 0 || code == 3) << entry.path();
    decoded_files += code == 0 ? 1 : 0;
  }
  EXPECT_GT(decoded_files, 30u);
}

}  // namespace
}  // namespace ostia::imaging
