#pragma once
/// \file What a case keeps of its report: the reader's impression, modifiers of CAD-RADS, words on features
/// of plaque and on lesions of a calcium score, and who signed which version.

#include "ostia/analysis/cad_rads.h"
#include "ostia/analysis/high_risk_plaque.h"
#include "ostia/analysis/scct_segments.h"
#include "ostia/session/calcium_words.h"
#include "ostia/session/lesion_state.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// How much plaque the reader sees in each artery, the left main's with the LAD's.
struct SeenPlaque {
  analysis::PlaqueAmount lad = analysis::PlaqueAmount::none, lcx = analysis::PlaqueAmount::none,
                         rca = analysis::PlaqueAmount::none;
  bool operator==(const SeenPlaque&) const = default;
};

/// What the reader says beside the measurements.
struct ReportModifiers {
  analysis::Ischaemia ischaemia = analysis::Ischaemia::not_tested;
  bool stent = false, graft = false;
  std::string exception = {};           ///< what it is, free text; empty: none
  std::optional<SeenPlaque> seen = {};  ///< plaque burden by sight; nothing: not judged
  std::optional<double> agatston = {};  ///< calcium score, [0, 20000]
  /// In place of the one that the report chooses; nothing: that one.
  std::optional<analysis::PlaqueBurden> burden = {};
  analysis::Dominance dominance = analysis::Dominance::unknown;  ///< unknown: as the tree has it
  bool operator==(const ReportModifiers&) const = default;
};

/// On a feature of the plaque of a lesion, which is known by its stretch.
struct FeatureWord {
  std::int32_t vessel = 0;
  double from_mm = 0.0, to_mm = 0.0;
  analysis::PlaqueFeature feature = analysis::PlaqueFeature::low_attenuation;
  LesionState state = LesionState::open;  ///< accepted: it is there; rejected: it is not
  bool operator==(const FeatureWord&) const = default;
};

/// A report that was signed; its number is its place, from 1.
struct ReportVersion {
  std::string date;     ///< "2026-03-01"
  std::string signer;   ///< free text
  std::string changes;  ///< against the version before; of the first: may be empty
  std::string digest;   ///< of what was signed (report_content_digest)
  bool operator==(const ReportVersion&) const = default;
};

struct ReportNotes {
  std::string impression = {};  ///< the reader's text; empty: the report drafts one
  ReportModifiers modifiers = {};
  std::vector<FeatureWord> features = {};
  std::vector<CalciumWord> calcium = {};  ///< of a case of a scan for the calcium score
  std::vector<ReportVersion> versions = {};
  bool operator==(const ReportNotes&) const = default;
};

/// Throw InvalidInput for what is none: a text of more than 20000 bytes, a score outside its range, a stretch
/// that is none, a date that is no "YYYY-MM-DD", a version without a signer.
void validate_impression(const std::string& text);
void validate(const ReportModifiers& modifiers);
void validate(const std::vector<FeatureWord>& features);
void validate(const ReportVersion& version);

/// The reader's word on a feature of the lesion of a stretch: the one that shares most with it, and no less
/// than half of the shorter of the two; open where there is none.
LesionState word_on(const ReportNotes& notes, std::int32_t vessel, double from_mm, double to_mm,
                    analysis::PlaqueFeature feature);
/// The words after another one, instead of the one that was there; open is none.
std::vector<FeatureWord> with_feature(std::vector<FeatureWord> features, const FeatureWord& word);

}  // namespace ostia::session
