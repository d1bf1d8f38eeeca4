#include "outcome.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace ostia::cohort {
namespace {

using nlohmann::json;

constexpr std::size_t measures_stage = stage_of("measures"), pressure_stage = stage_of("pressure");

/// Takes a number of each entry of a list, where it is one.
template <class Join>
double joined(const json& document, const char* list, const json::json_pointer& member, const Join& join) {
  double out = std::numeric_limits<double>::quiet_NaN();
  const auto entries = document.find(list);
  if (entries == document.end()) return out;
  for (const json& entry : *entries) {
    if (!entry.contains(member) || !entry.at(member).is_number()) continue;
    const double value = entry.at(member).get<double>();
    out = std::isnan(out) ? value : join(out, value);
  }
  return out;
}

constexpr auto least = [](double a, double b) { return std::min(a, b); };
constexpr auto greatest = [](double a, double b) { return std::max(a, b); };
constexpr auto sum = [](double a, double b) { return a + b; };

/// Null where it is no JSON object: then nothing of it is known.
json result_document(const OpenCohort& cohort, const CohortScan& scan, std::size_t stage) {
  if (!is_done(scan.results[stage].state)) return json::object();
  const Stage& one = stages[stage];
  try {
    json document = json::parse(core::read_file(cohort.folder() / one.folder / scan.pseudonym / one.result),
                                nullptr, false);
    if (document.is_object()) return document;
  } catch (const IoError&) {
    // Taken away a moment ago.
  }
  return json::object();
}

Outcome read_outcome(const OpenCohort& cohort, const CohortScan& scan) {
  Outcome out;
  const json report = result_document(cohort, scan, measures_stage);
  const json::json_pointer category("/cad_rads/category");
  if (report.contains(category) && report.at(category).is_string())
    out.cad_rads = report.at(category).get<std::string>();
  out.mla_mm2 = joined(report, "segments", json::json_pointer("/least_area_mm2"), least);
  out.stenosis_percent = joined(report, "stenoses", json::json_pointer("/diameter_percent"), greatest);
  out.plaque_mm3 = joined(report, "vessels", json::json_pointer("/plaque/plaque_mm3"), sum);
  const json pressure = result_document(cohort, scan, pressure_stage);
  out.ffr = joined(pressure, "outlets", json::json_pointer("/ffr"), least);
  return out;
}

std::string digest_where_done(const StageResult& result) {
  return is_done(result.state) ? result.result : "";
}

}  // namespace

Outcomes::Outcomes(const OpenCohort& cohort) : cohort_(&cohort) {
  if (!cohort.has_later_tables()) return;
  known_.emplace(
      cohort.store(),
      "SELECT cad_rads, mla_mm2, stenosis_percent, plaque_mm3, ffr FROM outcome WHERE scan = ? AND "
      "measures = ? AND pressure = ?");
  put_.emplace(cohort.store(), "INSERT OR REPLACE INTO outcome VALUES(?, ?, ?, ?, ?, ?, ?, ?)");
}

Outcome Outcomes::of(const CohortScan& scan) {
  const std::string measures = digest_where_done(scan.results[measures_stage]),
                    pressure = digest_where_done(scan.results[pressure_stage]);
  if (measures.empty() && pressure.empty()) return {};
  if (known_ && known_->with(scan.number, measures, pressure).step())
    return {known_->text(0), known_->real_or_nan(1), known_->real_or_nan(2), known_->real_or_nan(3),
            known_->real_or_nan(4)};
  Outcome out = read_outcome(*cohort_, scan);
  if (put_ && cohort_->keeps())
    put_->with(scan.number, measures, pressure, out.cad_rads, out.mla_mm2, out.stenosis_percent,
               out.plaque_mm3, out.ffr)
        .step();
  return out;
}

}  // namespace ostia::cohort
