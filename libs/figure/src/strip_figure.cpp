#include "ostia/figure/strip_figure.h"

#include "canvas.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/figure/plot.h"
#include "ostia/figure/slice_figure.h"

#include <algorithm>
#include <cmath>

namespace ostia::figure {
namespace {

constexpr double kLeft = 58.0, kGap = 14.0, kBottom = 28.0, kMarks = 10.0, kLabel = 12.0;

void validate(const std::vector<StripPanel>& panels, const StripFigureOptions& options) {
  if (panels.empty()) throw InvalidInput("a straightened vessel is drawn of at least one view");
  for (const StripPanel& panel : panels) {
    if (panel.width < 1 || panel.height != panels.front().height || panel.height < 1 ||
        panel.values.size() != static_cast<std::size_t>(panel.width) * static_cast<std::size_t>(panel.height))
      throw InvalidInput(
          "a straightened view of " + std::to_string(panel.width) + " x " + std::to_string(panel.height) +
          " pixels with " + std::to_string(panel.values.size()) +
          " values cannot be drawn beside one of height " + std::to_string(panels.front().height));
  }
  if (!(options.pixel_mm > 0.0) || !(options.window_hu > 0.0) || !std::isfinite(options.level_hu) ||
      !std::isfinite(options.first_mm) || !(options.px_per_mm >= 0.5 && options.px_per_mm <= 50.0))
    throw InvalidInput("a straightened view is drawn with 0.5 to 50 px a mm, positive pixels and window");
}

Raster grey(const StripPanel& panel, const StripFigureOptions& options) {
  Raster raster{panel.width, panel.height, {}};
  raster.rgba.reserve(4 * panel.values.size());
  for (const float value : panel.values) {
    const std::uint8_t level = grey_level(static_cast<double>(value), options.level_hu, options.window_hu);
    raster.rgba.insert(raster.rgba.end(), {level, level, level, 255});
  }
  return raster;
}

/// Where things lie.
struct StripLayout {
  double top = 0.0, height = 0.0, zoom = 1.0, first_mm = 0.0, px_per_mm = 1.0;
  std::vector<double> left, width;
  double right() const { return left.back() + width.back(); }
  double y(double s_mm) const { return top + (s_mm - first_mm) * px_per_mm; }
  double last_mm() const { return first_mm + height / px_per_mm; }
};

StripLayout layout_of(const std::vector<StripPanel>& panels, const StripFigureOptions& options) {
  StripLayout layout;
  layout.zoom = options.pixel_mm * options.px_per_mm;
  layout.first_mm = options.first_mm;
  layout.px_per_mm = options.px_per_mm;
  const bool titles =
      std::any_of(panels.begin(), panels.end(), [](const StripPanel& p) { return !p.title.empty(); });
  layout.top = 6.0 + (options.title.empty() ? 0.0 : 30.0) + (titles ? 20.0 : 0.0);
  layout.height = std::max(1.0, layout.zoom * panels.front().height);
  double x = kLeft;
  for (const StripPanel& panel : panels) {
    const double title = panel.title.empty() ? 0.0 : Canvas::text_size(panel.title, 11.5).x();
    layout.left.push_back(x);
    layout.width.push_back(layout.zoom * panel.width);
    x += std::max(layout.width.back(), title) + kGap;
  }
  return layout;
}

void draw_panel(Canvas& canvas, const StripPanel& panel, const Raster& image, const StripLayout& layout,
                std::size_t n, const StripFigureOptions& options) {
  const double left = layout.left[n], width = layout.width[n];
  if (!panel.title.empty())
    canvas.text({left, layout.top - 5.0}, panel.title,
                {.size_px = 11.5, .color = theme(options.look).foreground, .along = Align::end});
  canvas.image(image, left, layout.top, width, layout.height);
  const Canvas::Clip clip(canvas, left, layout.top, width, layout.height);
  for (const auto& line : panel.contours) {
    std::vector<Vec2> points;
    points.reserve(line.size());
    for (const Vec2& px : line) points.emplace_back(Vec2(left, layout.top) + layout.zoom * px);
    canvas.polyline(points, options.contour, 1.1);
  }
}

void draw_ruler(Canvas& canvas, const StripLayout& layout, const Theme& look, const std::string& along) {
  const int count = std::max(2, static_cast<int>(layout.height / 45.0));
  const std::vector<double> ticks = nice_ticks(layout.first_mm, layout.last_mm(), count);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
  for (const double s : ticks) {
    canvas.line({kLeft - 7.0, layout.y(s)}, {kLeft, layout.y(s)}, look.muted, 1.0);
    canvas.text({kLeft - 10.0, layout.y(s)}, tick_text(s, step),
                {.size_px = 11, .color = look.foreground, .across = Align::end, .along = Align::middle});
  }
  canvas.text({4.0, layout.top + 0.5 * layout.height}, along,
              {.size_px = 11.5, .color = look.muted, .across = Align::middle, .upwards = true});
}

/// Brackets right of the panels, with their labels moved apart where they would overlap.
void draw_marks(Canvas& canvas, const std::vector<StripMark>& marks, const StripLayout& layout) {
  std::vector<StripMark> sorted = marks;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const StripMark& a, const StripMark& b) { return a.at_mm < b.at_mm; });
  const double x = layout.right() + kMarks;
  double free = layout.top;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const StripMark& mark = sorted[i];
    const double from = std::clamp(layout.y(mark.from_mm), layout.top, layout.top + layout.height);
    const double to = std::clamp(layout.y(mark.to_mm), layout.top, layout.top + layout.height);
    const double at = std::clamp(layout.y(mark.at_mm), layout.top, layout.top + layout.height);
    canvas.line({x, from}, {x, to}, mark.color, 3.0);
    for (std::size_t p = 0; p < layout.left.size(); ++p) {
      const double left = layout.left[p], right = left + layout.width[p];
      canvas.line({left, at}, {left + 9.0, at}, mark.color, 2.0);
      canvas.line({right - 9.0, at}, {right, at}, mark.color, 2.0);
    }
    // Room is kept for the labels that are still to come.
    const double below = 15.0 * static_cast<double>(sorted.size() - 1 - i);
    const double y =
        std::max(std::min(std::max(at, free + 7.0), layout.top + layout.height - below), free + 7.0);
    canvas.line({x + 2.0, at}, {x + 8.0, y}, mark.color, 1.0);
    canvas.text({x + 11.0, y}, mark.label,
                {.size_px = kLabel, .color = mark.color, .bold = true, .along = Align::middle});
    free = y + 8.0;
  }
}

}  // namespace

Picture strip_figure(const std::vector<StripPanel>& panels, const std::vector<StripMark>& marks,
                     const StripFigureOptions& options) {
  validate(panels, options);
  const StripLayout layout = layout_of(panels, options);
  const Theme look = theme(options.look);
  double label = 0.0;
  for (const StripMark& mark : marks)
    label = std::max(label, Canvas::text_size(mark.label, kLabel, true).x() + 20.0);
  const std::string note =
      "W " + core::shown_text(options.window_hu, 0) + "  L " + core::shown_text(options.level_hu, 0) + " HU";
  const double title = options.title.empty() ? 0.0 : Canvas::text_size(options.title, 15.0, true).x();
  const double last = panels.back().title.empty() ? 0.0 : Canvas::text_size(panels.back().title, 11.5).x();
  const double width = std::max({layout.right() + kMarks + label, kLeft + title, layout.left.back() + last,
                                 kLeft + Canvas::text_size(note, 11.0).x()}) +
                       8.0;
  const double height = layout.top + layout.height + kBottom;
  std::vector<Raster> images;
  for (const StripPanel& panel : panels) images.push_back(grey(panel, options));
  return drawn(static_cast<int>(std::ceil(width)), static_cast<int>(std::ceil(height)), [&](Canvas& canvas) {
    canvas.fill(0.0, 0.0, std::ceil(width), std::ceil(height), look.background);
    if (!options.title.empty())
      canvas.text({kLeft, 18.0}, options.title,
                  {.size_px = 15, .color = look.foreground, .bold = true, .along = Align::middle});
    for (std::size_t n = 0; n < panels.size(); ++n)
      draw_panel(canvas, panels[n], images[n], layout, n, options);
    draw_ruler(canvas, layout, look, options.along);
    draw_marks(canvas, marks, layout);
    canvas.text({kLeft, layout.top + layout.height + 7.0}, note, {.size_px = 11, .color = look.muted});
  });
}

}  // namespace ostia::figure
