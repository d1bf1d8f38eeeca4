#include "pressure/pressure_patients.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/hemodynamics/conditions.h"
#include "ostia/imaging/image_file.h"
#include "ostia/pipeline/vessel_choice.h"
#include "ostia/session/found_model.h"
#include "ostia/solver/boundary_conditions.h"

#include <algorithm>
#include <cctype>
#include <numbers>
#include <set>

namespace ostia::experiments {
namespace {

constexpr double root_reynolds = 600.0;

/// Letters, digits and dashes, each name once: a solver's faces are called by them.
void name_vessels(lumen::LumenModel& model) {
  std::set<std::string> taken;
  for (geometry::Vessel& vessel : model.tree.vessels) {
    std::string name = vessel.name;
    for (char& c : name)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
    if (name.empty() || taken.contains(name)) name += "v" + std::to_string(vessel.id);
    taken.insert(name);
    vessel.name = name;
  }
}

lumen::LumenModel larger_tree(const lumen::LumenModel& model) {
  std::vector<pipeline::RootedModel> parts = pipeline::rooted_parts(model);
  const auto largest = std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return a.model.vessels.size() < b.model.vessels.size();
  });
  return std::move(largest->model);
}

double root_diameter_mm(const lumen::LumenModel& model) {
  const auto& vessel = *model.vessels.front();
  std::vector<double> radii;
  for (double s = 1.0; s <= std::min(15.0, vessel.axis->length()); s += 0.5)
    radii.push_back(vessel.axis->radius(s));
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return 2.0 * *middle;
}

double mean_distance_mm(const lumen::VesselLumen& vessel) {
  double sum = 0.0;
  for (const lumen::SurfaceSample& sample : vessel.samples)
    sum += vessel.axis->nearest_foot(sample.position).rho_mm;
  return vessel.samples.empty() ? 0.0 : sum / static_cast<double>(vessel.samples.size());
}

}  // namespace

std::string text_of(const lumen::LumenModel& model) {
  constexpr int digits = 4;
  constexpr double told_every_mm = 1.0;
  std::string text;
  for (std::size_t v = 0; v < model.vessels.size(); ++v) {
    const lumen::VesselLumen& vessel = *model.vessels[v];
    const double length = vessel.axis->length();
    text += " [" + model.tree.vessels[v].name;
    const auto add = [&](double number) { text += " " + core::significant_text(number, digits); };
    for (const double number : {length, vessel.own_from_mm, mean_distance_mm(vessel)}) add(number);
    for (double s = 0.0; s <= length; s += told_every_mm) add(vessel.axis->radius(s));
    text += "]";
  }
  return text;
}

PressurePatient pressure_patient(const std::filesystem::path& masks, const std::string& name,
                                 const core::TaskContext& task) {
  const std::filesystem::path file = masks / (name + ".nrrd");
  if (!std::filesystem::is_regular_file(file))
    throw IoError("cannot read " + file.string() + ": there is no such file");
  task.set_stage(name);
  PressurePatient patient;
  patient.model =
      larger_tree(session::model_of_mask(imaging::read_labels(file).volume, nullptr, {}, task).found.model);
  name_vessels(patient.model);
  PressureCase& one = patient.planned;
  one.id = name;
  one.kind = PressureKind::patient;
  one.judged = true;
  one.diameter_mm = root_diameter_mm(patient.model);
  const hemodynamics::Conditions c;
  one.dilation = c.hyperaemic_resistance;
  const double per_flow =
      4.0 * c.density_kg_m3 / (std::numbers::pi * c.viscosity_mpa_s * one.diameter_mm);  // 1e-6 / 1e-3 / 1e-3
  one.flow_ml_s = std::min(solver::usual_flow_ml_s(one.diameter_mm) / one.dilation, root_reynolds / per_flow);
  one.reynolds = one.flow_ml_s * per_flow;
  return patient;
}

}  // namespace ostia::experiments
