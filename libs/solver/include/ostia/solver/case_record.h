#pragma once
/// \file What a case's folder says of itself, so that its results can be read back: `flow-case.json`
/// (docs/schemas/flow-case.schema.json) and the mesh as `mesh.vtu`.

#include "ostia/geometry/mixed_mesh.h"

#include <filesystem>
#include <map>
#include <string>

namespace ostia::solver {

struct BoundaryFlow;
struct BoundaryFlowOptions;

struct CaseRecord {
  std::string solver = "openfoam";  ///< or svmultiphysics
  double density_kg_m3 = 1060.0;
  double viscosity_mpa_s = 3.5;
  std::string rheology = "newton";  ///< or carreau
  double period_s = 0.0;            ///< 0: steady
  int cycles = 0;                   ///< 0: steady
  std::string outlets = "zero";     ///< split, resistance
  /// By the outlet's name, Pa s / m3; empty unless outlets are resistances.
  std::map<std::string, double> resistance_pa_s_m3;
  /// ... and their compliances, m3 / Pa; empty unless they are Windkessels.
  std::map<std::string, double> compliance_m3_pa;
  bool pulsatile() const { return period_s > 0.0; }
};
CaseRecord case_record(const std::string& solver, const BoundaryFlowOptions& options,
                       const BoundaryFlow& flow, int cycles, double total_compliance_ml_mmhg = 0.0);

/// Writes both files into a folder that is being made. Throws IoError, ResourceError.
void write_case_record(const CaseRecord& record, const geometry::MixedMesh& mesh,
                       const std::filesystem::path& folder);

/// Throws InvalidInput: no case of `ostia case` there, or a record that is not sound (by its field).
CaseRecord read_case_record(const std::filesystem::path& folder);

}  // namespace ostia::solver
