#pragma once
/// \file The program itself under real events of the X server.

#include "window_hand.h"

#include "ostia/core/files.h"

#include <QElapsedTimer>
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QPoint>
#include <QProcess>
#include <QProcessEnvironment>
#include <QRect>
#include <QStringList>
#include <QTest>
#include <algorithm>
#include <cstdlib>
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

/// The mouse to a place of the screen, and what it then does ("click 1").
inline void go(const QPoint& at, const QStringList& then = {}) {
  xdo(QStringList{"mousemove", QString::number(at.x()), QString::number(at.y())} + then);
}
/// With the main button down from place to place, in steps of a pixel or `step_px`.
inline void pull(const QPoint& from, const QPoint& to, int step_px = 1) {
  constexpr int rest_ms = 30;
  const QPoint way = to - from;
  const int steps = std::max(1, std::max(std::abs(way.x()), std::abs(way.y())) / step_px);
  go(from);
  QTest::qWait(rest_ms);
  xdo({"mousedown", "1"});
  for (int i = 1; i <= steps; ++i) {
    go(from + way * i / steps);
    QTest::qWait(rest_ms);
  }
  xdo({"mouseup", "1"});
}
/// One after the other.
inline void keys(const QStringList& names) {
  for (const QString& name : names) {
    xdo({"key", "--delay", "60", name});
    QTest::qWait(120);
  }
}

/// Killed at the end.
struct Program {
  QProcess process;
  explicit Program(const QStringList& arguments, const QProcessEnvironment& environment = {},
                   QProcess::ProcessChannelMode channels = QProcess::ForwardedErrorChannel) {
    process.setProcessChannelMode(channels);
    if (!environment.isEmpty()) process.setProcessEnvironment(environment);
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

/// The last line of a frame log that has these; empty where there is none.
inline QJsonObject last_line(const std::filesystem::path& log, const QString& view, const QString& with) {
  QFile file(QString::fromStdString(log.string()));
  QJsonObject last;
  if (!file.open(QIODevice::ReadOnly)) return last;
  for (const QByteArray& line : file.readAll().split('\n')) {
    const QJsonObject one = QJsonDocument::fromJson(line).object();
    if (one["view"].toString() == view && one.contains(with)) last = one;
  }
  return last;
}
/// The number of the picture that a view shows; 0 before there is one.
inline int picture(const std::filesystem::path& log, const QString& view) {
  return last_line(log, view, "picture")["picture"].toInt();
}
/// Where on the screen a view is.
inline QRect place(const std::filesystem::path& log, const QString& view) {
  const QJsonObject line = last_line(log, view, "width");
  return QRect(line["x"].toInt(), line["y"].toInt(), line["width"].toInt(), line["height"].toInt());
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
        return now > 0 && quiet.elapsed() > 800;
      },
      40000);
}

}  // namespace ostia::workstation::testing
