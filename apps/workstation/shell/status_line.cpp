#include "shell/status_line.h"

#include <QPaintEvent>
#include <QPainter>
#include <QSizeGrip>
#include <QStyleOption>
#include <algorithm>

namespace ostia::workstation {
namespace {

constexpr int message_left_px = 6, message_right_px = 12, message_gap_px = 6;
constexpr int fewest_letters = 8;

/// Those that stay at the right, as far as they are seen.
QList<const QWidget*> shown_parts(const QStatusBar& bar) {
  QList<const QWidget*> parts;
  for (const QObject* one : bar.children())
    if (const auto* part = qobject_cast<const QWidget*>(one); part && part->isVisible()) parts << part;
  return parts;
}

}  // namespace

StatusLine::StatusLine(QWidget* parent) : QStatusBar(parent) {
  connect(this, &QStatusBar::messageChanged, this, [this](const QString& text) { setToolTip(text); });
}

QRect StatusLine::message_room() const {
  int right = width() - message_right_px;
  for (const QWidget* part : shown_parts(*this)) right = std::min(right, part->x() - message_gap_px);
  return {message_left_px, 0, std::max(0, right - message_left_px), height()};
}

QString StatusLine::shown_message() const {
  return fontMetrics().elidedText(currentMessage(), Qt::ElideRight, message_room().width());
}

void StatusLine::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  QStyleOption panel;
  panel.initFrom(this);
  style()->drawPrimitive(QStyle::PE_PanelStatusBar, &panel, &painter, this);
  for (const QWidget* part : shown_parts(*this)) {
    const QRect around = part->geometry().adjusted(-2, -1, 2, 1);
    if (qobject_cast<const QSizeGrip*>(part) || !event->rect().intersects(around)) continue;
    QStyleOption frame;
    frame.rect = around;
    frame.palette = palette();
    style()->drawPrimitive(QStyle::PE_FrameStatusBarItem, &frame, &painter, part);
  }
  painter.setPen(palette().windowText().color());
  painter.drawText(message_room(), Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine, shown_message());
}

ElidedLabel::ElidedLabel(int most_letters, QWidget* parent) : QLabel(parent), most_letters_(most_letters) {
  setTextFormat(Qt::PlainText);
}

QString ElidedLabel::shown_text() const {
  return fontMetrics().elidedText(text(), Qt::ElideMiddle, contentsRect().width());
}

QSize ElidedLabel::sizeHint() const {
  const QSize whole = QLabel::sizeHint();
  return {std::min(whole.width(), most_letters_ * fontMetrics().averageCharWidth()), whole.height()};
}

QSize ElidedLabel::minimumSizeHint() const {
  const QSize wanted = sizeHint();
  return {std::min(wanted.width(), fewest_letters * fontMetrics().averageCharWidth()), wanted.height()};
}

void ElidedLabel::paintEvent(QPaintEvent* event) {
  const QString shown = shown_text();
  const bool whole = shown == text();
  const QString tip = whole ? QString() : text();
  if (toolTip() != tip) setToolTip(tip);
  if (whole) return QLabel::paintEvent(event);
  QPainter painter(this);
  style()->drawItemText(&painter, contentsRect(), static_cast<int>(alignment()), palette(), isEnabled(),
                        shown, foregroundRole());
}

}  // namespace ostia::workstation
