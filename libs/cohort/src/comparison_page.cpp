#include "comparison_page.h"

#include "ostia/core/text.h"
#include "ostia/figure/html_report.h"

namespace ostia::cohort {
namespace {

constexpr const char* head_of_page = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Two cohorts compared</title><style>
:root { color-scheme: light dark; }
body { font: 14px/1.4 system-ui, sans-serif; max-width: 1100px; margin: 16px auto; padding: 0 12px; }
table { border-collapse: collapse; margin: 6px 0 16px; }
td, th { border-bottom: 1px solid #8884; padding: 2px 10px; text-align: right; font-weight: normal; }
td:first-child, th:first-child { text-align: left; }
.pair { display: flex; gap: 8px; } .pair img { width: 50%; }
code { font-family: ui-monospace, monospace; }
</style></head><body>
)";

std::string line_of(const char* cell, const std::vector<std::string>& texts) {
  std::string out = "<tr>";
  for (const std::string& text : texts)
    out += std::string("<") + cell + ">" + figure::html_escaped(text) + "</" + cell + ">";
  return out + "</tr>\n";
}

std::string measures_table(const CohortComparison& comparison) {
  const auto number = [](double value) { return core::significant_text(value, 4); };
  std::string out =
      "<h2>Figures</h2><table>" + line_of("th", {"", "scans", "changed", "bias", "limits of agreement",
                                                 "greatest difference", "lost", "gained"});
  for (const MeasureAgreement& one : comparison.measures)
    out += line_of("td", {one.measure + (one.unit.empty() ? "" : ", " + one.unit), std::to_string(one.scans),
                          std::to_string(one.changed), number(one.bias),
                          number(one.lower_limit) + " to " + number(one.upper_limit), number(one.greatest),
                          std::to_string(one.lost), std::to_string(one.gained)});
  return out + "</table>\n";
}

std::string states_table(const CohortComparison& comparison) {
  if (comparison.states.empty()) return "<p>No stage of a scan ended otherwise than before.</p>\n";
  std::string out = "<h2>Stages</h2><table>" + line_of("th", {"stage", "before", "after", "scans"});
  for (const StateChange& one : comparison.states)
    out += line_of("td", {one.stage, one.before, one.after, std::to_string(one.scans)});
  return out + "</table>\n";
}

std::string picture_element(const std::string& name, const char* what) {
  return name.empty() ? "" : "<img src=\"" + figure::html_escaped(name) + "\" alt=\"the tree " + what + "\">";
}

std::string scan_part(const ChangedScan& scan) {
  std::string out = "<h3><code>" + figure::html_escaped(scan.after) + "</code>, before <code>" +
                    figure::html_escaped(scan.before) + "</code></h3><table>" +
                    line_of("th", {"", "before", "after"});
  for (const auto& [what, before, after] : scan.values) out += line_of("td", {what, before, after});
  return out + "</table><div class=\"pair\">" + picture_element(scan.pictures[0], "before") +
         picture_element(scan.pictures[1], "after") + "</div>\n";
}

}  // namespace

std::string comparison_page(const CohortComparison& comparison, const std::vector<ChangedScan>& most) {
  std::string out = head_of_page;
  out += "<h1>Two cohorts compared</h1><p>" + std::to_string(comparison.before) + " scans before, " +
         std::to_string(comparison.after) + " after, " + std::to_string(comparison.matched) +
         " in both by their content, " + std::to_string(comparison.changed) +
         " of which changed (changes.csv). Differences are after less before.</p>\n";
  out += measures_table(comparison) + states_table(comparison);
  if (!most.empty()) out += "<h2>What changed most</h2>\n";
  for (const ChangedScan& one : most) out += scan_part(one);
  return out + "<p>Research software, not a medical device.</p></body></html>\n";
}

}  // namespace ostia::cohort
