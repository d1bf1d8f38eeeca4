#pragma once
/// \file What the window itself writes in the corners of an image: whose it is, and its grey window while
/// that changes. Not part of the view's own description, so that nothing else of the view can carry it away.

#include "ostia/session/workbench.h"
#include "ostia/view/text_layout.h"

#include <QSizeF>
#include <QStringList>
#include <vector>

namespace ostia::workstation {

/// At the lower left, a line each (more, where one is wider than the view), from the last upwards. Nothing in
/// a view that is too small for it. `view_px` in device pixels.
std::vector<view::OverlayText> identity_texts(const QSizeF& view_px, const QStringList& parts, double density,
                                              const view::TextMeasure& measure);

/// At the upper right: "W 900  L 250".
std::vector<view::OverlayText> grey_window_texts(const QSizeF& view_px, const session::GreyWindow& window,
                                                 double density);

/// Parts of a text that are no wider than `most_px`, broken between words where that can be.
QStringList broken(const QString& text, double most_px, const view::TextMeasure& measure);

}  // namespace ostia::workstation
