// Zips opened through the window, good ones and bad ones.

#include "tube_case.h"
#include "window_hand.h"
#include "zip_writer.h"

#include "ostia/core/files.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QDialog>
#include <tuple>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::message;
using testing::TestWindow;
using testing::tube_image;
using testing::wait_until;

struct ZipOpening : ::testing::Test {
  testing::Folder folder;
  fs::path state = folder / "state";
  static int open_dialogs() {
    int count = 0;
    for (const QWidget* widget : QApplication::topLevelWidgets())
      if (qobject_cast<const QDialog*>(widget) && widget->isVisible()) ++count;
    return count;
  }
};

TEST_F(ZipOpening, ASeriesIsTheSameImageAsItsFolderAndABadOneIsRefused) {
  const fs::path dicom = folder / "dicom", zip = folder / "series.zip", bad = folder / "bad.zip";
  imaging::write_dicom_series(dicom, tube_image());
  std::vector<ostia::testing::ZipMember> members;
  for (const auto& entry : fs::directory_iterator(dicom))
    members.push_back({"series/" + entry.path().filename().string(), core::read_file(entry.path()), true});
  core::write_file(zip, ostia::testing::zip_bytes(members));
  std::string of_zip, of_folder;
  for (const auto& [path, digest] : {std::pair(zip, &of_zip), {dicom, &of_folder}}) {
    TestWindow test(folder / ("state-" + path.filename().string()));
    test.window().open(path);
    ASSERT_TRUE(wait_until(
        [&] { return !test.bench().image().reference.sha256.empty() && !test.window().jobs().any(); }));
    EXPECT_EQ(test.bench().image().volume->geometry.size[2], 110);
    *digest = test.bench().image().reference.sha256;
  }
  EXPECT_EQ(of_zip, of_folder);
  members.front().name = "../escaped.dcm";
  core::write_file(bad, ostia::testing::zip_bytes(members));
  TestWindow test(state);
  test.window().open(bad);
  EXPECT_NE(test.failure().find("zip"), std::string::npos);
  EXPECT_FALSE(test.bench().image().volume);
  EXPECT_FALSE(fs::exists(folder / "escaped.dcm"));
}

TEST_F(ZipOpening, ABombIsRefusedInOneDialogAndTheOpenCaseStays) {
  const fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia";
  imaging::write_image(image, tube_image());
  session::CaseFile::create(case_file, testing::tube_model(), session::image_reference(image));
  session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
  TestWindow test(state);
  test.open(case_file);
  const lumen::LumenModel* model = test.bench().model();
  fs::create_directory(folder / "temporary");
  qputenv("TMPDIR", (folder / "temporary").c_str());
  // 256 MiB of nothing in some 250 KiB, and what declares less than it holds.
  const ostia::testing::ZipMember dense{"IM1", std::string(256 << 20, '\0'), true};
  const ostia::testing::ZipMember liar{"IM1", std::string(4 << 20, '\0'), true, 0, 0, 1000};
  for (const auto& [name, member, why] :
       {std::tuple("dense.zip", dense, "more than any image does"), {"liar.zip", liar, "is damaged"}}) {
    core::write_file(folder / name, ostia::testing::zip_bytes({member}));
    testing::answer_file_dialog(folder / name);
    test.window().findChild<QAction*>("file.open")->trigger();
    ASSERT_TRUE(wait_until([&] { return !test.window().jobs().any(); }));
    EXPECT_THAT(message(), AllOf(HasSubstr(name), HasSubstr(why)));
    EXPECT_EQ(open_dialogs(), 0) << name;
    EXPECT_TRUE(fs::is_empty(folder / "temporary")) << name;
    EXPECT_EQ(test.bench().model(), model);
    EXPECT_EQ(test.bench().image().volume->geometry.size[2], 110);
  }
  qunsetenv("TMPDIR");
}

}  // namespace
}  // namespace ostia::workstation
