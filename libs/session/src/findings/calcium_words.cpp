#include "ostia/session/calcium_words.h"

#include "ostia/core/error.h"

#include <cmath>
#include <string>

namespace ostia::session {
namespace {

constexpr std::size_t most_calcium_words = 2000;
constexpr double same_lesion_mm = 2.0, farthest_mm = 10000.0;

}  // namespace

void validate(const std::vector<CalciumWord>& words) {
  if (words.size() > most_calcium_words)
    throw InvalidInput("a case keeps up to " + std::to_string(most_calcium_words) +
                       " words on lesions of calcium");
  for (const CalciumWord& one : words)
    if (!(one.centre.cwiseAbs().maxCoeff() <= farthest_mm))
      throw InvalidInput("a lesion of calcium lies at a place that is none; give x, y and z in mm");
}

std::vector<CalciumWord> with_word(std::vector<CalciumWord> words, const CalciumWord& word) {
  std::erase_if(words, [&](const CalciumWord& one) { return (one.centre - word.centre).norm() == 0.0; });
  words.push_back(word);
  return words;
}

std::map<int, analysis::CalciumPlace> places_said(const std::vector<CalciumWord>& words,
                                                  const std::vector<analysis::CalciumLesion>& lesions) {
  std::map<int, analysis::CalciumPlace> places;
  for (const CalciumWord& word : words) {
    const analysis::CalciumLesion* nearest = nullptr;
    double off_mm = same_lesion_mm;
    for (const analysis::CalciumLesion& lesion : lesions)
      if (const double off = (lesion.centre - word.centre).norm(); off <= off_mm)
        nearest = &lesion, off_mm = off;
    if (nearest != nullptr) places[nearest->number] = word.place;
  }
  return places;
}

}  // namespace ostia::session
