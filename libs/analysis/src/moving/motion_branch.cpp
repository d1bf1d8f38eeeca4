// What is measured of one branch.

#include "branches/line_derivatives.h"
#include "degrees.h"
#include "moving/motion_parts.h"

#include "ostia/geometry/frame.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace ostia::analysis {
namespace {

constexpr std::size_t least_points = 6;  // of a polynomial of degree 5

/// The branch's bends at one time, point by point; lists are empty where it is too short.
struct Bends {
  std::vector<double> speed;  ///< of the curve by the template's abscissa
  std::vector<double> curvature, torsion;
};

struct Limits {
  bool shape = false, curvature = false, torsion = false;  ///< can be measured
  double least_curvature = 0.0;
};

Bends bends_of(const std::vector<Vec3>& points, const LineDerivatives& derivatives, const Limits& limits) {
  const auto d = derivatives(points);
  Bends bends;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double speed = d[0][i].norm();
    bends.speed.push_back(speed);
    const Vec3 across = d[0][i].cross(d[1][i]);
    const double curvature = across.norm() / std::max(speed * speed * speed, 1e-12);
    if (limits.curvature) bends.curvature.push_back(curvature);
    if (limits.torsion)
      bends.torsion.push_back(curvature >= limits.least_curvature ? across.dot(d[2][i]) / across.squaredNorm()
                                                                  : not_measured);
  }
  return bends;
}

/// Mean of the torsion's size, weighted by the curvature squared: both parts are polynomials of derivatives,
/// so that straight pieces neither count nor spoil it.
double torsion_size(const std::vector<Vec3>& points, const LineDerivatives& derivatives,
                    const std::vector<double>& shares) {
  const auto d = derivatives(points);
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 across = d[0][i].cross(d[1][i]);
    const double share = shares[i] / std::max(std::pow(d[0][i].squaredNorm(), 3), 1e-12);
    sum += share * std::abs(across.dot(d[2][i]));
    weight += share * across.squaredNorm();
  }
  return weight > 0.0 ? sum / weight : not_measured;
}

/// Degrees that places beside the axis have turned about it, against a frame that does not turn.
std::vector<double> twist_of(const std::vector<Vec3>& axis, const std::vector<Vec3>& beside) {
  // Tangents from neighbours alone: those of fitted polynomials cut sharp bends short, which frames would
  // show.
  const std::vector<geometry::Frame> frames =
      geometry::rotation_minimising_frames(axis, geometry::tangents(axis), beside.front() - axis.front());
  std::vector<double> twist;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const Vec3 side = beside[i] - axis[i];
    double angle = degrees * std::atan2(side.dot(frames[i].binormal), side.dot(frames[i].normal));
    if (i > 0) angle += 360.0 * std::round((twist.back() - angle) / 360.0);
    twist.push_back(angle);
  }
  return twist;
}

class Measurer {
 public:
  Measurer(const MovingBranch& branch, const PhasePoints& common, const MotionMeasureOptions& options,
           std::vector<std::string>& warnings)
      : branch_(branch), common_(common), options_(options), shares_(length_shares(branch.s_mm)) {
    const double length = branch.s_mm.back();
    limits_.shape = branch.rest.size() >= least_points;
    limits_.curvature = limits_.shape && length >= options.reach_mm;
    limits_.torsion = limits_.shape && length >= 2.0 * options.reach_mm;
    limits_.least_curvature = options.least_curvature_per_mm;
    if (!limits_.torsion)
      warnings.push_back("branch " + branch.name + " is too short for " +
                         (limits_.curvature ? "torsion" : "curvature and torsion") + ": " +
                         std::to_string(branch.rest.size()) + " points, " + std::to_string(length) + " mm");
    if (limits_.shape) derivatives_.emplace(branch.s_mm, options.reach_mm);
  }

  BranchMotion measured() {
    motion_.vessel = branch_.vessel;
    motion_.name = branch_.name;
    motion_.length_mm = branch_.s_mm.back();
    motion_.s_mm = branch_.s_mm;
    const std::vector<double> still(branch_.rest.size(), 0.0);
    displaced(still, still, true);
    shaped(branch_.rest, {}, true);
    sized(branch_.rest, true);
    for (std::size_t k = 0; k < branch_.places.size(); ++k) {
      std::vector<double> displacement, speed;
      for (std::size_t i = 0; i < branch_.rest.size(); ++i) {
        displacement.push_back((branch_.places[k][i] - branch_.rest[i]).norm());
        speed.push_back(branch_.rates[k][i].norm() / options_.rr_s);
      }
      displaced(displacement, speed, false);
      shaped(shape_of(branch_)[k], branch_.beside.empty() ? std::vector<Vec3>{} : branch_.beside[k], false);
      sized(common_[k], false);
    }
    return std::move(motion_);
  }

 private:
  void set(MotionMeasure m, double value, bool at_template) {
    TimeCurve& curve = motion_.over_time[static_cast<std::size_t>(m)];
    if (at_template)
      curve.at_template = value;
    else
      curve.values.push_back(value);
  }
  void set(LocalMeasure m, std::vector<double> values, bool at_template) {
    if (values.empty()) return;
    AlongCurve& curve = motion_.along[static_cast<std::size_t>(m)];
    if (at_template)
      curve.at_template = std::move(values);
    else
      curve.values.push_back(std::move(values));
  }

  /// Weighted by length; what is not measured is left out. NaN where nothing is.
  double mean(const std::vector<double>& values) const {
    double sum = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) continue;
      sum += shares_[i] * values[i];
      weight += shares_[i];
    }
    return weight > 0.0 ? sum / weight : not_measured;
  }
  static double largest(const std::vector<double>& values) {
    return values.empty() ? not_measured : *std::max_element(values.begin(), values.end());
  }
  double mean_change(const std::vector<double>& values, const std::vector<double>& from) const {
    std::vector<double> change;
    for (std::size_t i = 0; i < values.size(); ++i) change.push_back(std::abs(values[i] - from[i]));
    return mean(change);
  }

  void displaced(const std::vector<double>& displacement, const std::vector<double>& speed,
                 bool at_template) {
    set(MotionMeasure::displacement_mean, mean(displacement), at_template);
    set(MotionMeasure::displacement_max, largest(displacement), at_template);
    set(LocalMeasure::displacement, displacement, at_template);
    if (at_template) return;  // the template is a place, not a time: it has no speed
    set(MotionMeasure::speed_mean, mean(speed), false);
    set(MotionMeasure::speed_max, largest(speed), false);
    set(LocalMeasure::speed, speed, false);
  }

  void shaped(const std::vector<Vec3>& points, const std::vector<Vec3>& beside, bool at_template) {
    const Bends bends = limits_.shape ? bends_of(points, *derivatives_, limits_) : Bends{};
    if (at_template) rest_ = bends;
    stretched(points, bends, at_template);
    set(MotionMeasure::curvature_mean, mean(bends.curvature), at_template);
    set(MotionMeasure::curvature_max, largest(bends.curvature), at_template);
    set(MotionMeasure::curvature_change, mean_change(bends.curvature, rest_.curvature), at_template);
    set(LocalMeasure::curvature, bends.curvature, at_template);
    set(MotionMeasure::torsion_mean, mean(bends.torsion), at_template);
    set(MotionMeasure::torsion_change, mean_change(bends.torsion, rest_.torsion), at_template);
    turned(bends, at_template);
    set(LocalMeasure::torsion, bends.torsion, at_template);
    std::vector<double> twist;
    if (limits_.shape && !branch_.beside.empty())
      twist = at_template ? std::vector<double>(points.size(), 0.0) : twist_of(points, beside);
    set(MotionMeasure::twist, twist.empty() ? not_measured : twist.back(), at_template);
    set(LocalMeasure::twist, twist, at_template);
  }

  void sized(const std::vector<Vec3>& points, bool at_template) {
    const bool bends =
        limits_.torsion && motion_[MotionMeasure::curvature_max].at_template >= limits_.least_curvature;
    set(MotionMeasure::torsion_size, bends ? torsion_size(points, *derivatives_, shares_) : not_measured,
        at_template);
  }

  void stretched(const std::vector<Vec3>& points, const Bends& bends, bool at_template) {
    std::vector<double> stretch;
    for (std::size_t i = 0; i < bends.speed.size(); ++i)
      stretch.push_back(bends.speed[i] / std::max(rest_.speed[i], 1e-12));
    const double whole = stretch.empty()
                             ? geometry::length(points) / std::max(geometry::length(branch_.rest), 1e-12)
                             : mean(stretch);
    set(MotionMeasure::length, whole * motion_.length_mm, at_template);
    set(MotionMeasure::stretch, whole, at_template);
    set(MotionMeasure::stretch_largest, largest(stretch), at_template);
    set(MotionMeasure::stretch_least,
        stretch.empty() ? not_measured : *std::min_element(stretch.begin(), stretch.end()), at_template);
    set(LocalMeasure::stretch, stretch, at_template);
  }

  /// The integral of the torsion over the arc, and where there is any.
  void turned(const Bends& bends, bool at_template) {
    if (bends.torsion.empty()) {
      set(MotionMeasure::torsion_total, not_measured, at_template);
      set(MotionMeasure::torsion_share, not_measured, at_template);
      return;
    }
    double total = 0.0, share = 0.0;
    for (std::size_t i = 0; i < bends.torsion.size(); ++i) {
      if (!std::isfinite(bends.torsion[i])) continue;
      total += bends.torsion[i] * bends.speed[i] * shares_[i] * motion_.length_mm;
      share += shares_[i];
    }
    set(MotionMeasure::torsion_total, share > 0.0 ? degrees * total : not_measured, at_template);
    set(MotionMeasure::torsion_share, share, at_template);
  }

  const MovingBranch& branch_;
  const PhasePoints& common_;
  const MotionMeasureOptions& options_;
  std::vector<double> shares_;
  Limits limits_;
  std::optional<LineDerivatives> derivatives_;
  Bends rest_;
  BranchMotion motion_;
};

}  // namespace

const PhasePoints& shape_of(const MovingBranch& branch) {
  return branch.shape.empty() ? branch.places : branch.shape;
}

std::vector<double> length_shares(const std::vector<double>& s_mm) {
  std::vector<double> shares(s_mm.size(), 0.0);
  for (std::size_t i = 1; i < s_mm.size(); ++i) {
    const double half = 0.5 * (s_mm[i] - s_mm[i - 1]) / (s_mm.back() - s_mm.front());
    shares[i - 1] += half;
    shares[i] += half;
  }
  return shares;
}

BranchMotion branch_motion(const MovingBranch& branch, const PhasePoints& common,
                           const MotionMeasureOptions& options, std::vector<std::string>& warnings) {
  return Measurer(branch, common, options, warnings).measured();
}

}  // namespace ostia::analysis
