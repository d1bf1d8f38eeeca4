#include "pressure/pressure_keep.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using KeptJson = nlohmann::ordered_json;

constexpr int kept_version = 1;
// Parts of a millimetre, a pascal, a ml/s that are kept.
constexpr double of_mm = 1e3, of_pa = 1e2, of_ml_s = 1e7;

double rounded(double value, double parts) {
  return std::round(value * parts) / parts;
}

/// Sections of one vessel after the other.
KeptJson sections_json(const std::vector<SectionPressure>& sections) {
  KeptJson out = KeptJson::array();
  for (const SectionPressure& one : sections) {
    if (out.empty() || out.back()["vessel"] != one.vessel)
      out.push_back({{"vessel", one.vessel}, {"s_mm", KeptJson::array()}, {"pa", KeptJson::array()}});
    out.back()["s_mm"].push_back(rounded(one.s_mm, of_mm));
    out.back()["pa"].push_back(rounded(one.pressure_pa, of_pa));
  }
  return out;
}

std::vector<SectionPressure> sections_of_json(const KeptJson& vessels) {
  std::vector<SectionPressure> sections;
  for (const KeptJson& vessel : vessels) {
    const auto id = vessel.at("vessel").get<std::int32_t>();
    const KeptJson& s_mm = vessel.at("s_mm");
    for (std::size_t i = 0; i < s_mm.size(); ++i)
      sections.push_back({id, s_mm.at(i).get<double>(), vessel.at("pa").at(i).get<double>()});
  }
  return sections;
}

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
  KeptJson outlets = KeptJson::object();
  for (const auto& [name, ml_s] : run.outlets_ml_s) outlets[name] = rounded(ml_s, of_ml_s);
  return KeptJson{{"v", kept_version},
                  {"digest", run.digest},
                  {"failure", run.failure},
                  {"converged", run.converged},
                  {"iterations", run.iterations},
                  {"cells", run.cells},
                  {"seconds", std::round(run.seconds)},
                  {"inlet_ml_s", rounded(run.inlet_ml_s, of_ml_s)},
                  {"outlets_ml_s", outlets},
                  {"sections", sections_json(run.sections)}}
             .dump() +
         "\n";
}

PressureRun run_of_json(const std::string& text, const fs::path& file) {
  try {
    const KeptJson in = KeptJson::parse(text);
    if (in.at("v") != kept_version)
      throw InvalidInput(file.string() + " was kept by another version; name another folder to keep runs in");
    PressureRun run;
    in.at("digest").get_to(run.digest);
    in.at("failure").get_to(run.failure);
    in.at("converged").get_to(run.converged);
    in.at("iterations").get_to(run.iterations);
    in.at("cells").get_to(run.cells);
    in.at("seconds").get_to(run.seconds);
    in.at("inlet_ml_s").get_to(run.inlet_ml_s);
    in.at("outlets_ml_s").get_to(run.outlets_ml_s);
    run.sections = sections_of_json(in.at("sections"));
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
  const fs::path file = folder_ / (id + ".json");
  if (!fs::exists(file)) return std::nullopt;
  PressureRun run = run_of_json(core::read_file(file), file);
  if (run.digest != digest) return std::nullopt;
  return run;
}

void PressureKeep::put(const std::string& id, const PressureRun& run) const {
  core::write_file(folder_ / (id + ".json"), run_json(run));
}

void PressureKeep::drop(const std::string& id) const {
  std::error_code ignored;
  fs::remove_all(folder_ / id, ignored);
}

}  // namespace ostia::experiments
