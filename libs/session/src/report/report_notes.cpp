#include "ostia/session/report_notes.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::session {
namespace {

constexpr std::size_t longest_text = 20000, longest_line = 500, most_words = 1000;
constexpr double largest_agatston = 20000.0;

bool is_date(const std::string& text) {
  if (text.size() != 10) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool dash = i == 4 || i == 7;
    if (dash ? text[i] != '-' : !(text[i] >= '0' && text[i] <= '9')) return false;
  }
  const int month = std::stoi(text.substr(5, 2)), day = std::stoi(text.substr(8, 2));
  return month >= 1 && month <= 12 && day >= 1 && day <= 31;
}

bool is_digest(const std::string& text) {
  return text.size() == 64 && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
         });
}

void require_line(const std::string& text, const std::string& what) {
  if (text.size() > longest_line || text.find_first_of("\r\n") != std::string::npos)
    throw InvalidInput(what + " is one line of up to " + std::to_string(longest_line) + " bytes");
}

const FeatureWord* feature_word(const std::vector<FeatureWord>& words, std::int32_t vessel, double from_mm,
                                double to_mm, analysis::PlaqueFeature feature) {
  const FeatureWord* best = nullptr;
  double most_mm = 0.0;
  for (const FeatureWord& one : words) {
    if (one.vessel != vessel || one.feature != feature) continue;
    const double shared = std::min(to_mm, one.to_mm) - std::max(from_mm, one.from_mm);
    const double shorter = std::min(to_mm - from_mm, one.to_mm - one.from_mm);
    if (shared > most_mm && shared >= 0.5 * shorter) best = &one, most_mm = shared;
  }
  return best;
}

}  // namespace

void validate_impression(const std::string& text) {
  if (text.size() > longest_text)
    throw InvalidInput("an impression of " + std::to_string(text.size()) + " bytes; up to " +
                       std::to_string(longest_text) + " are kept");
}

void validate(const ReportModifiers& modifiers) {
  require_line(modifiers.exception, "what the modifier E stands for");
  if (modifiers.agatston && !(*modifiers.agatston >= 0.0 && *modifiers.agatston <= largest_agatston))
    throw InvalidInput("a calcium score of " + core::shortest_text(*modifiers.agatston) +
                       "; an Agatston score is 0 to 20000");
}

void validate(const std::vector<FeatureWord>& features) {
  if (features.size() > most_words)
    throw InvalidInput("a case keeps up to " + std::to_string(most_words) + " words on features of plaque");
  for (const FeatureWord& one : features)
    if (!(one.from_mm >= 0.0 && one.from_mm < one.to_mm && std::isfinite(one.to_mm)))
      throw InvalidInput("the plaque from " + core::shortest_text(one.from_mm) + " to " +
                         core::shortest_text(one.to_mm) +
                         " mm is no stretch; give its proximal end before its distal one");
}

void validate(const ReportVersion& version) {
  if (!is_date(version.date))
    throw InvalidInput("a report is signed on \"" + version.date + "\"; give a date as 2026-03-01");
  if (version.signer.empty()) throw InvalidInput("a report is signed by nobody; give a name");
  require_line(version.signer, "who signs a report");
  require_line(version.changes, "what changed in a report");
  if (!is_digest(version.digest))
    throw InvalidInput("a signed report has the digest \"" + version.digest +
                       "\"; it is a SHA-256 of 64 hexadecimal digits");
}

LesionState word_on(const ReportNotes& notes, std::int32_t vessel, double from_mm, double to_mm,
                    analysis::PlaqueFeature feature) {
  const FeatureWord* word = feature_word(notes.features, vessel, from_mm, to_mm, feature);
  return word ? word->state : LesionState::open;
}

std::vector<FeatureWord> with_feature(std::vector<FeatureWord> features, const FeatureWord& word) {
  while (const FeatureWord* said =
             feature_word(features, word.vessel, word.from_mm, word.to_mm, word.feature))
    features.erase(features.begin() + (said - features.data()));
  if (word.state != LesionState::open) features.push_back(word);
  return features;
}

}  // namespace ostia::session
