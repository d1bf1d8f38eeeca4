#pragma once
/// \file The lumen's size along a vessel over the heart's cycle: a 4D profile.

#include "ostia/core/task_context.h"
#include "ostia/session/beating.h"
#include "ostia/session/workbench.h"

#include <cstdint>
#include <vector>

namespace ostia::session {

/// The lumen's outlines across a vessel at the case's own phase, every millimetre.
struct LumenRings {
  std::int32_t vessel = 0;
  std::vector<double> s_mm;  ///< rising
  std::vector<std::vector<Vec3>>
      rings;                        ///< about each abscissa, in order; empty where the lumen was not found
  std::vector<Vec3> before, after;  ///< places of the axis on either side of it
};
/// What `lumen_rings` needs, of the case as it is now. Throws InvalidInput for a vessel that is not there.
ProfileWork ring_work(const Session& session, std::int32_t vessel);
/// Takes its time; any thread. Throws as analysis::measured_section does; Cancelled.
LumenRings lumen_rings(const ProfileWork& work, const core::TaskContext& task = core::no_task());

/// Of the lumen where the cage has carried it.
struct BeatingProfile {
  std::int32_t vessel = 0;
  std::vector<double> s_mm;    ///< at the case's own phase
  std::vector<double> phases;  ///< evenly spaced, from 0
  /// [phase][section] area across the carried axis: that of the outline seen along it, since what was a plane
  /// across the vessel may lie obliquely there, and a tube cut obliquely has its own cross-section when seen
  /// so; NaN where there is no outline.
  std::vector<std::vector<double>> area_mm2;
  double diameter_mm(std::size_t phase, std::size_t section) const;  ///< of the circle of that area
};
/// At `phases` phases, 3 at least. Throws InvalidInput.
BeatingProfile beating_profile(const LumenRings& rings, const Beating& beating, std::size_t phases = 50);

}  // namespace ostia::session
