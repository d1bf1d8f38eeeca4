// FFR along the selected vessel in its profile: as it is, what it would be, and the threshold.
#include "ostia/core/quantity_text.h"
#include "ostia/figure/plot.h"
#include "ostia/session/pressure_board.h"
#include "ostia/view/pressure_layer.h"
#include "ostia/view/profile_view.h"
#include "ostia/view/words.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {
namespace {

constexpr double ffr_room_px = 46.0;  // of its axis at the right, with its numbers
constexpr double top_ffr = 1.1, usual_low_ffr = 0.5;

}  // namespace

void ProfileView::set_pressure(session::PressureBoard* board) {
  pressure_changes_.clear();
  pressure_ = board;
  if (board) {
    pressure_changes_.push_back(board->shown.observe([this](const bool&) { touch(); }));
    pressure_changes_.push_back(board->changed.observe([this] { touch(); }));
  }
  touch();
}

bool ProfileView::ffr_drawn() const {
  return pressure_ && pressure_->shown.get() && pressure_->now();
}

double ProfileView::ffr_room() const {
  return ffr_drawn() ? ffr_room_px : 0.0;
}

void ProfileView::add_ffr(const Frame& f) {
  if (!ffr_drawn()) return;
  const session::PressureReport& now = *pressure_->now();
  const std::vector<session::FfrPoint> along = session::ffr_along(now, bench_.vessel.get());
  if (along.empty()) return;
  double low = usual_low_ffr;
  for (const session::FfrPoint& one : along)
    for (const double value : {one.ffr, one.after, one.low})
      if (std::isfinite(value)) low = std::min(low, std::floor(10.0 * value) / 10.0);
  low = std::max(0.0, low);
  const auto y = [&](double value) { return f.y((value - low) / (top_ffr - low)); };
  const auto curve = [&](Role role, bool dashed, double session::FfrPoint::*value) {
    OverlayLine line{{}, role, 1.0, dashed};
    const auto end = [&] {
      if (line.px.size() > 1) overlay_.lines.push_back(line);
      line.px.clear();
    };
    for (const session::FfrPoint& one : along) {
      if (std::isfinite(one.*value))
        line.px.emplace_back(f.x(one.s_mm), y(one.*value));
      else
        end();
    }
    end();
  };
  const double threshold = now.options.reading.threshold;
  overlay_.lines.push_back(
      {{Vec2(f.left, y(threshold)), Vec2(f.right, y(threshold))}, Role::pressure, 0.45, true});
  for (std::size_t i = 0; i + 1 < along.size(); ++i) {
    const session::FfrPoint &a = along[i], &b = along[i + 1];
    const double least = 0.5 * (a.low + b.low), most = 0.5 * (a.high + b.high);
    if (!std::isfinite(least + most)) continue;
    overlay_.bands.push_back({Vec2(f.x(a.s_mm), y(most)), Vec2(f.x(b.s_mm), y(least)), Role::pressure, 0.22});
  }
  curve(Role::what_if, true, &session::FfrPoint::after);
  curve(Role::pressure, false, &session::FfrPoint::ffr);
  add_ffr_axis(f, low, threshold);
}

void ProfileView::add_ffr_axis(const Frame& f, double low, double threshold) {
  const double left = f.right + flow_room_px() * density_;
  const auto y = [&](double value) { return f.y((value - low) / (top_ffr - low)); };
  overlay_.lines.push_back({{Vec2(left, f.top), Vec2(left, f.bottom)}, Role::pressure, 0.6});
  const int rows = std::max(2, static_cast<int>((f.bottom - f.top) / (28.0 * density_)));
  const std::vector<double> ticks = figure::nice_ticks(low, 1.0, rows);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
  const double apart = 13.0 * density_;
  for (const double value : ticks)
    if (std::abs(y(value) - y(threshold)) > apart)
      add_tick(Vec2(left + 4.0 * density_, y(value)), figure::tick_text(value, step), Role::pressure,
               Anchor::left);
  add_tick(Vec2(left + 4.0 * density_, y(threshold)), core::ratio_text(threshold), Role::pressure,
           Anchor::left);
  add_text(Vec2(width_ - 4.0 * density_, (flow_room_px() > 0.0 ? 31.0 : 3.0) * density_), words().ffr,
           Role::pressure, Anchor::top_right);
}

}  // namespace ostia::view
