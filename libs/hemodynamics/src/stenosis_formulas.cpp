#include "ostia/hemodynamics/stenosis_formulas.h"

#include "circle.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>

namespace ostia::hemodynamics {
namespace {

/// Of f from `low` to 1 over the logarithm, since f goes with 1 / x towards 0 (Simpson).
template <typename Function>
double integral_to_one(double low, Function f) {
  constexpr int intervals = 200;
  const double step = -std::log(low) / intervals;
  double sum = 0.0;
  for (int i = 0; i <= intervals; ++i) {
    const double x = low * std::exp(step * i);
    sum += f(x) * x * (i == 0 || i == intervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
  }
  return sum * step / 3.0;
}

/// Huo and Kassab's entrance: a core of the share `x` of the radius, flat, about which the profile falls to
/// the wall.
double core_weight(double x) {
  const double whole = 3.0 + 2.0 * x + x * x;
  return (1.0 + 4.0 * x + 9.0 * x * x + 4.0 * x * x * x) / (x * (3.0 + 2.0 * x) * whole * whole);
}
/// How far a core of this share is from the beginning, over rho Q / (pi mu).
double core_reaches(double share) {
  return integral_to_one(share, [](double x) { return (1.0 - x) * (6.0 + x) / 5.0 * core_weight(x); });
}

double huo_kassab_pa(const StenosisCase& s, double vessel, double throat) {
  constexpr double least_core = 0.05;  // below it the flow counts as developed
  if (s.flow_ml_s <= 0.0) return 0.0;
  const double inertia = s.density_kg_m3 * s.flow_ml_s * s.flow_ml_s;             // Pa mm4
  const double scale = s.density_kg_m3 * s.flow_ml_s / (pi * s.viscosity_mpa_s);  // mm
  const double entrance = scale * core_reaches(least_core);
  double core = least_core;
  if (s.length_mm < entrance) {
    double low = least_core, high = 1.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (scale * core_reaches(middle) > s.length_mm ? low : high) = middle;
    }
    core = 0.5 * (low + high);
  }
  const double behind = std::max(0.0, s.length_mm - entrance);
  const double diffusive =
      inertia / (2.0 * throat * throat) * 96.0 / 5.0 * integral_to_one(core, core_weight) +
      8.0 * pi * s.viscosity_mpa_s * behind * s.flow_ml_s / (throat * throat);
  // From a flat jet (Borda and Carnot) to a developed one.
  const double narrow = 1.0 / throat, wide = 1.0 / vessel, fall = narrow - wide;
  const double flat = fall * fall, developed = 2.0 * fall * (narrow - wide / 3.0);
  const double jet = s.length_mm < entrance ? (1.0 - core) * (1.0 - core) : 1.0;
  return diffusive + 0.5 * inertia * (flat + (developed - flat) * jet);
}

}  // namespace

std::vector<FormulaDrop> stenosis_formulas(const StenosisCase& s) {
  if (!(s.throat_diameter_mm > 0.0 && s.throat_diameter_mm < s.vessel_diameter_mm && s.length_mm > 0.0 &&
        s.flow_ml_s >= 0.0))
    throw InvalidInput(
        "a stenosis has a throat above 0 and narrower than its vessel, a length above 0 and a flow of 0 "
        "or more");
  const double vessel = pi / 4.0 * s.vessel_diameter_mm * s.vessel_diameter_mm;
  const double throat = pi / 4.0 * s.throat_diameter_mm * s.throat_diameter_mm;
  const double ratio = vessel / throat, speed = s.flow_ml_s / vessel;  // m/s
  const double dynamic = s.density_kg_m3 * speed * speed;              // Pa
  const double expansion = (ratio - 1.0) * (ratio - 1.0) / 2.0;
  const auto poiseuille = [&](double length, double area) {
    return 8.0 * pi * s.viscosity_mpa_s * length * s.flow_ml_s / (area * area);
  };
  // Kv mu U / D with Kv = 32 (La / D) ratio^2 and La = 0.83 L + 1.64 d.
  const double effective = 0.83 * s.length_mm + 1.64 * s.throat_diameter_mm;
  const double viscous = poiseuille(effective, throat);
  return {{"Young-Tsai", "Young and Tsai 1973, J Biomech 6:395; Seeley and Young 1976, J Biomech 9:439",
           viscous + 1.52 * dynamic * expansion},
          {"Huo-Kassab", "Huo et al. 2012, J R Soc Interface 9:1325", huo_kassab_pa(s, vessel, throat)},
          {"Poiseuille and Borda-Carnot", "friction of the throat, whole loss of the jet's excess speed",
           poiseuille(s.length_mm, throat) + dynamic * expansion},
          {"Poiseuille", "friction of the throat alone", poiseuille(s.length_mm, throat)}};
}

}  // namespace ostia::hemodynamics
