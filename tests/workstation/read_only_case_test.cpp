// A case in a file or folder that may not be written: it is opened for reading, says so, refuses edits with
// one message, and a copy of it can be edited.

#include "tube_window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <QStatusBar>
#include <cstdlib>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::wait_until;

/// This process as a user who may write nowhere but into what is theirs; the superuser may write everywhere.
class PlainUser {
 public:
  PlainUser() : was_(::geteuid()) {
    if (was_ == 0) changed_ = ::seteuid(nobody) == 0;
  }
  ~PlainUser() {
    if (changed_ && ::seteuid(was_) != 0) std::abort();
  }
  PlainUser(const PlainUser&) = delete;
  PlainUser& operator=(const PlainUser&) = delete;
  static constexpr uid_t nobody = 65534;

 private:
  uid_t was_;
  bool changed_ = false;
};

struct ReadOnlyCase : testing::TubeWindow {
  fs::path own = folder / "own";  // of the plain user, who keeps the program's state there
  std::unique_ptr<PlainUser> user;
  ReadOnlyCase() {
    fs::create_directories(own);
    fs::rename(folder / "state", own / "state");
    fs::permissions(folder / ".", fs::perms(0755));
    fs::permissions(case_file, fs::perms(0644));
    fs::permissions(image, fs::perms(0644));
  }
  ~ReadOnlyCase() override {
    test.reset();
    user.reset();
    fs::permissions(folder / ".", fs::perms(0700));
  }
  static void give_away(const fs::path& path) {
    if (::geteuid() != 0) return;
    ASSERT_EQ(::chown(path.c_str(), PlainUser::nobody, PlainUser::nobody), 0);
  }
  void open_it() {
    test = std::make_unique<testing::TestWindow>(own / "state");
    for (const auto& entry : fs::recursive_directory_iterator(own)) give_away(entry.path());
    give_away(own);
    user = std::make_unique<PlainUser>();
    test->open(case_file);
    ASSERT_TRUE(wait_until([&] { return test->bench().image().volume != nullptr; }));
  }
  void expect_read_only() {
    EXPECT_THAT(window().statusBar()->currentMessage().toStdString(), HasSubstr("read-only"));
    EXPECT_THAT(window().windowTitle().toStdString(), HasSubstr("read-only"));
    EXPECT_TRUE(part<QLabel>("read_only")->isVisible());
    EXPECT_FALSE(test->bench().session().file().editable());
  }
  void pull_wall() {
    lumen::WallDrag pull;
    pull.vessel = test->bench().vessel.get();
    const auto axis = test->bench().axis();
    pull.from = axis->place(12.0, 0.0, testing::tube_radius_mm);
    pull.to = axis->place(12.0, 0.0, 1.4 * testing::tube_radius_mm);
    test->bench().edit(pull);
  }
};

TEST_F(ReadOnlyCase, InAFolderThatMayNotBeWrittenIsOpenedAndSaysSo) {
  if (::geteuid() == 0) give_away(case_file);  // the file could be written, beside it nothing
  fs::permissions(folder / ".", fs::perms(0555));
  open_it();
  expect_read_only();
}

TEST_F(ReadOnlyCase, AFileThatMayNotBeWrittenIsOpenedAndSaysSo) {
  if (::geteuid() == 0) give_away(folder / ".");
  fs::permissions(case_file, fs::perms(0444));
  open_it();
  expect_read_only();
}

TEST_F(ReadOnlyCase, AnEditIsRefusedWithOneMessageThatSaysWhatToDo) {
  fs::permissions(folder / ".", fs::perms(0555));
  open_it();
  const auto before = test->bench().session().file().model();
  // As the brush does: many times in one gesture.
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(window().desk().messages.guarded([this] { pull_wall(); }));
  ASSERT_EQ(testing::open_boxes().size(), 1u);
  const std::string said = testing::message();
  EXPECT_THAT(said, HasSubstr("not changed"));
  EXPECT_THAT(said, HasSubstr("Save the case as"));
  EXPECT_EQ(said.find(case_file.string()), std::string::npos);
  EXPECT_EQ(test->bench().session().file().model(), before);
}

TEST_F(ReadOnlyCase, TheMouseIsRefusedToo) {
  fs::permissions(folder / ".", fs::perms(0555));
  open_it();
  part<QAction>("vessel.split")->trigger();
  EXPECT_THAT(testing::message(), HasSubstr("Save the case as"));
}

TEST_F(ReadOnlyCase, LookingAroundAndClosingItSaysNothing) {
  fs::permissions(folder / ".", fs::perms(0555));
  open_it();
  window().statusBar()->clearMessage();
  test->bench().cursor_mm.set(20.0);
  testing::let_work(1500);  // when the place would be kept
  part<QAction>("file.close")->trigger();
  EXPECT_EQ(window().statusBar()->currentMessage(), "");
  EXPECT_TRUE(testing::open_boxes().empty());
  EXPECT_EQ(window().windowTitle(), "Ostia");
  EXPECT_FALSE(part<QLabel>("read_only")->isVisible());
}

TEST_F(ReadOnlyCase, ItsCopyCanBeEdited) {
  fs::permissions(folder / ".", fs::perms(0555));
  open_it();
  testing::answer_file_dialog(own / "copy.ostia");
  part<QAction>("file.save_as")->trigger();
  ASSERT_TRUE(
      wait_until([&] { return window().desk().case_path == own / "copy.ostia" && !window().jobs().any(); }));
  EXPECT_EQ(window().windowTitle(), "Ostia");
  EXPECT_FALSE(part<QLabel>("read_only")->isVisible());
  EXPECT_TRUE(window().desk().messages.guarded([this] { pull_wall(); }));
  EXPECT_EQ(test->bench().session().file().edits().size(), 1u);
}

TEST_F(ReadOnlyCase, OneThatMayBeWrittenSaysNothingOfIt) {
  open_case();
  EXPECT_EQ(window().windowTitle(), "Ostia");
  EXPECT_FALSE(part<QLabel>("read_only")->isVisible());
}

}  // namespace
}  // namespace ostia::workstation
