// A mask of coronary arteries that is opened becomes a case, alone or with the image on the table.

#include "window_hand.h"

#include "ostia/geometry/polyline.h"
#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QElapsedTimer>
#include <QMessageBox>
#include <QStatusBar>
#include <algorithm>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3;
using testing::TestWindow;
using testing::wait_until;

/// A vessel with a branch, as labels and as a CT that shows it.
struct Painted {
  imaging::MaskVolume mask;
  imaging::ImageVolume image;
};
Painted painted(double shift_mm) {
  Painted made;
  made.mask.geometry.size = {60, 40, 90};
  made.mask.geometry.spacing = {0.6, 0.6, 0.6};
  made.mask.geometry.origin = {-8.0, -12.0, -6.0};
  made.image.geometry = made.mask.geometry;
  const std::vector<Vec3> trunk{{0, shift_mm, 0}, {0, shift_mm, 20}, {2, shift_mm, 40}};
  const std::vector<Vec3> branch{{0, shift_mm, 14}, {8, shift_mm, 24}, {17, shift_mm, 28}};
  for (std::int64_t k = 0; k < 90; ++k)
    for (std::int64_t j = 0; j < 40; ++j)
      for (std::int64_t i = 0; i < 60; ++i) {
        const Vec3 at = made.mask.geometry.world(
            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        const bool inside = (geometry::closest(trunk, at).point - at).norm() < 1.9 ||
                            (geometry::closest(branch, at).point - at).norm() < 1.4;
        made.mask.voxels.push_back(inside ? 1 : 0);
        const auto noise = static_cast<std::int16_t>((i * 7919 + j * 104729 + k * 1299709) % 211);
        made.image.voxels.push_back(static_cast<std::int16_t>(inside ? 350 + noise : noise - 100));
      }
  return made;
}

struct MaskOpening : ::testing::Test {
  testing::Folder folder;
  TestWindow test{folder / "state"};
  bool idle() {
    return wait_until([&] { return !test.window().jobs().any(); }, 60000);
  }
  /// By File > Open.
  void choose(const fs::path& file) {
    testing::answer_file_dialog(file);
    test.window().findChild<QAction*>("file.open")->trigger();
  }
};

TEST_F(MaskOpening, AloneItBecomesACaseAndTheWindowIsNeverStuck) {
  imaging::write_image(folder / "mask.nrrd", painted(0.0).mask);
  choose(folder / "mask.nrrd");
  ASSERT_TRUE(wait_until([&] { return test.window().jobs().running("open") || test.bench().has_case(); }));
  QElapsedTimer since;
  since.start();
  qint64 longest = 0;
  while (!test.bench().has_case() || test.window().jobs().any()) {  // the mask's job, then the case's
    const qint64 before = since.elapsed();
    QApplication::processEvents(QEventLoop::AllEvents, 10);
    longest = std::max(longest, since.elapsed() - before);
    ASSERT_LT(since.elapsed(), 60000);
  }
  EXPECT_LT(longest, 2000);
  ASSERT_TRUE(test.bench().has_case()) << test.window().statusBar()->currentMessage().toStdString();
  EXPECT_EQ(test.bench().model()->tree.vessels.size(), 2U);
  EXPECT_FALSE(test.bench().session().file().image());
  EXPECT_TRUE(test.window().statusBar()->currentMessage().contains("of the mask; a question mark"))
      << test.window().statusBar()->currentMessage().toStdString();
}

TEST_F(MaskOpening, WithItsImageOnTheTableTheCaseBelongsToTheImage) {
  const Painted patient = painted(0.0);
  imaging::write_image(folder / "ct.nrrd", patient.image);
  imaging::write_image(folder / "mask.nii.gz", patient.mask);
  test.window().open(folder / "ct.nrrd");
  ASSERT_TRUE(idle());
  ASSERT_TRUE(test.bench().image().volume);
  choose(folder / "mask.nii.gz");
  ASSERT_TRUE(wait_until([&] { return test.bench().has_case() && !test.window().jobs().any(); }, 60000));
  const auto image = test.bench().session().file().image();
  ASSERT_TRUE(image);
  EXPECT_EQ(image->sha256, test.bench().image().reference.sha256);
}

TEST_F(MaskOpening, AnotherPatientsMaskIsRefusedAndWhatWasOpenStays) {
  imaging::write_image(folder / "ct.nrrd", painted(0.0).image);
  imaging::write_image(folder / "mask.nrrd", painted(7.0).mask);
  test.window().open(folder / "ct.nrrd");
  ASSERT_TRUE(idle());
  test.window().open(folder / "mask.nrrd");
  QMessageBox* box = nullptr;
  ASSERT_TRUE(wait_until([&] { return (box = test.window().findChild<QMessageBox*>()) != nullptr; }, 60000));
  EXPECT_TRUE((box->text() + box->informativeText()).contains("close the image"))
      << (box->text() + box->informativeText()).toStdString();
  box->reject();
  EXPECT_FALSE(test.bench().has_case());
  EXPECT_TRUE(test.bench().image().volume);
}

TEST_F(MaskOpening, CancelledThereIsNoCase) {
  imaging::write_image(folder / "mask.nrrd", painted(0.0).mask);
  test.window().open(folder / "mask.nrrd");
  test.window().jobs().cancel("open");
  ASSERT_TRUE(idle());
  EXPECT_FALSE(test.bench().has_case());
  std::error_code none;
  EXPECT_TRUE(!fs::exists(folder / "state/cases") || fs::is_empty(folder / "state/cases", none));
}

}  // namespace
}  // namespace ostia::workstation
