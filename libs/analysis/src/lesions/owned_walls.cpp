#include "lesions/owned_walls.h"

#include "names/vessel_way.h"

#include "ostia/core/error.h"

#include <string>

namespace ostia::analysis {

OwnedWalls::OwnedWalls(const lumen::LumenModel& model, const SurfaceOfVessel& surface_of, std::int32_t vessel)
    : surface_of_(surface_of), axis_(lumen::vessel(model, vessel).axis) {
  if (!surface_of) throw InvalidInput("a lumen can only be measured with its walls: surface_of is empty");
  if (!axis_) throw InvalidInput("vessel " + std::to_string(vessel) + " has no axis");
  for (const std::int32_t segment : path_of(model.tree, vessel).segments) {
    const std::int32_t owner = owner_of_segment(model.tree, segment).id;
    if (!stretches_.empty() && stretches_.back().second == owner) continue;
    stretches_.emplace_back(stretches_.empty() ? 0.0 : lumen::vessel(model, owner).own_from_mm, owner);
  }
}

std::int32_t OwnedWalls::owner(double s_mm) const {
  std::size_t i = stretches_.size() - 1;
  while (i > 0 && s_mm < stretches_[i].first) --i;
  return stretches_[i].second;
}

void OwnedWalls::ask(double s_mm) {
  const std::int32_t owning = owner(s_mm);
  if (walls_.count(owning) > 0) return;
  auto wall = surface_of_(owning);
  if (!wall) throw InvalidInput("vessel " + std::to_string(owning) + " has no solved wall to be measured");
  walls_.emplace(owning, std::move(wall));
}

}  // namespace ostia::analysis
