#pragma once
/// \file Puts a view's plain description on the screen.

#include "views/overlay_colors.h"

#include "ostia/session/workbench.h"
#include "ostia/view/overlay.h"
#include "ostia/view/text_layout.h"

#include <QImage>
#include <QPainter>
#include <QSizeF>
#include <cstdint>
#include <map>
#include <vector>

namespace ostia::workstation {

/// An 8-bit picture of CT numbers; NaN is black. `reused` is written over where its size fits.
QImage grey_picture(const view::GreyImage& image, const session::GreyWindow& window, QImage reused = {});

/// Where labels of measurements stood, from their anchors, by the measurements' ids.
using LabelOffsets = std::map<std::int32_t, view::Vec2>;

/// In the painter's font; the painter's device outlives it.
view::TextMeasure text_measure(const QPainter& painter);

struct OverlayPainting {
  QSizeF size;           ///< of the view, device pixels
  double density = 1.0;  ///< device pixels per unit
  Ground ground = Ground::image;
  /// Labels are painted near where these have them, which are brought up to date; null: nobody knows.
  LabelOffsets* before = nullptr;
  std::vector<view::OverlayText> corners = {};  ///< of the window itself, behind the view's own texts
};

/// In device pixels: the painter's scale is 1. Texts are painted where view::lay_out_texts puts them; of each
/// of the overlay's, then of each in the corners, returns where that is.
std::vector<view::PlacedText> paint_overlay(QPainter& painter, const view::Overlay& overlay,
                                            const OverlayPainting& how);

}  // namespace ostia::workstation
