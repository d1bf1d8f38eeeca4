// The figures of the pressure experiment as JSON (docs/schemas/experiment-pressure.schema.json).

#include "ostia/experiments/pressure.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::experiments {
namespace {

using FiguresJson = nlohmann::ordered_json;

FiguresJson number(double value) {
  return std::isfinite(value) ? FiguresJson(value) : FiguresJson();
}
FiguresJson number(const std::optional<double>& value) {
  return value ? number(*value) : FiguresJson();
}

FiguresJson settings(const PressureOptions& o) {
  return {{"first_seed", o.plan.first_seed},
          {"vessels",
           {{"concentric", o.plan.concentric},
            {"eccentric", o.plan.eccentric},
            {"tapered", o.plan.tapered},
            {"bend", o.plan.bend},
            {"series", o.plan.series},
            {"fork", o.plan.fork}}},
          {"edge_ratio", o.mesh.edge_ratio},
          {"other_edge_ratios", o.other_edge_ratios},
          {"layers", o.mesh.layers},
          {"layer_thickness", o.mesh.layer_thickness},
          {"iterations", o.mesh.iterations},
          {"tolerance", o.mesh.tolerance},
          {"patients", o.masks.empty() ? std::vector<std::string>() : o.patients}};
}

FiguresJson summary_json(const PressureSummary& s) {
  return {{"cases", s.cases},
          {"readings", s.readings},
          {"bias", s.bias},
          {"sd", s.sd},
          {"alike", s.alike},
          {"worst", s.worst},
          {"worst_case", s.worst_id},
          {"rms_mmhg", s.rms_mmhg},
          {"worst_rms_mmhg", s.worst_rms_mmhg}};
}

FiguresJson row_json(const PressureRow& row) {
  const PressureCase& one = row.planned;
  FiguresJson out{{"case", one.id},
                  {"kind", name_of(one.kind)},
                  {"medina", one.medina.empty() ? FiguresJson() : FiguresJson(one.medina)},
                  {"seed", one.seed},
                  {"half", name_of(half_of(one))},
                  {"diameter_mm", one.diameter_mm},
                  {"flow_ml_s", one.flow_ml_s},
                  {"reynolds", one.reynolds},
                  {"stenoses", FiguresJson::array()},
                  {"failure", row.failure.empty() ? FiguresJson() : FiguresJson(row.failure)},
                  {"converged", row.run.converged},
                  {"iterations", row.run.iterations},
                  {"cells", row.run.cells},
                  {"seconds", row.run.seconds},
                  {"rms_mmhg", row.failure.empty() ? number(row.rms_mmhg) : FiguresJson()},
                  {"readings", FiguresJson::array()}};
  for (const PlannedStenosis& s : one.stenoses)
    out["stenoses"].push_back({{"vessel", s.vessel == 0 ? "main" : "side"},
                               {"at_mm", s.at_mm},
                               {"length_mm", s.length_mm},
                               {"severity", s.severity},
                               {"aside_mm", s.aside_mm},
                               {"oval", s.oval}});
  for (const PressureReading& reading : row.readings)
    out["readings"].push_back({{"vessel", reading.vessel},
                               {"s_mm", reading.s_mm},
                               {"ffr_1d", number(reading.ffr_1d)},
                               {"ffr_3d", number(reading.ffr_3d)},
                               {"difference", number(reading.difference())},
                               {"ffr_1d_exact_sections", number(reading.exact)},
                               {"ffr_1d_fitted", number(reading.fitted)}});
  return out;
}

FiguresJson mesh_json(const ConvergenceRow& row) {
  return {{"case", row.id},
          {"edge_ratios", row.edge_ratios},
          {"cells", row.cells},
          {"drops_mmhg", row.drops_mmhg},
          {"order", number(row.order)},
          {"extrapolated_mmhg", number(row.richardson_mmhg)}};
}

}  // namespace

std::string parameters_json(const PressureOptions& options) {
  return settings(options).dump();
}

std::string pressure_json(const PressureResults& results, const PressureOptions& options) {
  FiguresJson out{{"v", 1},
                  {"kind", "pressure"},
                  {"parameters", settings(options)},
                  {"aortic_mmhg", results.aortic_mmhg},
                  {"cases_planned", results.planned},
                  {"cases_run", results.rows.size()},
                  {"poiseuille_error", number(poiseuille_error(results))}};
  for (const auto& [name, half] :
       {std::pair{"fitting", PressureHalf::fitting}, std::pair{"judging", PressureHalf::judging},
        std::pair{"patients", PressureHalf::patients}})
    out["summary"][name] = {
        {"model", summary_json(summarize(results, half))},
        {"fitted", results.fit ? summary_json(summarize(results, half, true)) : FiguresJson()}};
  out["fit"] = FiguresJson();
  if (results.fit)
    out["fit"] = {{"development", results.fit->development},
                  {"layer_friction", results.fit->layer_friction},
                  {"readings", results.fit->readings},
                  {"rms_before", results.fit->rms_before},
                  {"rms_after", results.fit->rms_after}};
  out["meshes"] = FiguresJson::array();
  for (const ConvergenceRow& row : results.convergence) out["meshes"].push_back(mesh_json(row));
  out["cases"] = FiguresJson::array();
  for (const PressureRow& row : results.rows) out["cases"].push_back(row_json(row));
  return out.dump(1) + "\n";
}

}  // namespace ostia::experiments
