#include "ostia/phantom/truth.h"

#include "coronaries/axis_place.h"

#include "ostia/core/error.h"
#include "ostia/geometry/frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using geometry::Contour;
using geometry::ContourSection;

double angle(int index, int points) {
  return 2.0 * std::numbers::pi * index / points;
}

const RadialProfile& profile(const CoronaryVessel& vessel, Boundary boundary) {
  return boundary == Boundary::lumen ? vessel.lumen : vessel.wall;
}

/// Abscissas from end to end, equally far apart, no farther than `spacing`; two at least.
std::vector<double> places(const AnnotatedSection& section, double spacing) {
  const auto steps = std::max(1, static_cast<int>(std::ceil(section.length_mm() / spacing - 1e-9)));
  std::vector<double> out;
  for (int i = 0; i <= steps; ++i)
    out.push_back(section.s_from_mm + section.length_mm() * static_cast<double>(i) / steps);
  return out;
}

ContourSection section_of(const AnnotatedSection& section, const CoronaryVessel& vessel, std::string observer,
                          const char* boundary) {
  ContourSection out;
  out.section = section.key;
  out.vessel = vessel.name;
  out.observer = std::move(observer);
  out.boundary = boundary;
  out.health = section.health;
  return out;
}

/// Radii over theta about the true axis, in the plane across it.
template <class Radius>
Contour contour_about(const CoronaryVessel& vessel, double s, int points, const Radius& radius) {
  const AxisPlace place = place_at(vessel.axis, s);
  Contour contour;
  contour.s_mm = s;
  for (int i = 0; i < points; ++i) {
    const double theta = angle(i, points);
    contour.points.push_back(place.point + radius(theta) * geometry::radial_direction(place.frame, theta));
  }
  return contour;
}

}  // namespace

void validate(const ContourOptions& options) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("contours: ") + what);
  };
  require(options.spacing_mm > 0.0 && std::isfinite(options.spacing_mm), "the spacing must be above 0 mm");
  require(options.observer_spacing_mm > 0.0 && std::isfinite(options.observer_spacing_mm),
          "the observers' spacing must be above 0 mm");
  require(options.points >= 8 && options.points <= 1024, "a contour has 8 to 1024 points");
}

Vec3 boundary_point(const CoronaryVessel& vessel, Boundary boundary, double s_mm, double theta) {
  const AxisPlace place = place_at(vessel.axis, s_mm);
  return place.point +
         profile(vessel, boundary).at(s_mm, theta) * geometry::radial_direction(place.frame, theta);
}

Contour true_contour(const CoronaryVessel& vessel, Boundary boundary, double s_mm, int points) {
  const RadialProfile& radii = profile(vessel, boundary);
  return contour_about(vessel, s_mm, points, [&](double theta) { return radii.at(s_mm, theta); });
}

geometry::ContourSet annotate(const CoronaryTree& tree, const std::vector<AnnotatedSection>& sections,
                              const ContourOptions& contours, const ObserverOptions& observers) {
  validate(contours);
  validate(observers);
  geometry::ContourSet out;
  for (const AnnotatedSection& section : sections) {
    const CoronaryVessel& vessel = vessel_of(tree, section.vessel);
    for (const Boundary boundary : {Boundary::lumen, Boundary::wall}) {
      ContourSection truth =
          section_of(section, vessel, "truth", boundary == Boundary::lumen ? "lumen" : "wall");
      for (const double s : places(section, contours.spacing_mm))
        truth.contours.push_back(true_contour(vessel, boundary, s, contours.points));
      out.sections.push_back(std::move(truth));
    }
    for (int observer = 1; observer <= observers.count; ++observer) {
      ContourSection drawn = section_of(section, vessel, "observer" + std::to_string(observer), "lumen");
      for (const double s : places(section, contours.observer_spacing_mm)) {
        const RadialDeviation deviation = radial_deviation(vessel, observer, s, observers);
        drawn.contours.push_back(contour_about(vessel, s, contours.points, [&](double theta) {
          return observed_radius(vessel.lumen.at(s, theta), deviation.at(theta));
        }));
      }
      out.sections.push_back(std::move(drawn));
    }
  }
  return out;
}

int stenosis_category(double diameter_stenosis) {
  if (diameter_stenosis <= 0.0) return 0;
  if (diameter_stenosis < 0.25) return 1;
  if (diameter_stenosis < 0.50) return 2;
  if (diameter_stenosis < 0.70) return 3;
  return diameter_stenosis < 1.0 ? 4 : 5;
}

}  // namespace ostia::phantom
