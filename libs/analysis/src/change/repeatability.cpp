#include "ostia/analysis/repeatability.h"

#include "change/repeatability_table.h"

#include <cmath>

namespace ostia::analysis {
namespace {

constexpr double normal_95 = 1.96;

struct MeasureWords {
  const char *key, *title;
};
constexpr std::array<MeasureWords, change_measure_count> measure_words{
    {{"mld_mm", "MLD, mm"},
     {"mla_mm2", "MLA, mm2"},
     {"stenosis_percent", "stenosis, %"},
     {"length_mm", "length, mm"},
     {"plaque_mm3", "plaque, mm3"},
     {"low_attenuation_mm3", "low attenuation, mm3"},
     {"fibrofatty_mm3", "fibrofatty, mm3"},
     {"fibrous_mm3", "fibrous, mm3"},
     {"calcified_mm3", "calcified, mm3"},
     {"burden_percent", "burden, %"},
     {"remodelling_index", "remodelling index"},
     {"fat_hu", "fat, HU"}}};
constexpr std::array<const char*, change_scope_count> scope_words{"lesion", "segment", "vessel", "patient"};

}  // namespace

std::string key_of(ChangeMeasure measure) {
  return measure_words[static_cast<std::size_t>(measure)].key;
}

std::string title_of(ChangeMeasure measure) {
  return measure_words[static_cast<std::size_t>(measure)].title;
}

std::string key_of(ChangeScope scope) {
  return scope_words[static_cast<std::size_t>(scope)];
}

double DifferenceSpread::at(double mean) const {
  return std::hypot(sd, share * mean);
}

std::optional<double> Repeatability::smallest_real(ChangeScope scope, ChangeMeasure measure,
                                                   double mean) const {
  const double sd = of(scope, measure).at(mean);
  return sd > 0.0 && std::isfinite(sd) ? std::optional(normal_95 * sd) : std::nullopt;
}

Repeatability phantom_repeatability() {
  Repeatability table;
  table.from = repeatability_from;
  for (std::size_t s = 0; s < change_scope_count; ++s)
    for (std::size_t m = 0; m < change_measure_count; ++m)
      table.spreads[s][m] = {repeatability_table[s][m][0], repeatability_table[s][m][1]};
  return table;
}

std::string to_string(ChangeVerdict verdict) {
  switch (verdict) {
    case ChangeVerdict::unchanged:
      return "unchanged";
    case ChangeVerdict::less:
      return "less";
    case ChangeVerdict::more:
      return "more";
    case ChangeVerdict::not_known:
      break;
  }
  return "not known";
}

std::optional<double> Difference::change() const {
  return before && after ? std::optional(*after - *before) : std::nullopt;
}

ChangeVerdict Difference::verdict() const {
  const std::optional<double> by = change();
  if (!by || !smallest_real) return ChangeVerdict::not_known;
  if (std::abs(*by) <= *smallest_real) return ChangeVerdict::unchanged;
  return *by > 0.0 ? ChangeVerdict::more : ChangeVerdict::less;
}

Difference difference(std::optional<double> before, std::optional<double> after, ChangeScope scope,
                      ChangeMeasure measure, const Repeatability& repeatability) {
  Difference out{before, after, {}};
  if (before && after)
    out.smallest_real = repeatability.smallest_real(scope, measure, 0.5 * (*before + *after));
  return out;
}

}  // namespace ostia::analysis
