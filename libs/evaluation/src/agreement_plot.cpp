#include "ostia/evaluation/agreement_plot.h"

#include "ostia/evaluation/agreement.h"
#include "ostia/figure/plot.h"

#include <algorithm>
#include <cmath>

namespace ostia::evaluation {
namespace {

/// Three digits of the spread tell enough of a limit.
std::string named(const std::string& name, double value, double spread) {
  const double step = spread > 0.0 ? std::pow(10.0, std::floor(std::log10(spread)) - 2.0) : 0.01;
  return name + " " + figure::tick_text(std::round(value / step) * step, std::min(step, 1.0));
}

}  // namespace

figure::Picture agreement_plot(const std::vector<double>& reference, const std::vector<double>& result,
                               const AgreementPlotOptions& options) {
  const BlandAltman a = bland_altman(reference, result);
  figure::Series dots{"pairs", {}, {}, {}, figure::LineStyle::points, 3.0};
  for (std::size_t i = 0; i < reference.size(); ++i) {
    dots.x.push_back(0.5 * (reference[i] + result[i]));
    dots.y.push_back(result[i] - reference[i]);
  }
  std::vector<figure::Series> series{dots};
  const auto [left, right] = std::minmax_element(dots.x.begin(), dots.x.end());
  if (std::abs(a.slope) > 2.0 * a.slope_error) {  // never where either is NaN
    series.push_back({"regression",
                      {*left, *right},
                      {a.intercept + a.slope * *left, a.intercept + a.slope * *right},
                      {},
                      figure::LineStyle::dashed,
                      1.5});
  }
  figure::PlotOptions how;
  how.title = options.title;
  how.x_label = "mean of both (" + options.unit + ")";
  how.y_label = "result - reference (" + options.unit + ")";
  how.width_px = options.width_px;
  how.height_px = options.height_px;
  // What rounding alone makes differ sets no range.
  const double least = 1e-9 * std::max({std::abs(*left), std::abs(*right), 1e-300});
  if (*right - *left > least)
    how.x_range = {*left - 0.05 * (*right - *left), *right + 0.05 * (*right - *left)};
  const double room = 0.15 * (a.upper_limit - a.lower_limit);
  const auto [low, high] = std::minmax_element(dots.y.begin(), dots.y.end());
  if (room > least)
    how.y_range = {std::min(*low, a.lower_limit) - room, std::max(*high, a.upper_limit) + room};
  const double spread = room > least ? a.sd : 0.0;
  using Along = figure::ReferenceLine::Along;
  how.references = {{Along::y, a.bias, named("bias", a.bias, spread)},
                    {Along::y, a.lower_limit, named("-1.96 SD", a.lower_limit, spread)},
                    {Along::y, a.upper_limit, named("+1.96 SD", a.upper_limit, spread)}};
  return figure::line_plot(series, how);
}

}  // namespace ostia::evaluation
