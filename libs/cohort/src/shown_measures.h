#pragma once
/// \file The figures by which a scan is shown among many.

#include "outcome.h"

#include <array>

namespace ostia::cohort {

/// Its distribution is told in bins; what lies beyond their ends is in the first or the last one.
struct ShownMeasure {
  const char* name;
  const char* title;
  const char* unit;
  double from, step;
  int bins;
  double Outcome::*value;
};
inline constexpr std::array shown_measures{
    ShownMeasure{"mla_mm2", "Minimal lumen area", "mm2", 0.0, 0.5, 40, &Outcome::mla_mm2},
    ShownMeasure{"stenosis_percent", "Worst diameter stenosis", "%", 0.0, 5.0, 20,
                 &Outcome::stenosis_percent},
    ShownMeasure{"plaque_mm3", "Plaque", "mm3", 0.0, 25.0, 40, &Outcome::plaque_mm3},
    ShownMeasure{"ffr", "Least FFR at an end", "", 0.0, 0.025, 40, &Outcome::ffr}};

}  // namespace ostia::cohort
