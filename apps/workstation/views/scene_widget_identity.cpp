// Whose tree it is, in the corner of the 3D view.

#include "shell/identity.h"
#include "views/corner_texts.h"
#include "views/overlay_painter.h"
#include "views/raster_image.h"
#include "views/scene_widget.h"

#include <cmath>

namespace ostia::workstation {
namespace {

constexpr double text_units = 12.0;   // as the 2D views write
constexpr double taken_units = 84.0;  // of the view's width, by what stands at its right
constexpr double least_tree_width = 150.0, least_tree_height = 190.0;  // units; with cube and scale below

/// The lines on nothing, as large as they are.
QImage written(const QStringList& parts, double width_px, double density, const QFont& base, bool dark) {
  QImage sheet(1, 1, QImage::Format_ARGB32_Premultiplied);
  QFont font = base;
  font.setPixelSize(static_cast<int>(std::lround(text_units * density)));
  const auto measure = [&](QImage& on) {
    QPainter painter(&on);
    painter.setFont(font);
    return text_measure(painter);
  };
  const view::TextMeasure before = measure(sheet);
  QStringList lines;
  for (const QString& part : parts) lines << broken(part, width_px, before);
  double widest = 0.0;
  for (const QString& line : lines) widest = std::max(widest, before.width(line.toStdString(), 1.0));
  const double high = std::ceil(before.line);
  QImage image(static_cast<int>(std::ceil(widest + 4.0 * density)),
               static_cast<int>(std::ceil(high * lines.size() + 2.0 * density)),
               QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::transparent);
  view::Overlay overlay;
  for (int i = 0; i < lines.size(); ++i)
    overlay.texts.push_back({{density, density + i * high}, lines[i].toStdString(), view::Role::information});
  QPainter painter(&image);
  painter.setFont(font);
  paint_overlay(painter, overlay, {QSizeF(image.size()), density, dark ? Ground::image : Ground::paper});
  return image;
}

}  // namespace

void SceneWidget::show_identity(Identity& identity) {
  identity_ = &identity;
  identity_changed_ = identity.changed.observe([this] {
    refresh_identity();
    request_render();
  });
  refresh_identity();
}

void SceneWidget::refresh_identity() {
  const QStringList parts =
      identity_ && identity_->on_views.get() ? identity_parts(identity_->now()) : QStringList();
  if (parts.isEmpty() || width() < least_tree_width || height() < least_tree_height)
    return scene_->set_corner({}, {});
  const double density = devicePixelRatioF();
  const QImage image = written(parts, (width() - taken_units) * density, density, font(), dark_);
  scene_->set_corner(raster_of(image), parts.join(QStringLiteral(", ")).toStdString());
}

}  // namespace ostia::workstation
