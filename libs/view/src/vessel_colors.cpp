#include "ostia/view/vessel_colors.h"

#include "ostia/analysis/aha_segments.h"

#include <array>
#include <map>
#include <vector>

namespace ostia::view {
namespace {

using figure::Color;

/// By the usual name without its number, and the number: more of a kind than there are colours begin anew.
const std::map<std::string, std::vector<Color>>& colors_of_names() {
  static const std::map<std::string, std::vector<Color>> colors{
      {"LM", {{0.94, 0.89, 0.26}}},
      {"LAD", {{0.90, 0.62, 0.00}}},
      {"D", {{0.84, 0.37, 0.00}, {0.98, 0.72, 0.44}, {0.72, 0.48, 0.22}}},
      {"S", {{0.62, 0.36, 0.16}, {0.80, 0.62, 0.44}}},
      {"RI", {{0.72, 0.78, 0.20}}},
      {"LCX", {{0.00, 0.62, 0.45}}},
      {"OM", {{0.47, 0.83, 0.58}, {0.00, 0.44, 0.34}, {0.30, 0.70, 0.30}}},
      {"LPDA", {{0.20, 0.52, 0.42}}},
      {"LPLB", {{0.62, 0.86, 0.76}}},
      {"RCA", {{0.34, 0.71, 0.91}}},
      {"CB", {{0.62, 0.82, 0.98}}},
      {"AM", {{0.18, 0.54, 0.78}}},
      {"PDA", {{0.00, 0.45, 0.70}}},
      {"PLB", {{0.45, 0.56, 0.92}}},
  };
  return colors;
}

constexpr std::array<Color, 4> nameless{
    {{0.80, 0.47, 0.65}, {0.60, 0.40, 0.80}, {0.93, 0.62, 0.78}, {0.55, 0.45, 0.60}}};

}  // namespace

figure::Color vessel_color(const std::string& name, std::int32_t id) {
  const std::string usual = analysis::usual_name(name);
  const std::size_t letters = usual.find_first_of("0123456789");
  const auto found = colors_of_names().find(usual.substr(0, letters));
  if (usual.empty() || found == colors_of_names().end())
    return nameless[static_cast<std::size_t>(id < 0 ? -(id + 1) : id) % nameless.size()];
  const int number = letters == std::string::npos ? 1 : std::stoi(usual.substr(letters));
  return found->second[static_cast<std::size_t>(number > 0 ? number - 1 : 0) % found->second.size()];
}

figure::Color vessel_color(const session::Workbench& bench, std::int32_t vessel) {
  if (bench.has_case()) {
    const auto annotations = bench.session().file().annotations();
    const session::VesselMark* mark = session::find_mark(*annotations, vessel);
    if (mark && mark->color) return {(*mark->color)[0], (*mark->color)[1], (*mark->color)[2], 1.0};
  }
  return vessel_color(bench.vessel_name(vessel), vessel);
}

}  // namespace ostia::view
