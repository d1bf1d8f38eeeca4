#include "ostia/experiments/extraction_report.h"

#include "extraction/extraction_tables.h"

#include "ostia/core/files.h"
#include "ostia/evaluation/agreement_plot.h"
#include "ostia/figure/html_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

Json json_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_of(const evaluation::MeanCenterlineScores& mean) {
  return {{"vessels", mean.vessels}, {"missing", mean.missed},     {"ov", mean.ov},
          {"of", mean.of},           {"ot", json_number(mean.ot)}, {"ai_mm", json_number(mean.ai_mm)}};
}

Json json_of(const evaluation::LumenSummary& s) {
  return {{"sections", s.sections},
          {"missing", s.missing},
          {"length_mm", s.length_mm},
          {"dice", s.dice},
          {"msd_mm", json_number(s.msd_mm)},
          {"rms_sd_mm", json_number(s.rms_sd_mm)},
          {"max_sd_mm", json_number(s.max_sd_mm)}};
}

Json json_of(const ExtractionSummary& s) {
  const evaluation::LesionDetection& d = s.stenoses;
  return {{"annotated", json_of(s.annotated)},
          {"all", json_of(s.all)},
          {"names", {{"right", s.right}, {"wrong", s.wrong}, {"unnamed", s.unnamed}, {"missing", s.missing}}},
          {"found_mm", s.found_mm},
          {"astray_mm", s.astray_mm},
          {"healthy", json_of(s.healthy)},
          {"diseased", json_of(s.diseased)},
          {"stenoses",
           {{"true_positive", d.all.true_positive},
            {"false_negative", d.all.false_negative},
            {"false_positive", d.all.false_positive},
            {"sensitivity", json_number(d.all.sensitivity())},
            {"ppv", json_number(d.all.ppv())},
            {"mean_grade_difference", json_number(d.mean_grade_difference)},
            {"weighted_kappa", json_number(d.weighted_kappa)}}},
          {"most_seconds", s.most_seconds},
          {"most_mb", s.most_mb}};
}

/// Each row an object of texts; numbers where they are.
Json json_of(const Table& table) {
  Json rows = Json::array();
  for (const std::vector<std::string>& cells : table.rows) {
    Json row;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Json value = Json::parse(cells[i], nullptr, false);
      row[table.header[i]] = value.is_number() ? value : Json(cells[i]);
    }
    rows.push_back(row);
  }
  return rows;
}

std::string csv_of(const Table& table) {
  std::string text;
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      text += (i > 0 ? "," : "") +
              (cells[i].find_first_of(",;\"") != std::string::npos ? "\"" + cells[i] + "\"" : cells[i]);
    text += "\n";
  };
  line(table.header);
  for (const std::vector<std::string>& row : table.rows) line(row);
  return text;
}

/// Diameters of equal area, contour by contour; reference, then result.
std::pair<std::vector<double>, std::vector<double>> diameters(const std::vector<ExtractionRun>& runs) {
  std::pair<std::vector<double>, std::vector<double>> pairs;
  for (const ExtractionRun& run : runs)
    for (const evaluation::SectionScore& score : run.sections) {
      if (!score.found) continue;
      for (const double r : score.reference_radius_mm) pairs.first.push_back(2.0 * r);
      for (const double r : score.result_radius_mm) pairs.second.push_back(2.0 * r);
    }
  return pairs;
}

}  // namespace

std::string parameters_json(const ExtractionScoreOptions& options) {
  return Json{{"astray_mm", options.astray_mm}, {"threshold", options.threshold}}.dump();
}

std::string extraction_json(const std::vector<ExtractionRun>& runs, const ExtractionScoreOptions& options) {
  Json out{{"v", 1}, {"kind", "extraction experiment"}};
  out["parameters"] = Json::parse(parameters_json(options));
  out["summary"] = json_of(summarize(runs, options));
  out["worst"] = worst_of(runs, options);
  out["cases"] = Json::array();
  for (const ExtractionRun& run : runs) {
    Json row = json_of(summarize({run}, options));
    row["case"] = run.case_name;
    row["failure"] = run.failure;
    row["longest_astray_mm"] = run.longest_astray_mm;
    out["cases"].push_back(row);
  }
  out["vessels"] = json_of(vessel_table(runs));
  out["sections"] = json_of(section_table(runs));
  out["stenoses"] = json_of(stenosis_table(runs, options));
  return out.dump(1) + "\n";
}

std::string extraction_text(const std::vector<ExtractionRun>& runs, const ExtractionScoreOptions& options) {
  const Table table = case_table(runs, options);
  std::vector<std::size_t> width(table.header.size());
  const auto widen = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) width[i] = std::max(width[i], cells[i].size());
  };
  widen(table.header);
  for (const std::vector<std::string>& row : table.rows) widen(row);
  std::string text;
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      text += "| " + cells[i] + std::string(width[i] - cells[i].size() + 1, ' ');
    text += "|\n";
  };
  line(table.header);
  for (const std::vector<std::string>& row : table.rows) line(row);
  for (const std::string& one : worst_of(runs, options)) text += one + "\n";
  return text;
}

void write_extraction_report(const fs::path& folder, const std::vector<ExtractionRun>& runs,
                             const ExtractionScoreOptions& options) {
  const Table cases = case_table(runs, options), vessels = vessel_table(runs);
  const Table sections = section_table(runs), stenoses = stenosis_table(runs, options);
  core::write_file(folder / "cases.csv", csv_of(cases));
  core::write_file(folder / "vessels.csv", csv_of(vessels));
  core::write_file(folder / "sections.csv", csv_of(sections));
  core::write_file(folder / "stenoses.csv", csv_of(stenoses));
  figure::HtmlReport page("The coronary tree found without a click", std::to_string(runs.size()) + " cases");
  page.section("Case by case");
  page.table(cases.header, cases.rows,
             "OV, OF, OT, AI: means over the challenge's four vessels of each case; OV, all: over every true "
             "vessel; astray: length of the found tree that lies outside of every true lumen; stenoses of " +
                 std::to_string(std::lround(100.0 * options.threshold)) +
                 " % and more; s and GB: of finding the model.");
  page.subsection("Worst");
  for (const std::string& one : worst_of(runs, options)) page.paragraph(one);
  const auto [reference, result] = diameters(runs);
  if (reference.size() >= 2) {
    const figure::Picture plot =
        evaluation::agreement_plot(reference, result, {.title = "Diameters: found against true"});
    plot.write_png(folder / "diameters.png", 2.0);
    page.section("Agreement of diameters");
    page.picture(plot, "Bland-Altman plot of the diameters of equal area in the annotated sections.");
  }
  page.section("Stenoses");
  page.table(stenoses.header, stenoses.rows);
  page.section("Sections");
  page.table(sections.header, sections.rows);
  page.section("Vessels");
  page.table(vessels.header, vessels.rows);
  page.write(folder / "report.html");
}

}  // namespace ostia::experiments
