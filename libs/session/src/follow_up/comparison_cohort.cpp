// Many pairs of scans together.

#include "follow_up/comparison_parts.h"

#include "ostia/core/csv.h"
#include "ostia/core/text.h"
#include "ostia/core/version.h"
#include "ostia/evaluation/agreement.h"
#include "ostia/evaluation/agreement_plot.h"
#include "ostia/figure/html_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace ostia::session {
namespace {

using analysis::ChangeMeasure;
using analysis::ChangeScope;
using CohortJson = nlohmann::ordered_json;

constexpr std::size_t least_for_share = 10, least_for_statistics = 2;

struct CohortValues {
  std::vector<double> before, after;
};

CohortValues values_of(const std::vector<CohortRow>& rows, ChangeScope scope, ChangeMeasure measure) {
  CohortValues out;
  for (const CohortRow& one : rows)
    if (one.scope == scope && one.measure == measure && one.difference.change()) {
      out.before.push_back(*one.difference.before);
      out.after.push_back(*one.difference.after);
    }
  return out;
}

/// d^2 = sd^2 + share^2 m^2 by least squares, neither below 0.
analysis::DifferenceSpread spread_of(const CohortValues& values) {
  const auto n = static_cast<double>(values.before.size());
  if (values.before.size() < least_for_statistics) return {};
  double d2 = 0.0, m2 = 0.0, m4 = 0.0, d2m2 = 0.0;
  for (std::size_t i = 0; i < values.before.size(); ++i) {
    const double d = values.after[i] - values.before[i], m = 0.5 * (values.after[i] + values.before[i]);
    d2 += d * d / n, m2 += m * m / n, m4 += m * m * m * m / n, d2m2 += d * d * m * m / n;
  }
  const double varies = m4 - m2 * m2;
  if (values.before.size() < least_for_share || !(varies > 1e-12 * m4)) return {std::sqrt(d2), 0.0};
  const double slope = (d2m2 - d2 * m2) / varies;
  if (!(slope > 0.0)) return {std::sqrt(d2), 0.0};
  if (d2 > slope * m2) return {std::sqrt(d2 - slope * m2), std::sqrt(slope)};
  return {0.0, std::sqrt(d2m2 / m4)};
}

void each_measure(const std::function<void(ChangeScope, ChangeMeasure)>& work) {
  for (const ChangeScope scope : analysis::change_scopes)
    for (const ChangeMeasure measure : analysis::change_measures) work(scope, measure);
}

std::size_t pairs_in(const std::vector<CohortRow>& rows) {
  std::set<std::string> names;
  for (const CohortRow& one : rows) names.insert(one.pair);
  return names.size();
}

std::string cohort_from(const std::vector<CohortRow>& rows) {
  return std::to_string(pairs_in(rows)) + " pairs of a cohort, Ostia " + core::version();
}

CohortJson cohort_number(double value) {
  return std::isfinite(value) ? CohortJson(value) : CohortJson(nullptr);
}

}  // namespace

std::vector<CohortRow> cohort_rows(const std::string& pair, const Comparison& made) {
  std::vector<CohortRow> rows;
  const auto add = [&](ChangeScope scope, const std::string& label, const analysis::StretchChange& change) {
    for (const ChangeMeasure measure : analysis::change_measures)
      if (const analysis::Difference& one = analysis::of(change, measure); one.change())
        rows.push_back({pair, scope, label, measure, one});
  };
  for (const analysis::LesionChange& one : made.change.lesions)
    add(ChangeScope::lesion, compared_label(made, one), one.change);
  for (const analysis::PlacedChange& one : made.change.segments)
    add(ChangeScope::segment, one.label, one.change);
  for (const analysis::PlacedChange& one : made.change.vessels)
    add(ChangeScope::vessel, one.label, one.change);
  add(ChangeScope::patient, "patient", made.change.patient);
  return rows;
}

analysis::Repeatability cohort_repeatability(const std::vector<CohortRow>& rows, const std::string& from) {
  analysis::Repeatability table;
  table.from = from;
  each_measure([&](ChangeScope scope, ChangeMeasure measure) {
    table.of(scope, measure) = spread_of(values_of(rows, scope, measure));
  });
  return table;
}

std::string cohort_json(const std::vector<CohortRow>& rows, const std::vector<std::string>& warnings) {
  CohortJson agreement = CohortJson::array();
  each_measure([&](ChangeScope scope, ChangeMeasure measure) {
    const CohortValues values = values_of(rows, scope, measure);
    if (values.before.size() < least_for_statistics) return;
    const evaluation::BlandAltman one = evaluation::bland_altman(values.before, values.after);
    std::size_t changed = 0;
    for (const CohortRow& row : rows)
      if (row.scope == scope && row.measure == measure &&
          (row.difference.verdict() == analysis::ChangeVerdict::less ||
           row.difference.verdict() == analysis::ChangeVerdict::more))
        ++changed;
    agreement.push_back({{"scope", analysis::key_of(scope)},
                         {"measure", analysis::key_of(measure)},
                         {"count", one.count},
                         {"bias", one.bias},
                         {"sd", one.sd},
                         {"lower_limit", one.lower_limit},
                         {"upper_limit", one.upper_limit},
                         {"bias_interval", {one.bias_interval[0], one.bias_interval[1]}},
                         {"correlation", cohort_number(one.correlation)},
                         {"changed", changed}});
  });
  const CohortJson out{
      {"v", 1},
      {"kind", "comparison cohort"},
      {"pairs", pairs_in(rows)},
      {"agreement", agreement},
      {"repeatability", CohortJson::parse(repeatability_json(cohort_repeatability(rows, cohort_from(rows))))},
      {"warnings", warnings}};
  return out.dump(2) + "\n";
}

std::string cohort_csv(const std::vector<CohortRow>& rows) {
  std::string out = core::csv_line(
      {"pair", "scope", "label", "measure", "before", "after", "change", "smallest_real", "verdict"});
  for (const CohortRow& one : rows) {
    std::vector<std::string> cells{one.pair, analysis::key_of(one.scope), one.label,
                                   analysis::key_of(one.measure)};
    const std::vector<std::string> values = difference_cells(one.difference);
    cells.insert(cells.end(), values.begin(), values.end());
    out += core::csv_line(cells);
  }
  return out;
}

std::string cohort_html(const std::vector<CohortRow>& rows, const std::vector<std::string>& warnings) {
  figure::HtmlReport page("Pairs of scans compared", std::to_string(pairs_in(rows)) + " pairs");
  for (const std::string& warning : warnings) page.notice(figure::Notice::warning, warning);
  std::vector<std::vector<std::string>> table;
  each_measure([&](ChangeScope scope, ChangeMeasure measure) {
    const CohortValues values = values_of(rows, scope, measure);
    if (values.before.size() < least_for_statistics) return;
    const evaluation::BlandAltman one = evaluation::bland_altman(values.before, values.after);
    table.push_back({analysis::key_of(scope), analysis::title_of(measure), std::to_string(one.count),
                     core::signed_text(one.bias, 2), core::fixed_text(one.sd, 2),
                     core::signed_text(one.lower_limit, 2), core::signed_text(one.upper_limit, 2)});
  });
  page.section("Agreement");
  page.table({"of", "measure", "values", "bias", "sd", "lower limit", "upper limit"}, table,
             "Differences, later - former (Bland and Altman); limits are bias -+ 1.96 sd");
  for (const ChangeMeasure measure :
       {ChangeMeasure::least_area, ChangeMeasure::plaque, ChangeMeasure::calcified}) {
    const CohortValues values = values_of(rows, ChangeScope::lesion, measure);
    if (values.before.size() < least_for_statistics) continue;
    page.picture(evaluation::agreement_plot(values.before, values.after,
                                            {.title = "lesions: " + analysis::title_of(measure), .unit = ""}),
                 "Lesions, " + analysis::title_of(measure));
  }
  return page.html();
}

}  // namespace ostia::session
