// What a person chooses is not left among the settings of the user.

#include "shell/file_dialogs.h"

#include "window_hand.h"

#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QSettings>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr const char* name = "Jane";  // of the patient, as it stands in the folder's

/// The user's own folder, made before Qt looks for it.
const testing::Folder& home() {
  static const testing::Folder folder;
  return folder;
}

/// What below the user's folder holds the name, in its own name or its content.
std::vector<std::string> traces() {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(home() / "")) {
    const std::string path = fs::relative(entry.path(), home() / "").string();
    const std::string content = entry.is_regular_file() ? core::read_file(entry.path()) : "";
    if ((path + content).find(name) != std::string::npos) found.push_back(path);
  }
  return found;
}

struct FileDialogs : ::testing::Test {
  testing::Folder folder;
  fs::path patient = folder / "Doe^Jane", image = patient / "heart.nrrd";
  FileDialogs() {
    fs::remove_all(home() / ".config");
    fs::create_directories(patient / "series");
    core::write_file(image, "an image");
  }
};

/// In the next dialog goes to the folder of `answer`, as by double clicks, and chooses it there. `seen`:
/// where the dialog was when it came up.
void choose(const fs::path& answer, std::string* seen = nullptr) {
  QTimer::singleShot(300, [=] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (!dialog) return;
    if (seen) *seen = dialog->directory().absolutePath().toStdString();
    dialog->setDirectory(QString::fromStdString(answer.parent_path().string()));
    dialog->findChild<QLineEdit*>()->setText(QString::fromStdString(answer.filename().string()));
    QMetaObject::invokeMethod(dialog, "accept");
  });
}

TEST_F(FileDialogs, ABareDialogOfQtLeavesThePath) {
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope,
                     QString::fromStdString((home() / ".config").string()));
  choose(image);
  EXPECT_EQ(QFileDialog::getOpenFileName(nullptr, "Open").toStdString(), image.string());
  EXPECT_THAT(traces(), ElementsAre(".config/QtProject.conf"));
}

TEST_F(FileDialogs, LeaveNothingOfWhatWasChosen) {
  choose(image);
  EXPECT_EQ(ask_open_file(nullptr, "Open", "Images (*.nrrd);;All files (*)").toStdString(), image.string());
  choose(patient / "new.ostia");
  EXPECT_EQ(ask_save_file(nullptr, "Save", "Cases (*.ostia)").toStdString(),
            (patient / "new.ostia").string());
  choose(patient / "series");
  EXPECT_EQ(ask_folder(nullptr, "Open a folder").toStdString(), (patient / "series").string());
  EXPECT_THAT(traces(), IsEmpty());
}

TEST_F(FileDialogs, LeaveNothingOfWhatWasOnlyLookedAt) {
  QTimer::singleShot(300, [] {
    if (auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget())) dialog->reject();
  });
  EXPECT_TRUE(ask_open_file(nullptr, "Open", {}, QString::fromStdString(image.string())).isEmpty());
  EXPECT_THAT(traces(), IsEmpty());
}

TEST_F(FileDialogs, BeginWhereThePersonWasLast) {
  fs::create_directories(folder / "elsewhere");
  std::string seen;
  choose(image);
  ask_open_file(nullptr, "Open");
  choose(folder / "elsewhere" / "new.ostia", &seen);
  ask_save_file(nullptr, "Save");
  EXPECT_EQ(seen, patient.string());
  choose(patient / "series", &seen);
  ask_folder(nullptr, "Open a folder");
  EXPECT_EQ(seen, (folder / "elsewhere").string());
  choose(image, &seen);
  ask_open_file(nullptr, "Open", {}, QString::fromStdString((patient / "series").string()));
  EXPECT_EQ(seen, (patient / "series").string());
}

TEST_F(FileDialogs, AreTheOnlyOnesOfTheWorkstation) {
  std::vector<std::string> others;
  int seen = 0;
  for (const auto& entry : fs::recursive_directory_iterator(OSTIA_WORKSTATION_SOURCES)) {
    if (!entry.is_regular_file() || entry.path().filename() == "file_dialogs.cpp") continue;
    ++seen;
    if (core::read_file(entry.path()).find("<QFileDialog>") != std::string::npos)
      others.push_back(entry.path().filename().string());
  }
  EXPECT_GT(seen, 100) << "sources of the workstation";
  EXPECT_THAT(others, IsEmpty());
}

}  // namespace
}  // namespace ostia::workstation

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  using ostia::workstation::home;
  const auto set = [](const char* variable, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    qputenv(variable, QByteArray::fromStdString(folder.string()));
  };
  set("HOME", home() / "");
  set("XDG_CONFIG_HOME", home() / ".config");
  set("XDG_DATA_HOME", home() / ".local/share");
  set("XDG_STATE_HOME", home() / ".local/state");
  set("XDG_CACHE_HOME", home() / ".cache");
  QApplication application(argc, argv);
  QApplication::setApplicationName("ostia");
  return RUN_ALL_TESTS();
}
