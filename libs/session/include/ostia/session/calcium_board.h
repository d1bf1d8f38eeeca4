#pragma once
/// \file A calcium score that a person reads: its lesions, which of them is chosen, and where each lies.

#include "ostia/analysis/calcium_score.h"
#include "ostia/session/case_file.h"
#include "ostia/session/property.h"
#include "ostia/session/signal.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace ostia::session {

/// What was scored, and of which scan.
struct CalciumReading {
  std::shared_ptr<const imaging::ImageVolume> scan;
  ImageReference reference;  ///< of the scan
  std::optional<double> tube_kv = {};
  std::shared_ptr<const analysis::ScoredCalcium> scored;  ///< as the program proposes
};

/// A person's words on lesions are steps ("calcium.places") of a case file of the scan: a case without
/// vessels, which is made by the first word, so that a scan that was only looked at leaves none. It is never
/// the case of the workbench. One thread.
class CalciumBoard {
 public:
  /// `case_file`: where words are kept, those that are there already counted. Throws IoError, and
  /// InvalidInput for a file that is no case of this scan; what was read before stays then. A case that may
  /// not be written is read.
  void take(CalciumReading reading, const std::filesystem::path& case_file);
  void close();

  const CalciumReading* reading() const { return reading_ ? &*reading_ : nullptr; }
  /// With the person's words; only with a reading.
  const analysis::CalciumScore& score() const { return score_; }
  /// The lesion of this number; null for another one, and without a reading.
  const analysis::CalciumLesion* lesion(int number) const;
  /// The number of the lesion at a place, or within `reach_mm` of it; 0: none.
  int lesion_at(const geometry::Vec3& place, double reach_mm = 2.0) const;
  /// Whether it was made of this image.
  bool is_of(const std::shared_ptr<const imaging::ImageVolume>& image) const;

  /// A step of the case. Throws InvalidInput for a number that is not there, IoError (CaseIsReadOnly),
  /// ResourceError.
  void say(int number, analysis::CalciumPlace place);
  bool can_undo() const;
  bool can_redo() const;
  bool undo();
  bool redo();
  void set_author(const std::string& name) { author_ = name; }  ///< of steps from here on

  Property<bool> shown{false};                          ///< lesions over slices
  Property<int> chosen{0};                              ///< number of a lesion; 0: none
  Signal<> changed;                                     ///< another reading, or other words
  std::uint64_t revision() const { return revision_; }  ///< another number with each change

 private:
  void recount();
  std::optional<CalciumReading> reading_;
  analysis::CalciumScore score_;
  std::filesystem::path path_;
  std::optional<CaseFile> file_;
  std::string author_;
  std::uint64_t revision_ = 1;
};

}  // namespace ostia::session
