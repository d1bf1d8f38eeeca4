#include "views/corner_texts.h"

#include "views/overlay_colors.h"
#include "views/overlay_painter.h"

#include <QCoreApplication>
#include <QFontMetricsF>

namespace ostia::workstation {
namespace {

constexpr double corner_edge = 6.0;   // units from the rim, as the view's own texts have it
constexpr double least_view = 110.0;  // units; smaller ones are strips beside a larger view

bool too_small(const QSizeF& view_px, double density) {
  return view_px.width() < least_view * density || view_px.height() < least_view * density;
}

void paint_line(QPainter& painter, const view::Vec2& px, const QString& text, view::Anchor anchor,
                double density) {
  view::Overlay overlay;
  overlay.texts.push_back({px, text.toStdString(), view::Role::information, anchor});
  paint_overlay(painter, overlay, density, Ground::image);
}

}  // namespace

void paint_identity(QPainter& painter, const QSizeF& view_px, const QStringList& parts, double density,
                    double above_px) {
  if (parts.isEmpty() || too_small(view_px, density)) return;
  const QFontMetricsF metrics(painter.font(), painter.device());
  // The letter of the lower side stands in the middle, the scale at the right.
  const double room = 0.5 * view_px.width() - 3.0 * corner_edge * density;
  double y = view_px.height() - corner_edge * density - above_px;
  for (int i = parts.size() - 1; i >= 0; --i) {
    const QString shown = metrics.elidedText(parts[i], Qt::ElideRight, room);
    paint_line(painter, view::Vec2(corner_edge * density, y), shown, view::Anchor::bottom_left, density);
    y -= metrics.height();
  }
}

void paint_grey_window(QPainter& painter, const QSizeF& view_px, const session::GreyWindow& window,
                       double density) {
  if (too_small(view_px, density)) return;
  const QString text = QCoreApplication::translate("ostia::workstation::PictureWidget", "W %1  L %2")
                           .arg(window.width_hu, 0, 'f', 0)
                           .arg(window.level_hu, 0, 'f', 0);
  paint_line(painter, view::Vec2(view_px.width() - corner_edge * density, corner_edge * density), text,
             view::Anchor::top_right, density);
}

}  // namespace ostia::workstation
