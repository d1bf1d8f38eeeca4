#pragma once
/// \file The part of a vessel's way that is its parents', as views mark it.

#include "ostia/figure/color.h"
#include "ostia/session/workbench.h"

#include <string>
#include <vector>

namespace ostia::view {

/// A stretch of the selected vessel's way, in abscissas of the case's own phase.
struct WayMark {
  std::int32_t vessel = 0;  ///< whose wall it is
  bool parent = true;       ///< another vessel's
  double from_mm = 0.0, to_mm = 0.0;
  std::string name;  ///< of the owner's standard segments there: "LM (5)"; its own name where none is known
  figure::Color color;
};
/// From the aorta to the vessel's end; empty without a vessel.
std::vector<WayMark> way_marks(const session::Workbench& bench);

}  // namespace ostia::view
