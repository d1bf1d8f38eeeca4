#include "pictures/section_places.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::view {
namespace {

using geometry::Vec2;

constexpr int directions = 90;        // of lines through the centroid that are tried
constexpr double as_good_mm = 0.005;  // lines whose lengths differ by less are equally good
constexpr int halving_steps = 30;

/// An outline on its plane, about the origin.
class FlatOutline {
 public:
  explicit FlatOutline(const analysis::MeasuredSection& section) : centre_(section.measures.centroid) {
    const Vec3 normal = section.measures.normal;
    u_ = normal.unitOrthogonal();
    v_ = normal.cross(u_);
    for (const Vec3& point : section.contour)
      points_.emplace_back((point - centre_).dot(u_), (point - centre_).dot(v_));
  }
  Vec3 direction(double angle) const { return std::cos(angle) * u_ + std::sin(angle) * v_; }
  Vec3 place(double angle, double radius) const { return centre_ + radius * direction(angle); }
  /// How far out the outline is first met; infinite where it is not.
  double radius(double angle) const {
    const Vec2 along(std::cos(angle), std::sin(angle));
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vec2 &a = points_[i], side = points_[(i + 1) % points_.size()] - a;
      const double slope = cross(along, side);
      if (slope == 0.0) continue;
      const double t = cross(a, along) / slope, r = cross(a, side) / slope;
      if (t >= 0.0 && t <= 1.0 && r > 0.0) nearest = std::min(nearest, r);
    }
    return nearest;
  }
  double width(double angle) const { return radius(angle) + radius(angle + std::numbers::pi); }

 private:
  Vec3 centre_, u_, v_;
  std::vector<Vec2> points_;
};

/// Directions of the lines that are as long as `wanted`, or else come nearest to it.
std::vector<double> fitting_directions(const FlatOutline& outline, double wanted) {
  std::vector<std::pair<double, double>> tried;  // how far off, angle
  const auto off = [&](double angle) { return outline.width(angle) - wanted; };
  const double step = std::numbers::pi / directions;
  for (int i = 0; i < directions; ++i) {
    double low = i * step, high = low + step;
    const double at_low = off(low), at_high = off(high);
    tried.emplace_back(std::abs(at_low), low);
    if (!std::isfinite(at_low) || !std::isfinite(at_high) || (at_low < 0.0) == (at_high < 0.0)) continue;
    for (int k = 0; k < halving_steps; ++k) {
      const double middle = 0.5 * (low + high);
      ((off(middle) < 0.0) == (at_low < 0.0) ? low : high) = middle;
    }
    tried.emplace_back(std::abs(off(low)), low);
  }
  const double least = std::min_element(tried.begin(), tried.end())->first;
  std::vector<double> fitting;
  for (const auto& [away, angle] : tried)
    if (std::isfinite(away) && away <= least + as_good_mm) fitting.push_back(angle);
  return fitting;
}

}  // namespace

std::optional<analysis::MeasuredSection> section_of(const session::Workbench& bench, std::int32_t vessel,
                                                    double s_mm, int around) {
  const auto axis = bench.axis(vessel);
  if (!axis) return std::nullopt;
  const auto surface_of = [&](std::int32_t one) { return bench.session().live().surface(one); };
  analysis::ProfileOptions options;
  options.around = around;
  analysis::MeasuredSection section = analysis::measured_section(
      *bench.model(), surface_of, vessel, std::clamp(s_mm, 0.0, axis->length()), options);
  if (!section.measures.found) return std::nullopt;
  return section;
}

std::optional<std::pair<Vec3, Vec3>> diameter_ends(const analysis::MeasuredSection& section,
                                                   const Vec3& sight) {
  if (section.contour.size() < 3) return std::nullopt;
  const FlatOutline outline(section);
  const std::vector<double> fitting = fitting_directions(outline, section.measures.diameter_mm);
  if (fitting.empty()) return std::nullopt;
  const auto along_sight = [&](double angle) { return std::abs(outline.direction(angle).dot(sight)); };
  const double best = *std::min_element(fitting.begin(), fitting.end(),
                                        [&](double a, double b) { return along_sight(a) < along_sight(b); });
  return std::pair(outline.place(best, outline.radius(best)),
                   outline.place(best, -outline.radius(best + std::numbers::pi)));
}

std::vector<Vec3> widened(const analysis::MeasuredSection& section, double by_mm) {
  std::vector<Vec3> points = section.contour;
  for (Vec3& point : points) {
    const Vec3 out = point - section.measures.centroid;
    if (out.norm() > 0.0) point += by_mm * out.normalized();
  }
  return points;
}

}  // namespace ostia::view
