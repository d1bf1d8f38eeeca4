#pragma once
/// \file Parts of what colours pixels of a view: where they are, and where they lie about a vessel.

#include "ostia/core/parallel.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/view/curved_view.h"

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

}  // namespace ostia::view
