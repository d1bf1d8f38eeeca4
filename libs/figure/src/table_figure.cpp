#include "canvas.h"
#include "text.h"

#include "ostia/core/error.h"
#include "ostia/figure/plot.h"

#include <algorithm>
#include <cmath>

namespace ostia::figure {

Picture table_figure(const std::vector<std::string>& header,
                     const std::vector<std::vector<std::string>>& rows, const TableFigureOptions& options) {
  if (header.empty()) throw InvalidInput("a table needs at least one column");
  for (const auto& row : rows) {
    if (row.size() != header.size()) {
      throw InvalidInput("a table's row has " + std::to_string(row.size()) + " cells under a header of " +
                         std::to_string(header.size()));
    }
  }
  constexpr double kSize = 13.0;
  constexpr double kRow = 26.0;
  constexpr double kPadding = 14.0;
  std::vector<double> widths;
  double width = 2.0 * kPadding;
  for (std::size_t c = 0; c < header.size(); ++c) {
    double widest = Canvas::text_size(header[c], kSize, true).x();
    for (const auto& row : rows) widest = std::max(widest, Canvas::text_size(row[c], kSize).x());
    widths.push_back(widest + 2.0 * kPadding);
    width += widths.back();
  }
  const double title = options.title.empty() ? 0.0 : 36.0;
  if (title > 0.0) width = std::max(width, Canvas::text_size(options.title, 16.0, true).x() + 4.0 * kPadding);
  const double height = title + kRow * static_cast<double>(rows.size() + 1) + 2.0 * kPadding;
  const std::vector<bool> numeric = numeric_columns(header.size(), rows);
  const Theme look = theme(options.look);

  const auto draw = [&](Canvas& canvas) {
    canvas.fill(0, 0, std::ceil(width), std::ceil(height), look.background);
    double y = kPadding;
    if (title > 0.0) {
      canvas.text({2.0 * kPadding, y}, options.title,
                  {.size_px = 16, .color = look.foreground, .bold = true});
      y += title;
    }
    const auto line = [&](const std::vector<std::string>& cells, bool bold) {
      double x = kPadding;
      for (std::size_t c = 0; c < cells.size(); ++c) {
        const double at = numeric[c] ? x + widths[c] - kPadding : x + kPadding;
        canvas.text({at, y + 0.5 * kRow}, cells[c],
                    {.size_px = kSize,
                     .color = look.foreground,
                     .bold = bold,
                     .across = numeric[c] ? Align::end : Align::start,
                     .along = Align::middle});
        x += widths[c];
      }
      y += kRow;
    };
    line(header, true);
    canvas.line({kPadding, y}, {width - kPadding, y}, look.muted, 1.4);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (r % 2 == 1) canvas.fill(kPadding, y, width - 2.0 * kPadding, kRow, look.panel);
      line(rows[r], false);
    }
    canvas.line({kPadding, y}, {width - kPadding, y}, look.grid, 1.0);
  };
  return drawn(static_cast<int>(std::ceil(width)), static_cast<int>(std::ceil(height)), draw);
}

}  // namespace ostia::figure
