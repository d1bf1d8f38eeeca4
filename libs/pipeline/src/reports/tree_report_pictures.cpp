// The plots of a tree's report.

#include "ostia/core/text.h"
#include "ostia/figure/plot.h"
#include "ostia/pipeline/tree_report.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace ostia::pipeline {
namespace {

using analysis::LogFit;
using analysis::OrderMeasure;
using analysis::TreeReport;
using figure::Series;

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;
constexpr int bins = 48;
constexpr double widest_exponent = 8.0;  // beyond lie forks with a child nearly as wide as its parent

/// Points of log10(value) by order, and the line through them.
Series points_of(const std::string& name, const TreeReport& report,
                 const std::function<double(const OrderMeasure&)>& value, std::size_t color) {
  Series points{name, {}, {}, figure::palette(color), figure::LineStyle::points};
  for (const OrderMeasure& one : report.orders)
    if (value(one) > 0.0) {
      points.x.push_back(one.order);
      points.y.push_back(std::log10(value(one)));
    }
  return points;
}

Series line_of(const LogFit& fit, const Series& points, std::size_t color) {
  Series line{core::significant_text(fit.ratio, 3) + " times an order",
              {},
              {},
              figure::palette(color),
              figure::LineStyle::dashed};
  for (const double x : {points.x.front(), points.x.back()}) {
    line.x.push_back(x);
    line.y.push_back(fit.a + fit.b * x);
  }
  return line;
}

void add_by_order(const TreeReport& report, std::vector<ReportPicture>& all) {
  struct Law {
    const char *name, *heading, *label, *caption;
    LogFit fit;
    std::function<double(const OrderMeasure&)> value;
  };
  const Law laws[] = {
      {"diameter-by-order", "Diameter by order", "log10 of the mean diameter of elements (mm)",
       "Mean diameter of the elements of each diameter-defined order, and the line through the logarithms.",
       report.diameter_fit, [](const OrderMeasure& one) { return one.element_diameter_mm.mean; }},
      {"length-by-order", "Length by order", "log10 of the mean length of elements (mm)",
       "Mean length of the elements of each order.", report.length_fit,
       [](const OrderMeasure& one) { return one.element_length_mm.mean; }},
      {"number-by-order", "Number by order", "log10 of the number of elements",
       "How many elements there are of each order.", report.number_fit,
       [](const OrderMeasure& one) { return static_cast<double>(one.element_diameter_mm.count); }}};
  for (const Law& law : laws) {
    const Series points = points_of("elements", report, law.value, 0);
    if (points.x.empty()) continue;
    std::vector<Series> series{points};
    if (law.fit.points > 1) series.push_back(line_of(law.fit, points, 1));
    figure::PlotOptions options;
    options.x_label = "diameter-defined order";
    options.y_label = law.label;
    options.x_range = figure::Range{points.x.front() - 0.5, points.x.back() + 0.5};
    all.push_back({law.name, law.heading, law.caption, figure::line_plot(series, options)});
  }
}

void add_histogram(const std::string& name, const std::string& heading, const std::string& label,
                   const std::string& caption, const std::vector<double>& values,
                   std::optional<figure::Range> range, std::vector<ReportPicture>& all) {
  if (values.empty()) return;
  figure::PlotOptions options;
  options.x_label = label;
  options.y_label = "number";
  all.push_back({name, heading, caption,
                 figure::histogram_plot(figure::histogram(values, bins, std::move(range)), options)});
}

std::vector<double> logarithms(const std::vector<analysis::BranchMeasure>& branches,
                               const std::function<double(const analysis::BranchMeasure&)>& value) {
  std::vector<double> all;
  for (const analysis::BranchMeasure& one : branches)
    if (value(one) > 0.0) all.push_back(std::log10(value(one)));
  return all;
}

}  // namespace

std::vector<ReportPicture> tree_pictures(const MeasuredTree& tree) {
  const TreeReport& report = tree.report;
  std::vector<ReportPicture> all;
  add_by_order(report, all);
  std::vector<double> exponents, angles;
  for (const analysis::ForkExponent& one : report.exponents)
    if (one.k) exponents.push_back(*one.k);
  for (const analysis::ForkAngles& one : report.angles)
    angles.push_back(degrees_per_radian * one.between_rad);
  add_histogram("murray", "Murray's exponent", "k of r^k = sum of the children's r^k",
                "One value a fork; forks with a child as wide as its parent have none, those above " +
                    std::to_string(static_cast<int>(widest_exponent)) + " are not shown.",
                exponents, figure::Range{0.0, widest_exponent}, all);
  add_histogram("angles", "Angles at forks", "angle between two children (degrees)",
                "Between the widest child and each other.", angles, figure::Range{0.0, 180.0}, all);
  add_histogram("branch-lengths", "Length of branches", "log10 of the length (mm)", "From fork to fork.",
                logarithms(report.branches, [](const auto& one) { return one.sum.length_mm; }), {}, all);
  add_histogram("branch-diameters", "Diameter of branches", "log10 of the mean diameter (mm)",
                "The mean along each branch.",
                logarithms(report.branches, [](const auto& one) { return one.diameter_mm; }), {}, all);
  return all;
}

}  // namespace ostia::pipeline
