#pragma once
/// \file What the window itself writes in the corners of an image: whose it is, and its grey window while
/// that changes. Not part of the view's own description, so that nothing else of the view can carry it away.

#include "ostia/session/workbench.h"

#include <QPainter>
#include <QStringList>

namespace ostia::workstation {

/// At the lower left, a line each, cut off at the middle of the view; `above_px` are kept free below. Nothing
/// in a view that is too small for it. In device pixels: the painter's scale is 1.
void paint_identity(QPainter& painter, const QSizeF& view_px, const QStringList& parts, double density,
                    double above_px);

/// At the upper right: "W 900  L 250".
void paint_grey_window(QPainter& painter, const QSizeF& view_px, const session::GreyWindow& window,
                       double density);

}  // namespace ostia::workstation
