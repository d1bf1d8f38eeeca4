#pragma once
/// \file Colours and widths of what is drawn in the views, by its role: lumen, truth, kinds of plaque, ...

#include "ostia/view/overlay.h"

#include <QColor>
#include <QPixmap>

namespace ostia::workstation {

/// How a role is drawn over an image (always dark) or on the theme's own background (plots).
enum class Ground { image, paper };
QColor role_color(view::Role role, Ground ground);
QPixmap color_square(const QColor& color);  ///< for lists and legends
double role_width(view::Role role);         ///< in units of the interface

}  // namespace ostia::workstation
