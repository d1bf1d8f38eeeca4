#include "ostia/imaging/series_preview.h"

#include "dicom_shown.h"
#include "dicom_writer.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace ostia::imaging {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using testing::CtSlice;
using ::testing::HasSubstr;

DicomSeries series_of(const std::function<void(CtSlice&, int)>& change, int count = 5) {
  const fs::path folder = testing::temporary_folder("preview");
  testing::write_series(folder, count, 0.75, change);
  return scan_dicom(folder).series.at(0);
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

TEST(SeriesPreview, MiddleSliceInTheFilesWindow) {
  const DicomSeries series = series_of([](CtSlice& s, int k) {
    s.rows = 40;
    s.columns = 80;
    s.window_centre = "200\\40";
    s.window_width = "400\\350";
    s.study_date = "20240301";
    s.description = "CTA 75 %";
    s.value = [k](int i, int) { return 1024 + (k == 2 ? 5 * i : 0); };
  });
  const SeriesPreview p = preview(series, 40);
  EXPECT_EQ(p.width, 40);
  EXPECT_EQ(p.height, 20);
  ASSERT_EQ(p.pixels.size(), 800U);
  EXPECT_TRUE(p.window.from_file);
  EXPECT_EQ(p.window.centre_hu, 200.0);
  EXPECT_EQ(p.window.width_hu, 400.0);
  // Pixel x is the mean of columns 2x and 2x + 1: 10 x + 2.5 HU, from 0 (black) to 400 (white).
  for (int x = 0; x < 40; ++x) {
    for (int y = 0; y < 20; ++y)
      ASSERT_NEAR(p.pixels[static_cast<std::size_t>(40 * y + x)],
                  255.0 * std::min(1.0, (10 * x + 2.5) / 400.0), 0.51);
  }
  EXPECT_EQ(p.shown.patient_name, "DOE, JANE");
  EXPECT_EQ(p.shown.study_date, "2024-03-01");
  EXPECT_EQ(p.shown.series_description, "CTA 75 %");
  EXPECT_EQ(p.shown.slices, 5);
}

TEST(SeriesPreview, WithoutAWindowThatOfAngiographyCounts) {
  const auto plain = preview(series_of([](CtSlice&, int) {}));
  EXPECT_FALSE(plain.window.from_file);
  EXPECT_GT(plain.window.width_hu, 0.0);
  EXPECT_TRUE(plain.shown.study_date.empty());
  const auto wrong = preview(series_of([](CtSlice& s, int) {
    s.window_centre = "40";
    s.window_width = "-5";
  }));
  EXPECT_FALSE(wrong.window.from_file);
  const auto text = preview(series_of([](CtSlice& s, int) { s.window_centre = s.window_width = "0,5"; }));
  EXPECT_FALSE(text.window.from_file);
}

TEST(SeriesPreview, SidesAreTheRadiologistsInAnyOrientation) {
  const auto corner = [](CtSlice& s, int) {
    s.rows = s.columns = 32;
    s.window_centre = "500";
    s.window_width = "1000";
    s.value = [](int i, int j) { return 1024 + (i < 16 && j < 16 ? 1000 : 0); };
  };
  const auto quadrant = [](const SeriesPreview& p, int x, int y) {
    return p.pixels[static_cast<std::size_t>(32 * y + x)];
  };
  const SeriesPreview usual = preview(series_of(corner), 32);
  EXPECT_EQ(quadrant(usual, 4, 4), 255);
  EXPECT_EQ(quadrant(usual, 27, 27), 0);
  const SeriesPreview turned = preview(series_of([&](CtSlice& s, int k) {
                                         corner(s, k);
                                         s.orientation = "-1\\0\\0\\0\\-1\\0";
                                       }),
                                       32);
  EXPECT_EQ(quadrant(turned, 4, 4), 0);
  EXPECT_EQ(quadrant(turned, 27, 27), 255);
}

TEST(SeriesPreview, OtherImageFilesToo) {
  ImageVolume image;
  image.geometry.size = {20, 10, 3};
  image.geometry.spacing = Vec3(1.0, 2.0, 1.0);
  for (int n = 0; n < 600; ++n)
    image.voxels.push_back(static_cast<std::int16_t>(n / 200 == 1 ? n % 20 : -1000));
  for (const char* name : {"a.nrrd", "a.mha"}) {
    const fs::path path = testing::temporary_folder("preview") / name;
    write_image(path, image);
    const SeriesPreview p = preview(path, 20);
    EXPECT_EQ(p.width, 20);
    EXPECT_EQ(p.height, 20);
    EXPECT_EQ(p.shown.slices, 3);
    EXPECT_TRUE(p.shown.patient_name.empty());
    EXPECT_LT(p.pixels[0], 10);
    EXPECT_GT(p.pixels[19], 245);
  }
}

TEST(SeriesPreview, FirstSliceLiesWhereItLiesInTheVolume) {
  const fs::path folder = testing::temporary_folder("preview");
  testing::write_series(folder, 7, 0.75);
  const auto volume = read_dicom(folder).volume;
  const DicomSeries series = scan_dicom(folder).series.at(0);
  for (const std::int64_t k : {-1, 0, 6}) {
    const SeriesSlice slice = first_slice(series, k);
    EXPECT_EQ(slice.index, k < 0 ? 3 : k);
    EXPECT_EQ(slice.image.geometry.size, (std::array<std::int64_t, 3>{5, 4, 1}));
    const Vec3 place = volume.geometry.world(Vec3(2, 3, static_cast<double>(slice.index)));
    EXPECT_LT((slice.image.geometry.world(Vec3(2, 3, 0)) - place).norm(), 1e-9);
    EXPECT_EQ(slice.image(2, 3, 0), volume(2, 3, slice.index));
  }
  EXPECT_THROW(first_slice(series, 7), InvalidInput);
  EXPECT_THROW(first_slice(DicomSeries{}), InvalidInput);
  EXPECT_THROW(preview(series, 8), InvalidInput);
  fs::remove(series.files[3]);
  EXPECT_THROW(first_slice(series), IoError);
}

TEST(SeriesPreview, NamesAreReadable) {
  EXPECT_EQ(shown_name("Doe^Jane^^Dr.", ""), "Doe, Jane  Dr.");
  EXPECT_EQ(shown_name("M\xfcller^J\xf6rg", "ISO_IR 100"), "M\xc3\xbcller, J\xc3\xb6rg");
  EXPECT_EQ(shown_name("M\xc3\xbcller^A=X^Y", "ISO_IR 192"), "M\xc3\xbcller, A");
  EXPECT_EQ(shown_name("M\xfcller", ""), "M?ller");
  EXPECT_EQ(shown_name("", ""), "");
  EXPECT_EQ(shown_text("a\x1b[2Jb\n", ""), "a [2Jb");
  EXPECT_EQ(shown_text("\xc3", "ISO_IR 192"), "?");
  EXPECT_EQ(shown_date("20240301"), "2024-03-01");
  EXPECT_EQ(shown_date("2024.03.01"), "2024-03-01");
  EXPECT_EQ(shown_date("<b>"), "");
}

TEST(ReadDicomSeries, OneSeriesFromItsOwnFiles) {
  const fs::path folder = testing::temporary_folder("both");
  testing::write_series(folder, 6, 0.75);
  fs::create_directory(folder / "other");
  testing::write_series(folder / "other", 4, 1.0, [](CtSlice& s, int) { s.series = "9.9"; });
  const DicomFolder found = scan_dicom(folder);
  ASSERT_EQ(found.series.size(), 2U);
  for (const DicomSeries& series : found.series) {
    DicomReadOptions options;
    options.series_uid = series.uid;
    const auto all = read_dicom(folder, options), own = read_dicom_series(series);
    EXPECT_EQ(all.volume.voxels, own.volume.voxels);
    EXPECT_TRUE(same_grid(all.volume.geometry, own.volume.geometry));
  }
  fs::remove(found.series[0].files[2]);
  EXPECT_THROW(read_dicom_series(found.series[0]), IoError);
  DicomSeries fewer = found.series[1];
  fewer.files.pop_back();
  fewer.frames.pop_back();
  EXPECT_NO_THROW(read_dicom_series(fewer));  // three slices that are a series, too
}

TEST(ReadDicomSeries, RunsInTheBackgroundWithProgressAndStopsWithinASecond) {
  ImageVolume image;
  image.geometry.size = {512, 512, 60};
  image.geometry.spacing = Vec3(0.4, 0.4, 0.5);
  image.voxels.assign(static_cast<std::size_t>(image.geometry.voxels()), 40);
  const fs::path folder = testing::temporary_folder("large") / "series";
  write_dicom_series(folder, image);
  const DicomSeries series = scan_dicom(folder).series.at(0);
  {
    core::TaskContext task;
    std::atomic<bool> done{false};
    std::thread reader([&] {
      EXPECT_EQ(read_dicom_series(series, {}, task).volume.voxels, image.voxels);
      done = true;
    });
    double last = 0.0;
    int between = 0;
    while (!done) {
      const double now = task.progress();
      EXPECT_GE(now, last);
      if (now > last && now > 0.12 && now < 1.0) ++between;
      last = now;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    reader.join();
    EXPECT_EQ(task.progress(), 1.0);
    EXPECT_GE(between, 2) << "no progress was seen while it decoded";
  }
  for (const double at : {0.0, 0.15, 0.5, 0.85}) {
    core::TaskContext task;
    std::atomic<bool> done{false};
    bool cancelled = false;
    std::thread reader([&] {
      try {
        read_dicom_series(series, {}, task);
      } catch (const Cancelled&) {
        cancelled = true;
      }
      done = true;
    });
    while (task.progress() < at && !done) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const auto start = Clock::now();
    task.cancel();
    reader.join();
    EXPECT_LT(seconds_since(start), 1.0);
    EXPECT_TRUE(cancelled || at > 0.8);  // so late it may have been done
  }
}

}  // namespace
}  // namespace ostia::imaging
