#include "ostia/geometry/cage_motion.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <cmath>

namespace ostia::geometry {

std::string percent_text(double phase) {
  return core::trimmed_text(std::round(phase * 1e4) / 1e2, 6) + " %";
}

void validate(const CageMotion& motion, const std::string& name) {
  const CageGrid& grid = motion.grid;
  if (grid.cells < 1 || grid.cells > 256 || !grid.origin.allFinite() || !grid.cell_mm.allFinite() ||
      grid.cell_mm.minCoeff() <= 0.0)
    throw InvalidInput(name + ": the grid needs 1 to 256 cells a side of more than 0 mm, at a finite place");
  if (!(motion.template_phase >= 0.0 && motion.template_phase < 1.0))
    throw InvalidInput(name + ": the template's phase must be from 0 to below 1, not " +
                       std::to_string(motion.template_phase));
  if (motion.phases.empty()) throw InvalidInput(name + " has no phases");
  double before = -1.0;
  for (const CagePhase& one : motion.phases) {
    if (!(one.phase >= 0.0 && one.phase < 1.0 && one.phase > before))
      throw InvalidInput(name + ": phases must rise from 0 to below 1; one is " + std::to_string(one.phase));
    before = one.phase;
    if (one.control_points.size() != grid.point_count())
      throw InvalidInput(name + ": the phase " + percent_text(one.phase) + " has " +
                         std::to_string(one.control_points.size()) + " control points, the grid has " +
                         std::to_string(grid.point_count()));
    for (const Vec3& p : one.control_points)
      if (!p.allFinite())
        throw InvalidInput(name + ": the phase " + percent_text(one.phase) +
                           " has a control point that is not a number");
  }
}

}  // namespace ostia::geometry
