#include "dicom_writer.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/imaging/dicom.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

namespace ostia::imaging {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using testing::CtSlice;
using ::testing::HasSubstr;
using testing::write_series;

fs::path series_folder(
    int count, double spacing, const std::function<void(CtSlice&, int)>& change = [](CtSlice&, int) {}) {
  const fs::path folder = testing::temporary_folder("read");
  write_series(folder, count, spacing, change);
  return folder;
}

template <class E = InvalidInput>
std::string refusal(const fs::path& folder, const DicomReadOptions& options = {}) {
  try {
    read_dicom(folder, options);
  } catch (const E& error) {
    return error.what();
  }
  return "read, and not refused";
}

/// Environment variable for the length of a scope.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) before_ = old;
    ::setenv(name, value.c_str(), 1);
  }
  ~Environment() { before_.empty() ? ::unsetenv(name_) : ::setenv(name_, before_.c_str(), 1); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::string before_;
};

/// A program that stands in for the worker.
fs::path stand_in(const std::string& script) {
  const fs::path path = testing::temporary_folder("worker") / "worker";
  std::ofstream(path) << "#!/bin/sh\n" << script << '\n';
  fs::permissions(path, fs::perms::owner_all);
  return path;
}

TEST(ReadDicom, VoxelsAreHounsfieldUnitsWhereTheyBelong) {
  const auto image = read_dicom(series_folder(6, 0.75));
  EXPECT_EQ(image.volume.geometry.size, (std::array<std::int64_t, 3>{5, 4, 6}));
  for (std::int64_t k = 0; k < 6; ++k) {
    for (std::int64_t j = 0; j < 4; ++j) {
      for (std::int64_t i = 0; i < 5; ++i) ASSERT_EQ(image.volume(i, j, k), 100 * k + 10 * j + i);
    }
  }
  EXPECT_NEAR((image.volume.geometry.world(Vec3(2, 3, 4)) - Vec3(-9, -18.5, 103)).norm(), 0.0, 1e-9);
  EXPECT_EQ(image.header.format, "DICOM");
  EXPECT_TRUE(image.header.warnings.empty());
}

TEST(ReadDicom, RescaledSliceBySliceRoundedAndClamped) {
  const auto image = read_dicom(series_folder(3, 1.0, [](CtSlice& s, int k) {
    s.bits_stored = 16;
    s.high_bit = 15;
    s.slope = k == 0 ? "1" : k == 1 ? "0.5" : "2";
    s.intercept = k == 0 ? "-1000" : k == 1 ? "10" : "0";
    s.value = [](int i, int) { return i == 4 ? 60'000 : 1000 + i; };
  }));
  EXPECT_EQ(image.volume(1, 0, 0), 1);
  EXPECT_EQ(image.volume(1, 0, 1), 511);  // 510.5, half away from zero
  EXPECT_EQ(image.volume(2, 0, 1), 511);
  EXPECT_EQ(image.volume(1, 0, 2), 2002);
  EXPECT_EQ(image.volume(4, 0, 2), 32767);
  EXPECT_THAT(image.header.warnings, Contains(HasSubstr("8 voxels lie outside")));
  EXPECT_THAT(image.header.warnings, Contains(HasSubstr("rounded to whole HU")));
}

TEST(ReadDicom, EnhancedMultiFrameImage) {
  const fs::path path = testing::temporary_folder("read") / "enhanced.dcm";
  // Not in the order of their places.
  testing::write_bytes(path, testing::enhanced_ct({{"0\\0\\4"}, {"0\\0\\0"}, {"0\\0\\2"}}));
  const auto image = read_dicom(path);
  ASSERT_EQ(image.volume.geometry.size, (std::array<std::int64_t, 3>{2, 2, 3}));
  EXPECT_DOUBLE_EQ(image.volume.geometry.spacing[2], 2.0);
  EXPECT_EQ(image.volume(1, 1, 0), 2 * 103 - 10);
  EXPECT_EQ(image.volume(0, 0, 1), 2 * 200 - 10);
  EXPECT_EQ(image.volume(0, 0, 2), -10);
}

TEST(ReadDicom, CutShortIsRefusedByName) {
  const fs::path folder = series_folder(4, 1.0);
  fs::resize_file(folder / "slice2.dcm", fs::file_size(folder / "slice2.dcm") - 5);
  EXPECT_THAT(refusal(folder), AllOf(HasSubstr("slice2.dcm"), HasSubstr("cut short")));
}

TEST(ReadDicom, LargestSizeWithoutDataIsRefusedAtOnce) {
  EXPECT_THAT(refusal(series_folder(2, 1.0,
                                    [](CtSlice& s, int) {
                                      s.rows = s.columns = 65535;
                                      s.has_pixels = false;
                                    })),
              HasSubstr("no pixel data"));
}

TEST(ReadDicom, DamagedFilesAreRefusedByName) {
  const fs::path folder = testing::temporary_folder("read");
  testing::DicomWriter w;
  w.text(0x00080016u, "UI", "1.2.840.10008.5.1.4.1.1.2");
  w.element(0x00091010u, "OB", "short", 0xFFFFFFFEll);
  testing::write_bytes(folder / "big.dcm", testing::part10("1.2.840.10008.1.2.1", w.data_set()));
  EXPECT_THAT(refusal(folder), AllOf(HasSubstr("big.dcm"), HasSubstr("4294967294 bytes")));
  EXPECT_THAT(refusal(folder / "big.dcm"), HasSubstr("4294967294 bytes"));
}

TEST(ReadDicom, SpacingMayBeGiven) {
  const fs::path folder = series_folder(3, 1.0, [](CtSlice& s, int) { s.pixel_spacing = ""; });
  EXPECT_THAT(refusal(folder), HasSubstr("--pixel-spacing"));
  DicomReadOptions options;
  options.pixel_spacing_mm = 0.4;
  EXPECT_EQ(read_dicom(folder, options).volume.geometry.spacing[0], 0.4);
  options.pixel_spacing_mm = -1.0;
  EXPECT_THAT(refusal(folder, options), HasSubstr("must be positive"));
}

TEST(ReadDicom, CommaIsRefused) {
  EXPECT_THAT(refusal(series_folder(3, 1.0, [](CtSlice& s, int) { s.pixel_spacing = "0,5\\0,5"; })),
              HasSubstr("0,5"));
}

TEST(ReadDicom, StackedByInstanceNumberWhenTheUserSaysHow) {
  const fs::path folder = series_folder(4, 1.0, [](CtSlice& s, int k) {
    s.position = "";
    s.instance = std::to_string(40 - k);
  });
  EXPECT_THAT(refusal(folder), HasSubstr("ImagePositionPatient"));
  DicomReadOptions options;
  options.slice_spacing_mm = 1.5;
  const auto image = read_dicom(folder, options);
  EXPECT_NEAR(image.volume.geometry.spacing[2], 1.5, 1e-9);
  EXPECT_EQ(image.volume(0, 0, 0), 300);
  EXPECT_THAT(image.header.warnings, Contains(HasSubstr("instance number")));
}

TEST(ReadDicom, AMissingSliceTakesConsent) {
  const fs::path folder = series_folder(7, 1.0);
  fs::remove(folder / "slice3.dcm");
  EXPECT_THAT(refusal(folder), AllOf(HasSubstr("1 slice is missing"), HasSubstr("--resample")));
  DicomReadOptions options;
  options.resample_uneven = true;
  const auto image = read_dicom(folder, options);
  ASSERT_EQ(image.volume.geometry.size[2], 7);
  for (std::int64_t k = 0; k < 7; ++k) EXPECT_EQ(image.volume(2, 1, k), 100 * k + 12);
  EXPECT_THAT(image.header.warnings, Contains(HasSubstr("resampled to even slices")));
}

TEST(ReadDicom, UnevenSlicesTakeConsent) {
  const fs::path folder = series_folder(5, 0.0, [](CtSlice& s, int k) {
    const double z[] = {0.0, 1.0, 2.5, 3.0, 4.0};
    s.position = "0\\0\\" + std::to_string(z[k]);
    s.value = [z = z[k]](int, int) { return 1024 + static_cast<int>(100.0 * z); };
  });
  EXPECT_THAT(refusal(folder), HasSubstr("unevenly"));
  DicomReadOptions options;
  options.resample_uneven = true;
  const auto image = read_dicom(folder, options);
  for (std::int64_t k = 0; k < image.volume.geometry.size[2]; ++k) {
    EXPECT_NEAR(image.volume(1, 1, k),
                100.0 * image.volume.geometry.world(Vec3(1, 1, static_cast<double>(k)))[2], 1.0);
  }
}

TEST(ReadDicom, TiltIsCorrectedAndRecorded) {
  // A bright rod along z through slices whose planes are tilted by atan(3/4).
  const int rows = 40;
  const fs::path folder = series_folder(8, 0.0, [&](CtSlice& s, int k) {
    s.rows = rows;
    s.columns = 6;
    s.pixel_spacing = "1\\1";
    s.orientation = "1\\0\\0\\0\\0.8\\0.6";
    s.position = "0\\0\\" + std::to_string(5.0 * k);
    // In the plane the pixel of row j lies at y = 0.8 j: the rod is at y = 16, row 20 of every slice.
    s.value = [](int, int j) { return 1024 + (j == 20 ? 900 : j == 19 || j == 21 ? 450 : 0); };
  });
  const auto image = read_dicom(folder);
  EXPECT_THAT(image.header.warnings, Contains(HasSubstr("tilted gantry, 36.8")));
  const Geometry& g = image.volume.geometry;
  EXPECT_NEAR(g.spacing[2], 4.0, 1e-9);
  for (int k = 0; k < 8; ++k) {
    const Vec3 at = g.index(Vec3(2, 16, 5.0 * k + 0.6 * 20));  // where the rod meets slice k
    EXPECT_NEAR(at[2], k, 1e-6);
    EXPECT_EQ(image.volume(2, std::lround(at[1]), std::lround(at[2])), 900) << k;
  }
  EXPECT_EQ(image.volume(2, g.size[1] - 1, 0), -1024);  // beyond the first slice, into which the others reach
}

TEST(ReadDicom, CopiesAreRefused) {
  const fs::path folder = series_folder(3, 1.0);
  fs::copy_file(folder / "slice1.dcm", folder / "again.dcm");
  EXPECT_THAT(refusal(folder), HasSubstr("'again.dcm' and 'slice1.dcm'"));
}

TEST(ReadDicom, OfSeveralSeriesOneMustBeChosen) {
  const fs::path folder = series_folder(3, 1.0);
  fs::create_directory(folder / "more");
  write_series(folder / "more", 4, 1.0, [](CtSlice& s, int) { s.series = "9.9"; });
  EXPECT_THAT(refusal(folder), AllOf(HasSubstr("2 series"), HasSubstr("1.2.3 ("), HasSubstr("9.9 (")));
  DicomReadOptions options;
  options.series_uid = "9.9";
  EXPECT_EQ(read_dicom(folder, options).volume.geometry.size[2], 4);
  options.series_uid = "7";
  EXPECT_THAT(refusal(folder, options), HasSubstr("no series 7"));
}

TEST(ReadDicom, ColourIsRefused) {
  EXPECT_THAT(refusal(series_folder(3, 1.0, [](CtSlice& s, int) { s.photometric = "RGB"; })),
              HasSubstr("colour"));
}

TEST(ReadDicom, CorruptCompressedDataAreRefusedByName) {
  const fs::path folder = series_folder(3, 1.0, [](CtSlice& s, int k) {
    s.transfer_syntax = "1.2.840.10008.1.2.5";
    std::string frame("\x02\0\0\0\x40\0\0\0\x44\0\0\0", 12);
    frame.resize(64, '\0');
    s.streams = {frame + std::string("\xED\x04\x00\x00", 4) +
                 (k == 1 ? std::string("\x40\x07", 2) : std::string("\xED\x07", 2))};
  });
  EXPECT_THAT(refusal(folder), AllOf(HasSubstr("slice1.dcm"), HasSubstr("RLE")));
}

TEST(ReadDicom, AWorkerThatDiesNamesTheFileItWasAt) {
  const fs::path folder = series_folder(4, 1.0);
  const Environment crash("OSTIA_WORKER",
                          stand_in("echo '@slice 0' >&2\necho '@slice 2' >&2\nkill -ABRT $$").string());
  EXPECT_THAT(refusal(folder), AllOf(HasSubstr("slice2.dcm"), HasSubstr("signal 6")));
}

TEST(ReadDicom, AWorkerThatLiesIsNotBelieved) {
  const fs::path folder = series_folder(4, 1.0);
  const Environment lazy("OSTIA_WORKER", stand_in("echo short > \"$3\"").string());
  EXPECT_THAT(refusal(folder), HasSubstr("left out slice"));
}

TEST(ReadDicom, NoRoomIsNotTheFilesFault) {
  const fs::path folder = series_folder(4, 1.0);
  const Environment full("OSTIA_WORKER",
                         stand_in("echo '@slice 1' >&2\necho 'out of memory' >&2\nexit 5").string());
  EXPECT_THAT(refusal<ResourceError>(folder), AllOf(HasSubstr("slice1.dcm"), HasSubstr("out of memory")));
}

TEST(ReadDicom, LeavesNothingInTheTemporaryFolder) {
  const fs::path folder = series_folder(3, 1.0), temporary = testing::temporary_folder("tmp"),
                 bad = stand_in("echo x > \"$3\"; exit 3");
  {
    const Environment here("TMPDIR", temporary.string());
    read_dicom(folder);
    const Environment crash("OSTIA_WORKER", bad.string());
    EXPECT_THROW(read_dicom(folder), InvalidInput);
  }
  EXPECT_TRUE(fs::is_empty(temporary));
}

TEST(ReadDicom, NamesWithSpacesAndUmlauts) {
  const fs::path folder = testing::temporary_folder("read") / "Jürgens Herz 1\n" / std::string(200, 'x');
  fs::create_directories(folder);
  write_series(folder, 3, 1.0);
  EXPECT_EQ(read_dicom(folder).volume(1, 1, 1), 111);
}

TEST(ReadDicom, WhatIsKeptNamesNoPatient) {
  const auto image = read_dicom(series_folder(3, 1.0, [](CtSlice& s, int) { s.modality = "MR"; }));
  ASSERT_FALSE(image.header.warnings.empty());
  for (const std::string& warning : image.header.warnings) EXPECT_EQ(warning.find("DOE"), std::string::npos);
}

TEST(ReadDicom, ReportsProgressAndCanBeCancelled) {
  const fs::path folder = series_folder(3, 1.0);
  const core::TaskContext task;
  read_dicom(folder, {}, task);
  EXPECT_EQ(task.progress(), 1.0);
  const core::TaskContext stopped;
  stopped.cancel();
  EXPECT_THROW(read_dicom(folder, {}, stopped), Cancelled);
}

}  // namespace
}  // namespace ostia::imaging
