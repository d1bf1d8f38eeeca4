#include "folder_trouble.h"

#include <QCoreApplication>
#include <QFileInfo>

namespace ostia::workstation {
namespace {

/// The words of the dialogs that export surfaces and meshes.
QString words(const char* text) {
  return QCoreApplication::translate("ostia::workstation::MeshingDialog", text);
}

constexpr const char* no_name = QT_TRANSLATE_NOOP("ostia::workstation::MeshingDialog", "Name a new folder.");
constexpr const char* a_file = QT_TRANSLATE_NOOP("ostia::workstation::MeshingDialog",
                                                 "There is a file of this name. Name another folder.");
constexpr const char* nowhere =
    QT_TRANSLATE_NOOP("ostia::workstation::MeshingDialog", "There is no folder %1.");
constexpr const char* closed = QT_TRANSLATE_NOOP("ostia::workstation::MeshingDialog",
                                                 "Nothing can be written in %1. Choose another place.");

}  // namespace

QString folder_trouble(const QString& path) {
  const QFileInfo folder(path), parent(folder.absolutePath());
  if (path.isEmpty() || folder.fileName().isEmpty() || folder.fileName() == "." || folder.fileName() == "..")
    return words(no_name);
  if (folder.exists() && !folder.isDir()) return words(a_file);
  if (!parent.exists()) return words(nowhere).arg(parent.filePath());
  if (!parent.isDir() || !parent.isWritable()) return words(closed).arg(parent.filePath());
  return {};
}

}  // namespace ostia::workstation
