#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/experiments/sensitivity.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/plot.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

double percent(double value, double of) {
  return of > 0.0 ? 100.0 * (value / of - 1.0) : 0.0;
}

Json json_of(const LumenFigures& f) {
  return {{"volume_mm3", f.volume_mm3},
          {"mean_diameter_mm", f.mean_diameter_mm},
          {"least_diameter_mm", f.least_diameter_mm},
          {"axis_mm", f.axis_mm},
          {"lost_sections", f.lost}};
}

Json json_of(const std::vector<ParameterRun>& runs) {
  Json out = Json::array();
  for (const ParameterRun& run : runs) {
    Json one{{"name", run.name},
             {"option", run.meaning},
             {"default", run.settings[run.standard].setting.name},
             {"plateau_change", run.plateau},
             {"verdict", run.verdict},
             {"settings", Json::array()}};
    for (const SettingRun& s : run.settings) {
      Json row{{"value", s.setting.name}, {"near", s.setting.near}, {"lumina", Json::array()}};
      for (const LumenFigures& f : s.cases) row["lumina"].push_back(json_of(f));
      if (!s.failure.empty()) row["failure"] = s.failure;
      one["settings"].push_back(row);
    }
    out.push_back(one);
  }
  return out;
}

std::string csv_of(const std::vector<ParameterRun>& runs, const SensitivityResult& result) {
  std::string text =
      "parameter,value,default,near,lumen,volume_percent,mean_diameter_mm,least_diameter_mm,axis_mm,lost\n";
  for (const ParameterRun& run : runs) {
    for (std::size_t v = 0; v < run.settings.size(); ++v) {
      const SettingRun& s = run.settings[v];
      for (std::size_t c = 0; c < s.cases.size(); ++c) {
        const LumenFigures &f = s.cases[c], &t = result.truth[c];
        char row[320];
        std::snprintf(row, sizeof row, "\"%s\",%s,%d,%d,%s,%.3f,%.4f,%.4f,%.4f,%d\n", run.name.c_str(),
                      s.setting.name.c_str(), v == run.standard ? 1 : 0, s.setting.near ? 1 : 0,
                      result.lumina[c].c_str(), percent(f.volume_mm3, t.volume_mm3),
                      f.mean_diameter_mm - t.mean_diameter_mm, f.least_diameter_mm - t.least_diameter_mm,
                      f.axis_mm, f.lost);
        text += row;
      }
    }
  }
  return text;
}

/// Mean volume of all lumina against the truth's.
double mean_volume_percent(const SettingRun& run, const SensitivityResult& result) {
  double sum = 0.0;
  for (std::size_t c = 0; c < run.cases.size(); ++c)
    sum += percent(run.cases[c].volume_mm3, result.truth[c].volume_mm3);
  return run.failure.empty() ? sum / static_cast<double>(run.cases.size()) : std::nan("");
}

figure::Picture plot_of(const std::vector<ParameterRun>& runs, const SensitivityResult& result,
                        const std::string& title) {
  std::vector<figure::Series> series;
  for (const ParameterRun& run : runs) {
    const double standard = run.settings[run.standard].setting.value;
    if (run.choice || standard == 0.0) continue;
    figure::Series line{run.name};
    for (const SettingRun& s : run.settings) {
      line.x.push_back(s.setting.value / standard);
      line.y.push_back(mean_volume_percent(s, result));
    }
    series.push_back(std::move(line));
  }
  if (series.empty()) series.push_back({"none", {0.75, 1.25}, {0.0, 0.0}});
  figure::PlotOptions how;
  how.title = title;
  how.x_label = "value / default";
  how.y_label = "volume against the truth (%)";
  how.width_px = 820;
  how.height_px = 480;
  how.x_range = figure::Range{0.4, 1.8};
  how.y_range = figure::Range{-12.0, 12.0};
  how.references = {{figure::ReferenceLine::Along::x, 0.75, "-25 %"},
                    {figure::ReferenceLine::Along::x, 1.25, "+25 %"},
                    {figure::ReferenceLine::Along::y, 0.0, ""}};
  return figure::line_plot(series, how);
}

figure::Picture plots_of(const SensitivityResult& result) {
  return figure::grid({plot_of(result.level_set, result, "Fronts and level set"),
                       plot_of(result.boundary, result, "Boundary on rays")},
                      {.columns = 1, .look = figure::Look::light});
}

void add_table(figure::HtmlReport& page, const std::vector<ParameterRun>& runs,
               const SensitivityResult& result) {
  std::vector<std::string> header{"parameter", "value"};
  for (const std::string& name : result.lumina)
    for (const char* what : {"volume %", "mean d", "least d", "axis"}) header.push_back(name + ": " + what);
  header.push_back("verdict");
  std::vector<std::vector<std::string>> rows;
  for (const ParameterRun& run : runs) {
    for (std::size_t v = 0; v < run.settings.size(); ++v) {
      const SettingRun& s = run.settings[v];
      std::vector<std::string> row{run.name, s.setting.name + (v == run.standard ? " (default)" : "")};
      for (std::size_t c = 0; c < s.cases.size(); ++c) {
        const LumenFigures &f = s.cases[c], &t = result.truth[c];
        row.insert(row.end(), {core::signed_text(percent(f.volume_mm3, t.volume_mm3), 2),
                               core::signed_text(f.mean_diameter_mm - t.mean_diameter_mm, 3),
                               core::signed_text(f.least_diameter_mm - t.least_diameter_mm, 3),
                               core::signed_text(f.axis_mm, 3)});
      }
      row.push_back(s.failure.empty() ? (v == run.standard ? run.verdict : "") : s.failure);
      rows.push_back(std::move(row));
    }
  }
  page.table(header, rows, "Differences to the truth; diameters and the axis in mm.");
}

}  // namespace

std::string parameters_json(const SensitivityOptions& options, const std::string& only) {
  return Json{{"seed", options.seed}, {"section_step_mm", options.section_step_mm}, {"only", only}}.dump();
}

std::string sensitivity_json(const SensitivityResult& result, const SensitivityOptions& options) {
  Json out{{"v", 1}, {"kind", "sensitivity"}};
  out["parameters"] = Json::parse(parameters_json(options, ""));
  out["lumina"] = Json::array();
  for (std::size_t c = 0; c < result.lumina.size(); ++c) {
    Json one = json_of(result.truth[c]);
    one["name"] = result.lumina[c];
    out["lumina"].push_back(one);
  }
  out["level_set"] = json_of(result.level_set);
  out["boundary"] = json_of(result.boundary);
  return out.dump(1) + "\n";
}

std::string sensitivity_text(const SensitivityResult& result) {
  std::string text;
  for (const auto* runs : {&result.level_set, &result.boundary}) {
    for (const ParameterRun& run : *runs) {
      char row[256];
      std::snprintf(row, sizeof row, "%-36s default %-8s %s\n", run.name.c_str(),
                    run.settings[run.standard].setting.name.c_str(), run.verdict.c_str());
      text += row;
    }
  }
  return text;
}

void write_sensitivity_report(const fs::path& folder, const SensitivityResult& result) {
  core::write_file(folder / "level-set.csv", csv_of(result.level_set, result));
  core::write_file(folder / "boundary.csv", csv_of(result.boundary, result));
  const figure::Picture plots = plots_of(result);
  plots.write_png(folder / "sensitivity.png", 1.5);
  figure::HtmlReport page("Sensitivity of the lumen to the segmentation's parameters",
                          "One at a time, on lumina that are known exactly");
  page.paragraph(
      "A default lies on a plateau where a change of it by up to 25 % changes no lumen's volume by more than "
      "2 %.");
  page.picture(plots, "Mean volume of the lumina against the truth.");
  page.section("Fronts and level set");
  add_table(page, result.level_set, result);
  page.section("Boundary on rays");
  add_table(page, result.boundary, result);
  page.write(folder / "report.html");
}

}  // namespace ostia::experiments
