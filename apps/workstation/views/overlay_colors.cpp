#include "views/overlay_colors.h"

#include "shell/theme.h"

#include "ostia/view/plaque_colors.h"

#include <algorithm>

namespace ostia::workstation {
namespace {

/// As in pictures of a report, `figure::palette`.
QColor color_of_palette(std::size_t index) {
  const figure::Color color = figure::palette(index);
  return QColor::fromRgbF(color.r, color.g, color.b);
}

QColor color_of_plaque(view::Role role) {
  const auto& [of, color] = *std::ranges::find(view::plaque_colors, role, &view::PlaqueColor::role);
  return QColor::fromRgbF(color.r, color.g, color.b);
}

}  // namespace

QColor role_color(view::Role role, Ground ground) {
  using view::Role;
  const bool bright = ground == Ground::image || current_theme() == Theme::dark;
  switch (role) {
    case Role::lumen:
      return QColor(255, 176, 46);
    case Role::outer_wall:
      return bright ? QColor(240, 228, 66) : QColor(130, 115, 0);
    case Role::truth:
      return QColor(102, 219, 255);
    case Role::axis:
      return QColor(120, 200, 120);
    case Role::other_axis:
      return QColor(150, 150, 160);
    case Role::cursor:
      return bright ? QColor(90, 190, 255) : QColor(20, 110, 190);
    case Role::reference:
      return bright ? QColor(140, 220, 160) : QColor(30, 130, 60);
    case Role::stenosis:
      return QColor(232, 84, 72);
    case Role::measurement:
      return bright ? QColor(255, 240, 120) : QColor(130, 105, 0);
    case Role::selected:
      return bright ? QColor(255, 110, 220) : QColor(185, 20, 140);
    case Role::stroke:
      return QColor(120, 255, 220);
    case Role::dismissed:
      return QColor(255, 90, 90);
    case Role::handle:
      return QColor(255, 255, 255);
    case Role::information:
      return bright ? QColor(214, 218, 224) : QColor(40, 44, 50);
    case Role::warning:
      return QColor(255, 150, 60);
    case Role::diameter:
      return bright ? QColor(255, 176, 46) : QColor(180, 95, 0);
    case Role::area:
      return bright ? QColor(120, 170, 255) : QColor(40, 80, 190);
    case Role::grid:
      return bright ? QColor(110, 115, 125) : QColor(170, 174, 182);
    case Role::low_attenuation:
    case Role::fibrofatty:
    case Role::fibrous:
    case Role::calcified:
      return color_of_plaque(role);
    // As the three axes are coloured elsewhere, lightened for dark images.
    case Role::axial_plane:
      return QColor(240, 110, 100);
    case Role::coronal_plane:
      return QColor(120, 215, 110);
    case Role::sagittal_plane:
      return QColor(245, 215, 90);
    case Role::shear:
      return bright ? QColor(64, 214, 190) : QColor(0, 120, 105);
    case Role::pressure:
      return bright ? QColor(226, 140, 255) : QColor(135, 40, 170);
    case Role::what_if:
      return bright ? QColor(64, 214, 190) : QColor(0, 120, 105);
    case Role::limited:
      return bright ? QColor(196, 176, 255) : QColor(105, 80, 190);
    case Role::not_evaluable:
      return bright ? QColor(255, 60, 170) : QColor(180, 0, 105);
    case Role::calcium_lm:
      return color_of_palette(6);
    case Role::calcium_lad:
      return color_of_palette(0);
    case Role::calcium_lcx:
      return color_of_palette(1);
    case Role::calcium_rca:
      return color_of_palette(2);
    case Role::calcium_elsewhere:
      return color_of_palette(7);
    case Role::fat_dark:
      return QColor(40, 90, 255);
    case Role::fat_middle:
      return QColor(240, 228, 66);
    case Role::fat_bright:
      return QColor(213, 94, 0);
  }
  return Qt::white;
}

QPixmap color_square(const QColor& color) {
  constexpr int side = 12;
  QPixmap square(side, side);
  square.fill(color);
  return square;
}

double role_width(view::Role role) {
  using view::Role;
  switch (role) {
    case Role::lumen:
      return 1.6;
    case Role::diameter:
      return 1.8;
    case Role::stroke:
    case Role::selected:
    case Role::measurement:
      return 1.6;
    case Role::grid:
    case Role::outer_wall:
      return 0.8;
    default:
      return 1.1;
  }
}

}  // namespace ostia::workstation
