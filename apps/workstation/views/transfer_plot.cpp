#include "views/transfer_plot.h"

#include "shell/bind.h"
#include "views/heart_volume.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

constexpr int plot_lines_high = 7;
constexpr double pull_px = 80.0;  // up: e times as soft

double plot_low_hu() {
  return HeartVolume::histogram_low_hu;
}
double plot_range_hu() {
  return HeartVolume::histogram_high_hu - HeartVolume::histogram_low_hu;
}

}  // namespace

TransferPlot::TransferPlot(HeartVolume& heart, QWidget* parent) : QWidget(parent), heart_(heart) {
  setObjectName("heart_curve");
  setAccessibleName(tr("Opacity of each CT number"));
  setToolTip(
      tr("Drag to the side: other CT numbers are seen. Up or down: softer or harder. Double click: the "
         "preset as it is."));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setCursor(Qt::SizeAllCursor);
  const auto again = [this](const auto&...) { update(); };
  keep_with(this, heart.preset.observe(again));
  keep_with(this, heart.shift_hu.observe(again));
  keep_with(this, heart.stretch.observe(again));
  connect(&heart, &HeartVolume::shown_changed, this, [this] { update(); });
}

QSize TransferPlot::sizeHint() const {
  return {240, plot_lines_high * fontMetrics().height()};
}

QSize TransferPlot::minimumSizeHint() const {
  return {120, sizeHint().height()};
}

QRectF TransferPlot::area() const {
  return QRectF(rect()).adjusted(1.0, 2.0, -1.0, -fontMetrics().height() - 2.0);
}

void TransferPlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(area(), palette().color(QPalette::Base));
  paint_histogram(painter, area());
  paint_curve(painter, area());
  paint_numbers(painter, area());
}

/// By the logarithm: vessels are few voxels among many.
void TransferPlot::paint_histogram(QPainter& painter, const QRectF& area) const {
  const std::vector<std::int64_t>& counts = heart_.histogram();
  if (counts.empty()) return;
  const double most = std::log1p(static_cast<double>(*std::max_element(counts.begin(), counts.end())));
  if (most <= 0.0) return;
  const double wide = area.width() / static_cast<double>(counts.size());
  QColor color = palette().color(QPalette::Mid);
  for (std::size_t n = 0; n < counts.size(); ++n) {
    const double high = area.height() * std::log1p(static_cast<double>(counts[n])) / most;
    painter.fillRect(QRectF(area.left() + wide * static_cast<double>(n), area.bottom() - high, wide, high),
                     color);
  }
}

void TransferPlot::paint_curve(QPainter& painter, const QRectF& area) const {
  const view::VolumeTransfer transfer = view::transfer_of(heart_.look());
  const int steps = std::max(2, static_cast<int>(area.width()) / 2);
  QPainterPath line;
  for (int n = 0; n <= steps; ++n) {
    const double share = static_cast<double>(n) / steps, hu = plot_low_hu() + share * plot_range_hu();
    const QPointF at(area.left() + share * area.width(),
                     area.bottom() - area.height() * view::opacity_at(transfer, hu));
    if (n == 0)
      line.moveTo(at);
    else
      line.lineTo(at);
    const figure::Color c = view::color_at(transfer, hu);
    QColor fill = QColor::fromRgbF(c.r, c.g, c.b);
    fill.setAlphaF(0.75);
    painter.fillRect(QRectF(at.x(), at.y(), area.width() / steps + 0.5, area.bottom() - at.y()), fill);
  }
  painter.setPen(QPen(palette().color(QPalette::Text), 1.5));
  painter.drawPath(line);
}

void TransferPlot::paint_numbers(QPainter& painter, const QRectF& area) const {
  painter.setPen(palette().color(QPalette::Text));
  for (const int hu : {0, 300, 600, 900}) {
    const double x = area.left() + (hu - plot_low_hu()) / plot_range_hu() * area.width();
    painter.drawLine(QPointF(x, area.bottom()), QPointF(x, area.bottom() + 3.0));
    painter.drawText(QRectF(x - 40.0, area.bottom() + 2.0, 80.0, fontMetrics().height()),
                     Qt::AlignHCenter | Qt::AlignTop, hu == 900 ? tr("900 HU") : QString::number(hu));
  }
}

void TransferPlot::mousePressEvent(QMouseEvent* event) {
  pressed_ = event->localPos();
  shift_hu_ = heart_.shift_hu.get();
  stretch_ = heart_.stretch.get();
}

void TransferPlot::mouseMoveEvent(QMouseEvent* event) {
  if (!(event->buttons() & Qt::LeftButton)) return;
  const QPointF moved = event->localPos() - pressed_;
  heart_.shift_hu.set(shift_hu_ + moved.x() / area().width() * plot_range_hu());
  heart_.stretch.set(stretch_ * std::exp(-moved.y() / pull_px));
}

void TransferPlot::mouseDoubleClickEvent(QMouseEvent*) {
  heart_.reset_look();
}

}  // namespace ostia::workstation
