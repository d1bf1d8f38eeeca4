#pragma once
/// \file The hand of a walk.

#include "qa/walk.h"

#include "ostia/view/picture_view.h"

#include <QEvent>
#include <QPointF>
#include <optional>
#include <vector>

class QWidget;

namespace ostia::workstation {

/// With the step's button and keys; `down`: the buttons that are down then.
void send_mouse(QWidget& widget, QEvent::Type type, const QPointF& at, const WalkStep& step,
                Qt::MouseButtons down);
/// From place to place in a hand's small steps, both ends included.
std::vector<QPointF> way_through(const std::vector<QPointF>& places);
/// Where a person who looks from there to the right finds the lumen's line.
std::optional<view::Vec2> wall_right_of(view::PictureView& view, view::Vec2 px);

}  // namespace ostia::workstation
