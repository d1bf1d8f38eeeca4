#pragma once
/// \file Names of coronary segments (AHA 1975, SCCT 2014).

#include "ostia/lumen/lumen_model.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::analysis {

/// One of the standard segments: 1-17 of the AHA, 18 (L-PLB) of the SCCT.
struct AhaSegment {
  int number = 0;
  std::string code;    ///< "pLAD"
  std::string name;    ///< "proximal LAD"
  std::string vessel;  ///< "LAD": the vessel's usual name in a tree
};
const std::vector<AhaSegment>& aha_segments();

/// Which of LM, LAD, LCX, RCA a vessel's name belongs to ("D1" is LAD's, "OM2" LCX's); empty for a name that
/// is not known. The part of LAD or LCX before the bifurcation of the left main is "LM": see segments_of.
std::string main_vessel_of(const std::string& vessel_name);

/// A vessel's usual name: "LAD" for "lad", "OM2" for "M 2", "PDA" for "RPDA"; empty for a name that is not
/// known.
std::string usual_name(const std::string& vessel_name);

/// The tree's vessels as a reader goes through them: RCA and its branches (CB, AM, PDA, PLB), then LM, LAD,
/// diagonals, septals, RI, LCX, marginals and what goes on behind from them. Numbers ascend; a PDA or PLB is
/// where its tree is. What has none of these names stands behind the vessel that it leaves, or at the end.
std::vector<std::int32_t> vessels_in_reading_order(const geometry::VesselTree& tree);

/// A stretch of a vessel that is one standard segment.
struct VesselSegment {
  std::int32_t vessel = 0;
  double from_mm = 0.0, to_mm = 0.0;
  std::string label;  ///< "pLAD (6)"; the vessel's own name where it is none of the standard's
  std::optional<AhaSegment> aha;
};
/// The tree's own stretches, each in segments by the places where branches leave (proximal to the first large
/// branch, mid to the second or halfway, distal), the left main before LAD and LCX part.
std::vector<VesselSegment> segments_of(const lumen::LumenModel& model);
/// The vessel's segment that a place lies in: its first before that begins. Null for a vessel without one.
const VesselSegment* segment_at(const std::vector<VesselSegment>& segments, std::int32_t vessel, double s_mm);

}  // namespace ostia::analysis
