#include "ostia/session/pressure_document.h"

#include "report/case_report_words.h"

#include "ostia/core/quantity_text.h"
#include "ostia/core/text.h"
#include "ostia/core/version.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/pdf_document.h"
#include "ostia/figure/plot.h"
#include "ostia/session/pressure_readout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ostia::session {
namespace {

using core::fixed_text;
using core::ratio_text;
using hemodynamics::outlet_ratio;
using hemodynamics::pa_of_mmhg;
using report_words::own;
using Rows = std::vector<std::vector<std::string>>;

constexpr double per_minute = 60.0;

std::string lowest_text(const PressureReport& report) {
  const auto& network = *report.network;
  std::optional<double> least;
  std::string where;
  for (std::size_t k = 0; k < network.outlets().size(); ++k) {
    const auto ratio = outlet_ratio(network, report.under_hyperaemia, k);
    if (!ratio || (least && *ratio >= *least)) continue;
    least = ratio;
    where = network.network().branches[network.outlets()[k]].name;
  }
  return least ? ratio_text(least) + " at the end of " + where : "not known: all ends lie behind occlusions";
}

std::string flow_text(const PressureReport& report) {
  using hemodynamics::FlowSource;
  const std::string flow = fixed_text(report.resting.total_ml_s * per_minute, 0) + " ml/min, ";
  return flow + (report.resting.source == FlowSource::told   ? "told"
                 : report.resting.source == FlowSource::mass ? "by the left ventricle's mass"
                                                             : "by the vessels' calibre");
}

std::vector<std::pair<std::string, std::string>> pressure_summary(const PressureReport& report,
                                                                  const PressureDocumentOptions& options) {
  const hemodynamics::Conditions& c = report.options.conditions;
  std::vector<std::pair<std::string, std::string>> rows;
  if (!options.date.empty()) rows.emplace_back("Date", options.date);
  if (options.image) rows.emplace_back("Image", options.image->pseudonym);
  rows.emplace_back("Lowest FFR", lowest_text(report));
  rows.emplace_back("Mean aortic pressure", fixed_text(report.under_hyperaemia.aortic_pa / pa_of_mmhg, 0) +
                                                " mmHg (" + fixed_text(c.systolic_mmhg, 0) + "/" +
                                                fixed_text(c.diastolic_mmhg, 0) + " by cuff)");
  rows.emplace_back("Flow of the tree at rest", flow_text(report));
  rows.emplace_back("Program", "Ostia " + core::version());
  return rows;
}

std::string told_ratio(const hemodynamics::LesionReading& one, double value) {
  return one.occluded ? "occluded" : ratio_text(value);
}

Rows lesion_rows_of(const PressureReport& report) {
  Rows rows;
  for (std::size_t i = 0; i < report.under_hyperaemia.lesions.size(); ++i) {
    const auto &one = report.under_hyperaemia.lesions[i], &rest = report.at_rest.lesions[i];
    std::vector<std::string> row{one.lesion.name,
                                 own(report.tree.network.branches[one.lesion.throat.branch].name),
                                 core::length_text(one.lesion.throat.s_mm),
                                 told_ratio(one, one.before),
                                 told_ratio(one, one.behind),
                                 core::length_text(one.distance_mm),
                                 told_ratio(one, one.delta()),
                                 told_ratio(rest, rest.behind)};
    if (report.after) {
      const auto& other = report.after->under_hyperaemia.lesions[i];
      row.push_back(told_ratio(other, other.behind));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Rows outlet_rows_of(const PressureReport& report) {
  Rows rows;
  const auto& network = *report.network;
  for (std::size_t k = 0; k < network.outlets().size(); ++k) {
    const std::size_t b = network.outlets()[k];
    const double rest = report.rest.solution.flow_ml_s[b], most = report.hyperaemia.solution.flow_ml_s[b];
    const auto ratio = outlet_ratio(network, report.under_hyperaemia, k);
    std::vector<std::string> row{own(network.network().branches[b].name),
                                 ratio ? ratio_text(ratio) : "occluded",
                                 fixed_text(most * per_minute, 0),
                                 fixed_text(rest * per_minute, 0),
                                 rest > 0.0 ? ratio_text(most / rest) : "-",
                                 ratio ? ratio_text(report.under_hyperaemia.pullbacks[k].ppg_index) : "-"};
    if (report.after)
      row.push_back(ratio_text(outlet_ratio(report.after->network, report.after->under_hyperaemia, k)));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Groups of inputs with a say in a reading, the first in what varies first.
std::string varies_by(const hemodynamics::SobolIndices& indices) {
  constexpr double least_say = 0.05;
  std::vector<std::size_t> groups;
  for (std::size_t g = 0; g < hemodynamics::input_groups; ++g)
    if (indices.total[g] >= least_say) groups.push_back(g);
  std::ranges::stable_sort(groups, std::ranges::greater(), [&](std::size_t g) { return indices.total[g]; });
  std::string text;
  for (const std::size_t g : groups)
    text += (text.empty() ? "" : "; ") +
            std::string(hemodynamics::name_of(static_cast<hemodynamics::InputGroup>(g))) + " " +
            core::percent_text(100.0 * indices.total[g]) + " %";
  return text.empty() ? "-" : text;
}

std::vector<std::string> sure_row(std::string what, const hemodynamics::UncertainReading& one) {
  if (!one.ratio.known) return {std::move(what), "occluded", "-", "-", "-"};
  return {std::move(what), ratio_text(one.ratio.median),
          ratio_text(one.ratio.low) + " - " + ratio_text(one.ratio.high),
          core::percent_text(100.0 * one.ratio.probability), varies_by(one.indices)};
}

Rows sure_rows_of(const PressureReport& report) {
  Rows rows;
  const hemodynamics::PressureUncertainty& sure = *report.uncertainty;
  for (std::size_t i = 0; i < sure.lesions.size(); ++i)
    rows.push_back(sure_row(report.under_hyperaemia.lesions[i].lesion.name, sure.lesions[i]));
  for (const hemodynamics::UncertainReading& one : sure.outlets)
    rows.push_back(sure_row(own(report.tree.network.branches[one.place.branch].name), one));
  return rows;
}

Rows stretch_rows_of(const PressureReport& report) {
  Rows rows;
  for (const WhatIf& one : report.options.what_ifs) {
    const auto vessel = report.tree.vessels.find(one.vessel);
    const std::string percent = core::percent_text(one.percent);
    rows.push_back(
        {own(vessel == report.tree.vessels.end() ? std::to_string(one.vessel) : vessel->second.name),
         core::length_text(one.from_mm), core::length_text(one.to_mm),
         one.kind == WhatIfKind::open ? "opened to the reference, " + percent + " % left"
                                      : "narrowed by " + percent + " %"});
  }
  return rows;
}

Rows input_rows_of(const PressureReport& report) {
  const hemodynamics::Conditions usual;
  Rows rows;
  for (const hemodynamics::ConditionInput& input : hemodynamics::condition_inputs()) {
    const auto value_in = [&](const hemodynamics::Conditions& c) {
      return input.value ? std::optional(c.*input.value) : c.*input.optional;
    };
    const auto value = value_in(report.options.conditions);
    const std::string unit = input.unit.empty() ? "" : " " + std::string(input.unit);
    rows.push_back({std::string(input.meaning), value ? own(core::shortest_text(*value) + unit) : "-",
                    own(core::shortest_text(input.usual_low) + "-" + core::shortest_text(input.usual_high)),
                    value != value_in(usual) ? "told" : std::string(input.source)});
  }
  return rows;
}

/// Those with a narrowing, in the tree's order; the two whose ends have the lowest FFR where none has.
std::vector<std::int32_t> vessels_of_curves(const PressureReport& report) {
  std::vector<std::int32_t> vessels;
  const auto add = [&](std::int32_t vessel) {
    if (std::find(vessels.begin(), vessels.end(), vessel) == vessels.end()) vessels.push_back(vessel);
  };
  for (const auto& lesion : report.tree.lesions)
    add(report.tree.network.branches[lesion.throat.branch].vessel);
  for (const WhatIf& one : report.options.what_ifs)
    if (report.tree.vessels.contains(one.vessel)) add(one.vessel);
  if (!vessels.empty()) return vessels;
  std::vector<std::pair<double, std::int32_t>> ends;
  for (std::size_t k = 0; k < report.network->outlets().size(); ++k)
    if (const auto ratio = outlet_ratio(*report.network, report.under_hyperaemia, k))
      ends.emplace_back(*ratio, report.tree.network.branches[report.network->outlets()[k]].vessel);
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 0; k < ends.size() && k < 2; ++k) add(ends[k].second);
  return vessels;
}

template <class Document>
void compose_pressures(Document& written, const PressureReport& report,
                       const PressureDocumentOptions& options) {
  const core::Phrasebook& words = pressure_words(options.language);
  report_words::Said<Document> document(written, words);
  document.notice(figure::Notice::warning, std::string(hemodynamics::research_use));
  document.section("Summary");
  document.key_values(pressure_summary(report, options));
  document.section("Narrowings");
  std::vector<std::string> header{"No.", "Vessel",           "At (mm)", "Before",
                                  "FFR", "Read behind (mm)", "Takes",   "Pd/Pa at rest"};
  if (report.after) header.push_back("FFR, what if");
  if (report.under_hyperaemia.lesions.empty())
    document.paragraph("None was found.");
  else
    document.table(header, lesion_rows_of(report), "Narrowings");
  document.paragraph("FFR is Pd/Pa under hyperaemia, read behind each narrowing; at or below " +
                     ratio_text(report.options.reading.threshold) + " it counts as significant.");
  if (report.uncertainty) {
    document.section("How sure");
    document.table({"Narrowing or end", "Median FFR", "95 % lie in",
                    "At or below " + ratio_text(report.uncertainty->threshold) + " (%)", "Varies by"},
                   sure_rows_of(report), "How sure");
    document.paragraph("Of " + std::to_string(report.uncertainty->samples) +
                       " trees drawn within what is not known for sure of the wall and the inputs.");
  }
  if (report.after) {
    document.section("What if");
    document.paragraph(
        "Stretches that are looked at as if they had another calibre; the lumen and the beds behind it stay "
        "as they are.");
    document.table({"Vessel", "From (mm)", "To (mm)", "What if"}, stretch_rows_of(report), "What if");
  }
  document.section("Pullback curves");
  for (const PressureCurve& one : pressure_curves(report, options))
    document.picture(one.picture, words.say(one.name + ": FFR along its way from the aorta" +
                                            (report.after ? ", as it is and what if" : "")));
  document.section("Ends of the vessels");
  header = {"Vessel", "FFR", "Flow (ml/min)", "At rest (ml/min)", "Flow reserve", "Pullback index"};
  if (report.after) header.push_back("FFR, what if");
  document.table(header, outlet_rows_of(report), "Ends of the vessels");
  if (!report.warnings.empty()) document.section("Marks");
  for (const std::string& warning : report.warnings) document.notice(figure::Notice::note, warning);
  document.section("Inputs");
  document.table({"Input", "Value", "Usual", "Source"}, input_rows_of(report), "Inputs");
  document.paragraph("How they come about: Ostia's page on pressure and flow along the coronary tree.");
}

std::string title_of_pressures(const PressureDocumentOptions& options) {
  return pressure_words(options.language).say("Pressure and flow along the coronary arteries");
}

std::string case_of_pressures(const PressureDocumentOptions& options) {
  return options.image ? pressure_words(options.language).say("Case of " + options.image->pseudonym)
                       : pressure_words(options.language).say("computed");
}

figure::PdfDocument pdf_of_pressures(const PressureReport& report, const PressureDocumentOptions& options) {
  const core::Phrasebook& words = pressure_words(options.language);
  // The sentence stands at the head, and its short form, which fits a line, at the foot of each page.
  figure::PdfDocument document(
      title_of_pressures(options), case_of_pressures(options),
      {words.say("Research software, not a medical device; no decision on a patient may rest on it."),
       report_words::document(options.language)});
  compose_pressures(document, report, options);
  return document;
}

}  // namespace

std::vector<PressureCurve> pressure_curves(const PressureReport& report,
                                           const PressureDocumentOptions& options) {
  const core::Phrasebook& words = pressure_words(options.language);
  std::vector<PressureCurve> curves;
  for (const std::int32_t vessel : vessels_of_curves(report)) {
    figure::Series now, after;
    now.name = words.say("as it is");
    after.name = words.say("what if");
    after.style = figure::LineStyle::dashed;
    figure::Series low{"95 %", {}, {}, {}, figure::LineStyle::dashed, 1.0}, high = low;
    high.name.clear();
    double least = 1.0;
    bool known = false, sure = false;
    for (const FfrPoint& one : ffr_along(report, vessel)) {
      now.x.push_back(one.s_mm), now.y.push_back(one.ffr);
      after.x.push_back(one.s_mm), after.y.push_back(one.after);
      low.x.push_back(one.s_mm), low.y.push_back(one.low);
      high.x.push_back(one.s_mm), high.y.push_back(one.high);
      sure = sure || std::isfinite(one.low);
      known = known || std::isfinite(one.ffr) || std::isfinite(one.after);
      for (const double value : {one.ffr, one.after, one.low})
        if (std::isfinite(value)) least = std::min(least, value);
    }
    if (!known) continue;
    figure::PlotOptions how;
    how.title = report.tree.vessels.at(vessel).name;
    how.x_label = words.say("mm from the aorta");
    how.y_label = "FFR (" + words.say("computed") + ")";
    how.y_range = figure::Range{std::min(0.5, std::floor(10.0 * least) / 10.0), 1.02};
    how.height_px = 300;
    how.references.push_back({figure::ReferenceLine::Along::y, report.options.reading.threshold,
                              ratio_text(report.options.reading.threshold)});
    for (const auto& lesion : report.tree.lesions)
      if (report.tree.network.branches[lesion.throat.branch].vessel == vessel)
        how.references.push_back({figure::ReferenceLine::Along::x, lesion.throat.s_mm, lesion.name});
    std::vector<figure::Series> series{std::move(now)};
    if (report.after) series.push_back(std::move(after));
    if (sure) {
      low.color = high.color = figure::Color{0.55, 0.55, 0.58};
      series.push_back(std::move(low));
      series.push_back(std::move(high));
    }
    curves.push_back({vessel, report.tree.vessels.at(vessel).name, figure::line_plot(series, how)});
  }
  return curves;
}

std::string pressure_html(const PressureReport& report, const PressureDocumentOptions& options) {
  figure::HtmlReport document(title_of_pressures(options), case_of_pressures(options),
                              report_words::document(options.language));
  compose_pressures(document, report, options);
  return document.html();
}

std::string pressure_pdf(const PressureReport& report, const PressureDocumentOptions& options) {
  return pdf_of_pressures(report, options).pdf();
}

std::vector<figure::Picture> pressure_pages(const PressureReport& report,
                                            const PressureDocumentOptions& options) {
  return pdf_of_pressures(report, options).pages();
}

}  // namespace ostia::session
