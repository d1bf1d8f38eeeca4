#include "ostia/solver/case_record.h"

#include "case_text.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/io/mesh_export.h"
#include "ostia/solver/boundary_conditions.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::solver {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr const char* record_name = "flow-case.json";

/// A field of a record, or a refusal that names it.
template <class T>
T field(const json& record, const char* name, const fs::path& file) {
  try {
    return record.at(name).get<T>();
  } catch (const json::exception&) {
    throw InvalidInput("cannot read " + file.string() + ": its field " + name + " is missing or no " +
                       (std::is_same_v<T, std::string> ? "text" : "number"));
  }
}

}  // namespace

CaseRecord case_record(const std::string& solver, const BoundaryFlowOptions& options,
                       const BoundaryFlow& flow, int cycles, double total_compliance_ml_mmhg) {
  CaseRecord record;
  record.solver = solver;
  record.density_kg_m3 = options.blood.density_kg_m3;
  record.viscosity_mpa_s = options.blood.viscosity_mpa_s;
  record.rheology = name_of(options.blood.rheology);
  if (options.waveform) {
    record.period_s = options.waveform->period_s;
    record.cycles = cycles;
  }
  record.outlets = name_of(options.outlets);
  if (options.outlets == OutletModel::resistance)
    for (const Outlet& outlet : flow.outlets) {
      record.resistance_pa_s_m3[outlet.name] = outlet.resistance_pa_s_m3;
      if (total_compliance_ml_mmhg > 0.0)
        record.compliance_m3_pa[outlet.name] =
            windkessel_of(outlet, total_compliance_ml_mmhg).compliance_m3_pa;
    }
  return record;
}

void write_case_record(const CaseRecord& record, const geometry::MixedMesh& mesh, const fs::path& folder) {
  json written = {{"v", 1},
                  {"solver", record.solver},
                  {"density_kg_m3", record.density_kg_m3},
                  {"viscosity_mPa_s", record.viscosity_mpa_s},
                  {"rheology", record.rheology},
                  {"period_s", record.period_s},
                  {"cycles", record.cycles},
                  {"outlets", record.outlets},
                  {"resistance_Pa_s_m3", record.resistance_pa_s_m3}};
  if (!record.compliance_m3_pa.empty()) written["compliance_m3_Pa"] = record.compliance_m3_pa;
  write_case_file(folder / record_name, written.dump(2) + "\n");
  io::export_mesh(mesh, io::MeshFormat::vtu, folder / "mesh.vtu");
}

CaseRecord read_case_record(const fs::path& folder) {
  const fs::path file = folder / record_name;
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw InvalidInput("there is no folder " + folder.string());
  if (!fs::exists(file, error))
    throw InvalidInput(folder.string() + " is no case of `ostia case`: it has no " + record_name);
  const json record = json::parse(core::read_file(file), nullptr, false);
  if (!record.is_object() || record.value("v", json()) != 1)
    throw InvalidInput("cannot read " + file.string() + ": it is no record of a case, version 1");
  CaseRecord read;
  read.solver = field<std::string>(record, "solver", file);
  read.density_kg_m3 = field<double>(record, "density_kg_m3", file);
  read.viscosity_mpa_s = field<double>(record, "viscosity_mPa_s", file);
  read.rheology = field<std::string>(record, "rheology", file);
  read.period_s = field<double>(record, "period_s", file);
  read.cycles = field<int>(record, "cycles", file);
  read.outlets = field<std::string>(record, "outlets", file);
  if (!(read.density_kg_m3 > 0.0 && std::isfinite(read.density_kg_m3)) || !(read.period_s >= 0.0))
    throw InvalidInput("cannot read " + file.string() + ": density_kg_m3 must be positive, period_s not " +
                       "negative");
  const auto take = [&](const char* name, std::map<std::string, double>& values) {
    const json object = record.value(name, json::object());
    for (const auto& [outlet, value] : object.items())
      if (value.is_number()) values[outlet] = value.get<double>();
  };
  take("resistance_Pa_s_m3", read.resistance_pa_s_m3);
  take("compliance_m3_Pa", read.compliance_m3_pa);
  return read;
}

}  // namespace ostia::solver
