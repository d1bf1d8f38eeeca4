#pragma once
/// \file What touches taken apart: circles of lines opened.

#include "line_graph.h"

#include "ostia/coronary/mask_tree.h"

#include <cstdint>
#include <vector>

namespace ostia::coronary {

/// Lines between the roots, which count as one place, and all other circles are opened until a tree hangs on
/// each root: vessels that cross go on straight, each by itself; else the line whose thinnest place is the
/// thinnest is cut there. `labels`: the mask with its values, on whose borders vessels are cut first.
std::vector<MaskCut> part_touching(LineGraph& graph, const std::vector<std::int32_t>& roots,
                                   const imaging::MaskVolume& labels);

/// Leaves, led on to the mask's edge, that stand out by less than `least_mm` from the vessel they are on go,
/// the shortest first; a line alone goes below `alone_mm`. Roots stay. Returns how much went, mm.
double prune_lines(LineGraph& graph, const std::vector<std::int32_t>& roots, double least_mm,
                   double alone_mm);

}  // namespace ostia::coronary
