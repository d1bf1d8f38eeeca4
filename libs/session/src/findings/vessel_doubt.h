#pragma once
/// \file Why a person should look at a vessel first.

#include "ostia/coronary/axes.h"
#include "ostia/coronary/labels.h"

#include <string>

namespace ostia::session {

/// Empty where the program is sure of its axis and its name.
std::string doubt_about(const coronary::VesselLabel& label, const coronary::AxisNotes& axis);

}  // namespace ostia::session
