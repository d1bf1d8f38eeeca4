#pragma once
/// \file The program itself under real events of the X server.

#include "window_hand.h"

#include "ostia/core/files.h"

#include <QElapsedTimer>
#include <QProcess>
#include <QStringList>
#include <filesystem>
#include <string>

namespace ostia::workstation::testing {

/// What xdotool says.
inline QString xdo(const QStringList& arguments) {
  QProcess process;
  process.start("xdotool", arguments);
  process.waitForFinished();
  return QString::fromUtf8(process.readAllStandardOutput());
}

/// Killed at the end.
struct Program {
  QProcess process;
  explicit Program(const QStringList& arguments) {
    process.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    process.start(OSTIA_WORKSTATION, arguments);
    process.waitForStarted();
  }
  ~Program() {
    process.kill();
    process.waitForFinished();
  }
  bool runs() { return !process.waitForFinished(0) && process.state() == QProcess::Running; }
  /// Windows on the screen, named by what stands in their title.
  QStringList windows(const QString& title) const {
    return xdo({"search", "--onlyvisible", "--name", title}).split('\n', Qt::SkipEmptyParts);
  }
};

/// How often a view stands in a frame log.
inline int frames(const std::filesystem::path& log, const std::string& view) {
  std::error_code ignored;
  if (!std::filesystem::exists(log, ignored)) return 0;
  const std::string text = core::read_file(log), wanted = "\"view\":\"" + view + "\"";
  int count = 0;
  for (std::size_t at = text.find(wanted); at != std::string::npos; at = text.find(wanted, at + 1)) ++count;
  return count;
}

/// Waits until a CPR has been painted, and nothing more for a while.
inline bool settled(const std::filesystem::path& log) {
  int last = -1;
  QElapsedTimer quiet;
  quiet.start();
  return wait_until(
      [&] {
        const int now = frames(log, "cpr1");
        if (now != last) quiet.restart();
        last = now;
        return now > 0 && quiet.elapsed() > 1500;
      },
      40000);
}

}  // namespace ostia::workstation::testing
