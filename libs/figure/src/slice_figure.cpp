#include "ostia/figure/slice_figure.h"

#include "canvas.h"
#include "scale_bar.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/figure/plot.h"
#include "ostia/reformat/section.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::figure {
namespace {

constexpr Color kHalo{0.0, 0.0, 0.0, 0.75};
constexpr Color kOnImage{0.96, 0.96, 0.96, 1.0};

void validate(const reformat::PlaneImage& image, const SliceFigureOptions& options) {
  reformat::validate(image.plane);
  if (image.values.size() !=
      static_cast<std::size_t>(image.plane.width) * static_cast<std::size_t>(image.plane.height)) {
    throw InvalidInput("a slice of " + std::to_string(image.plane.width) + " x " +
                       std::to_string(image.plane.height) + " pixels comes with " +
                       std::to_string(image.values.size()) + " values");
  }
  if (!(options.window_hu > 0.0) || !std::isfinite(options.window_hu) || !std::isfinite(options.level_hu)) {
    throw InvalidInput("a slice's window of " + std::to_string(options.window_hu) + " HU about " +
                       std::to_string(options.level_hu) + " HU shows nothing; its width must be positive");
  }
  if (options.image_width_px < 16 || options.image_width_px > 16000) {
    throw InvalidInput("a slice " + std::to_string(options.image_width_px) +
                       " pixels wide cannot be drawn; take between 16 and 16000");
  }
}

/// Where the image lies in the figure.
struct SliceLayout {
  double left = 0, top = 0, width = 0, height = 0;
  double zoom = 1.0;  ///< figure pixels an image pixel
  Vec2 at(const Vec2& picture_px) const { return Vec2(left, top) + zoom * picture_px; }
};

void draw_rulers(Canvas& canvas, const reformat::Plane& plane, const SliceLayout& layout, const Theme& look) {
  const double bottom = layout.top + layout.height;
  const auto count = [](double length_px) { return std::max(2, static_cast<int>(length_px / 75.0)); };
  const Ruler across = horizontal_ruler(plane, count(layout.width));
  const Ruler down = vertical_ruler(plane, count(layout.height));
  const auto step = [](const Ruler& ruler) {
    return ruler.ticks.size() > 1 ? 5.0 * std::abs(ruler.ticks[1].value_mm - ruler.ticks[0].value_mm) : 1.0;
  };
  for (const Ruler::Tick& tick : across.ticks) {
    const double x = layout.left + layout.zoom * tick.position_px;
    canvas.line({x, bottom}, {x, bottom + (tick.major ? 7.0 : 3.5)}, look.muted, 1.0);
    if (tick.major) {
      canvas.text({x, bottom + 9.0}, tick_text(tick.value_mm, step(across)),
                  {.size_px = 11, .color = look.foreground, .across = Align::middle});
    }
  }
  for (const Ruler::Tick& tick : down.ticks) {
    const double y = layout.top + layout.zoom * tick.position_px;
    canvas.line({layout.left - (tick.major ? 7.0 : 3.5), y}, {layout.left, y}, look.muted, 1.0);
    if (tick.major) {
      canvas.text({layout.left - 10.0, y}, tick_text(tick.value_mm, step(down)),
                  {.size_px = 11, .color = look.foreground, .across = Align::end, .along = Align::middle});
    }
  }
  canvas.text({layout.left + 0.5 * layout.width, bottom + 24.0}, across.label,
              {.size_px = 11.5, .color = look.muted, .across = Align::middle});
  canvas.text({6.0, layout.top + 0.5 * layout.height}, down.label,
              {.size_px = 11.5, .color = look.muted, .across = Align::middle, .upwards = true});
}

void draw_contours(Canvas& canvas, const reformat::Plane& plane, const SliceLayout& layout,
                   const std::vector<SliceContour>& contours) {
  for (const SliceContour& contour : contours) {
    for (const auto& line : contour.lines) {
      std::vector<Vec2> points;
      for (const Vec3& p : line) points.push_back(layout.at(reformat::project(plane, p).picture_px));
      canvas.polyline(points, contour.color, contour.width_px);
    }
  }
}

void draw_points(Canvas& canvas, const reformat::Plane& plane, const SliceLayout& layout,
                 const std::vector<SlicePoint>& points, double reach_mm) {
  for (const SlicePoint& point : points) {
    const reformat::PlanePoint at = reformat::project(plane, point.position);
    if (!(std::abs(at.distance_mm) <= reach_mm)) continue;
    const Vec2 centre = layout.at(at.picture_px);
    canvas.circle(centre, 5.0, kHalo, 3.5);
    canvas.circle(centre, 5.0, point.color, 1.6);
    canvas.disc(centre, 1.3, point.color);
    canvas.text(centre + Vec2(9.0, 0.0), point.label,
                {.size_px = 12, .color = point.color, .bold = true, .along = Align::middle, .halo = kHalo});
  }
}

void draw_crosshair(Canvas& canvas, const reformat::Plane& plane, const SliceLayout& layout,
                    const Vec3& position) {
  const Vec2 at = layout.at(reformat::project(plane, position).picture_px);
  const Color color{0.35, 0.75, 0.95, 0.65};
  constexpr double kGap = 9.0;
  canvas.line({layout.left, at.y()}, {at.x() - kGap, at.y()}, color, 0.9);
  canvas.line({at.x() + kGap, at.y()}, {layout.left + layout.width, at.y()}, color, 0.9);
  canvas.line({at.x(), layout.top}, {at.x(), at.y() - kGap}, color, 0.9);
  canvas.line({at.x(), at.y() + kGap}, {at.x(), layout.top + layout.height}, color, 0.9);
}

void draw_letters(Canvas& canvas, const reformat::Plane& plane, const SliceLayout& layout) {
  const auto letter = [&](double x, double y, const Vec3& direction, Align across, Align along) {
    canvas.text(
        {layout.left + x, layout.top + y}, reformat::patient_letters(direction),
        {.size_px = 15, .color = kOnImage, .bold = true, .across = across, .along = along, .halo = kHalo});
  };
  const double middle_x = 0.5 * layout.width;
  const double middle_y = 0.5 * layout.height;
  letter(6.0, middle_y, -plane.u, Align::start, Align::middle);
  letter(layout.width - 6.0, middle_y, plane.u, Align::end, Align::middle);
  letter(middle_x, 4.0, -plane.v, Align::middle, Align::start);
  letter(middle_x, layout.height - 4.0, plane.v, Align::middle, Align::end);
}

/// "axial  z = 12.3 mm" where the plane is one of the three, else empty.
std::string plane_name(const reformat::Plane& plane) {
  static constexpr std::array<const char*, 3> kNames{"sagittal  x = ", "coronal  y = ", "axial  z = "};
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(plane.normal()[axis]) > 0.9999985) {
      return kNames[static_cast<std::size_t>(axis)] + core::shown_text(reformat::centre(plane)[axis], 1) +
             " mm";
    }
  }
  return {};
}

void draw_notes(Canvas& canvas, const reformat::Plane& plane, const SliceLayout& layout,
                const std::vector<SliceContour>& contours, const SliceFigureOptions& options) {
  const TextStyle note{.size_px = 11.5, .color = kOnImage, .halo = kHalo};
  if (options.plane_name) canvas.text({layout.left + 8.0, layout.top + 6.0}, plane_name(plane), note);
  TextStyle low = note;
  low.along = Align::end;
  canvas.text(
      {layout.left + 8.0, layout.top + layout.height - 6.0},
      "W " + core::shown_text(options.window_hu, 0) + "  L " + core::shown_text(options.level_hu, 0) + " HU",
      low);
  double y = layout.top + 14.0;
  TextStyle right = note;
  right.across = Align::end;
  right.along = Align::middle;
  for (const SliceContour& contour : contours) {
    if (contour.label.empty()) continue;
    const double x = layout.left + layout.width - 8.0;
    canvas.line({x - 20.0, y}, {x, y}, kHalo, contour.width_px + 2.5);
    canvas.line({x - 20.0, y}, {x, y}, contour.color, contour.width_px + 0.8);
    canvas.text({x - 26.0, y}, contour.label, right);
    y += 18.0;
  }
}

}  // namespace

std::uint8_t grey_level(double value_hu, double level_hu, double window_hu) {
  const double share = (value_hu - level_hu) / window_hu + 0.5;
  if (!(share > 0.0)) return 0;  // NaN, too
  return static_cast<std::uint8_t>(std::lround(255.0 * std::min(share, 1.0)));
}

Raster grey_raster(const reformat::PlaneImage& image, double level_hu, double window_hu) {
  Raster raster{image.plane.width, image.plane.height, {}};
  raster.rgba.resize(4 * image.values.size());
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const std::uint8_t grey = grey_level(static_cast<double>(image.values[i]), level_hu, window_hu);
    std::fill_n(raster.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i), 3, grey);
    raster.rgba[4 * i + 3] = 255;
  }
  return raster;
}

Picture slice_figure(const reformat::PlaneImage& image, const std::vector<SliceContour>& contours,
                     const std::vector<SlicePoint>& points, const SliceFigureOptions& options) {
  validate(image, options);
  SliceLayout layout;
  layout.zoom = static_cast<double>(options.image_width_px) / image.plane.width;
  layout.width = options.image_width_px;
  layout.height = std::max(1.0, std::round(layout.zoom * image.plane.height));
  layout.left = options.rulers ? 62.0 : 0.0;
  layout.top = options.title.empty() ? (options.rulers ? 10.0 : 0.0) : 36.0;
  const double width = layout.left + layout.width + (options.rulers ? 16.0 : 0.0);
  const double height = layout.top + layout.height + (options.rulers ? 46.0 : 0.0);
  const Theme look = theme(options.look);
  const Raster grey = grey_raster(image, options.level_hu, options.window_hu);

  return drawn(static_cast<int>(width), static_cast<int>(height), [&](Canvas& canvas) {
    canvas.fill(0, 0, width, height, look.background);
    if (!options.title.empty()) {
      canvas.text({layout.left, 18.0}, options.title,
                  {.size_px = 15, .color = look.foreground, .bold = true, .along = Align::middle});
    }
    canvas.image(grey, layout.left, layout.top, layout.width, layout.height);
    {
      const Canvas::Clip clip(canvas, layout.left, layout.top, layout.width, layout.height);
      if (options.crosshair) draw_crosshair(canvas, image.plane, layout, *options.crosshair);
      draw_contours(canvas, image.plane, layout, contours);
      draw_points(canvas, image.plane, layout, points, options.point_distance_mm);
      if (options.patient_letters) draw_letters(canvas, image.plane, layout);
      draw_notes(canvas, image.plane, layout, contours, options);
      if (options.scale_bar) {
        draw_scale_bar(canvas, {layout.left + layout.width - 12.0, layout.top + layout.height - 12.0},
                       image.plane.pixel_mm / layout.zoom, 0.3 * layout.width, kOnImage, kHalo);
      }
    }
    if (options.rulers) draw_rulers(canvas, image.plane, layout, look);
  });
}

Picture three_planes(const imaging::ImageVolume& image, const Vec3& position,
                     const std::vector<geometry::TriMesh>& surfaces, const std::vector<SlicePoint>& points,
                     const SliceFigureOptions& options) {
  SliceFigureOptions panel = options;
  panel.title.clear();
  panel.crosshair = position;
  std::vector<Picture> panels;
  // Finer than the screen's pixels, so that interpolation is the image's own, not the drawing's.
  const double finest = image.geometry.spacing.minCoeff();
  double extent = 0.0;
  std::vector<reformat::Plane> planes{reformat::axial_plane(image.geometry, position, finest),
                                      reformat::coronal_plane(image.geometry, position, finest),
                                      reformat::sagittal_plane(image.geometry, position, finest)};
  for (const auto& plane : planes) extent = std::max(extent, plane.width * plane.pixel_mm);
  const double pixel = extent / options.image_width_px;
  planes = {reformat::axial_plane(image.geometry, position, pixel),
            reformat::coronal_plane(image.geometry, position, pixel),
            reformat::sagittal_plane(image.geometry, position, pixel)};
  for (const reformat::Plane& plane : planes) {
    std::vector<SliceContour> contours;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      contours.push_back({reformat::section(surfaces[i], plane), palette(i), 1.6, {}});
    }
    panel.image_width_px = std::max(16, plane.width);
    panels.push_back(
        slice_figure(reformat::slice(image, plane, imaging::Interpolation::cubic), contours, points, panel));
  }
  return grid(panels, {.columns = 3, .title = options.title, .look = options.look});
}

}  // namespace ostia::figure
