#pragma once
/// \file How long the window takes from an event to the picture that answers it.

#include <QElapsedTimer>
#include <QFile>
#include <QMap>
#include <QRect>
#include <QString>
#include <cstdint>
#include <memory>
#include <optional>

namespace ostia::workstation {

/// One JSON line a painted view: {"t_ms":...,"view":"cpr1","event":12,"after_ms":8.4,"paint_ms":3.1,
/// "picture":2}, the last one the number of the picture painted (0: none yet; the tree has no numbers);
/// `after_ms` runs from the last input of the user that any view had to answer to the end of painting. Blocks
/// of the interface's thread longer than 50 ms are lines of their own: {"t_ms":...,"blocked_ms":73}. Off
/// until a file is named.
class FrameLog {
 public:
  static FrameLog& instance();
  bool open(const QString& path);  ///< false where it cannot be written
  bool on() const { return file_ != nullptr; }
  /// The display's own time of the input that is being handled, in milliseconds of the monotonic clock: what
  /// waited for its turn is counted from when the hand moved. Times that cannot be meant are passed over.
  void input(std::uint32_t display_ms);
  void event(const char* kind);  ///< the user did something
  void painted(const QString& view, double paint_ms, std::optional<std::uint64_t> picture = {});
  void blocked(double ms);
  /// Where a view is on the screen: {"view":"cpr1","x":300,"y":90,"width":280,"height":700}.
  void placed(const QString& view, const QRect& on_screen);

 private:
  FrameLog() { clock_.start(); }
  void write(const QString& line);
  double now_ms() const { return static_cast<double>(clock_.nsecsElapsed()) / 1e6; }
  QElapsedTimer clock_;
  std::unique_ptr<QFile> file_;
  QMap<QString, QRect> places_;  // as they were last written
  std::uint64_t event_ = 0;
  QString kind_;
  double event_ms_ = 0.0, input_ms_ = 0.0;
};

}  // namespace ostia::workstation
