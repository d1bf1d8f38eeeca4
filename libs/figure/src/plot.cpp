#include "ostia/figure/plot.h"

#include "canvas.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::figure {
namespace {

constexpr double kTickSize = 12.0;
constexpr double kLabelSize = 13.0;

/// The step of nice_ticks: 1, 2 or 5 times a power of ten.
double nice_step(double span, int count) {
  const double rough = span / std::max(1, count);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double share = rough / power;
  return power * (share < 1.5 ? 1.0 : share < 3.5 ? 2.0 : share < 7.5 ? 5.0 : 10.0);
}

void include(std::optional<Range>& range, double value) {
  if (!std::isfinite(value)) return;
  range = range ? Range{std::min(range->first, value), std::max(range->second, value)} : Range{value, value};
}

Range checked(const Range& range, const char* axis) {
  if (!std::isfinite(range.first) || !std::isfinite(range.second) || !(range.first < range.second)) {
    throw InvalidInput(std::string("the plot's ") + axis + " range from " + std::to_string(range.first) +
                       " to " + std::to_string(range.second) + " is empty");
  }
  return range;
}

/// Widened to whole ticks, so that the curve does not touch the frame.
Range rounded_out(Range range, int count) {
  // A range no wider than rounding has no ticks of its own.
  const double size = std::max(std::abs(range.first), std::abs(range.second));
  if (range.second - range.first <= 1e-9 * size) {
    const double half = size == 0.0 ? 1.0 : 0.1 * size;
    range = {range.first - half, range.second + half};
  }
  const double step = nice_step(range.second - range.first, count);
  const double epsilon = 1e-9;
  return {step * std::floor(range.first / step + epsilon), step * std::ceil(range.second / step - epsilon)};
}

/// The frame of a plot: where it lies, what it shows, and the map between.
struct Axes {
  double left = 0, top = 0, right = 0, bottom = 0;  // px
  Range x{0, 1}, y{0, 1};
  Vec2 operator()(double vx, double vy) const {
    return {left + (vx - x.first) / (x.second - x.first) * (right - left),
            bottom - (vy - y.first) / (y.second - y.first) * (bottom - top)};
  }
};

void validate(const PlotOptions& options) {
  const auto fits = [](int length) { return length >= 160 && length <= 8000; };
  if (!fits(options.width_px) || !fits(options.height_px)) {
    throw InvalidInput("a plot of " + std::to_string(options.width_px) + " x " +
                       std::to_string(options.height_px) +
                       " pixels cannot be drawn; both must lie between 160 and 8000");
  }
}

int x_ticks_for(const PlotOptions& options) {
  return std::clamp(options.width_px / 100, 2, 12);
}
int y_ticks_for(const PlotOptions& options) {
  return std::clamp(options.height_px / 65, 2, 10);
}

double widest_text(const std::vector<double>& ticks, double step) {
  double widest = 0.0;
  for (const double tick : ticks)
    widest = std::max(widest, Canvas::text_size(tick_text(tick, step), kTickSize).x());
  return widest;
}

double step_of(const std::vector<double>& ticks) {
  return ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
}

/// Places the frame within the picture; `legend_width` is kept free on the right.
Axes laid_out(const PlotOptions& options, const Range& x, const Range& y, double legend_width) {
  Axes axes;
  axes.x = x;
  axes.y = y;
  const auto ticks = nice_ticks(y.first, y.second, y_ticks_for(options));
  axes.left = 16.0 + (options.y_label.empty() ? 0.0 : 24.0) + widest_text(ticks, step_of(ticks)) + 8.0;
  axes.right = options.width_px - 20.0 - legend_width;
  axes.top = options.title.empty() ? 18.0 : 48.0;
  axes.bottom = options.height_px - 34.0 - (options.x_label.empty() ? 0.0 : 22.0);
  return axes;
}

void draw_axes(Canvas& canvas, const Axes& axes, const PlotOptions& options, const Theme& look, bool x_grid) {
  canvas.fill(0, 0, options.width_px, options.height_px, look.background);
  const double middle_x = 0.5 * (axes.left + axes.right);
  if (!options.title.empty()) {
    canvas.text({axes.left, 16.0}, options.title, {.size_px = 16, .color = look.foreground, .bold = true});
  }
  const TextStyle label{.size_px = kLabelSize, .color = look.foreground, .across = Align::middle};
  if (!options.x_label.empty()) canvas.text({middle_x, axes.bottom + 29.0}, options.x_label, label);
  if (!options.y_label.empty()) {
    TextStyle upright = label;
    upright.upwards = true;
    canvas.text({14.0, 0.5 * (axes.top + axes.bottom)}, options.y_label, upright);
  }
  const auto x_ticks = nice_ticks(axes.x.first, axes.x.second, x_ticks_for(options));
  const auto y_ticks = nice_ticks(axes.y.first, axes.y.second, y_ticks_for(options));
  for (const double tick : x_ticks) {
    const double x = axes(tick, axes.y.first).x();
    if (x_grid) canvas.line({x, axes.top}, {x, axes.bottom}, look.grid, 1.0);
    canvas.line({x, axes.bottom}, {x, axes.bottom + 5.0}, look.muted, 1.0);
    canvas.text({x, axes.bottom + 8.0}, tick_text(tick, step_of(x_ticks)),
                {.size_px = kTickSize, .color = look.muted, .across = Align::middle});
  }
  for (const double tick : y_ticks) {
    const double y = axes(axes.x.first, tick).y();
    canvas.line({axes.left, y}, {axes.right, y}, look.grid, 1.0);
    canvas.line({axes.left - 5.0, y}, {axes.left, y}, look.muted, 1.0);
    canvas.text({axes.left - 8.0, y}, tick_text(tick, step_of(y_ticks)),
                {.size_px = kTickSize, .color = look.muted, .across = Align::end, .along = Align::middle});
  }
}

void draw_frame(Canvas& canvas, const Axes& axes, const Theme& look) {
  canvas.line({axes.left, axes.top}, {axes.left, axes.bottom}, look.muted, 1.2);
  canvas.line({axes.left, axes.bottom}, {axes.right, axes.bottom}, look.muted, 1.2);
}

void draw_references(Canvas& canvas, const Axes& axes, const PlotOptions& options, const Theme& look) {
  for (const ReferenceLine& reference : options.references) {
    const bool along_x = reference.along == ReferenceLine::Along::x;
    const Range& range = along_x ? axes.x : axes.y;
    if (!(reference.value >= range.first && reference.value <= range.second)) continue;
    const TextStyle note{.size_px = 11,
                         .color = look.foreground,
                         .across = along_x ? Align::start : Align::end,
                         .along = along_x ? Align::start : Align::end,
                         .halo = look.background};
    if (along_x) {
      const double x = axes(reference.value, axes.y.first).x();
      canvas.polyline({{x, axes.top}, {x, axes.bottom}}, look.muted, 1.4, true);
      canvas.text({x + 5.0, axes.top + 2.0}, reference.label, note);
    } else {
      const double y = axes(axes.x.first, reference.value).y();
      canvas.polyline({{axes.left, y}, {axes.right, y}}, look.muted, 1.4, true);
      canvas.text({axes.right - 4.0, y - 2.0}, reference.label, note);
    }
  }
}

Color color_of(const Series& series, std::size_t index, const PlotOptions& options) {
  if (series.color) return *series.color;
  const Color color = palette(index);
  // Light colours are too pale for thin lines on white.
  const double luminance = 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
  return options.look == Look::light && luminance > 0.6 ? mixed(color, {0, 0, 0}, 0.22) : color;
}

void draw_series(Canvas& canvas, const Axes& axes, const Series& series, const Color& color) {
  const Canvas::Clip clip(canvas, axes.left - 1.0, axes.top - 1.0, axes.right - axes.left + 2.0,
                          axes.bottom - axes.top + 2.0);
  std::vector<Vec2> run;
  const auto end_run = [&] {
    if (series.style == LineStyle::points || run.size() == 1) {
      for (const Vec2& p : run) canvas.disc(p, 1.6 * series.width_px, color);
    } else {
      canvas.polyline(run, color, series.width_px, series.style == LineStyle::dashed);
    }
    run.clear();
  };
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (std::isfinite(series.x[i]) && std::isfinite(series.y[i])) {
      run.push_back(axes(series.x[i], series.y[i]));
    } else {
      end_run();
    }
  }
  end_run();
}

double legend_width(const std::vector<Series>& series) {
  double widest = 0.0;
  for (const Series& s : series) widest = std::max(widest, Canvas::text_size(s.name, kTickSize).x());
  return series.size() > 1 && widest > 0.0 ? widest + 52.0 : 0.0;
}

void draw_legend(Canvas& canvas, const Axes& axes, const std::vector<Series>& series,
                 const PlotOptions& options, const Theme& look) {
  if (legend_width(series) == 0.0) return;
  double y = axes.top + 8.0;
  for (std::size_t i = 0; i < series.size(); ++i, y += 22.0) {
    const double x = axes.right + 16.0;
    const Color color = color_of(series[i], i, options);
    if (series[i].style == LineStyle::points) {
      canvas.disc({x + 12.0, y}, 1.6 * series[i].width_px, color);
    } else {
      canvas.polyline({{x, y}, {x + 24.0, y}}, color, series[i].width_px + 0.5,
                      series[i].style == LineStyle::dashed);
    }
    canvas.text({x + 32.0, y}, series[i].name,
                {.size_px = kTickSize, .color = look.foreground, .along = Align::middle});
  }
}

}  // namespace

std::vector<double> nice_ticks(double low, double high, int count) {
  std::vector<double> ticks;
  if (!std::isfinite(low) || !std::isfinite(high) || !(low < high) || count < 1) return ticks;
  const double step = nice_step(high - low, count);
  const double first = std::ceil(low / step - 1e-9);
  const double last = std::floor(high / step + 1e-9);
  for (double i = first; i <= last; i += 1.0) ticks.push_back(i == 0.0 ? 0.0 : i * step);
  return ticks;
}

std::string tick_text(double value, double step) {
  const int decimals = step > 0.0 && std::isfinite(step)
                           ? std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 12)
                           : 3;
  return core::shown_text(value, decimals, "\xE2\x80\x93");  // en dash
}

Picture line_plot(const std::vector<Series>& series, const PlotOptions& options) {
  validate(options);
  std::optional<Range> x;
  std::optional<Range> y;
  for (const Series& s : series) {
    if (s.x.size() != s.y.size()) {
      throw InvalidInput("the plot's series \"" + s.name + "\" has " + std::to_string(s.x.size()) +
                         " x but " + std::to_string(s.y.size()) + " y values");
    }
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) continue;
      include(x, s.x[i]);
      include(y, s.y[i]);
    }
  }
  if (options.x_range) x = checked(*options.x_range, "x");
  if (options.y_range) y = checked(*options.y_range, "y");
  if (!x || !y) throw InvalidInput("the plot \"" + options.title + "\" has no finite value to show");
  if (options.y_from_zero && !options.y_range) include(y, 0.0);
  if (!options.x_range && x->first == x->second) x = rounded_out(*x, x_ticks_for(options));
  if (!options.y_range) y = rounded_out(*y, y_ticks_for(options));

  const Theme look = theme(options.look);
  const Axes axes = laid_out(options, *x, *y, legend_width(series));
  return drawn(options.width_px, options.height_px, [&](Canvas& canvas) {
    draw_axes(canvas, axes, options, look, true);
    draw_references(canvas, axes, options, look);
    for (std::size_t i = 0; i < series.size(); ++i) {
      draw_series(canvas, axes, series[i], color_of(series[i], i, options));
    }
    draw_frame(canvas, axes, look);
    draw_legend(canvas, axes, series, options, look);
  });
}

Histogram histogram(const std::vector<double>& values, int bins, std::optional<Range> range) {
  if (bins < 1 || bins > 100000) {
    throw InvalidInput("a histogram needs between 1 and 100000 bins, not " + std::to_string(bins));
  }
  if (range) {
    checked(*range, "histogram");
  } else {
    for (const double value : values) include(range, value);
    if (!range) range = Range{0.0, 1.0};
    if (range->first == range->second) range = rounded_out(*range, 5);
  }
  Histogram result;
  result.low = range->first;
  result.high = range->second;
  result.counts.assign(static_cast<std::size_t>(bins), 0);
  for (const double value : values) {
    if (!std::isfinite(value)) {
      ++result.not_finite;
    } else if (value < result.low) {
      ++result.below;
    } else if (value > result.high) {
      ++result.above;
    } else {
      const double share = (value - result.low) / (result.high - result.low);
      ++result.counts[std::min(result.counts.size() - 1, static_cast<std::size_t>(share * bins))];
    }
  }
  return result;
}

Picture histogram_plot(const Histogram& histogram, const PlotOptions& options) {
  validate(options);
  const Range x =
      options.x_range ? checked(*options.x_range, "x") : checked({histogram.low, histogram.high}, "x");
  std::size_t highest = 1;
  for (const std::size_t count : histogram.counts) highest = std::max(highest, count);
  const Range y = options.y_range ? checked(*options.y_range, "y")
                                  : rounded_out({0.0, static_cast<double>(highest)}, y_ticks_for(options));
  const Theme look = theme(options.look);
  const Axes axes = laid_out(options, x, y, 0.0);
  const double bin = (histogram.high - histogram.low) / static_cast<double>(histogram.counts.size());
  return drawn(options.width_px, options.height_px, [&](Canvas& canvas) {
    draw_axes(canvas, axes, options, look, false);
    {
      const Canvas::Clip clip(canvas, axes.left, axes.top, axes.right - axes.left, axes.bottom - axes.top);
      for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
        const double low = histogram.low + static_cast<double>(i) * bin;
        const Vec2 a = axes(low, static_cast<double>(histogram.counts[i]));
        const Vec2 b = axes(low + bin, 0.0);
        const double space = b.x() - a.x() > 4.0 ? 1.0 : 0.0;
        canvas.fill(a.x() + 0.5 * space, a.y(), b.x() - a.x() - space, b.y() - a.y(), palette(5));
      }
    }
    draw_references(canvas, axes, options, look);
    draw_frame(canvas, axes, look);
  });
}

}  // namespace ostia::figure
