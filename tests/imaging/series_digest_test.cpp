#include "dicom_writer.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/path_digest.h"
#include "ostia/imaging/dicom.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ostia::imaging {
namespace {

namespace fs = std::filesystem;
using testing::CtSlice;
using testing::write_series;

void write_phase(const fs::path& folder, const std::string& series, const std::string& name) {
  fs::create_directories(folder / name);
  write_series(folder / name, 4, 0.5, [&](CtSlice& slice, int) {
    slice.series = series;
    slice.sop_instance += "." + series;
  });
}

const DicomSeries& of_uid(const DicomFolder& folder, const std::string& uid) {
  for (const DicomSeries& series : folder.series)
    if (series.uid == uid) return series;
  throw InvalidInput("no series " + uid);
}

/// Three slices at two phases of the heart, in one file.
fs::path two_phases_in_one_file() {
  const fs::path folder = testing::temporary_folder("multiframe");
  std::vector<testing::EnhancedFrame> frames;
  for (const double percent : {40.0, 75.0})
    for (const char* position : {"0\\0\\0", "0\\0\\1", "0\\0\\2"}) frames.push_back({position, percent});
  testing::write_bytes(folder / "heart.dcm", testing::enhanced_ct(frames));
  return folder;
}

TEST(SeriesDigest, IsThatOfTheFolderWhichHoldsNothingElse) {
  const fs::path folder = testing::temporary_folder("digest");
  write_phase(folder, "1.2.3", "a");
  const DicomFolder found = scan_dicom(folder);
  ASSERT_EQ(found.series.size(), 1U);
  EXPECT_TRUE(found.series[0].whole_files);
  EXPECT_EQ(series_digest(found.series[0]), core::sha256_of_path(folder));
}

TEST(SeriesDigest, IsTheSeriesOwnWhateverLiesBesideIt) {
  const fs::path alone = testing::temporary_folder("digest"), both = testing::temporary_folder("digest");
  write_phase(alone, "1.2.3", "a");
  write_phase(both, "1.2.3", "other name");
  write_phase(both, "1.2.4", "b");
  core::write_file(both / "README.txt", "not an image");
  const DicomFolder found = scan_dicom(both);
  ASSERT_EQ(found.series.size(), 2U);
  EXPECT_EQ(series_digest(of_uid(found, "1.2.3")), core::sha256_of_path(alone));
  EXPECT_NE(series_digest(of_uid(found, "1.2.4")), series_digest(of_uid(found, "1.2.3")));
}

TEST(SeriesDigest, PhasesInOneFileDiffer) {
  const fs::path folder = two_phases_in_one_file();
  const DicomFolder found = scan_dicom(folder);
  ASSERT_EQ(found.series.size(), 2U);
  const std::string whole = core::sha256_of_path(folder);
  for (const DicomSeries& series : found.series) {
    ASSERT_EQ(series.frames.size(), 3U);
    EXPECT_FALSE(series.whole_files);
    EXPECT_NE(series_digest(series), whole);
  }
  EXPECT_NE(series_digest(found.series[0]), series_digest(found.series[1]));
  // The frames count as a set: in which order the slices lie is told by the file.
  DicomSeries turned = found.series[0];
  std::reverse(turned.frames.begin(), turned.frames.end());
  EXPECT_EQ(series_digest(turned), series_digest(found.series[0]));
}

TEST(SeriesDigest, AFileOfOneSeriesIsKnownByItself) {
  const fs::path folder = testing::temporary_folder("multiframe");
  testing::write_bytes(folder / "heart.dcm", testing::enhanced_ct({{"0\\0\\0"}, {"0\\0\\1"}, {"0\\0\\2"}}));
  const DicomFolder found = scan_dicom(folder);
  ASSERT_EQ(found.series.size(), 1U);
  EXPECT_TRUE(found.series[0].whole_files);
  EXPECT_EQ(found.series[0].files.size(), 3U);  // one a slice, yet read and counted once
  EXPECT_EQ(series_digest(found.series[0]), core::sha256_of_path(folder));
}

TEST(SeriesDigest, NeedsTheFiles) {
  const fs::path folder = testing::temporary_folder("digest");
  write_phase(folder, "1.2.3", "a");
  const DicomSeries series = scan_dicom(folder).series.at(0);
  fs::remove(series.files.front());
  EXPECT_THROW(series_digest(series), IoError);
  EXPECT_THROW(series_digest(DicomSeries{}), InvalidInput);
}

}  // namespace
}  // namespace ostia::imaging
