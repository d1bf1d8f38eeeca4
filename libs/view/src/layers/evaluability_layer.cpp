#include "ostia/view/evaluability_layer.h"

#include "ostia/view/words.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {
namespace {

using analysis::Evaluability;
using analysis::EvaluableStretch;

constexpr double left_units = 6.0, right_units = 10.0, text_units = 16.0;  // of the band, and height of words

std::string grade_text(const EvaluableStretch& stretch) {
  const Words& w = words();
  const std::string text = stretch.grade == Evaluability::evaluable ? w.evaluable
                           : stretch.grade == Evaluability::limited ? w.limited
                                                                    : w.not_evaluable;
  return stretch.by_person ? text + " (" + w.by_reader + ")" : text;
}

/// The grade at the stretch's beginning and the reasons below it, as far as there is room; beside the titles
/// and the directions of the patient, which stand at the top and half-way down.
void add_words(Overlay& overlay, const CurvedView& view, const EvaluableStretch& stretch, double from_px,
               double to_px) {
  const double line = text_units * view.density(), middle = 0.5 * view.height();
  std::vector<std::string> lines{grade_text(stretch)};
  for (const analysis::EvaluabilityReason reason : stretch.reasons) lines.push_back(words().reason(reason));
  double y = std::max(from_px, 2.0 * line) + 0.5 * line;
  const double last = std::min(to_px, view.height() - 3.0 * line) - 0.5 * line;
  for (const std::string& text : lines) {
    if (std::abs(y - middle) < line) y = middle + line;
    if (y > last) return;
    overlay.texts.push_back(
        {Vec2((right_units + 3.0) * view.density(), y), text, role_of(stretch.grade), Anchor::left});
    y += line;
  }
}

}  // namespace

Role role_of(Evaluability grade) {
  return grade == Evaluability::not_evaluable ? Role::not_evaluable : Role::limited;
}

std::string text_of(const EvaluableStretch& stretch) {
  std::string text = grade_text(stretch);
  const char* between = ": ";
  for (const analysis::EvaluabilityReason reason : stretch.reasons) {
    text += between + words().reason(reason);
    between = ", ";
  }
  return text;
}

std::vector<EvaluableStretch> stretches_of_way(const session::EvaluabilityBoard& board,
                                               const session::Workbench& bench, std::int32_t vessel) {
  std::vector<EvaluableStretch> out;
  for (const analysis::WayStretch& owned : bench.way(vessel))
    for (EvaluableStretch one : board.stretches(owned.vessel)) {
      one.from_mm = std::max(one.from_mm, owned.from_mm), one.to_mm = std::min(one.to_mm, owned.to_mm);
      if (one.from_mm < one.to_mm) out.push_back(std::move(one));
    }
  return out;
}

EvaluabilityLayer::EvaluabilityLayer(CurvedView& view, session::EvaluabilityBoard& board) : view_(view) {
  view_.set_layer(
      [this, &board](Overlay& overlay) {
        session::Workbench& bench = view_.bench();
        if (!board.shown.get() || !view_.ready()) return;
        const double unit = view_.density();
        for (const EvaluableStretch& one : stretches_of_way(board, bench, bench.vessel.get())) {
          if (one.grade == Evaluability::evaluable) continue;
          const double from = view_.row_of(bench.here_mm(one.from_mm)),
                       to = view_.row_of(bench.here_mm(one.to_mm));
          const Role role = role_of(one.grade);
          overlay.bands.push_back({Vec2(left_units * unit, from), Vec2(right_units * unit, to), role, 0.85});
          add_words(overlay, view_, one, from, to);
        }
      },
      PictureView::LayerPlace::evaluability);
  own_.push_back(board.shown.observe([this](const bool&) { view_.touch_layer(); }));
  own_.push_back(board.changed.observe([this] { view_.touch_layer(); }));
}

EvaluabilityLayer::~EvaluabilityLayer() {
  view_.set_layer({}, PictureView::LayerPlace::evaluability);
}

}  // namespace ostia::view
