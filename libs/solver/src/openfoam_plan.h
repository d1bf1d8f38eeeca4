#pragma once
/// \file What the writers of an OpenFOAM case's files know of it.

#include "ostia/solver/openfoam_case.h"

#include <filesystem>
#include <string>

namespace ostia::solver {

struct CasePlan {
  const OpenfoamCaseOptions& options;
  const BoundaryFlow& flow;
  double period_s = 0.0;  ///< 0: steady
  double time_step_s = 0.0;
  int long_axis = 0;  ///< along which the model is longest: 0, 1, 2
  bool pulsatile() const { return period_s > 0.0; }
  double end_time_s() const { return period_s * options.cycles; }
  double density() const { return options.flow.blood.density_kg_m3; }
  const char* program() const { return pulsatile() ? "pisoFoam" : "simpleFoam"; }
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
bool coupled(const CasePlan& plan);
/// constant/outletResistances: each outlet and its resistance over the density, the largest outlet first.
std::string outlet_resistances(const CasePlan& plan);

/// 0/U, 0/p and, for a pulsatile case, constant/boundaryData.
void write_boundaries(const CasePlan& plan, const std::filesystem::path& folder,
                      const core::TaskContext& task);

}  // namespace ostia::solver
