#pragma once
/// \file Puts a view's plain description on the screen.

#include "views/overlay_colors.h"

#include "ostia/session/workbench.h"
#include "ostia/view/overlay.h"

#include <QImage>
#include <QPainter>

namespace ostia::workstation {

/// An 8-bit picture of CT numbers; NaN is black. `reused` is written over where its size fits.
QImage grey_picture(const view::GreyImage& image, const session::GreyWindow& window, QImage reused = {});

/// In device pixels: the painter's scale is 1. `density`: device pixels per unit.
void paint_overlay(QPainter& painter, const view::Overlay& overlay, double density, Ground ground);

}  // namespace ostia::workstation
