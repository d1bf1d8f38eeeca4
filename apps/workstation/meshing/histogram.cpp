#include "meshing/histogram.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

constexpr std::size_t bar_count = 30;
constexpr int lines_high = 5;

QString text_of(double value) {
  return QString::fromStdString(view::three_digits(value));
}

}  // namespace

HistogramWidget::HistogramWidget(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void HistogramWidget::set_values(const std::vector<double>& values, const view::ValueScale& scale) {
  scale_ = scale;
  counts_.assign(values.empty() ? 0 : bar_count, 0);
  for (const double value : values) {
    if (std::isnan(value)) continue;
    const double t = std::clamp((value - scale.low) / (scale.high - scale.low), 0.0, 1.0);
    ++counts_[std::min(static_cast<std::size_t>(t * bar_count), bar_count - 1)];
  }
  const auto most = std::max_element(counts_.begin(), counts_.end());
  setAccessibleDescription(most == counts_.end() ? QString()
                                                 : told(static_cast<std::size_t>(most - counts_.begin())));
  update();
}

QSize HistogramWidget::sizeHint() const {
  return {200, lines_high * fontMetrics().height()};
}

QSize HistogramWidget::minimumSizeHint() const {
  return {80, sizeHint().height()};
}

QRectF HistogramWidget::bars() const {
  return QRectF(rect()).adjusted(1.0, 1.0, -1.0, -fontMetrics().height() - 2.0);
}

QString HistogramWidget::told(std::size_t bar) const {
  const double width = (scale_.high - scale_.low) / static_cast<double>(bar_count);
  const double low = scale_.low + width * static_cast<double>(bar);
  return tr("%1 to %2: %3 elements").arg(text_of(low), text_of(low + width)).arg(counts_[bar]);
}

bool HistogramWidget::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && !counts_.empty()) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const QRectF area = bars();
    const double t = std::clamp((help->x() - area.left()) / area.width(), 0.0, 0.999);
    QToolTip::showText(help->globalPos(), told(static_cast<std::size_t>(t * bar_count)), this);
    return true;
  }
  return QWidget::event(event);
}

void HistogramWidget::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const QRectF area = bars();
  painter.setPen(palette().color(QPalette::Mid));
  painter.drawLine(area.bottomLeft(), area.bottomRight());
  if (counts_.empty()) return;
  const double most = std::log1p(static_cast<double>(*std::max_element(counts_.begin(), counts_.end())));
  const double wide = area.width() / static_cast<double>(bar_count);
  for (std::size_t i = 0; i < bar_count; ++i) {
    if (counts_[i] == 0) continue;
    const double high = std::max(1.0, area.height() * std::log1p(static_cast<double>(counts_[i])) / most);
    const figure::Color color =
        view::scale_color(scale_.colors, (static_cast<double>(i) + 0.5) / static_cast<double>(bar_count));
    const QRectF bar(area.left() + wide * static_cast<double>(i), area.bottom() - high,
                     std::max(1.0, wide - 1.0), high);
    painter.fillRect(bar, QColor::fromRgbF(color.r, color.g, color.b));
  }
  painter.setPen(palette().color(QPalette::WindowText));
  const QRectF below(area.left(), area.bottom() + 2.0, area.width(), fontMetrics().height());
  painter.drawText(below, Qt::AlignLeft, text_of(scale_.low));
  painter.drawText(below, Qt::AlignHCenter, text_of(0.5 * (scale_.low + scale_.high)));
  painter.drawText(below, Qt::AlignRight, text_of(scale_.high));
}

}  // namespace ostia::workstation
