#include "pressure_keep.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using KeptJson = nlohmann::ordered_json;

/// What all runs of a folder have in common.
std::string plan_json(const PressureOptions& options) {
  KeptJson cases = KeptJson::array();
  for (const PressureCase& one : plan_pressure(options.plan)) cases.push_back(text_of(one));
  return KeptJson{{"v", 1},
                  {"edge_ratio", options.mesh.edge_ratio},
                  {"layers", options.mesh.layers},
                  {"layer_thickness", options.mesh.layer_thickness},
                  {"iterations", options.mesh.iterations},
                  {"tolerance", options.mesh.tolerance},
                  {"cases", cases}}
             .dump(1) +
         "\n";
}

}  // namespace

std::string run_json(const PressureRun& run) {
  KeptJson out{{"v", 1},
               {"digest", run.digest},
               {"failure", run.failure},
               {"converged", run.converged},
               {"iterations", run.iterations},
               {"cells", run.cells},
               {"seconds", run.seconds},
               {"inlet_ml_s", run.inlet_ml_s},
               {"outlets_ml_s", run.outlets_ml_s},
               {"sections", KeptJson::array()}};
  for (const SectionPressure& one : run.sections)
    out["sections"].push_back({one.vessel, one.s_mm, one.pressure_pa});
  return out.dump() + "\n";
}

PressureRun run_of_json(const std::string& text, const fs::path& file) {
  try {
    const KeptJson in = KeptJson::parse(text);
    PressureRun run;
    in.at("digest").get_to(run.digest);
    in.at("failure").get_to(run.failure);
    in.at("converged").get_to(run.converged);
    in.at("iterations").get_to(run.iterations);
    in.at("cells").get_to(run.cells);
    in.at("seconds").get_to(run.seconds);
    in.at("inlet_ml_s").get_to(run.inlet_ml_s);
    in.at("outlets_ml_s").get_to(run.outlets_ml_s);
    for (const KeptJson& one : in.at("sections"))
      run.sections.push_back(
          {one.at(0).get<std::int32_t>(), one.at(1).get<double>(), one.at(2).get<double>()});
    return run;
  } catch (const nlohmann::json::exception& error) {
    throw InvalidInput(file.string() + " is no run of this experiment (" + error.what() +
                       "); delete it, or name another folder to keep runs in");
  }
}

PressureKeep::PressureKeep(const PressureOptions& options) : folder_(options.keep) {
  std::error_code fault;
  fs::create_directories(folder_, fault);
  if (fault) throw IoError("cannot make the folder " + folder_.string() + ": " + fault.message());
  const fs::path plan = folder_ / "plan.json";
  const std::string now = plan_json(options);
  if (!fs::exists(plan)) {
    if (!fs::is_empty(folder_))
      throw InvalidInput(folder_.string() + " holds other files; name a folder of its own to keep runs in");
    core::write_file(plan, now);
  }
  if (core::read_file(plan) != now)
    throw InvalidInput("the runs kept in " + folder_.string() +
                       " are of another plan or mesh (plan.json there); give the same --seed, --edge-ratio, "
                       "--layers and --iterations, or another folder to keep runs in");
}

fs::path PressureKeep::folder_of(const std::string& id) const {
  const fs::path folder = folder_ / id;
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault) throw IoError("cannot make the folder " + folder.string() + ": " + fault.message());
  return folder;
}

std::optional<PressureRun> PressureKeep::find(const std::string& id, const std::string& digest) const {
  const fs::path file = folder_ / id / "run.json";
  if (!fs::exists(file)) return std::nullopt;
  PressureRun run = run_of_json(core::read_file(file), file);
  if (run.digest != digest) return std::nullopt;
  return run;
}

void PressureKeep::put(const std::string& id, const PressureRun& run) const {
  core::write_file(folder_of(id) / "run.json", run_json(run));
}

}  // namespace ostia::experiments
