#include "ostia/core/csv.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/experiments/hard.h"
#include "ostia/figure/html_report.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using core::fixed_or_dash;
using HardJson = nlohmann::ordered_json;

constexpr std::array hard_methods{HardMethod::path, HardMethod::growing, HardMethod::search};

/// Whether a method was run at all.
bool was_run(const HardRun& run, HardMethod method) {
  return !run_of(run, method).vessels.empty();
}

struct HardTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

std::string hearts_word(bool patients) {
  return patients ? "patients'" : "drawn";
}

std::string rate(double value) {
  return std::isnan(value) ? "-" : fixed_or_dash(100.0 * value, 0) + " %";
}

std::vector<std::string> score_cells(const evaluation::MeanCenterlineScores& mean) {
  return {fixed_or_dash(mean.ov, 3), fixed_or_dash(mean.of, 3), fixed_or_dash(mean.ot, 3),
          fixed_or_dash(mean.ai_mm, 3)};
}

/// Axes: what the challenge measures, beside what is published.
HardTable axes_table(const std::vector<HardRow>& rows) {
  HardTable table;
  table.header = {"suite",   "hearts",  "method",  "cases",      "refused",
                  "OV",      "OF",      "OT",      "AI, mm",     "published OV / OF / OT / AI",
                  "OV, all", "OF, all", "OT, all", "AI, all, mm"};
  for (const HardRow& row : rows) {
    const PublishedScore real = published(row.method);
    std::vector<std::string> cells{word(row.suite), hearts_word(row.patients), word(row.method),
                                   std::to_string(row.cases), std::to_string(row.refused)};
    const auto append = [&](const std::vector<std::string>& more) {
      cells.insert(cells.end(), more.begin(), more.end());
    };
    append(score_cells(row.summary.annotated));
    cells.push_back(fixed_or_dash(real.ov, 3) + " / " + fixed_or_dash(real.of, 3) + " / " +
                    fixed_or_dash(real.ot, 3) + " / " + fixed_or_dash(real.ai_mm, 2));
    append(score_cells(row.summary.all));
    table.rows.push_back(cells);
  }
  return table;
}

/// What the search alone gives.
HardTable lumen_table(const std::vector<HardRow>& rows) {
  HardTable table;
  table.header = {"suite",
                  "hearts",
                  "astray, mm a patient",
                  "names right / wrong / none",
                  "healthy Dice",
                  "MSD, mm",
                  "diseased Dice",
                  "MSD, mm",
                  "stenoses found / missed / false",
                  "sensitivity",
                  "PPV"};
  for (const HardRow& row : rows) {
    if (row.method != HardMethod::search) continue;
    const ExtractionSummary& s = row.summary;
    const evaluation::LesionCounts& lesions = s.stenoses.all;
    table.rows.push_back({word(row.suite), hearts_word(row.patients),
                          fixed_or_dash(s.astray_mm / static_cast<double>(row.cases), 1),
                          std::to_string(s.right) + " / " + std::to_string(s.wrong) + " / " +
                              std::to_string(s.unnamed + s.missing),
                          fixed_or_dash(s.healthy.dice, 3), fixed_or_dash(s.healthy.msd_mm, 3),
                          fixed_or_dash(s.diseased.dice, 3), fixed_or_dash(s.diseased.msd_mm, 3),
                          std::to_string(lesions.true_positive) + " / " +
                              std::to_string(lesions.false_negative) + " / " +
                              std::to_string(lesions.false_positive),
                          rate(lesions.sensitivity()), rate(lesions.ppv())});
  }
  return table;
}

/// What was drawn, and how each method did with it.
HardTable cases_table(const std::vector<HardRun>& runs, const ExtractionScoreOptions& options) {
  HardTable table;
  table.header = {"suite", "hearts", "seed", "anatomy"};
  for (const phantom::HardQuantity& one : phantom::hard_quantities())
    table.header.push_back(one.unit.empty() ? one.name : one.name + ", " + one.unit);
  for (const HardMethod method : hard_methods)
    for (const char* what : {"OV", "OF", "OT", "AI, mm"})
      table.header.push_back(std::string(word(method)) + ": " + what);
  table.header.insert(table.header.end(), {"astray, mm", "refused because"});
  for (const HardRun& run : runs) {
    std::vector<std::string> cells{word(run.suite), run.patient.empty() ? "drawn" : run.patient,
                                   std::to_string(run.seed)};
    const bool hard = run.suite == HardSuite::hard;
    cells.push_back(hard && run.patient.empty() ? phantom::word(run.draw.anatomy) : "usual");
    for (const double value : phantom::values_of(run.draw))
      cells.push_back(hard ? fixed_or_dash(value, 3) : "-");
    for (const HardMethod method : hard_methods)
      for (const std::string& cell : score_cells(summarize({run_of(run, method)}, options).annotated))
        cells.push_back(was_run(run, method) ? cell : "-");
    cells.insert(cells.end(), {fixed_or_dash(run.search.astray_mm, 1), run.search.failure});
    table.rows.push_back(cells);
  }
  return table;
}

HardTable vessels_table(const std::vector<HardRun>& runs) {
  HardTable table;
  table.header = {"suite", "hearts", "seed", "method", "vessel", "annotated", "length_mm",
                  "ov",    "of",     "ot",   "ai_mm",  "named",  "found_as"};
  for (const HardRun& run : runs)
    for (const HardMethod method : hard_methods)
      for (const VesselRun& one : run_of(run, method).vessels) {
        const bool named = method == HardMethod::search;
        table.rows.push_back({word(run.suite), run.patient.empty() ? "drawn" : run.patient,
                              std::to_string(run.seed), word(method), one.name, one.annotated ? "yes" : "no",
                              fixed_or_dash(one.length_mm, 1), fixed_or_dash(one.scores.ov, 4),
                              fixed_or_dash(one.scores.of, 4), fixed_or_dash(one.scores.ot, 4),
                              fixed_or_dash(one.scores.ai_mm, 4), named ? name_of(one.verdict) : "",
                              named ? one.found_name : ""});
      }
  return table;
}

/// How the suite is drawn.
HardTable quantities_table() {
  HardTable table;
  table.header = {"quantity", "unit",  "share of cases", "else", "spread",
                  "middle",   "width", "least",          "most", "usual"};
  for (const phantom::HardQuantity& one : phantom::hard_quantities()) {
    const bool even = one.spread == phantom::Spread::uniform;
    table.rows.push_back({one.name, one.unit, core::trimmed_text(one.share, 3),
                          one.share < 1.0 ? core::trimmed_text(one.without, 3) : "-",
                          phantom::word(one.spread), even ? "-" : core::trimmed_text(one.middle, 3),
                          even ? "-" : core::trimmed_text(one.width, 3), core::trimmed_text(one.least, 3),
                          core::trimmed_text(one.most, 3), one.reason});
  }
  return table;
}

std::string csv_text(const HardTable& table) {
  std::string text = core::csv_line(table.header);
  for (const std::vector<std::string>& row : table.rows) text += core::csv_line(row);
  return text;
}

std::string plain_text(const HardTable& table) {
  std::string text;
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) text += (i == 0 ? "" : " | ") + cells[i];
    text += "\n";
  };
  line(table.header);
  for (const std::vector<std::string>& row : table.rows) line(row);
  return text;
}

HardJson number_or_null(double value) {
  return std::isfinite(value) ? HardJson(value) : HardJson(nullptr);
}

HardJson axes_json(const evaluation::MeanCenterlineScores& mean) {
  return {{"vessels", mean.vessels}, {"missing", mean.missed},        {"ov", mean.ov},
          {"of", mean.of},           {"ot", number_or_null(mean.ot)}, {"ai_mm", number_or_null(mean.ai_mm)}};
}

HardJson lumen_json(const evaluation::LumenSummary& s) {
  return {{"sections", s.sections},
          {"missing", s.missing},
          {"dice", s.dice},
          {"msd_mm", number_or_null(s.msd_mm)}};
}

HardJson row_json(const HardRow& row) {
  const ExtractionSummary& s = row.summary;
  const PublishedScore real = published(row.method);
  HardJson out{{"suite", word(row.suite)},
               {"hearts", row.patients ? "patients" : "drawn"},
               {"method", word(row.method)},
               {"cases", row.cases},
               {"refused", row.refused},
               {"annotated", axes_json(s.annotated)},
               {"all", axes_json(s.all)},
               {"published",
                {{"ov", real.ov},
                 {"of", number_or_null(real.of)},
                 {"ot", number_or_null(real.ot)},
                 {"ai_mm", real.ai_mm}}}};
  if (row.method != HardMethod::search) return out;
  out["astray_mm_a_patient"] = s.astray_mm / static_cast<double>(row.cases);
  out["names"] = {{"right", s.right}, {"wrong", s.wrong}, {"unnamed", s.unnamed}, {"missing", s.missing}};
  out["healthy"] = lumen_json(s.healthy);
  out["diseased"] = lumen_json(s.diseased);
  out["stenoses"] = {{"true_positive", s.stenoses.all.true_positive},
                     {"false_negative", s.stenoses.all.false_negative},
                     {"false_positive", s.stenoses.all.false_positive},
                     {"sensitivity", number_or_null(s.stenoses.all.sensitivity())},
                     {"ppv", number_or_null(s.stenoses.all.ppv())}};
  return out;
}

HardJson case_json_of(const HardRun& run, const ExtractionScoreOptions& options) {
  HardJson out{{"suite", word(run.suite)},      {"hearts", run.patient.empty() ? "drawn" : "patients"},
               {"patient", run.patient},        {"seed", run.seed},
               {"refused", run.search.failure}, {"astray_mm", run.search.astray_mm},
               {"told", run.warnings}};
  HardJson drawn = HardJson::object();
  if (run.suite == HardSuite::hard) {
    const std::vector<phantom::HardQuantity> quantities = phantom::hard_quantities();
    const std::vector<double> values = phantom::values_of(run.draw);
    for (std::size_t i = 0; i < values.size(); ++i) drawn[quantities[i].name] = values[i];
    drawn["anatomy"] = run.patient.empty() ? phantom::word(run.draw.anatomy) : "usual";
  }
  out["drawn"] = drawn;
  for (const HardMethod method : hard_methods)
    if (was_run(run, method))
      out[word(method)] = axes_json(summarize({run_of(run, method)}, options).annotated);
  return out;
}

}  // namespace

PublishedScore published(HardMethod method) {
  switch (method) {
    case HardMethod::path:
      return {0.919, 0.564, 0.925, 0.46,
              "Metz et al., two points and a minimum cost path, in Schaap et al. 2009"};
    case HardMethod::growing:
      return {0.788, 0.644, 0.812, 0.29,
              "Kitslaar et al., connected components and morphology, in Schaap et al. 2009"};
    case HardMethod::search:
      break;
  }
  return {0.937, NAN, NAN, 0.30, "Yang et al. 2012, automatic"};
}

std::vector<HardRow> rows_of(const std::vector<HardRun>& runs, const ExtractionScoreOptions& options) {
  std::vector<HardRow> rows;
  for (const HardSuite suite : {HardSuite::full, HardSuite::hard})
    for (const bool patients : {false, true})
      for (const HardMethod method : hard_methods) {
        std::vector<ExtractionRun> these;
        HardRow row{suite, patients, method, 0, 0, {}};
        for (const HardRun& run : runs) {
          if (run.suite != suite || run.patient.empty() == patients || !was_run(run, method)) continue;
          these.push_back(run_of(run, method));
          these.back().case_name += run.patient;
          row.refused += these.back().failure.empty() ? 0 : 1;
        }
        row.cases = these.size();
        if (these.empty()) continue;
        row.summary = summarize(these, options);
        rows.push_back(std::move(row));
      }
  return rows;
}

std::string parameters_json(const HardOptions& options) {
  const phantom::HardStrength& s = options.strength;
  return HardJson{{"first_seed", options.first_seed},
                  {"cases", options.cases},
                  {"easy", options.easy},
                  {"search", options.search},
                  {"voxel_mm", options.voxel_mm},
                  {"strength",
                   {{"noise", s.noise},
                    {"blur", s.blur},
                    {"motion", s.motion},
                    {"venous", s.venous},
                    {"contact", s.contact},
                    {"calcium", s.calcium},
                    {"fall", s.fall},
                    {"closed", s.closed}}},
                  {"astray_mm", options.scores.astray_mm},
                  {"threshold", options.scores.threshold}}
      .dump();
}

std::string hard_json(const std::vector<HardRun>& runs, const HardOptions& options) {
  HardJson out{{"v", 1}, {"kind", "hard"}};
  out["parameters"] = HardJson::parse(parameters_json(options));
  out["rows"] = HardJson::array();
  for (const HardRow& row : rows_of(runs, options.scores)) out["rows"].push_back(row_json(row));
  out["cases"] = HardJson::array();
  for (const HardRun& run : runs) out["cases"].push_back(case_json_of(run, options.scores));
  return out.dump(1) + "\n";
}

std::string hard_text(const std::vector<HardRun>& runs, const HardOptions& options) {
  const std::vector<HardRow> rows = rows_of(runs, options.scores);
  return plain_text(axes_table(rows)) + (options.search ? plain_text(lumen_table(rows)) : "");
}

void write_hard_report(const fs::path& folder, const std::vector<HardRun>& runs, const HardOptions& options) {
  const std::vector<HardRow> rows = rows_of(runs, options.scores);
  const HardTable axes = axes_table(rows), lumen = lumen_table(rows), quantities = quantities_table();
  const HardTable cases = cases_table(runs, options.scores);
  core::write_file(folder / "cases.csv", csv_text(cases));
  core::write_file(folder / "vessels.csv", csv_text(vessels_table(runs)));
  figure::HtmlReport page("How hard the suites are", std::to_string(runs.size()) + " cases");
  page.section("Axes");
  page.table(
      axes.header, axes.rows,
      "OV to AI: means over the challenge's four vessels of each case, beside what is published on real "
      "scans; all: every vessel that is 1.5 mm wide where it begins.");
  for (const HardMethod method : hard_methods)
    page.paragraph(std::string("Published, ") + word(method) + ": " + published(method).method + ".");
  if (!lumen.rows.empty()) {
    page.section("The search without a click");
    page.table(lumen.header, lumen.rows);
  }
  page.section("How the suite hard is drawn");
  page.table(quantities.header, quantities.rows);
  page.section("Case by case");
  page.table(cases.header, cases.rows);
  page.write(folder / "report.html");
}

}  // namespace ostia::experiments
