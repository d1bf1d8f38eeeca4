#include "ostia/hemodynamics/stenosis_formulas.h"

#include "circle.h"

#include "ostia/core/error.h"

namespace ostia::hemodynamics {

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
          {"Poiseuille and Borda-Carnot", "friction of the throat, whole loss of the jet's excess speed",
           poiseuille(s.length_mm, throat) + dynamic * expansion},
          {"Poiseuille", "friction of the throat alone", poiseuille(s.length_mm, throat)}};
}

}  // namespace ostia::hemodynamics
