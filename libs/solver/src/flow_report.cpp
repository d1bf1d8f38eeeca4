#include "ostia/solver/flow_report.h"

#include "pressure_units.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/faces.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace ostia::solver {
namespace {

using core::shortest_text;
using geometry::FaceKind;
using nlohmann::json;

constexpr double largest_imbalance = 0.01;
constexpr double largest_misfit = 0.02;  // of an outlet's pressure to R Q; runs that settle come within 0.01

WallFigures figures_of(const WallSurface& wall, const WallSurface::Part& part,
                       const std::vector<double>& shear, const ShearLimits& limits) {
  const auto of_part = [&](const std::vector<double>& all) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(part.first);
    return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(part.count));
  };
  const std::vector<double> values = of_part(shear), areas = of_part(wall.areas_mm2);
  WallFigures f;
  f.name = part.name;
  double force = 0.0, low = 0.0, high = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    f.area_mm2 += areas[i];
    force += areas[i] * values[i];
    if (values[i] < limits.low_pa) low += areas[i];
    if (values[i] > limits.high_pa) high += areas[i];
  }
  f.mean_pa = force / f.area_mm2;
  f.low_share = low / f.area_mm2;
  f.high_share = high / f.area_mm2;
  f.least_pa = *std::ranges::min_element(values);
  f.greatest_pa = *std::ranges::max_element(values);
  f.p05_pa = weighted_percentile(values, areas, 0.05);
  f.p95_pa = weighted_percentile(values, areas, 0.95);
  return f;
}

json face_json(const EndFlow& end) {
  return {{"name", end.name},
          {"kind", name_of(end.kind)},
          {"area_mm2", end.area_mm2},
          {"flow_ml_s", end.flow_ml_s},
          {"pressure_Pa", end.pressure_pa},
          {"pressure_mmHg", end.pressure_pa / pa_per_mmhg}};
}

json wall_json(const WallFigures& wall) {
  return {{"name", wall.name},
          {"area_mm2", wall.area_mm2},
          {"wall_shear_stress_Pa",
           {{"mean", wall.mean_pa},
            {"least", wall.least_pa},
            {"greatest", wall.greatest_pa},
            {"p05", wall.p05_pa},
            {"p95", wall.p95_pa}}},
          {"low_share", wall.low_share},
          {"high_share", wall.high_share}};
}

/// Where outlets are coupled: reasons of those that are not at p = R Q, means over the cycle of a pulsatile
/// flow.
void judge_outlets(const FlowResult& result, std::vector<std::string>& reasons) {
  const std::map<std::string, double>& resistances = result.record.resistance_pa_s_m3;
  if (resistances.size() < 2) return;
  for (const EndFlow& end : result.ends) {
    const auto r = resistances.find(end.name);
    if (r == resistances.end()) continue;
    const double misfit = std::abs(end.pressure_pa - 1e-6 * r->second * end.flow_ml_s);
    if (!(misfit <= largest_misfit * std::abs(end.pressure_pa)))
      reasons.push_back("the outlet " + end.name + " has not settled at its resistance: see log.outlets");
  }
}

json or_null(const std::optional<double>& value) {
  return value ? json(*value) : json();
}

}  // namespace

void validate(const ShearLimits& limits) {
  if (!(limits.low_pa > 0.0 && limits.high_pa > limits.low_pa && std::isfinite(limits.high_pa)))
    throw InvalidInput("the limits of low and high shear stress are " + shortest_text(limits.low_pa) +
                       " and " + shortest_text(limits.high_pa) +
                       " Pa; the first must be positive and below the second");
}

double weighted_percentile(const std::vector<double>& values, const std::vector<double>& weights,
                           double share) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
  const double wanted = share * std::accumulate(weights.begin(), weights.end(), 0.0);
  double sum = 0.0;
  for (const std::size_t i : order) {
    sum += weights[i];
    if (sum >= wanted) return values[i];
  }
  return values[order.back()];
}

FlowReport flow_report(const FlowResult& result, const ShearLimits& limits) {
  validate(limits);
  FlowReport report;
  report.limits = limits;
  const std::vector<double> shear =
      result.record.pulsatile() ? result.mean_shear_pa : magnitudes(result.last.wall_shear_pa);
  for (const WallSurface::Part& part : result.wall.parts)
    report.walls.push_back(figures_of(result.wall, part, shear, limits));
  if (!result.run.converged) report.reasons.push_back(result.run.not_converged);
  const double imbalance = result.mass_balance_error();
  if (!(imbalance <= largest_imbalance))
    report.reasons.push_back("what flows in and what flows out differ by " +
                             shortest_text(std::round(1e3 * imbalance) / 10.0) + " %");
  judge_outlets(result, report.reasons);
  return report;
}

std::string report_json(const FlowResult& result, const FlowReport& report) {
  json faces = json::array(), walls = json::array();
  for (const EndFlow& end : result.ends) faces.push_back(face_json(end));
  for (const WallFigures& wall : report.walls) walls.push_back(wall_json(wall));
  const CaseRecord& c = result.record;
  const json cycle = c.pulsatile() ? json{{"period_s", c.period_s},
                                          {"times", result.times},
                                          {"change", or_null(result.run.cycle_change)}}
                                   : json();
  const json written = {
      {"v", 1},
      {"solver", c.solver},
      {"program", result.run.program},
      {"density_kg_m3", c.density_kg_m3},
      {"viscosity_mPa_s", c.viscosity_mpa_s},
      {"rheology", c.rheology},
      {"elements", {{"tetrahedra", result.mesh.tetrahedra.size()}, {"prisms", result.mesh.prisms.size()}}},
      {"cycle", cycle},
      {"run",
       {{c.pulsatile() ? "time_s" : "iterations", result.run.last},
        {"converged", result.run.converged},
        {"residuals", result.run.residuals},
        {"largest_courant", or_null(result.run.largest_courant)}}},
      {"mass_balance_error", result.mass_balance_error()},
      {"faces", faces},
      {"walls", walls},
      {"limits_Pa", {{"low", report.limits.low_pa}, {"high", report.limits.high_pa}}},
      {"verdict", {{"passed", report.passed()}, {"reasons", report.reasons}}}};
  // Names and reasons may hold what is no UTF-8.
  return written.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string faces_csv(const FlowResult& result, const FlowReport& report) {
  std::string text =
      "face,kind,area_mm2,flow_ml_s,pressure_Pa,pressure_mmHg,shear_mean_Pa,shear_least_Pa,shear_p05_Pa,"
      "shear_p95_Pa,shear_greatest_Pa,low_share,high_share\n";
  for (const EndFlow& end : result.ends)
    text += core::csv_cell(end.name) + "," + std::string(name_of(end.kind)) + "," +
            shortest_text(end.area_mm2) + "," + shortest_text(end.flow_ml_s) + "," +
            shortest_text(end.pressure_pa) + "," + shortest_text(end.pressure_pa / pa_per_mmhg) + ",,,,,,,\n";
  for (const WallFigures& wall : report.walls) {
    text += core::csv_cell(wall.name) + ",wall," + shortest_text(wall.area_mm2) + ",,,";
    for (const double value : {wall.mean_pa, wall.least_pa, wall.p05_pa, wall.p95_pa, wall.greatest_pa,
                               wall.low_share, wall.high_share})
      text += "," + shortest_text(value);
    text += "\n";
  }
  return text;
}

}  // namespace ostia::solver
