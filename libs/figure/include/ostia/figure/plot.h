#pragma once
/// \file Line plots, histograms and tables.

#include "ostia/figure/picture.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ostia::figure {

enum class LineStyle { solid, dashed, points };

/// One curve. A value that is not finite breaks the line.
struct Series {
  std::string name{};
  std::vector<double> x{}, y{};  ///< the same length
  std::optional<Color> color{};  ///< the palette's next, unless given
  LineStyle style = LineStyle::solid;
  double width_px = 2.0;
};

/// A straight line across the plot at x or y, with a note.
struct ReferenceLine {
  enum class Along { x, y } along = Along::y;
  double value = 0.0;
  std::string label{};
};

using Range = std::pair<double, double>;

struct PlotOptions {
  std::string title{}, x_label{}, y_label{};
  int width_px = 720, height_px = 420;  ///< 160 to 8,000
  Look look = Look::light;
  std::optional<Range> x_range{}, y_range{};  ///< what the data need, unless given
  bool y_from_zero = false;
  std::vector<ReferenceLine> references{};
};

/// Round numbers (1, 2 or 5 times a power of ten apart) within [low, high], about `count` of them.
std::vector<double> nice_ticks(double low, double high, int count);
/// A number with the decimals that a step needs: tick_text(0.30000000000000004, 0.1) is "0.3". Never depends
/// on the locale.
std::string tick_text(double value, double step);

/// Throws InvalidInput where x and y differ in length, no finite value is there to set a range, or a range is
/// empty.
Picture line_plot(const std::vector<Series>& series, const PlotOptions& options = {});

struct Histogram {
  double low = 0.0, high = 1.0;
  std::vector<std::size_t> counts{};  ///< [low + i w, low + (i + 1) w), the last closed
  std::size_t below = 0, above = 0, not_finite = 0;
};
/// `range` is that of the finite values unless given. Throws InvalidInput for no bin or an empty range given.
Histogram histogram(const std::vector<double>& values, int bins, std::optional<Range> range = {});
Picture histogram_plot(const Histogram& histogram, const PlotOptions& options = {});

struct TableFigureOptions {
  std::string title{};
  Look look = Look::light;
};
/// Rows of the header's length; columns whose cells are all numbers are set flush right.
Picture table_figure(const std::vector<std::string>& header,
                     const std::vector<std::vector<std::string>>& rows,
                     const TableFigureOptions& options = {});

}  // namespace ostia::figure
