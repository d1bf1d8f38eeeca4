#pragma once
/// \file Whether surfaces can be phases of one heart's cycle.

#include "ostia/pipeline/motion_fit.h"

#include <vector>

namespace ostia::pipeline {

/// Throws InvalidInput that names the phase: out of [0, 1), twice, fewer than three with a surface, points
/// that are not finite, the template's unit.
void require_phases(const std::vector<PhaseSurface>& phases);
/// Throws InvalidInput for a surface that is of another size than the template's, or lies elsewhere.
void require_like(const std::vector<PhaseSurface>& phases, std::size_t template_index);
/// Throws InvalidInput that tells why phases cannot be used, where fewer than three can.
void require_enough(const std::vector<PhaseFit>& phases, std::size_t usable);

}  // namespace ostia::pipeline
