#include "pressure/pressure_compare.h"

#include "ostia/core/csv.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/evaluation/agreement_plot.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/plot.h"

#include <algorithm>
#include <cmath>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using core::fixed_text;
using Cells = std::vector<std::string>;

constexpr std::size_t worst_shown = 6;

double severest(const PressureCase& one) {
  double most = 0.0;
  for (const PlannedStenosis& s : one.stenoses) most = std::max(most, s.severity);
  return most;
}

/// One line a place of reading; one without where there is no result.
std::vector<Cells> case_cells(const PressureRow& row) {
  const PressureCase& one = row.planned;
  const auto line = [&](const PressureReading* reading) {
    const auto number = [&](double value, int decimals) {
      return reading ? fixed_text(value, decimals) : std::string("-");
    };
    return Cells{one.id,
                 one.medina,
                 std::string(name_of(half_of(one))),
                 std::to_string(one.seed),
                 one.stenoses.empty() ? "-" : fixed_text(100.0 * severest(one), 0),
                 fixed_text(one.reynolds, 0),
                 fixed_text(one.flow_ml_s, 2),
                 reading ? reading->vessel : "-",
                 number(reading ? reading->ffr_1d : 0.0, 3),
                 number(reading ? reading->ffr_3d : 0.0, 3),
                 reading ? core::signed_text(reading->difference(), 3) : "-",
                 reading && reading->exact ? fixed_text(*reading->exact, 3) : "-",
                 number(reading ? reading->fitted : 0.0, 3),
                 row.failure.empty() ? fixed_text(row.rms_mmhg, 2) : "-",
                 std::to_string(row.run.cells),
                 fixed_text(row.run.seconds, 0),
                 !row.failure.empty() ? row.failure
                 : row.run.converged  ? ""
                                      : "not converged"};
  };
  std::vector<Cells> lines;
  for (const PressureReading& reading : row.readings) lines.push_back(line(&reading));
  if (lines.empty()) lines.push_back(line(nullptr));
  return lines;
}

/// The same for a page of the documentation, in fewer columns.
Cells short_cells(const PressureRow& row, const PressureReading* reading) {
  const PressureCase& one = row.planned;
  const bool first = !reading || reading == row.readings.data();
  const std::string vessel = row.readings.size() > 1 && reading ? ", " + reading->vessel : "";
  return {one.id + (one.medina.empty() ? "" : " (" + one.medina + ")") + vessel,
          one.kind == PressureKind::tube ? "" : std::string(name_of(half_of(one))),
          one.stenoses.empty() ? "none" : fixed_text(100.0 * severest(one), 0) + " %",
          fixed_text(one.reynolds, 0),
          reading ? fixed_text(reading->ffr_1d, 3) : "-",
          reading ? fixed_text(reading->ffr_3d, 3) : "-",
          reading ? core::signed_text(reading->difference(), 3) : "-",
          first && row.failure.empty() ? fixed_text(row.rms_mmhg, 2) : "",
          first ? std::to_string(row.run.cells) : "",
          first ? fixed_text(row.run.iterations, 0) : "",
          !row.failure.empty() ? row.failure
          : row.run.converged  ? ""
                               : "not converged"};
}

std::string markdown_table(const Cells& header, const std::vector<Cells>& lines) {
  std::string text;
  const auto line = [&](const Cells& cells) {
    text += "|";
    for (const std::string& cell : cells) text += " " + cell + (cell.empty() ? "|" : " |");
    text += "\n";
  };
  line(header);
  line(Cells(header.size(), "---"));
  for (const Cells& cells : lines) line(cells);
  return text + "\n";
}

const Cells case_header{"case",
                        "Medina",
                        "half",
                        "seed",
                        "diameter lost, %",
                        "Re",
                        "ml/s",
                        "vessel",
                        "FFR 1D",
                        "FFR 3D",
                        "1D - 3D",
                        "FFR 1D, exact sections",
                        "FFR 1D, fitted",
                        "RMS, mmHg",
                        "cells",
                        "seconds",
                        "note"};

std::string curves_csv(const PressureResults& results) {
  std::string text = core::csv_line({"case", "vessel", "s_mm", "diameter_mm", "mmhg_1d", "mmhg_3d"});
  for (const PressureRow& row : results.rows)
    for (const PressureCurve& curve : row.curves)
      for (std::size_t i = 0; i < curve.s_mm.size(); ++i)
        text += core::csv_line({row.planned.id, curve.vessel, fixed_text(curve.s_mm[i], 3),
                                fixed_text(curve.diameter_mm[i], 4), fixed_text(curve.mmhg_1d[i], 4),
                                fixed_text(curve.mmhg_3d[i], 4)});
  return text;
}

/// Pressure along all vessels of a case.
figure::Picture curves_plot(const PressureRow& row) {
  std::vector<figure::Series> series;
  std::size_t color = 0;
  for (const PressureCurve& curve : row.curves) {
    figure::Series three{curve.vessel + ", 3D", curve.s_mm, curve.mmhg_3d, figure::palette(color)};
    figure::Series one{curve.vessel + ", 1D", curve.s_mm, curve.mmhg_1d, figure::palette(color),
                       figure::LineStyle::dashed};
    series.push_back(std::move(three));
    series.push_back(std::move(one));
    ++color;
  }
  figure::PlotOptions how;
  how.title = row.planned.id + (row.planned.medina.empty() ? "" : " (Medina " + row.planned.medina + ")");
  how.x_label = "along the vessel (mm)";
  how.y_label = "pressure above the root's (mmHg)";
  return figure::line_plot(series, how);
}

double worst_of(const PressureRow& row) {
  double most = 0.0;
  for (const PressureReading& one : row.readings) most = std::max(most, std::abs(one.difference()));
  return most;
}

std::vector<const PressureRow*> worst_rows(const PressureResults& results) {
  std::vector<const PressureRow*> rows;
  for (const PressureRow& row : results.rows)
    if (counts(row) && !row.curves.empty()) rows.push_back(&row);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const PressureRow* a, const PressureRow* b) { return worst_of(*a) > worst_of(*b); });
  if (rows.size() > worst_shown) rows.resize(worst_shown);
  return rows;
}

std::vector<Cells> summary_cells(const PressureResults& results) {
  std::vector<Cells> lines;
  const auto add = [&](const std::string& name, PressureHalf half, bool fitted) {
    const PressureSummary s = summarize(results, half, fitted);
    if (s.readings == 0) return;
    lines.push_back({name, std::to_string(s.cases), std::to_string(s.readings), core::signed_text(s.bias, 4),
                     fixed_text(s.sd, 4), fixed_text(100.0 * s.alike, 1), core::signed_text(s.worst, 3),
                     s.worst_id, fitted ? "-" : fixed_text(s.rms_mmhg, 2),
                     fitted ? "-" : fixed_text(s.worst_rms_mmhg, 2)});
  };
  add("fitting half", PressureHalf::fitting, false);
  add("judging half", PressureHalf::judging, false);
  add("patients", PressureHalf::patients, false);
  if (results.fit) {
    add("fitting half, fitted", PressureHalf::fitting, true);
    add("judging half, fitted", PressureHalf::judging, true);
    add("patients, fitted", PressureHalf::patients, true);
  }
  return lines;
}

const Cells summary_header{"",      "cases", "readings",        "bias",           "SD", "alike at 0.80, %",
                           "worst", "case",  "RMS along, mmHg", "worst RMS, mmHg"};

const Cells mesh_header{"case",       "edge over radius",  "cells", "fall of pressure, mmHg",
                        "order seen", "extrapolated, mmHg"};

std::vector<Cells> mesh_cells(const PressureResults& results) {
  std::vector<Cells> lines;
  for (const ConvergenceRow& row : results.convergence)
    for (std::size_t i = 0; i < row.drops_mmhg.size(); ++i)
      lines.push_back({row.id, fixed_text(row.edge_ratios[i], 3), std::to_string(row.cells[i]),
                       fixed_text(row.drops_mmhg[i], 3), core::shown_text(row.order, 2),
                       core::shown_text(row.richardson_mmhg, 3)});
  return lines;
}

void add_meshes(figure::HtmlReport& page, const PressureResults& results) {
  if (const auto error = poiseuille_error(results))
    page.paragraph("Poiseuille's tube on this mesh: pressure falls by " +
                   core::signed_text(100.0 * *error, 2) + " % against theory for its circle.");
  if (results.convergence.empty()) return;
  page.table(mesh_header, mesh_cells(results), "Order and extrapolation only where the three fall in line.");
}

std::string tables_md(const PressureResults& results) {
  std::vector<Cells> cases;
  for (const PressureRow& row : results.rows) {
    for (const PressureReading& reading : row.readings) cases.push_back(short_cells(row, &reading));
    if (row.readings.empty()) cases.push_back(short_cells(row, nullptr));
  }
  return markdown_table(summary_header, summary_cells(results)) +
         (results.convergence.empty() ? "" : markdown_table(mesh_header, mesh_cells(results))) +
         markdown_table({"case", "half", "diameter lost", "Reynolds at the throat", "FFR 1D", "FFR 3D",
                         "1D - 3D", "RMS along, mmHg", "cells", "iterations", "note"},
                        cases);
}

void add_agreement(figure::HtmlReport& page, const PressureResults& results, const fs::path& folder) {
  std::vector<double> reference, result;
  for (const PressureRow& row : results.rows) {
    if (!counts(row)) continue;
    for (const PressureReading& one : row.readings) {
      reference.push_back(one.ffr_3d);
      result.push_back(one.ffr_1d);
    }
  }
  if (reference.size() < 2) return;
  const figure::Picture plot =
      evaluation::agreement_plot(reference, result, {"FFR in one and three dimensions", "FFR"});
  plot.write_png(folder / "agreement.png", 2.0);
  page.picture(plot, "All cases that converged: 1D less 3D against their mean (Bland and Altman).");
}

void add_worst(figure::HtmlReport& page, const PressureResults& results, const PressureOptions& options,
               const fs::path& folder) {
  const std::vector<const PressureRow*> worst = worst_rows(results);
  if (worst.empty()) return;
  page.section("Worst cases");
  for (const PressureRow* row : worst) {
    const figure::Picture plot = curves_plot(*row);
    plot.write_png(folder / ("worst-" + row->planned.id + ".png"), 2.0);
    const fs::path speed = options.keep / row->planned.id / "speed.png";
    const std::string copy = "worst-" + row->planned.id + "-speed.png";
    std::error_code ignored;
    const bool pictured = fs::exists(speed, ignored);
    if (pictured) core::write_file(folder / copy, core::read_file(speed));
    page.picture(plot, row->planned.id + ": FFR 1D less 3D is off by " + fixed_text(worst_of(*row), 3) +
                           " at most; RMS along the vessels " + fixed_text(row->rms_mmhg, 2) + " mmHg." +
                           (pictured ? " The speed of the blood: " + copy + "." : ""));
  }
}

}  // namespace

std::string pressure_text(const PressureResults& results) {
  std::string text = std::to_string(results.rows.size()) + " of " + std::to_string(results.planned) +
                     " cases have been run\n";
  const auto line = [&](const Cells& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) text += (i == 0 ? "" : " | ") + cells[i];
    text += "\n";
  };
  line(summary_header);
  for (const Cells& cells : summary_cells(results)) line(cells);
  if (results.fit)
    text += "fitted: development " + core::significant_text(results.fit->development, 3) +
            ", layer friction " + core::significant_text(results.fit->layer_friction, 3) + "\n";
  if (const auto error = poiseuille_error(results))
    text += "Poiseuille's tube: " + core::signed_text(100.0 * *error, 2) + " %\n";
  return text;
}

void write_pressure_report(const fs::path& folder, const PressureResults& results,
                           const PressureOptions& options) {
  std::string cases = core::csv_line(case_header);
  std::vector<Cells> lines;
  for (const PressureRow& row : results.rows)
    for (const Cells& cells : case_cells(row)) {
      cases += core::csv_line(cells);
      lines.push_back(cells);
    }
  core::write_file(folder / "cases.csv", cases);
  core::write_file(folder / "curves.csv", curves_csv(results));
  core::write_file(folder / "tables.md", tables_md(results));
  figure::HtmlReport page("Pressure in one and in three dimensions",
                          std::to_string(results.rows.size()) + " of " + std::to_string(results.planned) +
                              " cases have been run");
  page.notice(figure::Notice::note,
              "Research software: how far a computation in one dimension is from one in three, not how far "
              "either is from a patient.");
  page.paragraph("FFR is 1 plus the pressure that is lost, over a mean aortic pressure of " +
                 fixed_text(results.aortic_mmhg, 0) +
                 " mmHg, at the same flows in both. Figures are of the runs that converged.");
  page.section("Together");
  page.table(summary_header, summary_cells(results));
  if (results.fit)
    page.paragraph("Fitted to the fitting half: development " +
                   core::significant_text(results.fit->development, 3) + ", layer friction " +
                   core::significant_text(results.fit->layer_friction, 3) + "; its RMS of FFR went from " +
                   fixed_text(results.fit->rms_before, 4) + " to " + fixed_text(results.fit->rms_after, 4) +
                   ".");
  add_agreement(page, results, folder);
  page.section("Meshes");
  add_meshes(page, results);
  add_worst(page, results, options, folder);
  page.section("All cases");
  page.table(case_header, lines);
  page.write(folder / "report.html");
}

}  // namespace ostia::experiments
