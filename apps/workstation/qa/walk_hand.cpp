#include "qa/walk_hand.h"

#include <QApplication>
#include <QMouseEvent>
#include <QWidget>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

constexpr double move_px = 8.0;

}  // namespace

void send_mouse(QWidget& widget, QEvent::Type type, const QPointF& at, const WalkStep& step,
                Qt::MouseButtons down) {
  const Qt::MouseButton button = type == QEvent::MouseMove ? Qt::NoButton : step.button;
  QMouseEvent event(type, at, widget.mapTo(widget.window(), at.toPoint()), widget.mapToGlobal(at.toPoint()),
                    button, down, step.held);
  QApplication::sendEvent(&widget, &event);
}

std::vector<QPointF> way_through(const std::vector<QPointF>& places) {
  std::vector<QPointF> way{places.front()};
  for (std::size_t i = 1; i < places.size(); ++i) {
    const QPointF from = places[i - 1], step = places[i] - from;
    const int count = std::max(1, static_cast<int>(std::ceil(std::hypot(step.x(), step.y()) / move_px)));
    for (int k = 1; k <= count; ++k) way.push_back(from + step * k / count);
  }
  return way;
}

std::optional<view::Vec2> wall_right_of(view::PictureView& view, view::Vec2 px) {
  for (; px.x() < view.width(); px.x() += 1.0)
    if (const auto wall = view.wall_near(px, 1.0)) return wall->px;
  return std::nullopt;
}

}  // namespace ostia::workstation
