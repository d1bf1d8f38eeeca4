#pragma once
/// \file What a person noted on a former scan, carried with its tree.

#include "follow_up/carry_axes.h"

#include "ostia/session/annotation.h"

namespace ostia::session {

/// Marks of every carried vessel, the reader's words on lesions, and measurements; what is not carried is
/// told in `not_carried`.
Annotations carried_notes(const lumen::LumenModel& before, const Annotations& annotations,
                          const CarriedTree& carried, const analysis::PointMap& map,
                          std::vector<std::string>& not_carried);

}  // namespace ostia::session
