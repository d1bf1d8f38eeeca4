#include "views/frame_log.h"

namespace ostia::workstation {

FrameLog& FrameLog::instance() {
  static FrameLog log;
  return log;
}

bool FrameLog::open(const QString& path) {
  file_ = std::make_unique<QFile>(path);
  if (!file_->open(QIODevice::WriteOnly | QIODevice::Text)) file_.reset();
  return on();
}

void FrameLog::input(std::uint32_t display_ms) {
  if (!on()) return;
  constexpr std::uint32_t longest_ms = 5000;
  const auto monotonic_ms = static_cast<std::uint32_t>(clock_.msecsSinceReference() + clock_.elapsed());
  const std::uint32_t waited_ms = monotonic_ms - display_ms;  // the display's time wraps around
  input_ms_ = now_ms() - (waited_ms < longest_ms ? waited_ms : 0);
}

void FrameLog::event(const char* kind) {
  if (!on()) return;
  ++event_;
  kind_ = QString::fromLatin1(kind);
  event_ms_ = input_ms_;
}

void FrameLog::painted(const QString& view, double paint_ms, std::optional<std::uint64_t> picture) {
  if (!on()) return;
  const double now = now_ms();
  write(QStringLiteral(
            "{\"t_ms\":%1,\"view\":\"%2\",\"event\":%3,\"kind\":\"%4\",\"after_ms\":%5,\"paint_ms\":%6%7}")
            .arg(now, 0, 'f', 2)
            .arg(view)
            .arg(event_)
            .arg(kind_)
            .arg(now - event_ms_, 0, 'f', 2)
            .arg(paint_ms, 0, 'f', 2)
            .arg(picture ? QStringLiteral(",\"picture\":%1").arg(*picture) : QString()));
}

void FrameLog::blocked(double ms) {
  if (!on()) return;
  write(QStringLiteral("{\"t_ms\":%1,\"blocked_ms\":%2}").arg(now_ms(), 0, 'f', 2).arg(ms, 0, 'f', 1));
}

void FrameLog::placed(const QString& view, const QRect& on_screen) {
  if (!on() || places_[view] == on_screen) return;
  places_[view] = on_screen;
  write(QStringLiteral("{\"t_ms\":%1,\"view\":\"%2\",\"x\":%3,\"y\":%4,\"width\":%5,\"height\":%6}")
            .arg(now_ms(), 0, 'f', 2)
            .arg(view)
            .arg(on_screen.x())
            .arg(on_screen.y())
            .arg(on_screen.width())
            .arg(on_screen.height()));
}

void FrameLog::write(const QString& line) {
  file_->write(line.toUtf8() + '\n');
  file_->flush();
}

}  // namespace ostia::workstation
