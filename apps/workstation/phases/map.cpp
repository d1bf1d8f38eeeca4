#include "phases/map.h"

#include "shell/quantities.h"

#include "ostia/figure/plot.h"
#include "ostia/view/surface_field_scene.h"
#include "ostia/view/value_scale.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

constexpr int top_px = 6, bottom_px = 22, bar_px = 12;
constexpr double key_step_mm = 0.5, key_step_percent = 1.0;

view::ColorScale scale_of(PhaseMapValue value) {
  return value == PhaseMapValue::change ? view::ColorScale::diverging : view::ColorScale::sequential;
}

QRgb shown(view::ColorScale scale, double t) {
  const figure::Color color = view::scale_color(scale, t);
  return QColor::fromRgbF(color.r, color.g, color.b).rgb();
}

}  // namespace

PhaseMap::PhaseMap(session::Workbench& bench, session::PhaseClock& clock, QWidget* parent)
    : QWidget(parent), bench_(bench), clock_(clock) {
  setObjectName("phase_map");
  setAccessibleName(tr("Lumen profile over the cycle"));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  own_.push_back(bench.cursor_mm.observe([this](const double&) { update(); }));
  own_.push_back(clock.percent.observe([this](const double&) { update(); }));
}

QSize PhaseMap::minimumSizeHint() const {
  return {200, 90};
}

void PhaseMap::set_profile(std::optional<session::BeatingProfile> profile, double own_phase) {
  profile_ = std::move(profile);
  own_phase_ = own_phase;
  own_row_ = 0;
  for (std::size_t k = 0; profile_ && k < profile_->phases.size(); ++k)
    if (session::phase_distance(profile_->phases[k], own_phase) <
        session::phase_distance(profile_->phases[own_row_], own_phase))
      own_row_ = k;
  color();
}

void PhaseMap::set_value(PhaseMapValue value) {
  value_ = value;
  color();
}

double PhaseMap::value(std::size_t phase, std::size_t section) const {
  const double diameter = profile_->diameter_mm(phase, section);
  if (value_ == PhaseMapValue::area) return profile_->area_mm2[phase][section];
  if (value_ == PhaseMapValue::diameter) return diameter;
  return 100.0 * (diameter / profile_->diameter_mm(own_row_, section) - 1.0);
}

double PhaseMap::value_at(double phase, double s_mm) const {
  if (!profile_) return std::nan("");
  const auto phases = static_cast<double>(profile_->phases.size());
  const auto row = static_cast<std::size_t>(std::lround(phase * phases)) % profile_->phases.size();
  const std::vector<double>& s = profile_->s_mm;
  const auto nearest = std::min_element(
      s.begin(), s.end(), [&](double a, double b) { return std::abs(a - s_mm) < std::abs(b - s_mm); });
  return value(row, static_cast<std::size_t>(nearest - s.begin()));
}

void PhaseMap::color() {
  picture_ = {};
  update();
  if (!profile_) return;
  const std::size_t rows = profile_->phases.size(), columns = profile_->s_mm.size();
  std::vector<double> all;
  for (std::size_t k = 0; k < rows; ++k)
    for (std::size_t i = 0; i < columns; ++i) all.push_back(value(k, i));
  std::tie(low_, high_) = view::automatic_range(all);
  if (value_ == PhaseMapValue::change) {
    high_ = std::max({std::abs(low_), std::abs(high_), 1.0});
    low_ = -high_;
  }
  // The first phase is below the last, too, where the cycle ends.
  picture_ = QImage(static_cast<int>(columns), static_cast<int>(rows + 1), QImage::Format_RGB32);
  for (std::size_t k = 0; k <= rows; ++k)
    for (std::size_t i = 0; i < columns; ++i)
      picture_.setPixel(static_cast<int>(i), static_cast<int>(k),
                        shown(scale_of(value_), (all[k % rows * columns + i] - low_) / (high_ - low_)));
}

QRect PhaseMap::plot() const {
  const int left_px = fontMetrics().horizontalAdvance(QStringLiteral("100 %")) + 10;
  const int right_px = fontMetrics().horizontalAdvance(QStringLiteral("-100.0 mm\u00b2")) + bar_px + 20;
  return {left_px, top_px, std::max(1, width() - left_px - right_px),
          std::max(1, height() - top_px - bottom_px)};
}

QString PhaseMap::value_text(double value) const {
  if (!std::isfinite(value)) return QStringLiteral("\u2013");
  if (value_ == PhaseMapValue::diameter) return quantity::calibre(value) + tr(" mm");
  if (value_ == PhaseMapValue::area) return quantity::area(value) + tr(" mm\u00b2");
  return quantity::percent(value) + tr(" %");
}

/// Each sample's middle where its phase and its abscissa are: the outer ones are cut in half.
void PhaseMap::paint_picture(QPainter& painter, const QRect& at) const {
  const double wide = static_cast<double>(at.width()) / std::max(1, picture_.width() - 1);
  const double high = static_cast<double>(at.height()) / std::max(1, picture_.height() - 1);
  painter.save();
  painter.setClipRect(at);
  painter.drawImage(QRectF(at).adjusted(-wide / 2.0, -high / 2.0, wide / 2.0, high / 2.0), picture_);
  painter.restore();
}

void PhaseMap::paint_axes(QPainter& painter, const QRect& at) const {
  const int line = painter.fontMetrics().height();
  painter.setPen(palette().color(QPalette::Text));
  const int step = at.height() > 5 * line ? 25 : 50;
  for (int percent = 0; percent <= 100; percent += step) {
    const int y = at.top() + percent * at.height() / 100;
    painter.drawText(QRect(0, std::clamp(y - line / 2, 0, height() - line), at.left() - 5, line),
                     Qt::AlignRight | Qt::AlignVCenter, QStringLiteral("%1 %").arg(percent));
  }
  const double length = profile_->s_mm.back();
  const std::vector<double> ticks = figure::nice_ticks(0.0, length, std::max(2, at.width() / 60));
  for (const double s : ticks) {
    const int x = at.left() + static_cast<int>(s / length * at.width());
    painter.drawText(
        QRect(x - 40, at.bottom() + 3, 80, line), Qt::AlignCenter,
        QString::fromStdString(figure::tick_text(s, ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0)));
  }
}

void PhaseMap::paint_bar(QPainter& painter, const QRect& at) const {
  const QRect bar(at.right() + 10, at.top(), bar_px, at.height());
  for (int y = 0; y < bar.height(); ++y) {
    painter.setPen(QColor(shown(scale_of(value_), 1.0 - static_cast<double>(y) / bar.height())));
    painter.drawLine(bar.left(), bar.top() + y, bar.right(), bar.top() + y);
  }
  const int line = painter.fontMetrics().height();
  painter.setPen(palette().color(QPalette::Text));
  const QRect texts(bar.right() + 4, bar.top(), width() - bar.right() - 4, bar.height());
  painter.drawText(texts.adjusted(0, 0, 0, line), Qt::AlignLeft | Qt::AlignTop, value_text(high_));
  painter.drawText(texts.adjusted(0, 0, 0, 2), Qt::AlignLeft | Qt::AlignBottom, value_text(low_));
}

void PhaseMap::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  const QRect at = plot();
  if (picture_.isNull()) {
    painter.setPen(palette().color(QPalette::Text));
    painter.drawText(at, Qt::AlignCenter, tr("Being measured\u2026"));
    return;
  }
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  paint_picture(painter, at);
  paint_axes(painter, at);
  paint_bar(painter, at);
  const auto across = [&](double share, Qt::PenStyle style) {
    const int y = at.top() + static_cast<int>(share * at.height());
    for (const auto& [color, wide] : {std::pair(QColor(Qt::black), 3), {QColor(Qt::white), 1}}) {
      painter.setPen(QPen(color, wide, style, Qt::FlatCap));
      painter.drawLine(at.left(), y, at.right(), y);
    }
  };
  across(own_phase_, Qt::DotLine);
  across(clock_.percent.get() / 100.0, Qt::SolidLine);
  const double s = bench_.own_mm(bench_.cursor_mm.get()) / profile_->s_mm.back();
  const int x = at.left() + static_cast<int>(s * at.width());
  painter.setPen(QPen(QColor(Qt::black), 3));
  painter.drawLine(x, at.top(), x, at.bottom());
  painter.setPen(QPen(QColor(Qt::white), 1));
  painter.drawLine(x, at.top(), x, at.bottom());
  if (hasFocus()) {
    painter.setPen(QPen(palette().color(QPalette::Highlight), 2));
    painter.drawRect(rect().adjusted(1, 1, -1, -1));
  }
}

bool PhaseMap::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && profile_) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const QRect at = plot();
    if (!at.contains(help->pos())) return QWidget::event(event);
    const double s = profile_->s_mm.back() * (help->x() - at.left()) / at.width();
    const double phase = static_cast<double>(help->y() - at.top()) / at.height();
    QToolTip::showText(
        help->globalPos(),
        tr("%1 mm, %2 %: %3")
            .arg(quantity::length(s), quantity::percent(100.0 * phase), value_text(value_at(phase, s))),
        this);
    return true;
  }
  return QWidget::event(event);
}

void PhaseMap::go_to(const QPoint& place) {
  if (!profile_) return;
  const QRect at = plot();
  const double s = std::clamp(static_cast<double>(place.x() - at.left()) / at.width(), 0.0, 1.0);
  clock_.playing.set(false);
  clock_.percent.set(100.0 * (place.y() - at.top()) / at.height());
  bench_.cursor_mm.set(bench_.here_mm(s * profile_->s_mm.back()));
}

void PhaseMap::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) go_to(event->pos());
}
void PhaseMap::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) go_to(event->pos());
}

void PhaseMap::keyPressEvent(QKeyEvent* event) {
  const int key = event->key();
  if (key == Qt::Key_Left || key == Qt::Key_Right) {
    bench_.cursor_mm.set(bench_.cursor_mm.get() + (key == Qt::Key_Left ? -key_step_mm : key_step_mm));
  } else if (key == Qt::Key_Up || key == Qt::Key_Down) {
    clock_.playing.set(false);
    clock_.percent.set(clock_.percent.get() + (key == Qt::Key_Up ? -key_step_percent : key_step_percent));
  } else {
    QWidget::keyPressEvent(event);
  }
}

}  // namespace ostia::workstation
