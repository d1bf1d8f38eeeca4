#include "ostia/view/pressure_layer.h"

#include "ostia/core/quantity_text.h"
#include "ostia/view/words.h"

namespace ostia::view {
namespace {

constexpr double ffr_text_units = 15.0, threshold_units = 26.0, border_units = 6.0;

}  // namespace

std::string ffr_text(const std::optional<double>& ffr, const std::optional<session::FfrInterval>& interval) {
  const std::string text = words().ffr + " " + core::ratio_text(ffr);
  if (!ffr || !interval) return text;
  return text + " (" + core::ratio_text(interval->low) + "\xE2\x80\x93" + core::ratio_text(interval->high) +
         ")";
}

std::string what_if_text(const std::optional<double>& ffr) {
  return words().what_if + " " + core::ratio_text(ffr);
}

PressureLayer::PressureLayer(CurvedView& view, session::PressureBoard& board) : view_(view), board_(board) {
  view_.set_layer([this](Overlay& overlay) { add(overlay); }, PictureView::LayerPlace::pressure);
  own_.push_back(board.shown.observe([this](const bool&) { view_.touch_layer(); }));
  own_.push_back(board.changed.observe([this] { view_.touch_layer(); }));
}

PressureLayer::~PressureLayer() {
  view_.set_layer({}, PictureView::LayerPlace::pressure);
}

void PressureLayer::add(Overlay& overlay) const {
  const std::shared_ptr<const session::PressureReport>& now = board_.now();
  session::Workbench& bench = view_.bench();
  if (!board_.shown.get() || !now || !view_.ready() || !bench.axis()) return;
  const double unit = view_.density(), right = view_.width() - border_units * unit;
  const std::int32_t vessel = bench.vessel.get();
  const double s = bench.own_mm(bench.cursor_mm.get());
  const double row = view_.row_of(bench.cursor_mm.get());
  overlay.texts.push_back(
      {Vec2(right, row - 2.0 * unit),
       ffr_text(session::ffr_at(*now, vessel, s), session::ffr_interval_at(*now, vessel, s)), Role::pressure,
       Anchor::bottom_right});
  if (now->after)
    overlay.texts.push_back({Vec2(right, row + 2.0 * unit),
                             what_if_text(session::ffr_after_at(*now, vessel, s)), Role::what_if,
                             Anchor::top_right});
  const double threshold = now->options.reading.threshold;
  const auto falls = session::falls_to_threshold_mm(session::ffr_along(*now, vessel), threshold);
  if (!falls) return;
  const double at = view_.row_of(bench.here_mm(*falls));
  overlay.lines.push_back(
      {{Vec2(right - threshold_units * unit, at), Vec2(right, at)}, Role::pressure, 0.9, true});
  // Where the cursor's own text does not stand.
  if (std::abs(at - row) > 2.0 * ffr_text_units * unit)
    overlay.texts.push_back(
        {Vec2(right, at + 2.0 * unit), core::ratio_text(threshold), Role::pressure, Anchor::top_right});
}

}  // namespace ostia::view
