#pragma once
/// \file Colours and widths of the interface, dark and light.

#include "ostia/view/overlay.h"

#include <QColor>
#include <QPalette>
#include <QPen>

namespace ostia::workstation {

enum class Theme { dark, light };

/// Sets palette and style of the whole application.
void apply_theme(Theme theme);
Theme current_theme();

/// How a role is drawn over an image (always dark) or on the theme's own background (plots).
enum class Ground { image, paper };
QColor role_color(view::Role role, Ground ground);
double role_width(view::Role role);  ///< in units of the interface

}  // namespace ostia::workstation
