// What is dropped on the window. The events are Qt's, sent to the window: no drag begins in another program.

#include "opening/series_browser.h"
#include "tube_case.h"
#include "window_hand.h"

#include "ostia/core/files.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QDragEnterEvent>
#include <QDropEvent>
#include <QMessageBox>
#include <QMimeData>
#include <QUrl>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::TestWindow;
using testing::tube_image;
using testing::tube_model;
using testing::wait_until;

QUrl url(const fs::path& path) {
  return QUrl::fromLocalFile(QString::fromStdString(path.string()));
}

/// Over the window and let go: whether the window took it.
bool dropped(QWidget& window, const QMimeData& what) {
  const QPoint at(window.width() / 2, window.height() / 2);
  QDragEnterEvent enter(at, Qt::CopyAction, &what, Qt::LeftButton, Qt::NoModifier);
  enter.ignore();
  QApplication::sendEvent(&window, &enter);
  if (!enter.isAccepted()) return false;
  QDropEvent drop(at, Qt::CopyAction, &what, Qt::LeftButton, Qt::NoModifier);
  drop.ignore();
  QApplication::sendEvent(&window, &drop);
  return drop.isAccepted();
}
bool dropped(QWidget& window, const QList<QUrl>& urls) {
  QMimeData what;
  what.setUrls(urls);
  return dropped(window, what);
}

std::string message() {
  QMessageBox* box = nullptr;
  if (!wait_until([&] {
        for (QWidget* widget : QApplication::topLevelWidgets())
          if (auto* one = qobject_cast<QMessageBox*>(widget); one && one->isVisible()) box = one;
        return box != nullptr;
      }))
    return "no message";
  const std::string text = box->text().toStdString();
  box->close();
  QApplication::processEvents();
  return text;
}

struct Drop : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", dicom = folder / "dicom";
  TestWindow test{folder / "state"};
  Drop() {
    imaging::write_image(image, tube_image());
    session::CaseFile::create(case_file, tube_model(), session::image_reference(image));
  }
  bool image_is_there() {
    return wait_until(
        [&] { return !test.bench().image().reference.sha256.empty() && !test.window().jobs().any(); });
  }
};

TEST_F(Drop, ByQtEventsADicomFolderIsOpenedAsFromTheMenu) {
  imaging::write_dicom_series(dicom, tube_image());
  ASSERT_TRUE(dropped(test.window(), {url(dicom)}));
  ASSERT_TRUE(image_is_there());
  EXPECT_EQ(test.bench().image().volume->geometry.size[2], 110);
  TestWindow menu(folder / "other-state");
  menu.window().open(dicom);
  ASSERT_TRUE(wait_until(
      [&] { return !menu.bench().image().reference.sha256.empty() && !menu.window().jobs().any(); }));
  EXPECT_EQ(menu.bench().image().reference.sha256, test.bench().image().reference.sha256);
}

TEST_F(Drop, ByQtEventsAVolumeIsOpened) {
  ASSERT_TRUE(dropped(test.window(), {url(image)}));
  ASSERT_TRUE(image_is_there());
  EXPECT_EQ(test.bench().image().reference.sha256, session::image_reference(image).sha256);
  EXPECT_EQ(test.bench().image().volume->voxels, tube_image().voxels);
}

TEST_F(Drop, ByQtEventsACaseIsOpenedWithItsImage) {
  test.window().machine().remember_image(session::image_reference(image).sha256, image);
  ASSERT_TRUE(dropped(test.window(), {url(case_file)}));
  ASSERT_TRUE(image_is_there());
  ASSERT_TRUE(test.bench().has_case());
  EXPECT_EQ(test.bench().vessel_name(4), "LAD");
  // Onto a view the window gets it as well, and what is no case is refused while the open one stays.
  const fs::path fake = folder / "fake.ostia";
  core::write_file(fake, "not a case");
  ASSERT_TRUE(dropped(test.picture("cpr1"), {url(fake)}));
  EXPECT_THAT(message(), HasSubstr("fake.ostia"));
  EXPECT_TRUE(test.bench().has_case());
}

TEST_F(Drop, ByQtEventsWhatIsNoFileIsNotTaken) {
  QMimeData text;
  text.setText("image.nrrd");
  EXPECT_FALSE(dropped(test.window(), text));
  EXPECT_FALSE(dropped(test.window(), {QUrl("https://example.org/image.nrrd")}));
  EXPECT_FALSE(test.window().jobs().any());
  // A file that went between the drag and the drop.
  ASSERT_TRUE(dropped(test.window(), {url(folder / "gone.nrrd")}));
  EXPECT_THAT(test.failure(), HasSubstr("gone.nrrd"));
  EXPECT_FALSE(test.bench().image().volume);
}

TEST_F(Drop, ByQtEventsTwoFilesAtOnceAreRefusedInOneMessage) {
  ASSERT_TRUE(dropped(test.window(), {url(image), url(case_file)}));
  EXPECT_THAT(message(), HasSubstr("one case, image or folder at a time"));
  EXPECT_FALSE(test.window().jobs().any());
  EXPECT_FALSE(test.bench().has_case());
  EXPECT_FALSE(test.bench().image().volume);
}

/// Who changes their mind does not get the case's own image later.
TEST_F(Drop, AnImageDroppedRightAfterACaseIsWhatStays) {
  session::MachineState(folder / "state").remember_image(session::image_reference(image).sha256, image);
  const fs::path other = folder / "other.nrrd";
  imaging::write_image(other, tube_image(0.5));
  ASSERT_TRUE(dropped(test.window(), {url(case_file)}));
  ASSERT_TRUE(dropped(test.window(), {url(other)}));
  const std::string wanted = session::image_reference(other).sha256;
  ASSERT_TRUE(wait_until([&] { return test.bench().image().volume && !test.window().jobs().any(); }));
  testing::let_work(500);
  EXPECT_EQ(test.bench().image().reference.sha256, wanted);
  EXPECT_FALSE(test.bench().has_case());
}

}  // namespace
}  // namespace ostia::workstation
