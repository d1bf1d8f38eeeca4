// The plots of a motion's report.

#include "motion/motion_report_text.h"

#include "ostia/figure/plot.h"
#include "ostia/pipeline/motion_report.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace ostia::pipeline {
namespace {

using analysis::MotionMeasure;
using analysis::TimeCurve;
using analysis::TreeMotion;
using figure::Series;

constexpr std::size_t most_curves = 8;  // as the palette has colours: more cannot be told apart
constexpr std::size_t most_branches = 24;

/// Over the cycle; the value at 0 % comes again at 100 %.
Series series_of(const std::string& name, const TimeCurve& curve, const TreeMotion& motion,
                 std::size_t index) {
  Series one;
  one.name = name;
  for (std::size_t k = 0; k < curve.values.size(); ++k) {
    one.x.push_back(100.0 * motion.phases[k]);
    one.y.push_back(curve.values[k]);
  }
  if (motion.phases.front() == 0.0) {
    one.x.push_back(100.0);
    one.y.push_back(curve.values.front());
  }
  one.color = figure::palette(index);
  if (index >= most_curves) one.style = figure::LineStyle::dashed;
  return one;
}

bool is_known(const Series& one) {
  return std::any_of(one.y.begin(), one.y.end(), [](double value) { return std::isfinite(value); });
}

figure::PlotOptions options_of(const TreeMotion& motion, const std::string& label, bool from_zero) {
  figure::PlotOptions options;
  options.x_label = "share of the cycle since the R peak (%)";
  options.y_label = label;
  options.x_range = figure::Range{0.0, 100.0};
  options.y_from_zero = from_zero;
  options.height_px = 460;
  options.references.push_back({figure::ReferenceLine::Along::x, 100.0 * motion.template_phase, "template"});
  return options;
}

struct PlotOf {
  MotionMeasure measure;
  bool from_zero;
  const char* caption;
};

const std::vector<PlotOf>& plots() {
  static const std::vector<PlotOf> all{
      {MotionMeasure::displacement_mean, true,
       "Mean distance of a branch's points from the template's place."},
      {MotionMeasure::speed_mean, true, "Mean speed of a branch's points."},
      {MotionMeasure::stretch, false, "Length of the axis over that at the template."},
      {MotionMeasure::curvature_mean, true, "Mean curvature of the axis."},
      {MotionMeasure::curvature_change, true, "Mean of the local absolute changes from the template."},
      {MotionMeasure::torsion_mean, false, "Mean torsion of the axis; positive: a right-handed screw."},
      {MotionMeasure::torsion_size, false,
       "Mean size of the torsion, of the motion that all branches have in common."},
      {MotionMeasure::torsion_total, false, "Degrees that the osculating plane turns from end to end."},
      {MotionMeasure::twist, false,
       "Degrees that the distal end has turned about the axis against the proximal one."}};
  return all;
}

std::string label_of(const analysis::MeasureName& name) {
  return name.unit.empty() ? name.text : name.text + " (" + name.unit + ")";
}

void add(std::vector<ReportPicture>& pictures, const TreeMotion& motion, const std::string& name,
         const std::string& label, const std::string& caption, const std::vector<Series>& series,
         bool from_zero) {
  if (series.empty()) return;
  std::string heading = label;
  heading.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(heading.front())));
  pictures.push_back(
      {name, heading, caption, figure::line_plot(series, options_of(motion, label, from_zero))});
}

/// The nearest pairs.
std::vector<Series> nearest_pairs(const TreeMotion& motion) {
  std::vector<std::pair<double, Series>> all;
  for (const analysis::BranchDistance& pair : motion.distances) {
    Series one = series_of(motion_text::pair_name(motion, pair), pair.distance, motion, 0);
    if (is_known(one)) all.emplace_back(*std::min_element(one.y.begin(), one.y.end()), std::move(one));
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if (all.size() > most_curves) all.resize(most_curves);
  std::vector<Series> series;
  for (auto& [least, one] : all) {
    one.color = figure::palette(series.size());
    series.push_back(std::move(one));
  }
  return series;
}

}  // namespace

std::vector<ReportPicture> motion_pictures(const TreeMotion& motion) {
  std::vector<ReportPicture> pictures;
  for (const PlotOf& plot : plots()) {
    std::vector<Series> series;
    for (const analysis::BranchMotion& branch : motion.branches) {
      Series one = series_of(branch.name, branch[plot.measure], motion, series.size());
      if (is_known(one) && series.size() < most_branches) series.push_back(std::move(one));
    }
    const analysis::MeasureName& name = analysis::name_of(plot.measure);
    add(pictures, motion, name.name, label_of(name), plot.caption, series, plot.from_zero);
  }
  add(pictures, motion, "distance", "least distance (mm)",
      "Least distance of two branches' axes; of all pairs those that come nearest.", nearest_pairs(motion),
      true);
  std::vector<Series> angles;
  for (const analysis::JointAngle& one : motion.angles) {
    Series angle = series_of(one.name, one.angle, motion, angles.size());
    if (is_known(angle) && angles.size() < most_branches) angles.push_back(std::move(angle));
  }
  add(pictures, motion, "angle", "angle of branches (deg)",
      "Angle between two branches that leave a joint; 180: one goes on from the other.", angles, false);
  return pictures;
}

}  // namespace ostia::pipeline
