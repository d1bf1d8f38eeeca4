#pragma once
/// \file Straightened vessels side by side, with one ruler along the vessel and what is marked on it.

#include "ostia/figure/picture.h"
#include "ostia/geometry/vec.h"

#include <string>
#include <vector>

namespace ostia::figure {

/// A view whose rows run along the vessel at equal steps.
struct StripPanel {
  std::string title{};
  int width = 0, height = 0;
  std::vector<float> values{};                          ///< HU, rows from the top; NaN (outside) is black
  std::vector<std::vector<geometry::Vec2>> contours{};  ///< picture coordinates, px
};

/// A stretch of the vessel, with a place in it.
struct StripMark {
  double from_mm = 0.0, to_mm = 0.0, at_mm = 0.0;
  std::string label{};
  Color color = palette(3);
};

struct StripFigureOptions {
  std::string title{};
  std::string along = "mm along the vessel";  ///< at the ruler
  double pixel_mm = 0.25;                     ///< of the views, both ways
  double first_mm = 0.0;                      ///< abscissa of the first row's outer edge
  double px_per_mm = 4.0;                     ///< of the picture, both ways, [0.5, 50]
  double level_hu = 250.0, window_hu = 900.0;
  Color contour = colors::contour;
  Look look = Look::light;
};

/// Throws InvalidInput without panels, for panels of different heights or whose values do not fill them, and
/// for options out of range.
Picture strip_figure(const std::vector<StripPanel>& panels, const std::vector<StripMark>& marks = {},
                     const StripFigureOptions& options = {});

}  // namespace ostia::figure
