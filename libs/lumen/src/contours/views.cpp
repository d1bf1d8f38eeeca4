#include "ostia/lumen/views.h"

namespace ostia::lumen {

ViewSurface view_of(const reformat::CurvedReformation& reformation) {
  const reformat::CurvedOptions& options = reformation.options();
  ViewSurface view{options.width, options.height, options.pixel_mm, {}, {}};
  view.world = [reformation](const Vec2& px) { return reformation.world(px); };
  view.row = [reformation](double row_px) {
    const reformat::CurvedReformation::Row row = reformation.row(row_px);
    return ViewRow{row.start, reformation.options().pixel_mm * row.along};
  };
  return view;
}

ViewSurface view_of(const reformat::Plane& plane) {
  reformat::validate(plane);
  ViewSurface view{plane.width, plane.height, plane.pixel_mm, {}, {}};
  view.world = [plane](const Vec2& px) { return reformat::world(plane, px); };
  view.row = [plane](double row_px) {
    return ViewRow{plane.origin + row_px * plane.pixel_mm * plane.v, plane.pixel_mm * plane.u};
  };
  return view;
}

}  // namespace ostia::lumen
