#pragma once
/// \file What the mouse's main button does in a view, and what is told of it.

#include "ostia/analysis/measurement_kinds.h"

#include <array>
#include <optional>
#include <string_view>

namespace ostia::session {

enum class Tool {
  browse,      ///< the cursor goes where it is clicked
  drag,        ///< the wall is pulled
  draw,        ///< the wall is drawn anew
  brush,       ///< a ball pushes the wall
  axis,        ///< control points of the centerline
  add_vessel,  ///< a way from a distal end back to the tree
  add_artery,  ///< a way from an ostium of its own to a distal end
  distance,
  angle,
  area,
  diameter,
  stenosis,
  volume,
  ring_hu,
  arrow,
  note,
};
inline constexpr std::array<Tool, 16> all_tools = {
    Tool::browse,     Tool::drag,     Tool::draw,  Tool::brush, Tool::axis,     Tool::add_vessel,
    Tool::add_artery, Tool::distance, Tool::angle, Tool::area,  Tool::diameter, Tool::stenosis,
    Tool::volume,     Tool::ring_hu,  Tool::arrow, Tool::note};

struct ToolTraits {
  Tool tool;
  std::string_view name;  ///< in recordings ("add_vessel"), and in the window's command: "tool.add_vessel"
  std::optional<analysis::MeasureKind> measures;  ///< what it places; nothing for those that edit and look
};
/// Throws InvalidInput for a tool that is none of them.
const ToolTraits& traits_of(Tool tool);
/// The measurement that a tool places; nothing for the others.
std::optional<analysis::MeasureKind> measure_kind(Tool tool);

}  // namespace ostia::session
