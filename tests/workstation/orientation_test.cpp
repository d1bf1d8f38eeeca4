// The orientation of an image whose file says it wrongly or not at all, given by mouse and keys.

#include "opening/orientation_dialog.h"
#include "opening/series_browser.h"
#include "tube_case.h"
#include "window_hand.h"

#include "ostia/core/files.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/image_axes.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QTest>
#include <QTreeWidget>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::TestWindow;
using testing::wait_until;
using view::Vec3;

// A block of another CT number towards each side of the patient, LPS, mm from the middle.
struct Block {
  Vec3 at;
  int hu;
};
const Block left{{14, 0, 0}, 700}, right{{-14, 0, 0}, 900}, back{{0, 14, 0}, 500}, front{{0, -14, 0}, 300},
    head{{0, 0, 14}, 1100}, feet{{0, 0, -14}, 1300};

imaging::ImageVolume blocks() {
  imaging::ImageVolume image;
  image.geometry.size = {40, 40, 40};
  image.geometry.spacing = {1.0, 1.0, 1.0};
  image.geometry.origin = {-19.5, -19.5, -19.5};
  image.voxels.assign(64000, -50);
  for (std::int64_t k = 0; k < 40; ++k)
    for (std::int64_t j = 0; j < 40; ++j)
      for (std::int64_t i = 0; i < 40; ++i) {
        const Vec3 at =
            image.geometry.world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
        image(i, j, k) =
            static_cast<std::int16_t>(-50 - (i + 3 * j + 7 * k) % 41);  // no mask has so many values
        for (const Block& one : {left, right, back, front, head, feet})
          if ((at - one.at).cwiseAbs().maxCoeff() < 4.0) image(i, j, k) = static_cast<std::int16_t>(one.hu);
      }
  return image;
}

struct OrientationWindow : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd";
  std::unique_ptr<TestWindow> test = std::make_unique<TestWindow>(folder / "state");

  /// The image as a file has it that says it wrongly: R, A and I for L, P and S are what it takes to be
  /// right.
  void write_wrong(const std::string& axes) {
    const imaging::ImageVolume good = blocks();
    imaging::ImageVolume wrong = good;
    const auto at = [&](std::size_t axis, std::int64_t n) { return axes[axis] == "LPS"[axis] ? n : 39 - n; };
    for (std::int64_t k = 0; k < 40; ++k)
      for (std::int64_t j = 0; j < 40; ++j)
        for (std::int64_t i = 0; i < 40; ++i) wrong(i, j, k) = good(at(0, i), at(1, j), at(2, k));
    imaging::write_image(image, wrong);
  }
  MainWindow& window() { return test->window(); }
  session::Workbench& bench() { return test->bench(); }
  bool idle() {
    return wait_until([&] { return !window().jobs().any(); }, 60000) &&
           wait_until([&] { return !window().jobs().any(); });
  }
  void open(const fs::path& what) {
    window().open(what);
    ASSERT_TRUE(wait_until([&] { return bench().image().volume && !window().jobs().any(); }, 60000));
    ASSERT_TRUE(idle());
  }
  template <class Part>
  Part* part(const char* name) {
    auto* found = window().findChild<Part*>(name);
    if (!found) throw std::runtime_error(std::string("there is no ") + name);
    return found;
  }
  OrientationDialog& dialog() {
    auto* found = window().findChild<OrientationDialog*>();
    if (!found) {
      part<QAction>("file.orientation")->trigger();
      found = window().findChild<OrientationDialog*>();
    }
    if (!found) throw std::runtime_error("there is no dialog of the orientation");
    QApplication::processEvents();
    return *found;
  }
  void press(const char* name) { QTest::mouseClick(dialog().findChild<QPushButton*>(name), Qt::LeftButton); }
  void end(Qt::Key key) {
    const QPointer<OrientationDialog> shown(&dialog());
    QTest::keyClick(shown.data(), key);
    ASSERT_TRUE(wait_until([&] { return !shown || !shown->isVisible(); }));
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    ASSERT_TRUE(idle());
  }
  int hu_at(const Vec3& from_middle) {
    const imaging::ImageVolume& volume = *bench().image().volume;
    const auto& size = volume.geometry.size;
    const Vec3 middle =
        volume.geometry.world(0.5 * Vec3(static_cast<double>(size[0] - 1), static_cast<double>(size[1] - 1),
                                         static_cast<double>(size[2] - 1)));
    const Vec3 at = volume.geometry.index(middle + from_middle);
    return volume(std::lround(at.x()), std::lround(at.y()), std::lround(at.z()));
  }
  void expect_right() {
    for (const Block& one : {left, right, back, front, head, feet}) EXPECT_EQ(hu_at(one.at), one.hu);
  }
};

TEST_F(OrientationWindow, TheSlicesFollowAtOnceAndTheLettersMeanWhatTheySay) {
  write_wrong("LPS");
  open(image);
  const session::GreyWindow all{700.0, 1600.0};
  bench().grey.set(all);
  // The grey in the middle of a side of a slice, as a CT number.
  const auto seen = [&](const char* slice, double right_mm, double down_mm) {
    const QImage& picture = dialog().findChild<OrientationSlice*>(slice)->picture();
    const int x = static_cast<int>(0.5 * picture.width() + right_mm / 40.0 * picture.width());
    const int y = static_cast<int>(0.5 * picture.height() + down_mm / 40.0 * picture.height());
    return std::lround((qGray(picture.pixel(x, y)) / 255.0 - 0.5) * all.width_hu + all.level_hu);
  };
  const auto expect_slices = [&](const Block& l, const Block& r, const Block& p, const Block& a,
                                 const Block& s, const Block& i) {
    EXPECT_NEAR(seen("orientation_axial", 14, 0), l.hu, 5);
    EXPECT_NEAR(seen("orientation_axial", -14, 0), r.hu, 5);
    EXPECT_NEAR(seen("orientation_axial", 0, -14), a.hu, 5);
    EXPECT_NEAR(seen("orientation_axial", 0, 14), p.hu, 5);
    EXPECT_NEAR(seen("orientation_coronal", 14, 0), l.hu, 5);
    EXPECT_NEAR(seen("orientation_coronal", 0, -14), s.hu, 5);
    EXPECT_NEAR(seen("orientation_coronal", 0, 14), i.hu, 5);
    EXPECT_NEAR(seen("orientation_sagittal", -14, 0), a.hu, 5);
    EXPECT_NEAR(seen("orientation_sagittal", 14, 0), p.hu, 5);
    EXPECT_NEAR(seen("orientation_sagittal", 0, -14), s.hu, 5);
  };
  expect_slices(left, right, back, front, head, feet);
  testing::on_screen(window(), "orientation-dialog");
  press("orientation_flip_3");
  EXPECT_EQ(dialog().axes(), "LPI");
  expect_slices(left, right, back, front, feet, head);
  EXPECT_THAT(dialog().findChild<QLabel*>("orientation_told")->text().toStdString(), HasSubstr("mirrors"));
  testing::on_screen(window(), "orientation-mirrored");
  press("orientation_flip_1");
  EXPECT_EQ(dialog().axes(), "RPI");
  expect_slices(right, left, back, front, feet, head);
  EXPECT_THAT(dialog().findChild<QLabel*>("orientation_told")->text().toStdString(),
              ::testing::Not(HasSubstr("mirrors")));
  press("orientation_as_file");
  press("orientation_turn_axial");  // clockwise: what was to the left of the patient is behind them now
  expect_slices(front, back, left, right, head, feet);
  press("orientation_as_file");
  press("orientation_turn_coronal");
  expect_slices(head, feet, back, front, right, left);
  press("orientation_as_file");
  press("orientation_turn_sagittal");
  expect_slices(left, right, head, feet, front, back);
  press("orientation_as_file");
  auto* columns = dialog().findChild<QComboBox*>("orientation_axis_1");
  columns->setFocus();
  QTest::keyClick(columns, Qt::Key_End);  // towards the feet; what ran there takes the other place
  EXPECT_EQ(dialog().axes(), "IPL");
  expect_slices(head, feet, back, front, right, left);
  EXPECT_EQ(dialog().findChild<QComboBox*>("orientation_axis_3")->currentData().toChar(), QChar('L'));
  const std::string before = bench().image().reference.axes;
  end(Qt::Key_Escape);
  EXPECT_EQ(bench().image().reference.axes, before) << "it was cancelled";
}

TEST_F(OrientationWindow, AnImageOnItsHeadIsSetRightTakenBackAndRemembered) {
  write_wrong("LPI");
  open(image);
  EXPECT_EQ(hu_at(head.at), feet.hu) << "it has to be wrong at first";
  EXPECT_FALSE(part<QAction>("edit.undo")->isEnabled());
  press("orientation_flip_3");
  end(Qt::Key_Return);
  EXPECT_EQ(bench().image().reference.axes, "LPI");
  expect_right();
  testing::on_screen(window(), "orientation-set");
  part<QAction>("edit.undo")->trigger();
  ASSERT_TRUE(wait_until([&] { return bench().image().reference.axes.empty(); }));
  ASSERT_TRUE(idle());
  EXPECT_EQ(hu_at(head.at), feet.hu);
  part<QAction>("edit.redo")->trigger();
  ASSERT_TRUE(wait_until([&] { return bench().image().reference.axes == "LPI"; }));
  ASSERT_TRUE(idle());
  expect_right();
  test.reset();
  test = std::make_unique<TestWindow>(folder / "state");
  open(image);
  expect_right();
  EXPECT_EQ(bench().image().reference.axes, "LPI");
}

TEST_F(OrientationWindow, ACaseKeepsTheOrientationAndTheOneBeforeComesBack) {
  write_wrong("RPS");
  const fs::path first = folder / "first.ostia";
  session::ImageReference reference = session::image_reference(image);
  session::CaseFile::create(first, testing::tube_model(), reference);
  window().machine().remember_image(reference.sha256, image);
  test->open(first);
  ASSERT_TRUE(idle());
  press("orientation_flip_1");
  EXPECT_TRUE(dialog().findChild<QLabel*>("orientation_closes_case")->isVisible());
  end(Qt::Key_Return);
  EXPECT_FALSE(bench().has_case()) << "its vessels were drawn in the mirror";
  expect_right();
  EXPECT_TRUE(fs::exists(first));
  // A case of the image as it is now.
  const fs::path second = folder / "second.ostia";
  session::CaseFile::create(second, testing::tube_model(), bench().image().reference);
  part<QAction>("edit.undo")->trigger();
  ASSERT_TRUE(wait_until([&] { return bench().has_case() && bench().image().volume; }));
  ASSERT_TRUE(idle());
  EXPECT_EQ(window().desk().case_path, first);
  EXPECT_EQ(hu_at(left.at), right.hu);
  // Each case has the image as it was made with, whichever was open before.
  test->open(second);
  ASSERT_TRUE(wait_until([&] { return bench().image().volume && bench().image().reference.axes == "RPS"; }));
  ASSERT_TRUE(idle());
  expect_right();
  test->open(first);
  ASSERT_TRUE(wait_until([&] { return bench().image().volume && bench().image().reference.axes.empty(); }));
  ASSERT_TRUE(idle());
  EXPECT_EQ(hu_at(left.at), right.hu);
}

TEST_F(OrientationWindow, IsOfferedWhereNoArteryIsFound) {
  write_wrong("LPS");
  open(image);
  auto* way = part<QPushButton>("way.file.orientation");
  ASSERT_TRUE(wait_until([&] { return way->isVisible(); }));
  QTest::mouseClick(way, Qt::LeftButton);
  ASSERT_TRUE(window().findChild<OrientationDialog*>());
  EXPECT_EQ(dialog().axes(), "LPS");
  end(Qt::Key_Escape);
}

TEST_F(OrientationWindow, ASeriesThatDoesNotSayHowThePatientLiesIsAskedFor) {
  const fs::path series = folder / "series";
  imaging::write_dicom_series(series, blocks(), {});
  for (const auto& file : fs::directory_iterator(series)) {  // ImageOrientationPatient becomes another tag
    std::string bytes = core::read_file(file.path());
    const std::string tag("\x20\x00\x37\x00", 4), other("\x20\x00\x38\x00", 4);
    const std::size_t at = bytes.find(tag);
    ASSERT_NE(at, std::string::npos);
    core::write_file(file.path(), bytes.replace(at, 4, other));
  }
  window().open(series);
  ASSERT_TRUE(wait_until([&] { return window().findChild<SeriesBrowser*>() != nullptr; }, 60000));
  ASSERT_TRUE(idle());
  auto* browser = window().findChild<SeriesBrowser*>();
  auto* tree = browser->findChild<QTreeWidget*>();
  ASSERT_EQ(tree->topLevelItemCount(), 1);
  EXPECT_THAT(tree->topLevelItem(0)->text(4).toStdString(), HasSubstr("ImageOrientationPatient is missing"));
  tree->setCurrentItem(tree->topLevelItem(0));
  QTimer::singleShot(0, &window(), [] {
    for (QWidget* one : QApplication::topLevelWidgets())
      if (auto* box = qobject_cast<QMessageBox*>(one); box && box->isVisible())
        QTest::mouseClick(box->button(QMessageBox::Yes), Qt::LeftButton);
  });
  for (QPushButton* button : browser->findChildren<QPushButton*>())
    if (button->isDefault()) QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return window().findChild<OrientationDialog*>() != nullptr; }, 60000));
  EXPECT_EQ(dialog().axes(), "LPS") << "axial slices of one on the back";
  end(Qt::Key_Return);
  expect_right();
  EXPECT_FALSE(window().findChild<OrientationDialog*>());
}

}  // namespace
}  // namespace ostia::workstation
