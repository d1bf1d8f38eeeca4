#pragma once
/// \file Vessels of known resistance.

#include "ostia/hemodynamics/network_solver.h"

#include <cmath>
#include <functional>
#include <numbers>

namespace ostia::testing {

inline double circle_mm2(double radius_mm) {
  return std::numbers::pi * radius_mm * radius_mm;
}

/// Round, along z, with the radius r(s), sections `step` apart.
inline hemodynamics::Branch vessel_of(double length_mm, const std::function<double(double)>& radius_mm,
                                      int parent = -1, double step_mm = 0.5) {
  hemodynamics::Branch branch;
  branch.parent = parent;
  const int steps = static_cast<int>(std::ceil(length_mm / step_mm - 1e-9));
  for (int i = 0; i <= steps; ++i) {
    const double s = length_mm * i / steps;
    branch.stations.push_back({s, circle_mm2(radius_mm(s)), {}, 0.0, {0.0, 0.0, s}});
  }
  return branch;
}

inline hemodynamics::Branch tube_of(double length_mm, double radius_mm, int parent = -1) {
  return vessel_of(
      length_mm, [=](double) { return radius_mm; }, parent);
}

/// 8 mu L / (pi r^4), Pa s / ml.
inline double poiseuille_pa_s_ml(double length_mm, double radius_mm, double viscosity_mpa_s = 3.5) {
  return 8.0 * viscosity_mpa_s * length_mm / (std::numbers::pi * std::pow(radius_mm, 4));
}

/// With a cosine-shaped narrowing to `least` of the radius, `length` long about `middle`.
inline std::function<double(double)> narrowed(double radius_mm, double middle_mm, double length_mm,
                                              double least) {
  return [=](double s) {
    const double t = (s - middle_mm) / length_mm;
    return std::abs(t) < 0.5
               ? radius_mm * (1.0 - (1.0 - least) * 0.5 * (1.0 + std::cos(2.0 * std::numbers::pi * t)))
               : radius_mm;
  };
}

inline hemodynamics::FlowModel friction_alone() {
  hemodynamics::FlowModel model;
  model.inertia = false;
  return model;
}

}  // namespace ostia::testing
