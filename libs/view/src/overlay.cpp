#include "ostia/view/overlay.h"

#include "ostia/figure/plot.h"

#include <cmath>

namespace ostia::view {

ScaleBar scale_bar(double pixel_mm, int width_px) {
  const double most = pixel_mm * width_px / 4.0;
  if (!(most > 0.0) || !std::isfinite(most)) return {};
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  double length = power;
  for (const double times : {2.0, 5.0})
    if (times * power <= most) length = times * power;
  return {length / pixel_mm, figure::tick_text(length, length) + " mm"};
}

}  // namespace ostia::view
