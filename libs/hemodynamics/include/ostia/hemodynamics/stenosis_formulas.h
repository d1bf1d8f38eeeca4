#pragma once
/// \file Published formulas for the pressure over one stenosis: to compare with, not used by the network.

#include <string_view>
#include <vector>

namespace ostia::hemodynamics {

/// One stenosis in a round vessel.
struct StenosisCase {
  double vessel_diameter_mm = 3.0, throat_diameter_mm = 1.5, length_mm = 10.0;
  double flow_ml_s = 1.0;
  double density_kg_m3 = 1060.0, viscosity_mpa_s = 3.5;
};
struct FormulaDrop {
  std::string_view name, source;
  double pa = 0.0;
};
/// Young and Tsai 1973 (Kt = 1.52) with Seeley and Young's 1976 viscous term; Huo and Kassab's growing core
/// in the throat, and the jet's loss by how far it has developed; Poiseuille in the throat with Borda-Carnot
/// behind it; Poiseuille alone. Throws InvalidInput unless 0 < throat < vessel, length > 0 and
/// flow >= 0.
std::vector<FormulaDrop> stenosis_formulas(const StenosisCase& stenosis);

}  // namespace ostia::hemodynamics
