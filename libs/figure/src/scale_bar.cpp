#include "scale_bar.h"

#include "ostia/figure/plot.h"

#include <cmath>

namespace ostia::figure {

double scale_bar_mm(double mm_per_px, double longest_px) {
  const double longest = mm_per_px * longest_px;
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  return power * (longest >= 5.0 * power ? 5.0 : longest >= 2.0 * power ? 2.0 : 1.0);
}

void draw_scale_bar(Canvas& canvas, const Vec2& corner, double mm_per_px, double longest_px,
                    const Color& color, const Color& halo) {
  const double mm = scale_bar_mm(mm_per_px, longest_px);
  const Vec2 start(corner.x() - mm / mm_per_px, corner.y());
  canvas.line(start - Vec2(1.5, 0), corner + Vec2(1.5, 0), halo, 6.0);
  canvas.line(start, corner, color, 3.0);
  canvas.text({0.5 * (start.x() + corner.x()), corner.y() - 5.0}, tick_text(mm, mm) + " mm",
              {.size_px = 12, .color = color, .across = Align::middle, .along = Align::end, .halo = halo});
}

}  // namespace ostia::figure
