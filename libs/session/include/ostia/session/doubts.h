#pragma once
/// \file Where a person should look because the program is not sure: the found vessels' probabilities, kept
/// with the case, and the places of it that are doubtful, in order.

#include "ostia/coronary/certainty.h"
#include "ostia/session/case_file.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ostia::session {

/// Below that a place is doubtful: more than one in ten like it is wrong.
inline constexpr double least_sure = 0.9;

/// A place that the program is not sure of, on the case's model as it is now.
struct DoubtfulPlace {
  std::int32_t vessel = 0;
  double s_mm = 0.0;                  ///< of the least sure piece's middle, on the vessel's axis
  double from_mm = 0.0, to_mm = 0.0;  ///< the stretch of doubtful pieces that it belongs to
  double probability = 0.0;           ///< of the least sure piece
};

/// Keeps the probabilities with the case, as the setting "certainty": older programs read the case as
/// before. Throws as CaseFile::set_setting does.
void keep_certainty(CaseFile& file, const std::vector<coronary::VesselCertainty>& certainty);
/// As kept, without looks; nothing where none was kept, or where it cannot be read (of a newer program).
std::vector<coronary::VesselCertainty> kept_certainty(const CaseFile& file);

/// The least sure first. A piece whose place is no more on an axis (moved, cut off, deleted: a person has
/// seen to it) is left out, and so is what lies on a vessel that is marked as checked. Of a vessel that is
/// split or joined a piece goes with its place.
std::vector<DoubtfulPlace> doubtful_places(const std::vector<coronary::VesselCertainty>& certainty,
                                           const lumen::LumenModel& model, const Annotations& annotations,
                                           double below = least_sure);

/// Below that what was found is hardly an artery: fewer than one in ten like it is one.
inline constexpr double least_likely = 0.1;

/// Vessels that are hardly arteries, each with its probability: of those that no person has checked and whose
/// axis still runs where it was found (one that was moved or drawn is a person's).
std::map<std::int32_t, double> unlikely_vessels(const std::vector<coronary::VesselCertainty>& certainty,
                                                const lumen::LumenModel& model,
                                                const Annotations& annotations, double below = least_likely);

/// "probability 0.62, 0.31 from 40.0 to 50.0 mm"; empty where nothing is below the bound.
std::string doubt_text(const coronary::VesselCertainty& certainty, double below = least_sure);

}  // namespace ostia::session
