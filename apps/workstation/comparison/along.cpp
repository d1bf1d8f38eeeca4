#include "comparison/along.h"

#include "shell/quantities.h"
#include "views/overlay_painter.h"

#include "ostia/core/text.h"
#include "ostia/figure/plot.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

using analysis::ChangeVerdict;
using view::Anchor;
using view::Role;
using view::Vec2;

constexpr double cursor_step_mm = 0.5;   // of an arrow key and of a wheel's step
constexpr double share_of_sizes = 0.62;  // of the plot's height; the difference has the rest
constexpr double least_reach_mm = 0.5;   // of the difference's axis
constexpr int font_px = 12;

const analysis::ScannedVessel* scanned_vessel_of(const session::ComparedCase& of, std::int32_t vessel) {
  const auto found = std::ranges::find(of.tree.vessels, vessel, &analysis::ScannedVessel::vessel);
  return found == of.tree.vessels.end() ? nullptr : &*found;
}

/// Linear between sections; nothing where one of them is not found.
std::optional<double> diameter_at(const analysis::LumenProfile& profile, double s_mm) {
  const auto& all = profile.sections;
  const auto next = std::ranges::lower_bound(all, s_mm, {}, &analysis::SectionMeasures::s_mm);
  if (next == all.end()) return std::nullopt;
  const auto last = next == all.begin() || next->s_mm == s_mm ? next : std::prev(next);
  if (!last->found || !next->found) return std::nullopt;
  const double span = next->s_mm - last->s_mm, share = span > 0.0 ? (s_mm - last->s_mm) / span : 0.0;
  return last->diameter_mm + share * (next->diameter_mm - last->diameter_mm);
}

Role role_of_change(ChangeVerdict verdict) {
  return verdict == ChangeVerdict::less ? Role::stenosis : Role::reference;
}

bool is_real(const ComparedPlace& place) {
  const ChangeVerdict verdict = place.diameter.verdict();
  return verdict == ChangeVerdict::less || verdict == ChangeVerdict::more;
}

}  // namespace

std::vector<ComparedPlace> compared_along(const session::Comparison& made, std::int32_t vessel) {
  using analysis::ChangeMeasure;
  using analysis::ChangeScope;
  const analysis::VesselMatch* match = made.change.match.of_after(vessel);
  const analysis::ScannedVessel* is = match ? scanned_vessel_of(made.after, vessel) : nullptr;
  const analysis::ScannedVessel* was = match ? scanned_vessel_of(made.before, match->before) : nullptr;
  std::vector<ComparedPlace> places;
  if (!is || !was) return places;
  for (const analysis::SectionMeasures& section : is->profile.sections) {
    const auto there = match->to_before(section.s_mm);
    const auto before = there ? diameter_at(was->profile, *there) : std::nullopt;
    const auto now = section.found ? std::optional(section.diameter_mm) : std::nullopt;
    places.push_back({section.s_mm, analysis::difference(before, now, ChangeScope::lesion,
                                                         ChangeMeasure::least_diameter, made.repeatability)});
  }
  return places;
}

/// Where things lie, in units of the interface.
struct AlongWidget::Plot {
  double left = 40.0, right = 1.0, top = 22.0, middle = 1.0, low = 1.0, bottom = 1.0;
  double length_mm = 1.0, most_mm = 1.0, reach_mm = least_reach_mm;
  double x(double s_mm) const { return left + s_mm / length_mm * (right - left); }
  double y(double mm) const { return middle - std::clamp(mm / most_mm, 0.0, 1.0) * (middle - top); }
  double y_change(double mm) const {
    return 0.5 * (low + bottom) - std::clamp(mm / reach_mm, -1.0, 1.0) * 0.5 * (bottom - low);
  }
};

AlongWidget::AlongWidget(session::Workbench& now, QWidget* parent) : QWidget(parent), now_(now) {
  setObjectName("compared_along");
  setAccessibleName(tr("Diameter along the vessel, before and now"));
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::CrossCursor);
  own_.push_back(now.vessel.observe([this](const std::int32_t&) { read(); }));
  own_.push_back(now.cursor_mm.observe([this](const double&) { update(); }));
}

void AlongWidget::show_comparison(std::shared_ptr<const session::Comparison> made) {
  made_ = std::move(made);
  read();
}

void AlongWidget::read() {
  places_ = made_ ? compared_along(*made_, now_.vessel.get()) : std::vector<ComparedPlace>();
  const auto axis = now_.axis();
  length_mm_ = axis ? axis->length() : 0.0;
  update();
}

AlongWidget::Plot AlongWidget::plot() const {
  Plot made;
  made.right = std::max(made.left + 1.0, width() - 12.0);
  made.bottom = std::max(made.top + 20.0, height() - 24.0);
  made.middle = made.top + share_of_sizes * (made.bottom - made.top);
  made.low = made.middle + 8.0;
  made.length_mm = std::max(1e-3, length_mm_);
  for (const ComparedPlace& place : places_) {
    for (const auto& one : {place.diameter.before, place.diameter.after})
      if (one) made.most_mm = std::max(made.most_mm, 1.1 * *one);
    if (const auto change = place.diameter.change())
      made.reach_mm = std::max(made.reach_mm, 1.1 * std::abs(*change));
  }
  return made;
}

double AlongWidget::x_of(double now_mm) const {
  return plot().x(now_mm);
}

const ComparedPlace* AlongWidget::at_cursor() const {
  if (places_.empty()) return nullptr;
  const double s = now_.own_mm(now_.cursor_mm.get());
  return &*std::ranges::min_element(places_, {}, [s](const auto& one) { return std::abs(one.now_mm - s); });
}

QString AlongWidget::told() const {
  const ComparedPlace* place = at_cursor();
  if (!place) return tr("This vessel is in one of the scans alone.");
  const analysis::Difference& one = place->diameter;
  if (!one.change()) return tr("One of the scans shows no lumen here.");
  QString text =
      tr("%1 mm: diameter %2 mm before, %3 mm now, difference %4 mm")
          .arg(quantity::length(place->now_mm), quantity::calibre(one.before), quantity::calibre(one.after),
               QString::fromStdString(core::signed_text(*one.change(), 2)));
  if (one.smallest_real)
    text += tr(" (smallest real difference %1 mm)").arg(quantity::calibre(one.smallest_real));
  return text;
}

view::Overlay AlongWidget::drawn() const {
  view::Overlay out;
  const Plot p = plot();
  const auto text = [&](double x, double y, const QString& what, Role role, Anchor anchor) {
    out.texts.push_back({Vec2(x, y), what.toStdString(), role, anchor, {}, true});
  };
  const auto rows = [&](double low, double high, int count, const auto& y) {
    const std::vector<double> values = figure::nice_ticks(low, high, count);
    const double step = values.size() > 1 ? values[1] - values[0] : 1.0;
    for (const double value : values) {
      out.lines.push_back({{Vec2(p.left, y(value)), Vec2(p.right, y(value))}, Role::grid, 0.5});
      text(p.left - 4.0, y(value), QString::fromStdString(figure::tick_text(value, step)), Role::information,
           Anchor::right);
    }
  };
  rows(0.0, p.most_mm, 4, [&](double mm) { return p.y(mm); });
  rows(-p.reach_mm, p.reach_mm, 3, [&](double mm) { return p.y_change(mm); });
  const std::vector<double> along = figure::nice_ticks(0.0, p.length_mm, std::max(2, width() / 90));
  const double step = along.size() > 1 ? along[1] - along[0] : 1.0;
  for (const double s : along)
    text(p.x(s), p.bottom + 6.0, QString::fromStdString(figure::tick_text(s, step)), Role::information,
         Anchor::top);
  const auto curve = [&](Role role, const auto& y_of) {
    view::OverlayLine line{{}, role};
    const auto end = [&] {
      if (line.px.size() > 1) out.lines.push_back(line);
      line.px.clear();
    };
    for (const ComparedPlace& place : places_)
      if (const std::optional<double> y = y_of(place.diameter))
        line.px.emplace_back(p.x(place.now_mm), *y);
      else
        end();
    end();
  };
  for (std::size_t i = 0; i + 1 < places_.size(); ++i)
    if (is_real(places_[i]))
      out.bands.push_back({Vec2(p.x(places_[i].now_mm), p.top), Vec2(p.x(places_[i + 1].now_mm), p.bottom),
                           role_of_change(places_[i].diameter.verdict()), 0.3});
  const auto at = [&](const std::optional<double>& mm) {
    return mm ? std::optional(p.y(*mm)) : std::nullopt;
  };
  curve(Role::area, [&](const analysis::Difference& one) { return at(one.before); });
  curve(Role::diameter, [&](const analysis::Difference& one) { return at(one.after); });
  curve(Role::information, [&](const analysis::Difference& one) -> std::optional<double> {
    const auto change = one.change();
    return change ? std::optional(p.y_change(*change)) : std::nullopt;
  });
  const double cursor = p.x(now_.own_mm(now_.cursor_mm.get()));
  out.lines.push_back({{Vec2(cursor, p.top), Vec2(cursor, p.bottom)}, Role::cursor});
  text(p.left, 4.0, tr("now"), Role::diameter, Anchor::top_left);
  text(p.left + 50.0, 4.0, tr("before"), Role::area, Anchor::top_left);
  text(p.left + 110.0, 4.0, told(), Role::information, Anchor::top_left);
  return out;
}

void AlongWidget::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  QFont small = font();
  small.setPixelSize(font_px);
  painter.setFont(small);
  paint_overlay(painter, drawn(), {QSizeF(size()), 1.0, Ground::paper});
}

void AlongWidget::go_to(double x) {
  const Plot p = plot();
  const double share = std::clamp((x - p.left) / (p.right - p.left), 0.0, 1.0);
  now_.cursor_mm.set(now_.here_mm(share * p.length_mm));
}

void AlongWidget::mousePressEvent(QMouseEvent* event) {
  setFocus(Qt::MouseFocusReason);
  if (event->button() == Qt::LeftButton) go_to(event->localPos().x());
}

void AlongWidget::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons().testFlag(Qt::LeftButton)) go_to(event->localPos().x());
}

void AlongWidget::wheelEvent(QWheelEvent* event) {
  now_.cursor_mm.set(now_.cursor_mm.get() - cursor_step_mm * event->angleDelta().y() / 120.0);
  event->accept();
}

void AlongWidget::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Left && event->key() != Qt::Key_Right) return QWidget::keyPressEvent(event);
  const double steps = event->key() == Qt::Key_Left ? -1.0 : 1.0;
  now_.cursor_mm.set(now_.cursor_mm.get() + steps * cursor_step_mm);
}

}  // namespace ostia::workstation
