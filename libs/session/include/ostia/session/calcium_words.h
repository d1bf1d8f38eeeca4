#pragma once
/// \file A person's words on the lesions of a calcium score.

#include "ostia/analysis/calcium_score.h"

#include <map>
#include <vector>

namespace ostia::session {

/// Where a lesion lies, as a person says. The lesion is known by its centre: lesions are found anew whenever
/// the scan is scored.
struct CalciumWord {
  geometry::Vec3 centre = geometry::Vec3::Zero();  ///< LPS, mm
  analysis::CalciumPlace place = analysis::CalciumPlace::other;
  bool operator==(const CalciumWord&) const = default;
};

/// Throws InvalidInput for more than 2000 words and for centres that are nowhere in a patient.
void validate(const std::vector<CalciumWord>& words);
/// The words after another one, instead of the one that was there of the same lesion.
std::vector<CalciumWord> with_word(std::vector<CalciumWord> words, const CalciumWord& word);
/// What analysis::with_places is told: each word's lesion is the one whose centre is nearest, and no farther
/// than 2 mm. Words without a lesion are left out.
std::map<int, analysis::CalciumPlace> places_said(const std::vector<CalciumWord>& words,
                                                  const std::vector<analysis::CalciumLesion>& lesions);

}  // namespace ostia::session
