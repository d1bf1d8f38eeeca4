#include "ostia/lumen/contour_lines.h"

#include "contours/contour_tracer.h"

#include "ostia/core/error.h"

#include <cmath>
#include <string>

namespace ostia::lumen {

void validate(const ContourLineOptions& options) {
  if (!(options.step_px >= 0.5 && options.step_px <= 16.0))
    throw InvalidInput("contours are followed in steps of " + std::to_string(options.step_px) +
                       " pixels; give 0.5 to 16");
  if (!(options.largest_mm >= 0.01) || !std::isfinite(options.largest_mm))
    throw InvalidInput("contours are followed through cells of at most " +
                       std::to_string(options.largest_mm) + " mm; give at least 0.01 mm");
  if (!(options.bend_px > 0.0 && options.bend_px <= 1.0))
    throw InvalidInput("contours are straight to " + std::to_string(options.bend_px) +
                       " pixels; give more than 0 and at most 1");
}

void validate(const ViewSurface& view) {
  constexpr int most_pixels = 32767;
  if (view.width < 1 || view.height < 1 || view.width > most_pixels || view.height > most_pixels)
    throw InvalidInput("a view of " + std::to_string(view.width) + " x " + std::to_string(view.height) +
                       " pixels has no contours; both must lie between 1 and " + std::to_string(most_pixels));
  if (!(view.pixel_mm > 0.0) || !std::isfinite(view.pixel_mm))
    throw InvalidInput("the pixels of a view are " + std::to_string(view.pixel_mm) +
                       " mm wide; they must be wider than 0");
  if (!view.world && !view.row) throw InvalidInput("a view has no map to the world");
}

std::vector<ContourLine> contour_lines(const ScalarField& field, const ViewSurface& view,
                                       const std::vector<Vec2>& seeds_px, const ContourLineOptions& options) {
  validate(view);
  validate(options);
  return ContourTracer(view, seeds_px, options).trace(field);
}

}  // namespace ostia::lumen
