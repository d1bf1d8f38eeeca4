#include "shell/open_file.h"

#include "shell/desk.h"

#include <QCoreApplication>
#include <QDesktopServices>
#include <QProcess>
#include <QStandardPaths>
#include <QUrl>

namespace ostia::workstation {
namespace {

void cannot(const Desk& desk, const std::filesystem::path& path) {
  const QString where = QString::fromStdString(path.string());
  desk.messages.complain(
      QCoreApplication::translate("open_file", "This computer has no program that opens it. It is at %1.")
          .arg(where),
      QCoreApplication::translate("open_file", "%1 cannot be opened")
          .arg(QString::fromStdString(path.filename().string())));
}

}  // namespace

void open_with_desktop(const Desk& desk, const std::filesystem::path& path) {
  const QString opener = QStandardPaths::findExecutable("xdg-open");
  if (opener.isEmpty()) {
    if (!QDesktopServices::openUrl(QUrl::fromLocalFile(QString::fromStdString(path.string()))))
      cannot(desk, path);
    return;
  }
  // Without a parent: the viewer may be its child, and stays when the window goes.
  auto* process = new QProcess;
  process->setStandardOutputFile(QProcess::nullDevice());
  process->setStandardErrorFile(QProcess::nullDevice());
  const auto done = QOverload<int, QProcess::ExitStatus>::of(&QProcess::finished);
  QObject::connect(process, done, process, &QObject::deleteLater);
  QObject::connect(process, done, &desk.window, [&desk, path](int code, QProcess::ExitStatus) {
    if (code != 0) cannot(desk, path);
  });
  QObject::connect(process, &QProcess::errorOccurred, &desk.window,
                   [&desk, process, path](QProcess::ProcessError error) {
                     if (error != QProcess::FailedToStart) return;
                     cannot(desk, path);
                     process->deleteLater();
                   });
  process->start(opener, {QString::fromStdString(path.string())});
}

}  // namespace ostia::workstation
