#include "views/overlay_painter.h"

#include "ostia/view/label_layout.h"

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

QSizeF room_of(const QPainter& painter) {
  const double density = painter.device()->devicePixelRatioF();
  return QSizeF(painter.device()->width(), painter.device()->height()) * density;
}

QFont font_for(const QPainter& painter, const view::OverlayText& text) {
  return fitting(painter.font(), QString::fromStdString(text.text), room_of(painter).width(),
                 painter.device());
}

/// What would be cut off at the rim moves inwards.
QRectF box_of(const QPainter& painter, const view::OverlayText& text) {
  const QSizeF room = room_of(painter);
  QRectF box = text_box(QFontMetricsF(font_for(painter, text), painter.device()), text);
  box.moveLeft(std::clamp(box.left(), 0.0, std::max(0.0, room.width() - box.width())));
  box.moveTop(std::clamp(box.top(), 0.0, std::max(0.0, room.height() - box.height())));
  return box;
}

void paint_text(QPainter& painter, const view::OverlayText& text, const QRectF& box, Ground ground) {
  const QFont usual = painter.font();
  painter.setFont(font_for(painter, text));
  const QFontMetricsF metrics(painter.font(), painter.device());
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

view::LabelRect rect_of(const QRectF& box) {
  return {{box.left(), box.top()}, {box.width(), box.height()}};
}

/// Texts that stay where they are, then labels about them.
void paint_texts(QPainter& painter, const std::vector<view::OverlayText>& texts, double density,
                 Ground ground, LabelOffsets* before) {
  const QSizeF size = room_of(painter);
  view::LabelRoom room{{size.width(), size.height()}, 6.0 * density, {}};
  std::vector<view::LabelWish> wishes;
  std::vector<const view::OverlayText*> labels;
  for (const view::OverlayText& text : texts) {
    const QRectF box = box_of(painter, text);
    if (!text.label_of) {
      paint_text(painter, text, box, ground);
      room.taken.push_back(rect_of(box));
      continue;
    }
    wishes.push_back({text.px, {box.width(), box.height()}, {}});
    labels.push_back(&text);
    if (before && before->count(*text.label_of)) wishes.back().before = before->at(*text.label_of);
  }
  const std::vector<view::PlacedLabel> placed = view::place_labels(wishes, room);
  LabelOffsets now;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (!placed[i].shown) continue;
    const view::LabelRect& rect = placed[i].rect;
    now[*labels[i]->label_of] = rect.low - wishes[i].anchor;
    if (placed[i].leader_to) {
      painter.setPen(QPen(role_color(labels[i]->role, ground), density));
      painter.drawLine(point(wishes[i].anchor), point(*placed[i].leader_to));
    }
    paint_text(painter, *labels[i], QRectF(rect.low.x(), rect.low.y(), rect.size.x(), rect.size.y()), ground);
  }
  if (before) *before = std::move(now);
}

QColor color_of(view::Role role, const std::optional<figure::Color>& own, Ground ground) {
  return own ? QColor::fromRgbF(own->r, own->g, own->b) : role_color(role, ground);
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

void paint_overlay(QPainter& painter, const view::Overlay& overlay, double density, Ground ground,
                   LabelOffsets* before) {
  painter.setRenderHint(QPainter::Antialiasing);
  for (const auto& tint : overlay.tints)
    painter.drawImage(QPointF(tint->left, tint->top), tint_picture(*tint, ground));
  for (const view::OverlayBand& band : overlay.bands) {
    QColor color = color_of(band.role, band.color, ground);
    color.setAlphaF(band.opacity);
    painter.fillRect(QRectF(point(band.low), point(band.high)).normalized(), color);
  }
  painter.setBrush(Qt::NoBrush);
  QPolygonF polygon;
  for (const view::OverlayLine& line : overlay.lines) {
    if (line.px.size() < 2) continue;
    QColor color = color_of(line.role, line.color, ground);
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
    QColor color = color_of(mark.role, mark.color, ground);
    color.setAlphaF(mark.opacity);
    painter.setPen(mark.filled ? QPen(Qt::NoPen) : QPen(color, 1.4 * density));
    painter.setBrush(mark.filled ? QBrush(color) : QBrush(Qt::NoBrush));
    painter.drawEllipse(point(mark.px), mark.radius * density, mark.radius * density);
  }
  paint_texts(painter, overlay.texts, density, ground, before);
}

}  // namespace ostia::workstation
