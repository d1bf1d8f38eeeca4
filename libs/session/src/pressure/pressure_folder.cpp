#include "pressure/pressure_after_files.h"
#include "pressure/pressure_extras.h"
#include "pressure/pressure_uncertainty_files.h"

#include "ostia/core/csv.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/io/polydata_file.h"
#include "ostia/session/pressure_document.h"
#include "ostia/session/pressure_report.h"

#include <cmath>
#include <numbers>

namespace ostia::session {
namespace {

using core::fixed_text;
using hemodynamics::Branch;
using hemodynamics::pa_of_mmhg;

const hemodynamics::Distribution no_distribution;

io::Polydata lines_of(const PressureReport& report) {
  io::Polydata data;
  const auto& branches = report.tree.network.branches;
  auto& numbers = data.at_points.numbers;
  for (const char* name : {"FFR", "RestingPdPa", "Pressure_mmHg", "Flow_ml_min", "Area_mm2", "Radius",
                           "WallShear_Pa", "Reynolds", "Momentum", "Abscissas"})
    numbers[name] = {1, {}};
  if (report.after) numbers["FFRWhatIf"] = {1, {}};
  if (report.uncertainty)
    for (const char* name : {"FFRMedian", "FFRLow", "FFRHigh", "FFRProbability"}) numbers[name] = {1, {}};
  auto& whole = data.at_points.whole;
  for (const char* name : {"Vessel", "Branch", "Occluded", "Separated"}) whole[name] = {};
  for (std::size_t b = 0; b < branches.size(); ++b) {
    if (branches[b].stations.size() < 2) continue;
    std::vector<std::int32_t> line;
    for (std::size_t i = 0; i < branches[b].stations.size(); ++i) {
      const auto& station = branches[b].stations[i];
      const auto& flow = report.under_hyperaemia.stations[b][i];
      line.push_back(static_cast<std::int32_t>(data.points.size()));
      data.points.push_back(station.point);
      numbers["FFR"].values.push_back(report.under_hyperaemia.ratio(b, i));
      if (report.after) numbers["FFRWhatIf"].values.push_back(report.after->under_hyperaemia.ratio(b, i));
      if (report.uncertainty) {
        const hemodynamics::Distribution& of = report.uncertainty->stations[b][i];
        numbers["FFRMedian"].values.push_back(of.median);
        numbers["FFRLow"].values.push_back(of.low);
        numbers["FFRHigh"].values.push_back(of.high);
        numbers["FFRProbability"].values.push_back(of.probability);
      }
      numbers["RestingPdPa"].values.push_back(report.at_rest.ratio(b, i));
      numbers["Pressure_mmHg"].values.push_back(flow.pressure_pa / pa_of_mmhg);
      numbers["Flow_ml_min"].values.push_back(report.hyperaemia.solution.flow_ml_s[b] * 60.0);
      numbers["Area_mm2"].values.push_back(station.area_mm2);
      numbers["Radius"].values.push_back(std::sqrt(station.area_mm2 / std::numbers::pi));
      numbers["WallShear_Pa"].values.push_back(flow.wall_shear_pa);
      numbers["Reynolds"].values.push_back(flow.reynolds);
      numbers["Momentum"].values.push_back(flow.momentum);
      numbers["Abscissas"].values.push_back(station.s_mm);
      whole["Vessel"].push_back(branches[b].vessel);
      whole["Branch"].push_back(static_cast<std::int32_t>(b));
      whole["Occluded"].push_back(report.network->beyond_occlusion(b) ? 1 : 0);
      whole["Separated"].push_back(flow.separated() ? 1 : 0);
    }
    data.lines.push_back(std::move(line));
  }
  return data;
}

std::string stations_csv(const PressureReport& report) {
  std::string text = core::csv_line(
      joined_cells({"branch", "vessel", "name", "s_mm", "x", "y", "z", "area_mm2", "viscous_shape",
                    "curvature_per_mm", "ffr", "resting_pd_pa", "pressure_mmhg", "momentum", "wall_shear_pa",
                    "reynolds", "separated", "occluded"},
                   uncertain_columns(report)));
  const auto& branches = report.tree.network.branches;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const bool beyond = report.network->beyond_occlusion(b);
    for (std::size_t i = 0; i < branches[b].stations.size(); ++i) {
      const auto& station = branches[b].stations[i];
      const auto& flow = report.under_hyperaemia.stations[b][i];
      const auto unless_beyond = [&](double value, int decimals) {
        return beyond ? std::string() : fixed_text(value, decimals);
      };
      text += core::csv_line(joined_cells(
          {std::to_string(b), std::to_string(branches[b].vessel), branches[b].name,
           fixed_text(station.s_mm, 3), fixed_text(station.point.x(), 3), fixed_text(station.point.y(), 3),
           fixed_text(station.point.z(), 3), fixed_text(station.area_mm2, 4),
           fixed_text(station.shape.viscous, 4), fixed_text(station.curvature_per_mm, 5),
           unless_beyond(report.under_hyperaemia.ratio(b, i), 5),
           unless_beyond(report.at_rest.ratio(b, i), 5), unless_beyond(flow.pressure_pa / pa_of_mmhg, 4),
           fixed_text(flow.momentum, 4), fixed_text(flow.wall_shear_pa, 4), fixed_text(flow.reynolds, 1),
           flow.separated() ? "1" : "0", beyond ? "1" : "0"},
          uncertain_cells(report,
                          report.uncertainty ? report.uncertainty->stations[b][i] : no_distribution)));
    }
  }
  return text;
}

std::string lesions_csv(const PressureReport& report) {
  std::string text = core::csv_line(
      joined_cells({"lesion", "vessel", "from_mm", "throat_mm", "to_mm", "ffr", "read_behind_mm", "before",
                    "delta_ffr", "resting_pd_pa", "wave_free_ratio", "occluded"},
                   uncertain_columns(report)));
  const auto& lesions = report.under_hyperaemia.lesions;
  for (std::size_t i = 0; i < lesions.size(); ++i) {
    const auto& one = lesions[i];
    const auto number = [&](double value, int decimals) {
      return one.occluded ? std::string() : fixed_text(value, decimals);
    };
    text += core::csv_line(joined_cells(
        {one.lesion.name, report.tree.network.branches[one.lesion.throat.branch].name,
         fixed_text(one.lesion.from.s_mm, 2), fixed_text(one.lesion.throat.s_mm, 2),
         fixed_text(one.lesion.to.s_mm, 2), number(one.behind, 4), fixed_text(one.distance_mm, 1),
         number(one.before, 4), number(one.delta(), 4), number(report.at_rest.lesions[i].behind, 4),
         report.pulse ? number(report.pulse->places[i].wave_free_ratio, 4) : std::string(),
         one.occluded ? "1" : "0"},
        uncertain_cells(report,
                        report.uncertainty ? report.uncertainty->lesions[i].ratio : no_distribution)));
  }
  return text;
}

std::string outlets_csv(const PressureReport& report) {
  std::string text = core::csv_line(joined_cells({"branch", "vessel", "name", "diameter_mm", "asked_ml_min",
                                                  "rest_ml_min", "hyperaemic_ml_min", "ffr", "ppg_index"},
                                                 uncertain_columns(report)));
  const auto& network = *report.network;
  for (std::size_t k = 0; k < network.outlets().size(); ++k) {
    const std::size_t b = network.outlets()[k];
    const Branch& branch = network.network().branches[b];
    const auto& pullback = report.under_hyperaemia.pullbacks[k];
    const auto ratio = hemodynamics::outlet_ratio(network, report.under_hyperaemia, k);
    text += core::csv_line(
        joined_cells({std::to_string(b), std::to_string(branch.vessel), branch.name,
                      fixed_text(hemodynamics::outlet_diameter_mm(branch), 3),
                      fixed_text(report.resting.outlets_ml_s[k] * 60.0, 3),
                      fixed_text(report.rest.solution.flow_ml_s[b] * 60.0, 3),
                      fixed_text(report.hyperaemia.solution.flow_ml_s[b] * 60.0, 3),
                      ratio ? fixed_text(*ratio, 4) : std::string(),
                      ratio ? fixed_text(pullback.ppg_index, 3) : std::string()},
                     uncertain_cells(report, report.uncertainty ? report.uncertainty->outlets[k].ratio
                                                                : no_distribution)));
  }
  return text;
}

}  // namespace

void write_pressure_report(const std::filesystem::path& folder, const PressureReport& report,
                           const pipeline::JobKey& key, double seconds,
                           const PressureDocumentOptions& pages) {
  core::StagedFolder staged(folder);
  const auto write = [&](const char* name, const std::string& text) {
    core::write_file(staged.temporary() / name, core::redacted(text));
  };
  write("ffr.json", pressure_json(report));
  write("conditions.json", uncertain_conditions_json(report));
  write("stations.csv", stations_csv(report));
  write("lesions.csv", lesions_csv(report));
  write("outlets.csv", outlets_csv(report));
  if (report.uncertainty && report.options.uncertainty->indices) write("sobol.csv", sobol_csv(report));
  if (report.after) {
    write("what_if_stations.csv", what_if_stations_csv(report));
    write("what_if_readings.csv", what_if_readings_csv(report));
  }
  core::write_file(staged.temporary() / "pressure.html", pressure_html(report, pages));
  core::write_file(staged.temporary() / "pressure.pdf", pressure_pdf(report, pages));
  write("README.txt", std::string(hemodynamics::research_use) + "\n");
  io::write_polydata(staged.temporary() / "lines.vtp", lines_of(report));
  write_pressure_extras(staged.temporary(), report);
  pipeline::ManifestRecord record;
  record.key = key;
  record.seconds = seconds;
  record.warnings = report.warnings;
  pipeline::write_manifest(staged.temporary(), record);
  staged.commit();
}

}  // namespace ostia::session
