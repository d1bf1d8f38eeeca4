#include "ostia/analysis/graph_report.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::analysis {
namespace {

using geometry::VesselGraph;

void fit_orders(TreeReport& report) {
  std::vector<double> order, diameter, length, number;
  for (const OrderMeasure& row : report.orders) {
    order.push_back(row.order);
    diameter.push_back(row.element_diameter_mm.mean);
    length.push_back(row.element_length_mm.mean);
    number.push_back(static_cast<double>(row.element_diameter_mm.count));
  }
  report.diameter_fit = fit_log(order, diameter);
  report.length_fit = fit_log(order, length);
  report.number_fit = fit_log(order, number);
}

void gather_exponents(TreeReport& report) {
  std::vector<double> all;
  std::vector<std::vector<double>> by_order(report.orders.size());
  for (const ForkExponent& fork : report.exponents) {
    if (!fork.k) continue;
    const std::int32_t branch = report.links.branch_of[static_cast<std::size_t>(fork.parent)];
    const std::int32_t order = report.diameter_orders.of_branch[static_cast<std::size_t>(branch)];
    all.push_back(*fork.k);
    by_order[static_cast<std::size_t>(order - 1)].push_back(*fork.k);
  }
  report.murray_median = median(std::move(all));
  for (std::vector<double>& values : by_order)
    report.murray_by_order.push_back(values.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                    : median(std::move(values)));
}

void sum_roots(TreeReport& report) {
  for (std::size_t e = 0; e < report.subtrees.size(); ++e) {
    if (report.links.parent[e] >= 0) continue;
    const SubtreeTotals& tree = report.subtrees[e];
    report.total.length_mm += tree.length_mm;
    report.total.area_mm2 += tree.area_mm2;
    report.total.volume_mm3 += tree.volume_mm3;
    report.total.segments += tree.segments;
    report.total.ends += tree.ends;
  }
}

/// The bin of each value is found by its place between the ends, on the scale of the bins.
struct Scale {
  double low = 0.0, high = 0.0;
  bool logarithmic = false;
  double place(double value) const { return logarithmic ? std::log10(value) : value; }
  double value(double at) const { return logarithmic ? std::pow(10.0, at) : at; }
};

}  // namespace

LogFit fit_log(const std::vector<double>& x, const std::vector<double>& y) {
  LogFit fit;
  double sx = 0.0, sy = 0.0;
  const auto counts = [&](std::size_t i) { return std::isfinite(y[i]) && y[i] > 0.0; };
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!counts(i)) continue;
    ++fit.points;
    sx += x[i];
    sy += std::log10(y[i]);
  }
  if (fit.points < 2) return fit;
  const double mx = sx / fit.points, my = sy / fit.points;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!counts(i)) continue;
    const double dx = x[i] - mx, dy = std::log10(y[i]) - my;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  if (xx <= 0.0) return fit;
  fit.b = xy / xx;
  fit.a = my - fit.b * mx;
  fit.ratio = std::pow(10.0, fit.b);
  fit.r_squared = yy > 0.0 ? xy * xy / (xx * yy) : 1.0;
  return fit;
}

Histogram histogram(const std::vector<double>& values, int bins, bool logarithmic) {
  if (bins < 1) throw InvalidInput("histogram of " + std::to_string(bins) + " bins; give at least 1");
  Histogram result;
  result.logarithmic = logarithmic;
  Scale scale{0.0, 0.0, logarithmic};
  const auto counts = [&](double v) { return std::isfinite(v) && (!logarithmic || v > 0.0); };
  bool any = false;
  for (const double v : values) {
    if (!counts(v)) continue;
    scale.low = any ? std::min(scale.low, scale.place(v)) : scale.place(v);
    scale.high = any ? std::max(scale.high, scale.place(v)) : scale.place(v);
    any = true;
  }
  if (!any) return result;
  const bool one = !(scale.high > scale.low);
  const auto number = static_cast<std::size_t>(one ? 1 : bins);
  const double width = (scale.high - scale.low) / static_cast<double>(number);
  for (std::size_t i = 0; i <= number; ++i)
    result.bounds.push_back(
        scale.value(i == number ? scale.high : scale.low + width * static_cast<double>(i)));
  result.counts.assign(number, 0);
  for (const double v : values) {
    if (!counts(v)) continue;
    const double bin = one ? 0.0 : (scale.place(v) - scale.low) / width;
    ++result.counts[std::min(number - 1, static_cast<std::size_t>(std::max(0.0, bin)))];
  }
  return result;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

TreeReport measure_tree(const VesselGraph& graph, const core::TaskContext& task) {
  TreeReport report;
  task.set_stage("orders and totals");
  const geometry::GraphIncidence incidence(graph);
  report.links = link_tree(graph, incidence, task.sub(0.0, 0.3));
  task.set_progress(0.3);
  report.subtrees = subtree_totals(graph, report.links);
  sum_roots(report);
  report.branches = measure_branches(graph, report.links);
  report.strahler = strahler_orders(report.links);
  task.throw_if_cancelled();
  task.set_progress(0.5);
  report.diameter_orders = diameter_orders(report.links, report.branches);
  report.elements = tree_elements(report.links, report.branches, report.diameter_orders.of_branch);
  report.orders = measure_orders(report.elements, report.branches);
  report.connectivity = connectivity_matrix(report.elements);
  task.throw_if_cancelled();
  task.set_progress(0.8);
  report.angles = fork_angles(graph, incidence, report.links);
  report.exponents = fork_exponents(graph, incidence);
  gather_exponents(report);
  fit_orders(report);
  task.set_progress(1.0);
  return report;
}

}  // namespace ostia::analysis
