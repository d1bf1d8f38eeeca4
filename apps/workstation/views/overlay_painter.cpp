#include "views/overlay_painter.h"

#include <QApplication>
#include <QPainterPath>
#include <QPalette>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace ostia::workstation {
namespace {

QPointF point(const view::Vec2& p) {
  return {p.x(), p.y()};
}

QRectF text_box(const QFontMetricsF& metrics, const view::OverlayText& text) {
  using view::Anchor;
  const double w = metrics.horizontalAdvance(QString::fromStdString(text.text)), h = metrics.height();
  double x = text.px.x(), y = text.px.y();
  switch (text.anchor) {
    case Anchor::top:
    case Anchor::middle:
    case Anchor::bottom:
      x -= w / 2;
      break;
    case Anchor::top_right:
    case Anchor::right:
    case Anchor::bottom_right:
      x -= w;
      break;
    default:
      break;
  }
  switch (text.anchor) {
    case Anchor::left:
    case Anchor::middle:
    case Anchor::right:
      y -= h / 2;
      break;
    case Anchor::bottom_left:
    case Anchor::bottom:
    case Anchor::bottom_right:
      y -= h;
      break;
    default:
      break;
  }
  return {x, y, w, h};
}

/// The font, or a smaller one where the text would be wider than the view.
QFont fitting(QFont font, const QString& text, double room, QPaintDevice* device) {
  constexpr double least = 0.7;
  const double wide = QFontMetricsF(font, device).horizontalAdvance(text) + 4.0;
  if (wide > room && font.pixelSize() > 0)
    font.setPixelSize(static_cast<int>(font.pixelSize() * std::max(least, room / wide)));
  return font;
}

/// Around letters, which are readable over lines so.
QColor halo(Ground ground) {
  QColor around = ground == Ground::image ? QColor(Qt::black) : QApplication::palette().color(QPalette::Base);
  around.setAlpha(ground == Ground::image ? 190 : 220);
  return around;
}

void paint_text(QPainter& painter, const view::OverlayText& text, Ground ground) {
  const double density = painter.device()->devicePixelRatioF();
  const double w = painter.device()->width() * density, h = painter.device()->height() * density;
  const QFont usual = painter.font();
  painter.setFont(fitting(usual, QString::fromStdString(text.text), w, painter.device()));
  const QFontMetricsF metrics(painter.font(), painter.device());
  QRectF box = text_box(metrics, text);
  // What would be cut off at the rim moves inwards.
  box.moveLeft(std::clamp(box.left(), 0.0, std::max(0.0, w - box.width())));
  box.moveTop(std::clamp(box.top(), 0.0, std::max(0.0, h - box.height())));
  const QString shown = QString::fromStdString(text.text);
  const QPointF base(box.left(), box.top() + metrics.ascent());
  painter.setPen(halo(ground));
  const double by = std::max(1.0, metrics.height() / 14.0);
  for (const QPointF& step : {QPointF(by, by), QPointF(-by, by), QPointF(by, -by), QPointF(-by, -by)})
    painter.drawText(base + step, shown);
  painter.setPen(role_color(text.role, ground));
  painter.drawText(base, shown);
  painter.setFont(usual);
}

QImage tint_picture(const view::OverlayTint& tint, Ground ground) {
  std::vector<QRgb> colors{0};
  for (const view::Role role : tint.roles) {
    QColor color = role_color(role, ground);
    color.setAlphaF(tint.opacity);
    colors.push_back(qPremultiply(color.rgba()));
  }
  QImage made(tint.width, tint.height, QImage::Format_ARGB32_Premultiplied);
  for (int row = 0; row < tint.height; ++row) {
    const std::uint8_t* from = tint.what.data() + static_cast<std::ptrdiff_t>(row) * tint.width;
    auto* to = reinterpret_cast<QRgb*>(made.scanLine(row));
    for (int column = 0; column < tint.width; ++column) to[column] = colors[from[column]];
  }
  return made;
}

}  // namespace

QImage grey_picture(const view::GreyImage& image, const session::GreyWindow& window, QImage reused) {
  if (image.width <= 0 || image.height <= 0) return {};
  if (reused.width() != image.width || reused.height() != image.height)
    reused = QImage(image.width, image.height, QImage::Format_Grayscale8);
  const float low = static_cast<float>(window.level_hu - window.width_hu / 2.0);
  const float scale = 255.0F / static_cast<float>(window.width_hu);
  for (int row = 0; row < image.height; ++row) {
    const float* from = image.values.data() + static_cast<std::ptrdiff_t>(row) * image.width;
    uchar* to = reused.scanLine(row);
    for (int column = 0; column < image.width; ++column) {
      const float grey = (from[column] - low) * scale;
      to[column] = grey >= 255.0F ? 255 : grey > 0.0F ? static_cast<uchar>(grey) : 0;  // NaN compares false
    }
  }
  return reused;
}

void paint_overlay(QPainter& painter, const view::Overlay& overlay, double density, Ground ground) {
  painter.setRenderHint(QPainter::Antialiasing);
  for (const auto& tint : overlay.tints)
    painter.drawImage(QPointF(tint->left, tint->top), tint_picture(*tint, ground));
  for (const view::OverlayBand& band : overlay.bands) {
    QColor color = role_color(band.role, ground);
    color.setAlphaF(band.opacity);
    painter.fillRect(QRectF(point(band.low), point(band.high)).normalized(), color);
  }
  painter.setBrush(Qt::NoBrush);
  QPolygonF polygon;
  for (const view::OverlayLine& line : overlay.lines) {
    if (line.px.size() < 2) continue;
    QColor color = role_color(line.role, ground);
    color.setAlphaF(line.opacity);
    QPen pen(color, role_width(line.role) * density, line.dashed ? Qt::DashLine : Qt::SolidLine, Qt::FlatCap,
             Qt::RoundJoin);
    painter.setPen(pen);
    polygon.clear();
    polygon.reserve(static_cast<int>(line.px.size()));
    for (const view::Vec2& p : line.px) polygon << point(p);
    painter.drawPolyline(polygon);
  }
  for (const view::OverlayMark& mark : overlay.marks) {
    QColor color = role_color(mark.role, ground);
    color.setAlphaF(mark.opacity);
    painter.setPen(mark.filled ? QPen(Qt::NoPen) : QPen(color, 1.4 * density));
    painter.setBrush(mark.filled ? QBrush(color) : QBrush(Qt::NoBrush));
    painter.drawEllipse(point(mark.px), mark.radius * density, mark.radius * density);
  }
  for (const view::OverlayText& text : overlay.texts) paint_text(painter, text, ground);
}

}  // namespace ostia::workstation
