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

/// The font at a share of its size.
QFont scaled(QFont font, double scale) {
  if (scale < 1.0 && font.pixelSize() > 0)
    font.setPixelSize(std::max(1, static_cast<int>(font.pixelSize() * scale)));
  return font;
}

/// Around letters, which are readable over lines so.
QColor halo(Ground ground) {
  QColor around = ground == Ground::image ? QColor(Qt::black) : QApplication::palette().color(QPalette::Base);
  around.setAlpha(ground == Ground::image ? 190 : 220);
  return around;
}

void paint_text(QPainter& painter, const view::PlacedText& text, view::Role role, Ground ground) {
  const QFont usual = painter.font();
  painter.setFont(scaled(usual, text.scale));
  const QFontMetricsF metrics(painter.font(), painter.device());
  const QString shown = QString::fromStdString(text.text);
  const QPointF base(text.rect.low.x(), text.rect.low.y() + metrics.ascent());
  painter.setPen(halo(ground));
  const double by = std::max(1.0, metrics.height() / 14.0);
  for (const QPointF& step : {QPointF(by, by), QPointF(-by, by), QPointF(by, -by), QPointF(-by, -by)})
    painter.drawText(base + step, shown);
  painter.setPen(role_color(role, ground));
  painter.drawText(base, shown);
  painter.setFont(usual);
}

/// Texts that stay where they are, then labels about them, with lines to what they are of.
std::vector<view::PlacedText> paint_texts(QPainter& painter, const std::vector<view::OverlayText>& texts,
                                          const std::vector<view::OverlayLine>& lines,
                                          const OverlayPainting& how) {
  view::TextRoom room{{how.size.width(), how.size.height()}, how.density, {}};
  if (how.before) room.before = *how.before;
  std::vector<view::PlacedText> placed = view::lay_out_texts(texts, lines, text_measure(painter), room);
  LabelOffsets now;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (!placed[i].shown) continue;
    if (texts[i].label_of) now[*texts[i].label_of] = placed[i].rect.low - texts[i].px;
    if (placed[i].leader_to) {
      painter.setPen(QPen(role_color(texts[i].role, how.ground), how.density));
      painter.drawLine(point(texts[i].px), point(*placed[i].leader_to));
    }
    paint_text(painter, placed[i], texts[i].role, how.ground);
  }
  if (how.before) *how.before = std::move(now);
  return placed;
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

view::TextMeasure text_measure(const QPainter& painter) {
  const QFont usual = painter.font();
  QPaintDevice* device = painter.device();
  return {
      [usual, device](const std::string& text, double scale) {
        return QFontMetricsF(scaled(usual, scale), device).horizontalAdvance(QString::fromStdString(text));
      },
      QFontMetricsF(usual, device).height()};
}

std::vector<view::PlacedText> paint_overlay(QPainter& painter, const view::Overlay& overlay,
                                            const OverlayPainting& how) {
  const Ground ground = how.ground;
  const double density = how.density;
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
  if (how.corners.empty()) return paint_texts(painter, overlay.texts, overlay.lines, how);
  std::vector<view::OverlayText> texts = overlay.texts;
  texts.insert(texts.end(), how.corners.begin(), how.corners.end());
  return paint_texts(painter, texts, overlay.lines, how);
}

}  // namespace ostia::workstation
