#include "ostia/figure/value_colors.h"

#include "canvas.h"

#include "ostia/core/error.h"
#include "ostia/figure/plot.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::figure {
namespace {

constexpr Color of_bytes(int r, int g, int b) {
  return {r / 255.0, g / 255.0, b / 255.0, 1.0};
}

/// Viridis at eighths of its range; linear between them it is off by less than 2 % of a component.
constexpr std::array<Color, 9> anchors{
    of_bytes(68, 1, 84),    of_bytes(71, 44, 122),  of_bytes(59, 81, 139),
    of_bytes(44, 113, 142), of_bytes(33, 144, 141), of_bytes(39, 173, 129),
    of_bytes(92, 200, 99),  of_bytes(170, 220, 50), of_bytes(253, 231, 37)};
constexpr std::array<Color, 3> signed_anchors{of_bytes(0, 114, 178), of_bytes(240, 240, 240),
                                              of_bytes(213, 94, 0)};
constexpr Color unknown = of_bytes(128, 128, 128);

/// Linear between anchors that are evenly apart.
template <std::size_t count>
Color between(const std::array<Color, count>& colors, double t) {
  if (std::isnan(t)) return unknown;
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(count - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), count - 2);
  return mixed(colors[i], colors[i + 1], place - static_cast<double>(i));
}

constexpr double bar_width = 22.0, above = 52.0, below = 28.0;

/// Round values along the bar; where colours go with the root, 1, 2 and 5 times powers of ten as far as they
/// do not crowd.
std::vector<double> ticks_of(const ValueBar& bar) {
  if (!bar.root) return nice_ticks(bar.low, bar.high, 6);
  constexpr double apart = 0.07;  // of the bar
  std::vector<double> ticks{bar.high};
  const double range = bar.high - bar.low;
  double place = 1.0;
  for (double power = std::pow(10.0, std::floor(std::log10(range))); ticks.size() < 12; power /= 10.0) {
    for (const double step : {8.0, 5.0, 3.0, 2.0, 1.0}) {
      const double at = std::sqrt(step * power / range);
      if (at > place - apart) continue;
      if (at < apart) {
        ticks.push_back(bar.low);
        return ticks;
      }
      ticks.push_back(bar.low + step * power);
      place = at;
    }
  }
  return ticks;
}

}  // namespace

Color viridis(double t) {
  return between(anchors, t);
}

Color blue_to_vermilion(double t) {
  return between(signed_anchors, t);
}

Picture value_bar(const ValueBar& bar) {
  if (!std::isfinite(bar.low) || !std::isfinite(bar.high) || !(bar.low < bar.high))
    throw InvalidInput("the colours' range is from " + std::to_string(bar.low) + " to " +
                       std::to_string(bar.high) + "; the first has to be below the second");
  const Theme look = theme(bar.look);
  return drawn(bar.width_px, bar.height_px, [&](Canvas& canvas) {
    const double width = bar.width_px, height = bar.height_px, x = 16.0, length = height - above - below;
    canvas.fill(0, 0, width, height, look.background);
    canvas.text({x, 16.0}, bar.title, {.size_px = 13.0, .color = look.foreground, .bold = true});
    const int steps = std::max(1, static_cast<int>(length));
    for (int i = 0; i < steps; ++i)  // from the top, each a little over the next so that no gap shows
      canvas.fill(x, above + i * length / steps, bar_width, length / steps + (i + 1 < steps ? 0.5 : 0.0),
                  viridis(1.0 - (i + 0.5) / steps));
    canvas.frame(x, above, bar_width, length, look.muted, 0.8);
    const std::vector<double> ticks = ticks_of(bar);
    const double even = ticks.size() > 1 ? std::abs(ticks[1] - ticks[0]) : bar.high - bar.low;
    for (const double tick : ticks) {
      const double share = (tick - bar.low) / (bar.high - bar.low);
      const double y = above + length * (1.0 - (bar.root ? std::sqrt(share) : share));
      const double step = bar.root && tick > bar.low ? tick : even;
      const bool most = bar.more_above && tick > bar.high - 1e-9 * step;
      canvas.line({x + bar_width, y}, {x + bar_width + 5.0, y}, look.foreground, 1.0);
      canvas.text({x + bar_width + 9.0, y}, (most ? "\xe2\x89\xa5 " : "") + tick_text(tick, step),
                  {.size_px = 12.5, .color = look.foreground, .along = Align::middle});
    }
  });
}

double round_above(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (value <= step * power * (1.0 + 1e-9)) return step * power;
  return 10.0 * power;
}

}  // namespace ostia::figure
