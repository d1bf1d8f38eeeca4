#pragma once
/// \file Which ends of a mask's lines are the coronary ostia.

#include "line_graph.h"

#include "ostia/imaging/volume.h"

#include <optional>
#include <vector>

namespace ostia::coronary {

struct MaskOstia {
  std::optional<std::int32_t> left, right;  ///< nodes; a single one is `left` whichever it is
  bool one_part = false;                    ///< the lines lead from the one to the other
  double doubt_sigma = 0.0;                 ///< how far the way between both is from the usual one
};

/// Where a branch leaves right at an ostium, the thinned line runs from the one vessel into the other and has
/// no end there. Each such sharp bend gets a short line to the mask's edge; ids of these lines.
std::vector<std::int32_t> add_ends_at_bends(LineGraph& graph, const imaging::MaskVolume& lumen);

/// Ends are weighed by how wide they begin, by whether branches leave forwards for one who comes from there,
/// by where they lie to each other, and by `contacts` with the aorta, where there are any. At least one is
/// found where there is a line with an end.
MaskOstia ostia_of_lines(const LineGraph& graph, const std::vector<Vec3>& contacts);

}  // namespace ostia::coronary
