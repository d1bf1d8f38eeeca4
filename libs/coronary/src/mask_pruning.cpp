#include "mask_parting.h"

#include <algorithm>
#include <optional>
#include <set>

namespace ostia::coronary {

double prune_lines(LineGraph& graph, const std::vector<std::int32_t>& roots, double least_mm,
                   double alone_mm) {
  const std::set<std::int32_t> keep(roots.begin(), roots.end());
  double gone = 0.0;
  for (;;) {
    std::optional<std::int32_t> shortest;
    double shortest_mm = 1e9;
    for (const auto& [id, line] : graph.lines()) {
      if (line.from == line.to) continue;
      const std::size_t a = graph.degree(line.from), b = graph.degree(line.to);
      if (std::min(a, b) != 1) continue;
      const double mm = length_mm(line);
      double least = keep.contains(line.from) || keep.contains(line.to) ? 0.0 : alone_mm;
      if (a != 1 || b != 1) {
        const bool first = a == 1;
        if (keep.contains(first ? line.from : line.to) || std::max(a, b) == 2) continue;
        const double parent = graph.nodes().at(first ? line.to : line.from).radius_mm;
        least = least_mm + parent;
      }
      if (mm >= least || mm >= shortest_mm) continue;
      shortest = id;
      shortest_mm = mm;
    }
    if (!shortest) break;
    gone += shortest_mm;
    graph.remove_line(*shortest);
    graph.tidy(keep);
  }
  return gone;
}

}  // namespace ostia::coronary
