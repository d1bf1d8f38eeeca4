#pragma once
/// \file Velocity profiles of laminar flow on the real section of a vessel. See
/// docs/reference/solver-cases.md.

#include "ostia/solver/section.h"

#include <complex>
#include <vector>

namespace ostia::solver {

/// Fully developed steady flow: Poisson's equation -laplace(w) = 1 with w = 0 on the rim, by quadratic finite
/// elements on the section's triangulation (quadrilaterals cut in two). One value a facet.
struct DevelopedProfile {
  /// Mean over the facet over the mean over the section, >= 0: sum(relative * area) == section's area.
  std::vector<double> relative;
  /// Of the contour of equal velocity on which the facet lies: sqrt(1 - w / largest w), 0 in the middle, 1 on
  /// the rim. On a circle it is r / R, on an ellipse the root of x^2 / a^2 + y^2 / b^2.
  std::vector<double> radius;
  double largest = 0.0;  ///< of the velocity over its mean: 2 on circles and ellipses
  /// Mean of w over the section: the mean velocity is this times pressure gradient over viscosity. R^2 / 8 on
  /// a circle.
  double conductance_mm2 = 0.0;
};

/// Throws GeometryError when the section has no rim or no room inside it.
DevelopedProfile developed_profile(const Section& section);

/// One harmonic of pulsatile flow, complex amplitude of velocity over that of the section's mean velocity:
/// Womersley's profile of the circle of equal area, carried to the section by the contours of equal velocity
/// above; scaled so that sum(value * area) is exactly the area. `angular_frequency` in 1/s, kinematic
/// viscosity in mm2/s.
std::vector<std::complex<double>> oscillating_profile(const Section& section,
                                                      const DevelopedProfile& developed,
                                                      double angular_frequency, double viscosity_mm2_s);

/// Velocities at the facets, mm/s, along the inward normal: `values` times `flow_mm3_s` over the area, with
/// the sum of velocity . area exactly -flow (inward). Throws InvalidInput for another number of values.
std::vector<geometry::Vec3> inward_velocities(const Section& section, const std::vector<double>& values,
                                              double flow_mm3_s);

}  // namespace ostia::solver
