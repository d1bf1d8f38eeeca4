#include "canvas.h"

#include "text.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"

#include <pango/pangocairo.h>

#include <cmath>
#include <cstring>
#include <numbers>

namespace ostia::figure {
namespace {

struct Release {
  void operator()(PangoLayout* p) const { g_object_unref(p); }
  void operator()(cairo_surface_t* p) const { cairo_surface_destroy(p); }
  void operator()(cairo_t* p) const { cairo_destroy(p); }
  void operator()(PangoFontDescription* p) const { pango_font_description_free(p); }
  void operator()(cairo_font_options_t* p) const { cairo_font_options_destroy(p); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

Owned<PangoLayout> layout_of(cairo_t* context, const std::string& text, double size_px, bool bold) {
  Owned<PangoLayout> layout(pango_cairo_create_layout(context));
  const Owned<PangoFontDescription> font(pango_font_description_from_string("DejaVu Sans"));
  pango_font_description_set_weight(font.get(), bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_font_description_set_absolute_size(font.get(), size_px * PANGO_SCALE);
  pango_layout_set_font_description(layout.get(), font.get());
  // Unhinted, so that text has the same width at every density and in every file format.
  const Owned<cairo_font_options_t> options(cairo_font_options_create());
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  PangoContext* pango = pango_layout_get_context(layout.get());
  pango_cairo_context_set_font_options(pango, options.get());
  pango_cairo_context_set_resolution(pango, 96.0);
  pango_layout_context_changed(layout.get());
  const std::string clean = clean_utf8(core::redacted(text));
  pango_layout_set_text(layout.get(), clean.data(), static_cast<int>(clean.size()));
  return layout;
}

Vec2 size_of(PangoLayout* layout) {
  PangoRectangle extents;
  pango_layout_get_extents(layout, nullptr, &extents);
  return Vec2(extents.width, extents.height) / PANGO_SCALE;
}

double aligned(Align align, double length) {
  return align == Align::start ? 0.0 : align == Align::middle ? -0.5 * length : -length;
}

}  // namespace

void Canvas::set(const Color& color) {
  cairo_set_source_rgba(context_, color.r, color.g, color.b, color.a);
}

void Canvas::fill(double x, double y, double width, double height, const Color& color) {
  set(color);
  cairo_rectangle(context_, x, y, width, height);
  cairo_fill(context_);
}

void Canvas::frame(double x, double y, double width, double height, const Color& color, double line_px) {
  set(color);
  cairo_set_line_width(context_, line_px);
  cairo_rectangle(context_, x, y, width, height);
  cairo_stroke(context_);
}

void Canvas::line(const Vec2& a, const Vec2& b, const Color& color, double line_px) {
  set(color);
  cairo_set_line_width(context_, line_px);
  cairo_set_line_cap(context_, CAIRO_LINE_CAP_BUTT);
  cairo_move_to(context_, a.x(), a.y());
  cairo_line_to(context_, b.x(), b.y());
  cairo_stroke(context_);
}

void Canvas::polyline(const std::vector<Vec2>& points, const Color& color, double line_px, bool dashed) {
  if (points.size() < 2) return;
  set(color);
  cairo_set_line_width(context_, line_px);
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context_, dashed ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
  if (dashed) {
    const double pattern[] = {3.5 * line_px, 2.2 * line_px};
    cairo_set_dash(context_, pattern, 2, 0.0);
  }
  for (const Vec2& p : points) cairo_line_to(context_, p.x(), p.y());
  if (points.front() == points.back()) cairo_close_path(context_);
  cairo_stroke(context_);
  cairo_set_dash(context_, nullptr, 0, 0.0);
}

void Canvas::polygon(const std::vector<Vec2>& points, const Color& color) {
  set(color);
  for (const Vec2& p : points) cairo_line_to(context_, p.x(), p.y());
  cairo_close_path(context_);
  cairo_fill(context_);
}

void Canvas::disc(const Vec2& centre, double radius, const Color& color) {
  set(color);
  cairo_new_sub_path(context_);
  cairo_arc(context_, centre.x(), centre.y(), radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(context_);
}

void Canvas::circle(const Vec2& centre, double radius, const Color& color, double line_px) {
  set(color);
  cairo_set_line_width(context_, line_px);
  cairo_new_sub_path(context_);
  cairo_arc(context_, centre.x(), centre.y(), radius, 0.0, 2.0 * std::numbers::pi);
  cairo_stroke(context_);
}

void Canvas::text(const Vec2& at, const std::string& text, const TextStyle& style) {
  const auto layout = layout_of(context_, text, style.size_px, style.bold);
  const Vec2 size = size_of(layout.get());
  cairo_save(context_);
  cairo_translate(context_, at.x(), at.y());
  if (style.upwards) cairo_rotate(context_, -0.5 * std::numbers::pi);
  cairo_translate(context_, aligned(style.across, size.x()), aligned(style.along, size.y()));
  if (style.halo.a > 0.0) {
    set(style.halo);
    cairo_set_line_width(context_, 0.28 * style.size_px);
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
    cairo_move_to(context_, 0.0, 0.0);
    pango_cairo_layout_path(context_, layout.get());
    cairo_stroke(context_);
  }
  set(style.color);
  cairo_move_to(context_, 0.0, 0.0);
  pango_cairo_show_layout(context_, layout.get());
  cairo_new_path(context_);  // Pango leaves a current point, to which the next line would be joined
  cairo_restore(context_);
}

Vec2 Canvas::text_size(const std::string& text, double size_px, bool bold) {
  const Owned<cairo_surface_t> surface(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr));
  const Owned<cairo_t> context(cairo_create(surface.get()));
  return size_of(layout_of(context.get(), text, size_px, bold).get());
}

void Canvas::image(const Raster& raster, double x, double y, double width, double height) {
  if (raster.width < 1 || raster.height < 1) return;
  const Owned<cairo_surface_t> surface(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, raster.width, raster.height));
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  if (data == nullptr) throw ResourceError("not enough memory for an image of a figure");
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int row = 0; row < raster.height; ++row) {
    for (int column = 0; column < raster.width; ++column) {
      const std::uint8_t* p = raster.pixel(column, row);
      const auto alpha = static_cast<std::uint32_t>(p[3]);
      const auto premultiplied = [&](std::uint8_t c) { return (c * alpha + 127U) / 255U; };
      const std::uint32_t argb =
          (alpha << 24) | (premultiplied(p[0]) << 16) | (premultiplied(p[1]) << 8) | premultiplied(p[2]);
      std::memcpy(data + static_cast<std::ptrdiff_t>(row) * stride + 4 * static_cast<std::ptrdiff_t>(column),
                  &argb, 4);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  cairo_save(context_);
  cairo_translate(context_, x, y);
  cairo_rectangle(context_, 0.0, 0.0, width, height);
  cairo_clip(context_);
  cairo_scale(context_, width / raster.width, height / raster.height);
  cairo_set_source_surface(context_, surface.get(), 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(context_), CAIRO_FILTER_BILINEAR);
  cairo_pattern_set_extend(cairo_get_source(context_), CAIRO_EXTEND_PAD);
  cairo_paint(context_);
  cairo_restore(context_);
}

void Canvas::picture(const Picture& picture, double x, double y, double scale) {
  cairo_save(context_);
  cairo_translate(context_, x, y);
  cairo_scale(context_, scale, scale);
  picture.drawing().replay(context_);
  cairo_restore(context_);
}

Canvas::Clip::Clip(Canvas& canvas, double x, double y, double width, double height) : canvas_(canvas) {
  cairo_save(canvas_.context_);
  cairo_rectangle(canvas_.context_, x, y, width, height);
  cairo_clip(canvas_.context_);
}

Canvas::Clip::~Clip() {
  cairo_restore(canvas_.context_);
}

Drawing::Drawing(int width, int height, const std::function<void(Canvas&)>& draw)
    : width_(width), height_(height) {
  constexpr int kLongest = 32767;
  if (width < 1 || height < 1 || width > kLongest || height > kLongest) {
    throw InvalidInput("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                       " pixels cannot be drawn; both must lie between 1 and 32767");
  }
  const cairo_rectangle_t extents{0.0, 0.0, static_cast<double>(width), static_cast<double>(height)};
  Owned<cairo_surface_t> recording(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extents));
  {
    const Owned<cairo_t> context(cairo_create(recording.get()));
    Canvas canvas(context.get());
    draw(canvas);
    const cairo_status_t status = cairo_status(context.get());
    if (status != CAIRO_STATUS_SUCCESS) {
      throw ResourceError(std::string("a figure could not be drawn: ") + cairo_status_to_string(status));
    }
  }
  recording_ = recording.release();
}

Drawing::~Drawing() {
  cairo_surface_destroy(recording_);
}

void Drawing::replay(cairo_t* context) const {
  cairo_save(context);
  cairo_set_source_surface(context, recording_, 0.0, 0.0);
  cairo_paint(context);
  cairo_restore(context);
}

const std::string& Drawing::png(double density, const std::function<std::string()>& encoded) const {
  const std::lock_guard hold(encoding_);
  const auto known = png_.find(density);
  return known != png_.end() ? known->second : png_.emplace(density, encoded()).first->second;
}

Picture drawn(int width, int height, const std::function<void(Canvas&)>& draw) {
  return Picture(std::make_shared<const Drawing>(width, height, draw));
}

}  // namespace ostia::figure
