#pragma once
/// \file Beats as WFDB's annotation files have them.

#include "ostia/geometry/ecg_record.h"

#include <string>
#include <vector>

namespace ostia::io {

/// Throws InvalidInput for beats of a kind that WFDB does not know, or out of the order of time.
std::string annotation_bytes(const std::vector<geometry::EcgBeat>& beats);

}  // namespace ostia::io
