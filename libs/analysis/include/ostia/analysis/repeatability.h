#pragma once
/// \file By how much two scans of an unchanged patient differ (docs/methods/compare.md).

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace ostia::analysis {

/// What is compared between two scans.
enum class ChangeMeasure {
  least_diameter,   ///< MLD, mm
  least_area,       ///< MLA, mm^2
  stenosis,         ///< percent of diameter at the least area
  length,           ///< of a lesion, mm
  plaque,           ///< volumes of plaque, mm^3: all of it
  low_attenuation,  ///< and by class
  fibrofatty,
  fibrous,
  calcified,
  burden,       ///< 100 plaque / vessel: the percent atheroma volume
  remodelling,  ///< index
  fat,          ///< mean of the fat about a main artery, HU
};
inline constexpr std::size_t change_measure_count = 12;
inline constexpr std::array change_measures{
    ChangeMeasure::least_diameter, ChangeMeasure::least_area,  ChangeMeasure::stenosis,
    ChangeMeasure::length,         ChangeMeasure::plaque,      ChangeMeasure::low_attenuation,
    ChangeMeasure::fibrofatty,     ChangeMeasure::fibrous,     ChangeMeasure::calcified,
    ChangeMeasure::burden,         ChangeMeasure::remodelling, ChangeMeasure::fat};
/// As files have it, unit and all: "mld_mm", "mla_mm2", "stenosis_percent", "length_mm", "plaque_mm3",
/// "low_attenuation_mm3", "fibrofatty_mm3", "fibrous_mm3", "calcified_mm3", "burden_percent",
/// "remodelling_index", "fat_hu".
std::string key_of(ChangeMeasure measure);
std::string title_of(ChangeMeasure measure);  ///< for a reader: "MLA, mm2"

/// Of what it is a measure: the larger the stretch, the larger what two scans differ by.
enum class ChangeScope { lesion, segment, vessel, patient };
inline constexpr std::size_t change_scope_count = 4;
inline constexpr std::array change_scopes{ChangeScope::lesion, ChangeScope::segment, ChangeScope::vessel,
                                          ChangeScope::patient};
std::string key_of(ChangeScope scope);  ///< "lesion", "segment", "vessel", "patient"

/// Standard deviation of the difference between two scans of what has not changed.
struct DifferenceSpread {
  double sd = 0.0;     ///< in the measure's unit, >= 0; 0: not known
  double share = 0.0;  ///< of the mean of both values, >= 0
  /// sqrt(sd^2 + (share mean)^2).
  double at(double mean) const;
  friend bool operator==(const DifferenceSpread&, const DifferenceSpread&) = default;
};

struct Repeatability {
  std::array<std::array<DifferenceSpread, change_measure_count>, change_scope_count> spreads{};
  std::string from;  ///< where it was measured, for a reader

  const DifferenceSpread& of(ChangeScope scope, ChangeMeasure measure) const {
    return spreads[static_cast<std::size_t>(scope)][static_cast<std::size_t>(measure)];
  }
  DifferenceSpread& of(ChangeScope scope, ChangeMeasure measure) {
    return spreads[static_cast<std::size_t>(scope)][static_cast<std::size_t>(measure)];
  }
  /// The smallest real difference, 95 %: 1.96 standard deviations. Nothing where it is not known.
  std::optional<double> smallest_real(ChangeScope scope, ChangeMeasure measure, double mean) const;
};

/// The program's own (docs/methods/compare.md): empty until it is measured on pairs of synthetic scans.
Repeatability phantom_repeatability();

enum class ChangeVerdict { not_known, unchanged, less, more };
std::string to_string(ChangeVerdict verdict);  ///< "not known", "unchanged", "less", "more"

/// One measure in both scans; nothing where it could not be measured.
struct Difference {
  std::optional<double> before, after;
  std::optional<double> smallest_real;  ///< what the difference is told from noise by
  std::optional<double> change() const;
  /// More or less by more than the smallest real difference; not known without one of the three.
  ChangeVerdict verdict() const;
};
Difference difference(std::optional<double> before, std::optional<double> after, ChangeScope scope,
                      ChangeMeasure measure, const Repeatability& repeatability);

}  // namespace ostia::analysis
