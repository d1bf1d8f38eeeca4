#include "branches/branch_tubes.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <limits>

namespace ostia::analysis {

BranchTubes::BranchTubes(const BranchTracts& tracts) {
  for (const std::int32_t group : tracts.groups(false)) {
    Tube tube{group, {}};
    for (const BranchTract* one : tracts.distinct(group)) tube.lines.emplace_back(one->axis);
    tubes_.push_back(std::move(tube));
  }
}

double BranchTubes::value(const Tube& tube, const geometry::Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::BallLine& line : tube.lines) least = std::min(least, line.value(x));
  return least;
}

double BranchTubes::value(std::int32_t group, const geometry::Vec3& x) const {
  const auto found =
      std::find_if(tubes_.begin(), tubes_.end(), [&](const Tube& tube) { return tube.group == group; });
  return found == tubes_.end() ? std::numeric_limits<double>::infinity() : value(*found, x);
}

std::int32_t BranchTubes::nearest(const geometry::Vec3& x) const {
  std::int32_t best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const Tube& tube : tubes_) {
    const double v = value(tube, x);
    if (v < least) {
      least = v;
      best = tube.group;
    }
  }
  return best;
}

std::vector<std::int32_t> BranchTubes::nearest(const std::vector<geometry::Vec3>& places) const {
  constexpr std::size_t grain = 256;
  std::vector<std::int32_t> groups(places.size());
  core::parallel_for(places.size(), grain, [&](std::size_t i) { groups[i] = nearest(places[i]); });
  return groups;
}

}  // namespace ostia::analysis
