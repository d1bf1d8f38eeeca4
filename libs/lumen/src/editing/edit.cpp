#include "ostia/lumen/edit.h"

#include "editing/edit_kinds.h"

#include <array>

namespace ostia::lumen {

std::string op_name(const Edit& edit) {
  static constexpr std::array<const char*, std::variant_size_v<Edit>> names{
      "cpr.stroke",   "section.contour", "wall.drag",  "wall.push",      "axis.move",     "axis.insert",
      "axis.delete",  "axis.extend",     "axis.trim",  "branch.add",     "branch.delete", "branch.attach",
      "branch.split", "branch.merge",    "branch.cut", "branch.connect", "vessel.rename", "vessel.add"};
  return names[edit.index()];
}

EditOutcome apply(const LumenModel& model, const Edit& edit) {
  return std::visit([&](const auto& kind) { return apply_to(model, kind); }, edit);
}

}  // namespace ostia::lumen
