#pragma once
/// \file What flows through the open ends of a model, and what it flows against. See
/// docs/reference/solver-cases.md.

#include "ostia/solver/section.h"
#include "ostia/solver/waveform.h"

#include <complex>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::solver {

enum class Rheology {
  newtonian,
  carreau,  ///< shear-thinning: CarreauLaw
};

/// "newton", "carreau".
std::string_view name_of(Rheology rheology);

/// Viscosity of blood at a shear rate g: at_speed + (at_rest - at_speed) (1 + (relaxation g)^2)^((power - 1)
/// / 2) (Cho and Kensey, Biorheology 1991).
struct CarreauLaw {
  static constexpr double at_rest_mpa_s = 56.0, at_speed_mpa_s = 3.45, relaxation_s = 3.313, power = 0.3568;
};

struct Blood {
  double density_kg_m3 = 1060.0;  ///< in [500, 2000]
  double viscosity_mpa_s = 3.5;   ///< of the newtonian one, in [0.1, 100]
  Rheology rheology = Rheology::newtonian;
  double kinematic_viscosity_mm2_s() const { return 1e3 * viscosity_mpa_s / density_kg_m3; }
};

/// What the outlets do.
enum class OutletModel {
  zero_pressure,  ///< the same pressure at each
  split,          ///< a share of the flow each: its diameter to `split_exponent`
  resistance,     ///< pressure = resistance x flow; resistances as diameter to -`split_exponent`
};

struct OutletTraits {
  OutletModel model;
  std::string_view name;  ///< as it is written: "zero", "split", "resistance"
  std::string_view what;  ///< it does, in a few words
};
/// All of them, once each.
std::span<const OutletTraits> outlet_models();
std::string_view name_of(OutletModel outlets);
/// By its name. Throws InvalidInput, naming those there are.
OutletModel outlet_model(std::string_view name);

struct BoundaryFlowOptions {
  Blood blood;
  /// Mean flow through each inlet, by at most one of these; with none 1.43 d^2.55 (SI) of its diameter [van
  /// der Giessen et al. 2011]. All positive.
  std::optional<double> flow_ml_s, mean_velocity_cm_s, reynolds;
  std::map<std::string, double> inlet_flow_ml_s;  ///< by the face's name; goes before those above
  /// Pulsatile where there is one. One that is relative, or stands beside one of the flows above, is scaled
  /// to the mean flow; another one is taken as it is, through each inlet.
  std::optional<FlowWaveform> waveform;
  int harmonics = 12;  ///< of the waveform; in [1, 60]
  OutletModel outlets = OutletModel::zero_pressure;
  double split_exponent = 2.27;  ///< [van der Giessen et al. 2011]; 3 is Murray's; in [1, 4]
  /// Of all outlets together, mmHg s / ml; left out: 90 mmHg over the mean flow. Positive.
  std::optional<double> total_resistance_mmhg_s_ml;
};
void validate(const BoundaryFlowOptions& options);

struct Inlet {
  std::string name;  ///< as exports write it
  Section section;
  double mean_flow_ml_s = 0.0;
  double reynolds = 0.0;                   ///< by diameter and largest flow
  std::optional<FlowHarmonics> harmonics;  ///< of a pulsatile flow, scaled
  double flow_ml_s(double time_s) const { return harmonics ? harmonics->flow_ml_s(time_s) : mean_flow_ml_s; }
  double largest_flow_ml_s() const { return harmonics ? harmonics->largest_flow_ml_s() : mean_flow_ml_s; }
};

struct Outlet {
  std::string name;
  double area_mm2 = 0.0, diameter_mm = 0.0;
  double share = 0.0;               ///< of the flow, by diameter to `split_exponent`; they sum to 1
  double resistance_pa_s_m3 = 0.0;  ///< 0 unless OutletModel::resistance
};

struct BoundaryFlow {
  std::vector<Inlet> inlets;
  std::vector<Outlet> outlets;  ///< the largest first; of equal ones the first in the mesh
  std::vector<std::string> walls;
  double mean_flow_ml_s = 0.0;
  std::vector<std::string> warnings;
  double flow_ml_s(double time_s) const;  ///< through all inlets
};

/// A resistance in two parts with a compliance between them (RCR), against no pressure behind.
struct Windkessel {
  static constexpr double proximal_share = 0.09;  ///< of the resistance: a usual choice
  double proximal_pa_s_m3 = 0.0, distal_pa_s_m3 = 0.0;
  double compliance_m3_pa = 0.0;  ///< 0: a resistance alone
  /// Pressure over flow of a harmonic, Pa s / m3.
  std::complex<double> impedance(double angular_frequency) const;
};
/// Of an outlet with resistance. `total_compliance_ml_mmhg` is that of all outlets together, split as the
/// flow is; 0: none.
Windkessel windkessel_of(const Outlet& outlet, double total_compliance_ml_mmhg);

/// Throws InvalidInput: options, no inlet, no outlet or no wall (with their names), an inlet's name that the
/// mesh does not have, an inlet too small or too large for a vessel in mm; GeometryError for an inverted
/// element.
BoundaryFlow boundary_flow(const geometry::MixedMesh& mesh, const BoundaryFlowOptions& options);

/// 1.43 d^2.55 with d in m and the flow in m3/s.
double usual_flow_ml_s(double diameter_mm);

}  // namespace ostia::solver
