#include "shell/file_dialogs.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>

namespace ostia::workstation {
namespace {

/// Since the program began; in memory alone.
QString& last_folder() {
  static QString folder = QDir::currentPath();
  return folder;
}

void begin_in(QFileDialog& dialog, const QString& start) {
  const QFileInfo place(start);
  if (!start.isEmpty() && place.isDir()) {
    dialog.setDirectory(place.absoluteFilePath());
  } else if (!start.isEmpty() && place.dir().exists()) {
    dialog.setDirectory(place.absolutePath());
    dialog.selectFile(place.fileName());
  } else {
    dialog.setDirectory(last_folder());
  }
}

/// When a dialog goes, Qt writes where it was and its history to QtProject.conf. No file can be made below a
/// device: there is nothing that a crash could leave.
void keep_no_settings() {
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, QStringLiteral("/dev/null"));
}

QString ask(QWidget* parent, const QString& title, const QString& filter, const QString& start,
            QFileDialog::AcceptMode accept, QFileDialog::FileMode mode, bool may_replace = true) {
  keep_no_settings();
  QFileDialog dialog(parent, title);
  // The desktop's own dialog notes recent files for all programs.
  dialog.setOption(QFileDialog::DontUseNativeDialog);
  dialog.setOption(QFileDialog::ShowDirsOnly, mode == QFileDialog::Directory);
  dialog.setOption(QFileDialog::DontConfirmOverwrite, !may_replace);
  dialog.setAcceptMode(accept);
  dialog.setFileMode(mode);
  if (!filter.isEmpty()) dialog.setNameFilter(filter);
  begin_in(dialog, start);
  if (dialog.exec() != QDialog::Accepted || dialog.selectedFiles().isEmpty()) return {};
  const QString chosen = dialog.selectedFiles().front();
  last_folder() = QFileInfo(chosen).absolutePath();
  return chosen;
}

}  // namespace

QString ask_open_file(QWidget* parent, const QString& title, const QString& filter, const QString& start) {
  return ask(parent, title, filter, start, QFileDialog::AcceptOpen, QFileDialog::ExistingFile);
}

QString ask_save_file(QWidget* parent, const QString& title, const QString& filter, const QString& start) {
  return ask(parent, title, filter, start, QFileDialog::AcceptSave, QFileDialog::AnyFile);
}

QString ask_new_file(QWidget* parent, const QString& title, const QString& filter, const QString& start) {
  return ask(parent, title, filter, start, QFileDialog::AcceptSave, QFileDialog::AnyFile, false);
}

QString ask_folder(QWidget* parent, const QString& title, const QString& start) {
  return ask(parent, title, {}, start, QFileDialog::AcceptOpen, QFileDialog::Directory);
}

}  // namespace ostia::workstation
