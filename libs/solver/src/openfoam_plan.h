#pragma once
/// \file What the writers of an OpenFOAM case's files know of it.

#include "ostia/solver/openfoam_case.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::solver {

/// Of each element, tetrahedra first; empty: at rest.
struct StartFields {
  std::vector<geometry::Vec3> velocity_m_s;
  std::vector<double> pressure_pa;
};

struct CasePlan {
  const OpenfoamCaseOptions& options;
  const BoundaryFlow& flow;
  double period_s = 0.0;     ///< 0: steady
  double time_step_s = 0.0;  ///< the first, and all of them where the case was told one
  int long_axis = 0;         ///< along which the model is longest: 0, 1, 2
  StartFields start = {};
  bool pulsatile() const { return period_s > 0.0; }
  double end_time_s() const { return period_s * options.cycles; }
  /// A hundredth of the cycle: the inlets' velocities are straight between their samples.
  double longest_step_s() const { return period_s / options.samples_per_cycle; }
  double density() const { return options.flow.blood.density_kg_m3; }
  const char* program() const { return pulsatile() ? "pimpleFoam" : "simpleFoam"; }
};

// system/ and constant/, each whole.
std::string control_dict(const CasePlan& plan);
std::string fv_schemes(const CasePlan& plan);
std::string fv_solution(const CasePlan& plan);
std::string decompose_dict(const CasePlan& plan);
std::string transport_properties(const CasePlan& plan);
std::string turbulence_properties();
/// Slices across the longest side of the model: "(1 1 n)".
std::string slices(const CasePlan& plan, const std::string& count);

/// Allrun.
std::string run_script(const CasePlan& plan);
/// Outlets whose flows and pressures are found by running again and again: a steady case with resistances and
/// two outlets at least.
bool coupled_steady(const CasePlan& plan);
/// constant/outletResistances: each outlet and its resistance over the density, the largest outlet first.
std::string outlet_resistances(const CasePlan& plan);
/// What Allrun does then: shell functions of the coupling, and the runs.
std::string steady_coupling(const CasePlan& plan);

/// Outlets whose flows over a cycle are found from one cycle to the next: a pulsatile case with resistances.
bool coupled_by_cycle(const CasePlan& plan);
/// constant/outletWindkessels: each outlet with its proximal and distal resistance over the density and its
/// compliance times it, the largest outlet first.
std::string outlet_windkessels(const CasePlan& plan);
/// constant/outletTables of a pulsatile case: the flow of each outlet whose flow is given, m3/s, and the
/// largest outlet's pressure over the density where it has a resistance, over one cycle that is repeated; as
/// if the model itself resisted nothing.
void write_outlet_tables(const CasePlan& plan, const std::filesystem::path& folder);
/// What OpenFOAM reads such a table by.
std::string outlet_table(const std::string& outlet, const std::string& quantity);
/// All but the largest outlet, which takes what is left and holds the pressure.
bool flow_is_given(const CasePlan& plan, std::size_t outlet);
/// Shell functions that set the tables anew by what the last cycle has measured, and the loop over the
/// cycles.
std::string cycle_coupling(const CasePlan& plan);

/// 0/U, 0/p and, for a pulsatile case, constant/boundaryData.
void write_boundaries(const CasePlan& plan, const std::filesystem::path& folder,
                      const core::TaskContext& task);

}  // namespace ostia::solver
