#include "reading/reading_overlay.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/polyline.h"
#include "ostia/phantom/truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::experiments {
namespace {

constexpr double ostium_clear_mm = 2.0;  // from the aorta, whose wall is none of the vessel's
constexpr double blunt_end_mm = 2.0;     // of a vessel that ends while it is still wide
constexpr double least_counted_mm = 5.0;
constexpr double mouth_mm = 0.5;  // about another lumen, where the wall bends into it
constexpr int contour_points = 48;

/// What counts of a vessel; nothing where it is thin or short.
std::pair<double, double> counted_stretch(const phantom::CoronaryVessel& vessel, double least_radius_mm) {
  const double from = vessel.parent < 0 ? ostium_clear_mm : vessel.s_free_mm;
  const std::vector<double>& abscissa = vessel.axis.abscissa;
  double to = from;
  bool begun = false;
  for (std::size_t i = 0; i < abscissa.size() && i < vessel.healthy_radius_mm.size(); ++i) {
    if (abscissa[i] < from || vessel.healthy_radius_mm[i] < least_radius_mm) {
      if (abscissa[i] >= from && !begun) return {0.0, 0.0};  // it leaves its parent as a thin one
      continue;
    }
    begun = true;
    to = abscissa[i];
  }
  return {from, std::min(to, abscissa.back() - blunt_end_mm)};
}

CountedRow counted_row(const phantom::CoronaryVessel& vessel, double s_mm) {
  CountedRow row;
  row.s_mm = s_mm;
  row.foot = axis_place(vessel, s_mm);
  row.middle = geometry::contour_centroid(
      phantom::true_contour(vessel, phantom::Boundary::lumen, s_mm, contour_points));
  row.mean_mm = vessel.lumen.mean_at(s_mm);
  for (int a = 0; a < reading_angles; ++a) {
    const double theta = 2.0 * std::numbers::pi * a / reading_angles;
    const Vec3 out = phantom::boundary_point(vessel, phantom::Boundary::lumen, s_mm, theta) - row.foot;
    row.rays.push_back({out.normalized(), out.norm(), true});
  }
  return row;
}

}  // namespace

Vec3 axis_place(const phantom::CoronaryVessel& vessel, double s_mm) {
  return geometry::at_abscissa(vessel.axis.points, s_mm).point;
}

ReadingOverlay::ReadingOverlay(const phantom::CoronaryTree& tree, const ReadingOptions& options)
    : field_(tree), axes_(own_axes(phantom::vessel_tree(tree))) {
  for (const phantom::CoronaryVessel& vessel : tree.vessels) {
    const auto [from, to] = counted_stretch(vessel, 0.5 * options.least_diameter_mm);
    if (to - from < least_counted_mm) continue;
    CountedVessel counted{&vessel, from, to, {}};
    const auto pieces = static_cast<int>(std::floor((to - from) / reading_row_mm + 1e-6));
    for (int i = 0; i <= pieces; ++i) {
      CountedRow row = counted_row(vessel, from + reading_row_mm * i);
      for (CountedRow::Ray& ray : row.rays)
        ray.seen = !hidden(vessel.id, row.foot + ray.radius_mm * ray.direction);
      counted.rows.push_back(std::move(row));
    }
    vessels_.push_back(std::move(counted));
  }
  if (vessels_.empty())
    throw InvalidInput("reading: no vessel is " + core::mm_text(options.least_diameter_mm, 1) +
                       " wide where it begins and " + core::mm_text(least_counted_mm, 0) +
                       " long; count thinner ones");
}

bool ReadingOverlay::hidden(std::int32_t vessel, const Vec3& place) const {
  std::vector<phantom::VesselField::Place> places;
  field_.places(place, mouth_mm, places);
  return std::any_of(places.begin(), places.end(), [&](const phantom::VesselField::Place& one) {
    return one.vessel != vessel && one.rho_mm - one.lumen_mm <= mouth_mm;
  });
}

geometry::ContourSection ReadingOverlay::section(const CountedVessel& vessel, std::size_t first,
                                                 std::size_t last) {
  geometry::ContourSection section;
  section.vessel = vessel.vessel->name;
  section.section = vessel.vessel->name + " " + core::rounded_text(vessel.rows[first].s_mm, 0) + " to " +
                    core::rounded_text(vessel.rows[last].s_mm, 0) + " mm";
  section.observer = "truth";
  for (std::size_t i = first; i <= last; ++i)
    section.contours.push_back(
        phantom::true_contour(*vessel.vessel, phantom::Boundary::lumen, vessel.rows[i].s_mm, contour_points));
  return section;
}

}  // namespace ostia::experiments
