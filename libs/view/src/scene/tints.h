#pragma once
/// \file Parts of what colours pixels of a view: where they are, and where they lie about a vessel.

#include "ostia/core/parallel.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/session/outer_walls.h"
#include "ostia/view/curved_view.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

namespace ostia::view {

/// Nothing coloured yet, from one corner to the other as far as the view reaches.
OverlayTint blank_tint(const PictureView& view, const Vec2& low, const Vec2& high, std::vector<Role> roles);

/// Asks `of_row(y, pixels)` for each row, rows side by side; y is of the pixels' middles.
template <class OfRow>
void fill_tint(OverlayTint& tint, const OfRow& of_row) {
  core::parallel_for(static_cast<std::size_t>(tint.height), 16, [&](std::size_t row) {
    of_row(tint.top + static_cast<double>(row) + 0.5,
           tint.what.data() + row * static_cast<std::size_t>(tint.width));
  });
}

/// Where pixels of a stretched reformation lie about the vessel's axis: looked for at the corners of a mesh
/// over the tint, row by row from the axis outwards, near the row's own abscissa, as far as the vessel
/// reaches; between them places change evenly.
class PlacesAbout {
 public:
  /// `widest_mm`: how far from the axis places are wanted.
  PlacesAbout(CurvedView& view, const geometry::AxisCurve& axis, double widest_mm, const OverlayTint& tint);
  /// Of the middle of the tint's pixel in this column, in the row whose middles are at y: abscissa, and
  /// across the axis along theta = 0 and 90 degrees. Nothing where the vessel is not.
  std::optional<Vec3> at(int column, double y) const;

 private:
  int top_, columns_, rows_;
  double torn_mm_;
  std::vector<std::optional<Vec3>> mesh_;
};

/// Of a table of colours, in its order.
template <class Colors>
std::vector<Role> roles_of(const Colors& colors) {
  std::vector<Role> roles;
  for (const auto& one : colors) roles.push_back(one.role);
  return roles;
}

/// The outer wall's largest distance from the axis; 0 where there is none.
double widest_mm(const session::VesselWalls& walls);

/// What is coloured about a vessel: along its axis, and `widest_mm` about it.
struct TintedStretch {
  const geometry::AxisCurve& axis;
  double from_mm, to_mm, widest_mm;
  std::vector<Role> roles;
};

/// Each row is a line across the axis. `ray_at(s, theta)` is a function that says the code of a pixel by its
/// distance from the axis, in mm.
template <class RayAt>
OverlayTint tint_straightened(CurvedView& view, const TintedStretch& stretch, const RayAt& ray_at) {
  const double pixel = view.pixel_mm(), reach = stretch.widest_mm / pixel + 1.0;
  const double middle = view.axis_at(stretch.from_mm).x(),
               theta = view.theta_deg() * std::numbers::pi / 180.0;
  OverlayTint tint = blank_tint(view, {middle - reach, view.row_of(stretch.from_mm)},
                                {middle + reach, view.row_of(stretch.to_mm)}, stretch.roles);
  fill_tint(tint, [&](double y, std::uint8_t* row) {
    const double s = view.abscissa_at(y);
    const auto right = ray_at(s, theta), left = ray_at(s, theta + std::numbers::pi);
    for (int i = 0; i < tint.width; ++i) {
      const double from = pixel * (tint.left + i + 0.5 - middle);
      row[i] = from >= 0.0 ? right(from) : left(-from);
    }
  });
  return tint;
}

/// Rows cross the vessel as it comes.
template <class RayAt>
OverlayTint tint_stretched(CurvedView& view, const TintedStretch& stretch, const RayAt& ray_at) {
  const double beside = stretch.widest_mm / view.pixel_mm();
  OverlayTint tint =
      blank_tint(view, {0.0, view.row_of(stretch.from_mm) - beside},
                 {static_cast<double>(view.width()), view.row_of(stretch.to_mm) + beside}, stretch.roles);
  const PlacesAbout places(view, stretch.axis, stretch.widest_mm, tint);
  fill_tint(tint, [&](double y, std::uint8_t* row) {
    for (int i = 0; i < tint.width; ++i)
      if (const auto at = places.at(i, y))
        row[i] = ray_at(at->x(), std::atan2(at->z(), at->y()))(at->tail<2>().norm());
  });
  return tint;
}

/// On the reformation as it is shown; empty while a hand turns a stretched one.
template <class RayAt>
OverlayTint tint_about_vessel(CurvedView& view, const TintedStretch& stretch, const RayAt& ray_at) {
  if (view.bench().curved_mode.get() == reformat::CurvedMode::straightened)
    return tint_straightened(view, stretch, ray_at);
  return view.bench().turning.get() ? OverlayTint{} : tint_stretched(view, stretch, ray_at);
}

/// Has the view's layer drawn anew when it is switched on or off, when something else is known, and, while it
/// is on, when a hand begins or ends to turn the view.
std::vector<session::Subscription> redraw_with(PictureView& view, session::Property<bool>& shown,
                                               session::Signal<>& changed);

}  // namespace ostia::view
