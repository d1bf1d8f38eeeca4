#include "wall/job.h"

#include "ostia/core/error.h"

#include <cmath>
#include <string>

namespace ostia::lumen {

std::vector<double> WallJob::ask(const std::vector<Vec3>& places) {
  std::vector<double> out(places.size());
  if (places.empty()) return out;
  field_.values(places, out);
  evaluations_ += places.size();
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!std::isnan(out[i])) continue;
    throw InvalidInput("the lumen's field is not a number at " + std::to_string(places[i].x()) + ", " +
                       std::to_string(places[i].y()) + ", " + std::to_string(places[i].z()) +
                       " mm; solve its vessels again");
  }
  return out;
}

void WallJob::count_cells(std::size_t more) {
  if ((cells_ += more) <= largest_cells_) return;
  throw ResourceError("the lumen's wall passes more than " + std::to_string(largest_cells_) + " cells of " +
                      std::to_string(cell_mm_) +
                      " mm, more than the memory limit allows; take larger cells or raise memory_limit_mib");
}

}  // namespace ostia::lumen
