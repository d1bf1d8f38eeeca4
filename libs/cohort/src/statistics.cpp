#include "ostia/cohort/statistics.h"

#include "reference_values.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/evaluation/agreement_plot.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/plot.h"
#include "ostia/pipeline/manifest.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

constexpr const char* measures_of_outcomes[] = {"diameter_percent", "least_area_mm2", "plaque_mm3", "ffr"};
constexpr const char* of_a_scan = "scan";

using Key = std::tuple<std::string, std::string, std::string, std::string>;  ///< scan, level, item, measure
using ValuesByKey = std::map<Key, double>;

Key key_of(const TidyValue& value) {
  return {value.scan, value.level, value.item, value.measure};
}

/// With each scan's worst value of each measure, as level "scan".
ValuesByKey with_worst(const std::vector<TidyValue>& values) {
  ValuesByKey out;
  for (const TidyValue& one : values) {
    out[key_of(one)] = one.value;
    if (one.level == of_a_scan) continue;
    const auto [at, is_first] = out.try_emplace({one.scan, of_a_scan, "", one.measure}, one.value);
    if (!is_first)
      at->second =
          low_is_worse(one.measure) ? std::min(at->second, one.value) : std::max(at->second, one.value);
  }
  return out;
}

std::map<std::string, std::string> units_of(const std::vector<TidyValue>& values) {
  std::map<std::string, std::string> out;
  for (const TidyValue& one : values) out.emplace(one.measure, one.unit);
  return out;
}

std::vector<MeasureInBoth> agreements_of(const ValuesByKey& found, const TidyTable& reference,
                                         const std::map<std::string, std::string>& units) {
  std::map<std::pair<std::string, std::string>, MeasureInBoth> pairs;
  for (const TidyValue& one : reference.values) {
    if (one.level == "stenosis") continue;  // numbered within a scan: not the same one in both
    const auto known = found.find(key_of(one));
    if (known == found.end()) continue;
    MeasureInBoth& both = pairs[{one.level, one.measure}];
    both.level = one.level;
    both.measure = one.measure;
    both.unit = units.at(one.measure);
    both.scans.push_back(one.scan);
    both.items.push_back(one.item);
    both.reference.push_back(one.value);
    both.result.push_back(known->second);
  }
  std::vector<MeasureInBoth> out;
  for (auto& [key, both] : pairs) {
    if (both.result.size() < 2) continue;
    both.agreement = evaluation::bland_altman(both.reference, both.result);
    out.push_back(std::move(both));
  }
  return out;
}

/// By name, columns of 0 and 1 that are no measure: who has it, by scan.
std::map<std::string, std::map<std::string, bool>> outcomes_in(
    const TidyTable& reference, const std::map<std::string, std::string>& units) {
  std::map<std::string, std::map<std::string, bool>> out;
  std::set<std::string> others;
  for (const TidyValue& one : reference.values) {
    if (one.level != of_a_scan || units.contains(one.measure)) continue;
    if (one.value != 0.0 && one.value != 1.0) others.insert(one.measure);
    out[one.measure][one.scan] = one.value == 1.0;
  }
  for (const std::string& name : others) out.erase(name);
  return out;
}

std::optional<MeasureOfOutcome> told_by(const std::string& measure, const std::string& outcome,
                                        const std::map<std::string, bool>& has, const ValuesByKey& found) {
  MeasureOfOutcome out{measure, "", outcome, low_is_worse(measure), {}};
  std::vector<double> score;
  std::vector<bool> truth;
  for (const auto& [scan, has_it] : has) {
    const auto known = found.find({scan, of_a_scan, "", measure});
    if (known == found.end()) continue;
    score.push_back(out.low_is_worse ? -known->second : known->second);
    truth.push_back(has_it);
  }
  const auto positive = std::ranges::count(truth, true);
  if (positive == 0 || static_cast<std::size_t>(positive) == truth.size()) return {};
  out.roc = evaluation::roc(score, truth);
  return out;
}

double threshold_of(const MeasureOfOutcome& one, double threshold) {
  return one.low_is_worse ? -threshold : threshold;
}

std::string with_unit(const std::string& measure, const std::string& unit) {
  return unit.empty() || unit == "1" ? measure : measure + ", " + unit;
}

std::string shown(double value) {
  return core::significant_text(value, 4);
}

std::string interval_text(const evaluation::Interval& interval) {
  return std::isnan(interval[0]) ? "-" : shown(interval[0]) + " to " + shown(interval[1]);
}

void write_tables(const fs::path& folder, const Statistics& all) {
  std::string agreement = core::csv_line({"level", "measure", "unit", "pairs", "bias", "bias_from", "bias_to",
                                          "sd", "lower_limit", "upper_limit", "correlation", "slope"}),
              pairs = core::csv_line({"level", "measure", "scan", "item", "reference", "result"});
  const auto exact = [](double value) { return core::shortest_text(value); };
  for (const MeasureInBoth& one : all.agreements) {
    const evaluation::BlandAltman& a = one.agreement;
    agreement +=
        core::csv_line({one.level, one.measure, one.unit, std::to_string(a.count), exact(a.bias),
                        exact(a.bias_interval[0]), exact(a.bias_interval[1]), exact(a.sd),
                        exact(a.lower_limit), exact(a.upper_limit), exact(a.correlation), exact(a.slope)});
    for (std::size_t i = 0; i < one.result.size(); ++i)
      pairs += core::csv_line({one.level, one.measure, one.scans[i], one.items[i], exact(one.reference[i]),
                               exact(one.result[i])});
  }
  std::string roc = core::csv_line({"outcome", "measure", "unit", "with", "without", "area", "area_from",
                                    "area_to", "threshold", "sensitivity", "sensitivity_from",
                                    "sensitivity_to", "specificity", "specificity_from", "specificity_to"});
  for (const MeasureOfOutcome& one : all.outcomes) {
    const evaluation::Roc& r = one.roc;
    roc += core::csv_line({one.outcome, one.measure, one.unit, std::to_string(r.positive),
                           std::to_string(r.negative), exact(r.area), exact(r.area_interval[0]),
                           exact(r.area_interval[1]), exact(threshold_of(one, r.best.threshold)),
                           exact(r.best.sensitivity), exact(r.sensitivity_interval[0]),
                           exact(r.sensitivity_interval[1]), exact(r.best.specificity),
                           exact(r.specificity_interval[0]), exact(r.specificity_interval[1])});
  }
  core::write_file(folder / "agreement.csv", agreement);
  core::write_file(folder / "pairs.csv", pairs);
  core::write_file(folder / "roc.csv", roc);
}

void add_agreements(figure::HtmlReport& page, const Statistics& all) {
  if (all.agreements.empty()) return;
  page.section("Agreement");
  page.paragraph(
      "Differences are the cohort's less the reference's. Bias with its 95 % interval (Student's t); limits "
      "of "
      "agreement are bias -/+ 1.96 standard deviations (Bland and Altman 1986, 1999). Pairs are taken as "
      "independent, which those of one patient are not: of levels below the scan the intervals are too "
      "narrow.");
  std::vector<std::vector<std::string>> rows;
  for (const MeasureInBoth& one : all.agreements)
    rows.push_back({one.level, with_unit(one.measure, one.unit), std::to_string(one.agreement.count),
                    shown(one.agreement.bias), interval_text(one.agreement.bias_interval),
                    shown(one.agreement.lower_limit) + " to " + shown(one.agreement.upper_limit),
                    shown(one.agreement.correlation)});
  page.table({"level", "measure", "pairs", "bias", "95 %", "limits of agreement", "correlation"}, rows);
  for (const MeasureInBoth& one : all.agreements) {
    evaluation::AgreementPlotOptions how;
    how.title = one.measure + ", by " + one.level;
    how.unit = one.unit;
    page.picture(evaluation::agreement_plot(one.reference, one.result, how), how.title);
  }
}

figure::Picture roc_plot(const std::vector<const MeasureOfOutcome*>& curves, const std::string& outcome) {
  std::vector<figure::Series> series;
  for (const MeasureOfOutcome* one : curves) {
    figure::Series line{one->measure + " " + core::fixed_text(one->roc.area, 2), {0.0}, {0.0}, {}};
    for (const evaluation::RocPoint& point : one->roc.curve) {
      line.x.push_back(1.0 - point.specificity);
      line.y.push_back(point.sensitivity);
    }
    series.push_back(std::move(line));
  }
  series.push_back({"chance", {0.0, 1.0}, {0.0, 1.0}, {}, figure::LineStyle::dashed, 1.0});
  figure::PlotOptions how;
  how.title = outcome;
  how.x_label = "1 - specificity";
  how.y_label = "sensitivity";
  how.width_px = how.height_px = 480;
  how.x_range = how.y_range = {0.0, 1.0};
  return figure::line_plot(series, how);
}

void add_outcomes(figure::HtmlReport& page, const Statistics& all) {
  if (all.outcomes.empty()) return;
  page.section("Who has it");
  page.paragraph(
      "Of each scan its worst value: the greatest, or the least of areas and FFR. Area under the ROC curve "
      "with "
      "DeLong's 95 % interval (1988); the threshold of the greatest sensitivity and specificity together "
      "(Youden "
      "1950) with Wilson's intervals (1927). It was chosen on the same scans, so that both look better than "
      "they "
      "would on others.");
  std::vector<std::vector<std::string>> rows;
  std::map<std::string, std::vector<const MeasureOfOutcome*>> curves;
  for (const MeasureOfOutcome& one : all.outcomes) {
    const evaluation::Roc& r = one.roc;
    curves[one.outcome].push_back(&one);
    rows.push_back(
        {one.outcome, with_unit(one.measure, one.unit), std::to_string(r.positive),
         std::to_string(r.negative), core::fixed_text(r.area, 3), interval_text(r.area_interval),
         (one.low_is_worse ? "at most " : "at least ") + shown(threshold_of(one, r.best.threshold)),
         core::fixed_text(r.best.sensitivity, 2) + " (" + interval_text(r.sensitivity_interval) + ")",
         core::fixed_text(r.best.specificity, 2) + " (" + interval_text(r.specificity_interval) + ")"});
  }
  page.table(
      {"outcome", "measure", "with", "without", "area", "95 %", "threshold", "sensitivity", "specificity"},
      rows);
  for (const auto& [outcome, some] : curves)
    page.picture(roc_plot(some, outcome), "ROC curves of " + outcome + ", with the areas under them");
}

void write_page_of(const fs::path& folder, const Statistics& all) {
  figure::HtmlReport page("Statistics of a cohort",
                          std::to_string(all.scans) + " scans that the reference knows, too");
  add_agreements(page, all);
  add_outcomes(page, all);
  page.paragraph("Research software, not a medical device.");
  page.write(folder / "index.html");
}

}  // namespace

bool low_is_worse(const std::string& measure) {
  return measure == "ffr" || measure.starts_with("least_") || measure.ends_with("_ml_min");
}

Statistics write_statistics(const StatisticsOptions& options, const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  const fs::path measures = options.tables / "measures.csv";
  if (!fs::is_regular_file(measures))
    throw InvalidInput("cannot use " + options.tables.string() +
                       ": it has no measures.csv; `ostia cohort table` makes it");
  pipeline::require_free_folder(options.output);
  const TidyTable cohort = read_tidy_table(measures), reference = read_tidy_table(options.reference);
  task.set_progress(0.5);
  task.throw_if_cancelled();
  const ValuesByKey found = with_worst(cohort.values);
  const auto units = units_of(cohort.values);
  Statistics out;
  for (const std::string& scan : reference.scans) ++(cohort.scans.contains(scan) ? out.scans : out.unknown);
  out.agreements = agreements_of(found, reference, units);
  for (const auto& [outcome, has] : outcomes_in(reference, units))
    for (const char* measure : measures_of_outcomes)
      if (auto one = told_by(measure, outcome, has, found)) {
        one->unit = units.at(measure);
        out.outcomes.push_back(std::move(*one));
      }
  if (out.agreements.empty() && out.outcomes.empty())
    throw InvalidInput(
        "cannot use " + options.reference.string() + ": it shares " + std::to_string(out.scans) +
        " scans with the tables, but no measure of two of them and no column of 0 and 1; scans go "
        "by pseudonym, and measures by the names that dictionary.csv has");
  core::StagedFolder staged(options.output);
  write_tables(staged.temporary(), out);
  write_page_of(staged.temporary(), out);
  pipeline::ManifestRecord record;
  record.key = {
      "cohort statistics",
      {{"measures", core::sha256_file(measures)}, {"reference", core::sha256_file(options.reference)}},
      "{}"};
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pipeline::write_manifest(staged.temporary(), record);
  staged.commit();
  return out;
}

}  // namespace ostia::cohort
