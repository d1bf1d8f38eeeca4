#pragma once
/// \file Puts a view's plain description on the screen.

#include "views/overlay_colors.h"

#include "ostia/session/workbench.h"
#include "ostia/view/overlay.h"

#include <QImage>
#include <QPainter>
#include <cstdint>
#include <map>

namespace ostia::workstation {

/// An 8-bit picture of CT numbers; NaN is black. `reused` is written over where its size fits.
QImage grey_picture(const view::GreyImage& image, const session::GreyWindow& window, QImage reused = {});

/// Where labels of measurements stood, from their anchors, by the measurements' ids.
using LabelOffsets = std::map<std::int32_t, view::Vec2>;

/// In device pixels: the painter's scale is 1. `density`: device pixels per unit. Labels of measurements are
/// painted where view::place_labels puts them, near where `before` (taken and given; null: nobody knows) has
/// them.
void paint_overlay(QPainter& painter, const view::Overlay& overlay, double density, Ground ground,
                   LabelOffsets* before = nullptr);

}  // namespace ostia::workstation
