#include "ostia/session/tool.h"

#include "ostia/core/error.h"

#include <algorithm>

namespace ostia::session {
namespace {

using analysis::MeasureKind;

constexpr std::array<ToolTraits, all_tools.size()> tool_table = {{
    {Tool::browse, "browse", {}},
    {Tool::drag, "drag", {}},
    {Tool::draw, "draw", {}},
    {Tool::brush, "brush", {}},
    {Tool::axis, "axis", {}},
    {Tool::add_vessel, "add_vessel", {}},
    {Tool::add_artery, "add_artery", {}},
    {Tool::distance, "distance", MeasureKind::distance},
    {Tool::angle, "angle", MeasureKind::angle},
    {Tool::area, "area", MeasureKind::area},
    {Tool::diameter, "diameter", MeasureKind::diameter},
    {Tool::stenosis, "stenosis", MeasureKind::stenosis},
    {Tool::volume, "volume", MeasureKind::volume},
    {Tool::ring_hu, "ring_hu", MeasureKind::ring_hu},
    {Tool::arrow, "arrow", MeasureKind::arrow},
    {Tool::note, "note", MeasureKind::note},
}};

}  // namespace

const ToolTraits& traits_of(Tool tool) {
  const auto found = std::ranges::find(tool_table, tool, &ToolTraits::tool);
  if (found == tool_table.end()) throw InvalidInput("a tool that is none of those there are");
  return *found;
}

std::optional<analysis::MeasureKind> measure_kind(Tool tool) {
  return traits_of(tool).measures;
}

}  // namespace ostia::session
