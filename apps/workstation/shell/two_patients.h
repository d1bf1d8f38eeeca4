#pragma once

#include "ostia/imaging/series_preview.h"

namespace ostia::workstation {

/// The patients of two images are known to be two, as far as both are known.
bool two_patients(const imaging::ShownIdentity& a, const imaging::ShownIdentity& b);

}  // namespace ostia::workstation
