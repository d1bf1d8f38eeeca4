#include "mask_cut_place.h"

#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>

namespace ostia::coronary {
namespace {

constexpr double cut_radii = 0.4;         // inside the end of an axis: where meshes of cases are cut
constexpr double dome_reach_radii = 1.0;  // from there to what the dome reaches
constexpr double wide_share = 1.1;        // of the radius: walls are not round

}  // namespace

InwardLine::InwardLine(const geometry::Centerline& axis, bool from_first)
    : points_(axis.points), radius_(axis.radius) {
  if (!from_first) {
    std::reverse(points_.begin(), points_.end());
    std::reverse(radius_.begin(), radius_.end());
  }
  at_mm_ = geometry::abscissas(points_);
}

Vec3 InwardLine::point(double s_mm) const {
  return geometry::at_abscissa(points_, std::clamp(s_mm, 0.0, length())).point;
}

double InwardLine::radius_at(double s_mm) const {
  const geometry::PolylineLocation at = geometry::at_abscissa(points_, std::clamp(s_mm, 0.0, length()));
  return (1.0 - at.t) * radius_[at.segment] + at.t * radius_[at.segment + 1];
}

CutPlace InwardLine::cut(double trimmed_mm) const {
  const double left = length() - trimmed_mm;
  const double window = std::min(left, 2.0 * radius_at(trimmed_mm + 0.5 * left));
  CutPlace cut;
  for (int i = 0; i <= 16; ++i)
    cut.radius_mm = std::max(cut.radius_mm, radius_at(trimmed_mm + window * i / 16.0));
  const double s = trimmed_mm + std::min(cut_inside_mm(cut.radius_mm), 0.5 * left);
  cut.place = point(s);
  cut.outward = (point(std::max(trimmed_mm, s - cut.radius_mm)) - point(s + cut.radius_mm)).normalized();
  return cut;
}

double cut_inside_mm(double radius_mm) {
  return cut_radii * radius_mm;
}

bool in_the_way(const CutPlace& cut, const Vec3& centre, double radius_mm) {
  const Vec3 to = centre - cut.place;
  const double along = to.dot(cut.outward);
  const double aside = (to - along * cut.outward).norm() - wide_share * cut.radius_mm;
  const double beyond = std::max(-along, along - dome_reach_radii * cut.radius_mm);
  return std::hypot(std::max(0.0, aside), std::max(0.0, beyond)) < radius_mm + apart_mm;
}

}  // namespace ostia::coronary
