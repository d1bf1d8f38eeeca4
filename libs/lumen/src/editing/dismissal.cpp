#include "editing/dismissal.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ostia::lumen {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

// Caps lie at the ends of a vessel's own stretch.
bool closes_start(const SurfaceSample& sample, const AxisCurve& axis, double own_from_mm) {
  return sample.s_mm < 0.5 * (own_from_mm + axis.length());
}

}  // namespace

TangentFrameBundle::TangentFrameBundle(std::shared_ptr<const AxisCurve> axis,
                                       const std::vector<LinePlace>& line)
    : axis_(std::move(axis)) {
  if (line.empty()) throw InvalidInput("a tangent frame bundle needs a line with at least one place");
  for (const LinePlace& place : line) {
    const geometry::Frame frame = axis_->frame(place.s_mm);
    const double theta = geometry::angle_of(frame, place.offset);
    const double rho = place.offset.dot(geometry::radial_direction(frame, theta));
    if (!(rho > 0.0)) throw InvalidInput("a drawn line touches the vessel's axis; draw it along the wall");
    s_.push_back(s_.empty() ? place.s_mm : std::max(s_.back(), place.s_mm));
    x_.push_back(rho * std::cos(theta));
    y_.push_back(rho * std::sin(theta));
  }
}

TangentFrameBundle::Rotation TangentFrameBundle::at(double s_mm) const {
  const auto upper = std::upper_bound(s_.begin(), s_.end(), s_mm);
  double x = x_.front(), y = y_.front();
  if (upper == s_.end()) {
    x = x_.back();
    y = y_.back();
  } else if (upper != s_.begin()) {
    const auto i = static_cast<std::size_t>(upper - s_.begin());
    const double t = (s_mm - s_[i - 1]) / (s_[i] - s_[i - 1]);
    x = (1.0 - t) * x_[i - 1] + t * x_[i];
    y = (1.0 - t) * y_[i - 1] + t * y_[i];
  }
  const geometry::Frame frame = axis_->frame(s_mm);
  Rotation rotation;
  rotation.r1 = geometry::radial_direction(frame, std::atan2(y, x));
  rotation.r2 = frame.tangent;
  rotation.r3 = rotation.r1.cross(rotation.r2);
  return rotation;
}

double stroke_angle_deg(const TangentFrameBundle& bundle, const Vec3& place, double s_mm) {
  const Vec3 offset = place - bundle.axis().point(s_mm);
  const double length = offset.norm();
  if (length < 1e-9) return 90.0;
  return std::acos(std::clamp(offset.dot(bundle.at(s_mm).r1) / length, -1.0, 1.0)) / degree;
}

std::vector<std::size_t> contradicted(const std::vector<SurfaceSample>& samples,
                                      const TangentFrameBundle& bundle, const StrokeReach& reach) {
  std::vector<std::size_t> found;
  const double from = bundle.from_mm() - reach.margin_mm, to = bundle.to_mm() + reach.margin_mm;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const SurfaceSample& sample = samples[i];
    if (sample.s_mm < from || sample.s_mm > to) continue;
    if (sample.origin == SampleOrigin::cap &&
        !(closes_start(sample, bundle.axis(), reach.own_from_mm) ? reach.start_cap : reach.end_cap))
      continue;
    if (stroke_angle_deg(bundle, sample.position, sample.s_mm) <= reach.beta_deg) found.push_back(i);
  }
  return found;
}

bool contains(const AngularRange& range, double theta) {
  const double turn = 2.0 * std::numbers::pi;
  double past = std::fmod(theta - range.from, turn);
  if (past < 0.0) past += turn;
  return past <= range.width;
}

std::vector<std::size_t> contradicted(const std::vector<SurfaceSample>& samples, const AxisCurve& axis,
                                      double s_mm, double eps_mm, const std::optional<AngularRange>& range) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const SurfaceSample& sample = samples[i];
    if (sample.origin == SampleOrigin::cap || !(std::abs(sample.s_mm - s_mm) < 0.5 * eps_mm)) continue;
    if (range) {
      const Vec3 offset = sample.position - axis.point(sample.s_mm);
      if (!contains(*range, geometry::angle_of(axis.frame(sample.s_mm), offset))) continue;
    }
    found.push_back(i);
  }
  return found;
}

}  // namespace ostia::lumen
