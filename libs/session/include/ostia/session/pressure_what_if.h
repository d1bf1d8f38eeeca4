#pragma once
/// \file A tree's pressures as if stretches were opened or narrowed; the lumen stays as it is.

#include "ostia/session/pressure_report.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// The branches that the stretches change, by their index in the tree's network. Opened: each section of the
/// stretch gets the calibre of the vessel's reference line, less what is left of the stenosis, where it is
/// narrower; narrowed: a cosine to the throat in the middle, where it is wider. A section with another
/// calibre is round. A stretch may begin on the parents' part of a vessel's way. What changes nothing is told
/// in `notes`, if given. Throws InvalidInput as validate(WhatIf) does.
std::map<std::size_t, hemodynamics::Branch> branches_if(const PressureTree& tree,
                                                        const std::vector<WhatIf>& what_ifs,
                                                        std::vector<std::string>* notes = nullptr);

/// The tree of the report with its options' stretches, against the same beds: each keeps its resistance, as
/// the calibre of a stretch says nothing of the muscle behind it. Throws as flow_state does.
PressureAfter pressure_after(const PressureReport& report, std::vector<std::string>* notes = nullptr);

/// "LAD:12.5-30", "LAD:12.5-30:20", "4:10-18": vessel by name or id, stretch in mm from the root, percent
/// (opened: what is left, 0 unless told; narrowed: at the throat, needed). Throws InvalidInput that says what
/// is wrong with it; for a name that no vessel or more than one has.
WhatIf what_if_of_text(const std::string& text, WhatIfKind kind, const geometry::VesselTree& tree);

}  // namespace ostia::session
