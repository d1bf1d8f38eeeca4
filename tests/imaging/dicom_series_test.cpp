#include "dicom_writer.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/imaging/dicom.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ostia::imaging {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using testing::CtSlice;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::write_series;

DicomSeries only(const fs::path& folder) {
  const DicomFolder found = scan_dicom(folder);
  EXPECT_EQ(found.series.size(), 1u);
  return found.series.empty() ? DicomSeries{} : found.series.front();
}

fs::path dicom_series_series_folder(
    int count, double spacing, const std::function<void(CtSlice&, int)>& change = [](CtSlice&, int) {}) {
  const fs::path folder = testing::temporary_folder("series");
  write_series(folder, count, spacing, change);
  return folder;
}

TEST(DicomSeries, SlicesAreSortedByPositionAndSpacedByIt) {
  // Names, instance numbers and SliceThickness all say something else.
  const fs::path folder = dicom_series_series_folder(6, 0.0, [](CtSlice& s, int k) {
    s.position = "-10\\-20\\" + std::to_string(100.0 - 0.75 * k);
    s.thickness = "3";
  });
  const DicomSeries series = only(folder);
  EXPECT_TRUE(series.faults.empty()) << series.faults.front();
  EXPECT_TRUE(series.warnings.empty()) << series.warnings.front();
  EXPECT_FALSE(series.uneven);
  EXPECT_EQ(series.files.front().filename(), "slice5.dcm");
  EXPECT_NEAR(series.geometry.spacing[2], 0.75, 1e-9);
  EXPECT_NEAR(series.geometry.origin[2], 96.25, 1e-9);
  EXPECT_EQ(series.geometry.size, (std::array<std::int64_t, 3>{5, 4, 6}));
}

TEST(DicomSeries, PixelSpacingIsBetweenRowsFirst) {
  const DicomSeries series =
      only(dicom_series_series_folder(3, 1.0, [](CtSlice& s, int) { s.pixel_spacing = "0.7\\0.4"; }));
  EXPECT_EQ(series.geometry.spacing[0], 0.4);
  EXPECT_EQ(series.geometry.spacing[1], 0.7);
}

TEST(DicomSeries, AxesAreRightHandedWhateverTheOrientation) {
  for (const char* orientation :
       {"1\\0\\0\\0\\1\\0", "-1\\0\\0\\0\\1\\0", "0\\1\\0\\0\\0\\-1", "0.8\\0.6\\0\\-0.6\\0.8\\0"}) {
    const DicomSeries series = only(dicom_series_series_folder(4, 0.0, [&](CtSlice& s, int k) {
      s.orientation = orientation;
      s.position = std::to_string(2.0 * k) + "\\" + std::to_string(2.0 * k) + "\\" + std::to_string(2.0 * k);
    }));
    EXPECT_NEAR(series.geometry.direction.determinant(), 1.0, 1e-12) << orientation;
    EXPECT_GT(series.geometry.spacing[2], 0.0);
  }
}

TEST(DicomSeries, PixelSpacingMissingOrZero) {
  EXPECT_THAT(only(dicom_series_series_folder(3, 1.0, [](CtSlice& s, int) { s.pixel_spacing = ""; })).faults,
              ElementsAre(HasSubstr("PixelSpacing is missing in 'slice0.dcm'")));
  EXPECT_THAT(
      only(dicom_series_series_folder(3, 1.0, [](CtSlice& s, int) { s.pixel_spacing = "0\\0"; })).faults,
      ElementsAre(HasSubstr("must be positive")));
}

TEST(DicomSeries, NoPositionIsAskedForAndNeverThickness) {
  const DicomSeries series =
      only(dicom_series_series_folder(3, 1.0, [](CtSlice& s, int) { s.position = ""; }));
  EXPECT_THAT(series.faults, ElementsAre(HasSubstr("ImagePositionPatient is missing")));
}

TEST(DicomSeries, MissingSlicesAreShown) {
  const fs::path folder = dicom_series_series_folder(10, 0.8);
  fs::remove(folder / "slice4.dcm");
  fs::remove(folder / "slice5.dcm");
  const DicomSeries series = only(folder);
  EXPECT_TRUE(series.uneven);
  EXPECT_NEAR(series.geometry.spacing[2], 0.8, 1e-9);
  EXPECT_THAT(series.warnings,
              ElementsAre(HasSubstr("2 slices are missing between slices 4 and 5 (2.4 mm)")));
}

TEST(DicomSeries, ThinSlicesToo) {
  const fs::path folder = dicom_series_series_folder(10, 0.15);
  fs::remove(folder / "slice4.dcm");
  EXPECT_TRUE(only(folder).uneven);
}

TEST(DicomSeries, UnevenDistances) {
  const auto moved = [](double by) {
    return [by](CtSlice& s, int k) {
      if (k == 3) s.position = "-10\\-20\\" + std::to_string(100.0 + 2.0 * k + by);
    };
  };
  EXPECT_TRUE(only(dicom_series_series_folder(8, 2.0, moved(0.3))).uneven);
  EXPECT_FALSE(only(dicom_series_series_folder(8, 2.0, moved(0.1))).uneven);
}

TEST(DicomSeries, DistancesThatDriftApart) {
  // Each distance is within 0.2 mm of the typical one, but the middle lies 0.5 mm off the even grid.
  const DicomSeries series = only(dicom_series_series_folder(21, 0.0, [](CtSlice& s, int k) {
    s.position = "0\\0\\" + std::to_string(k <= 10 ? 2.0 * k : 20.0 + 2.1 * (k - 10));
  }));
  EXPECT_TRUE(series.uneven);
}

TEST(DicomSeries, GantryTiltIsMeasured) {
  const double tilt = 20.0 * M_PI / 180.0;
  const DicomSeries series = only(dicom_series_series_folder(8, 0.0, [&](CtSlice& s, int k) {
    s.orientation = "1\\0\\0\\0\\" + std::to_string(std::cos(tilt)) + "\\" + std::to_string(std::sin(tilt));
    s.position = "0\\0\\" + std::to_string(3.0 * k);
  }));
  EXPECT_TRUE(series.faults.empty());
  EXPECT_FALSE(series.uneven);
  EXPECT_NEAR(series.gantry_tilt_deg, 20.0, 1e-3);
  EXPECT_NEAR(series.geometry.spacing[2], 3.0 * std::cos(tilt), 1e-5);
  EXPECT_THAT(series.warnings, ElementsAre(HasSubstr("tilted gantry, 20")));
}

TEST(DicomSeries, DuplicatesAreSplitByTimeOrRefused) {
  const fs::path folder = testing::temporary_folder("series");
  for (int phase = 0; phase < 2; ++phase) {
    fs::create_directory(folder / std::to_string(phase));
    write_series(folder / std::to_string(phase), 4, 1.0, [&](CtSlice& s, int k) {
      s.sop_instance = "1.9." + std::to_string(10 * phase + k);
      s.trigger_time = std::to_string(300 * phase + 50);
    });
  }
  const DicomFolder found = scan_dicom(folder);
  ASSERT_EQ(found.series.size(), 2u);
  EXPECT_EQ(found.series[0].uid, "1.2.3");
  EXPECT_EQ(found.series[1].uid, "1.2.3#2");
  EXPECT_EQ(found.series[0].phase, "trigger time 50 ms");
  EXPECT_TRUE(found.series[0].faults.empty() && found.series[1].faults.empty());

  const fs::path copied = dicom_series_series_folder(4, 1.0);
  fs::copy_file(copied / "slice2.dcm", copied / "copy.dcm");
  EXPECT_THAT(only(copied).faults,
              ElementsAre(HasSubstr("'copy.dcm' and 'slice2.dcm' are the same image twice")));
}

TEST(DicomSeries, SeriesAndSizesAreSplit) {
  const fs::path folder = dicom_series_series_folder(5, 1.0);
  fs::create_directory(folder / "more");
  write_series(folder / "more", 3, 1.0, [](CtSlice& s, int) { s.rows = 8; });
  fs::create_directory(folder / "other");
  write_series(folder / "other", 2, 1.0, [](CtSlice& s, int) { s.series = "1.2.99"; });
  const DicomFolder found = scan_dicom(folder);
  ASSERT_EQ(found.series.size(), 3u);
  std::vector<std::string> uids;
  for (const DicomSeries& s : found.series) uids.push_back(s.uid + "/" + std::to_string(s.files.size()));
  EXPECT_THAT(uids, ::testing::UnorderedElementsAre("1.2.3/5", "1.2.3#2/3", "1.2.99/2"));
}

TEST(DicomSeries, LocalizersAreSetApart) {
  const fs::path folder = dicom_series_series_folder(5, 1.0, [](CtSlice& s, int k) {
    if (k == 4) s.image_type = "ORIGINAL\\PRIMARY\\LOCALIZER";
  });
  const DicomFolder found = scan_dicom(folder);
  ASSERT_EQ(found.series.size(), 2u);
  EXPECT_TRUE(found.series[0].faults.empty());
  EXPECT_EQ(found.series[0].files.size(), 4u);
  EXPECT_THAT(found.series[1].faults, Contains(HasSubstr("localizer")));
}

TEST(DicomSeries, ACutFileIsAFaultOfItsSeries) {
  const fs::path folder = dicom_series_series_folder(5, 1.0);
  fs::resize_file(folder / "slice3.dcm", fs::file_size(folder / "slice3.dcm") - 6);
  EXPECT_THAT(only(folder).faults, ElementsAre(HasSubstr("'slice3.dcm': pixel data cut short")));
  fs::resize_file(folder / "slice3.dcm", fs::file_size(folder / "slice3.dcm") - 101);
  EXPECT_THAT(only(folder).faults, ElementsAre(HasSubstr("'slice3.dcm' is damaged")));
}

TEST(DicomSeries, OtherFilesAreCounted) {
  const fs::path folder = dicom_series_series_folder(3, 1.0);
  testing::write_bytes(folder / "notes.txt", "not an image");
  testing::write_bytes(folder / "empty", "");
  EXPECT_EQ(scan_dicom(folder).skipped, 2u);
}

TEST(DicomSeries, AFileGivesItsSeries) {
  const fs::path folder = dicom_series_series_folder(3, 1.0);
  fs::create_directory(folder / "below");
  write_series(folder / "below", 2, 1.0, [](CtSlice& s, int) { s.series = "1.2.99"; });
  const DicomFolder found = scan_dicom(folder / "slice1.dcm");
  ASSERT_EQ(found.series.size(), 1u);
  EXPECT_EQ(found.series[0].files.size(), 3u);
  testing::write_bytes(folder / "notes.txt", "not an image");
  EXPECT_THROW(scan_dicom(folder / "notes.txt"), InvalidInput);
  EXPECT_THROW(scan_dicom(folder / "absent"), IoError);
}

TEST(DicomSeries, NamesWithSpacesAndUmlautsAndLongOnes) {
  const fs::path folder = testing::temporary_folder("series") / "Jürgens Herz 1" / std::string(200, 'x');
  fs::create_directories(folder);
  write_series(folder, 3, 1.0);
  EXPECT_EQ(only(folder).files.size(), 3u);
}

TEST(DicomSeries, WarningsNameNoPatient) {
  const fs::path folder = dicom_series_series_folder(10, 0.8);
  fs::remove(folder / "slice4.dcm");
  for (const std::string& warning : only(folder).warnings) {
    EXPECT_EQ(warning.find("DOE"), std::string::npos);
    EXPECT_EQ(warning.find(".dcm"), std::string::npos)
        << "warnings are saved, and file names may be a patient's";
  }
}

TEST(DicomSeries, CanBeCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(scan_dicom(dicom_series_series_folder(3, 1.0), task), Cancelled);
}

}  // namespace
}  // namespace ostia::imaging
