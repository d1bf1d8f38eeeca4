#pragma once
/// \file Whether surfaces can be phases of one heart's cycle.

#include "ostia/pipeline/motion_fit.h"

#include <array>
#include <vector>

namespace ostia::pipeline {

inline constexpr std::size_t least_phases = 3;  // of a periodic spline

/// One way from the template through the cycle.
struct Way {
  std::vector<std::size_t> phases;  ///< in the order in which they are taken
};
/// Both ways from one of the rising `phases`, until they meet: each of the others belongs to the nearer one,
/// and to that alone.
std::array<Way, 2> ways(const std::vector<double>& phases, std::size_t from);

/// Throws InvalidInput that names the phase: out of [0, 1), twice, fewer than three with a surface, points
/// that are not finite, the template's unit.
void require_phases(const std::vector<PhaseSurface>& phases);
/// Throws InvalidInput for a surface that is of another size than the template's, or lies elsewhere.
void require_like(const std::vector<PhaseSurface>& phases, std::size_t template_index);
/// Throws InvalidInput that tells why phases cannot be used, where fewer than three can.
void require_enough(const std::vector<PhaseFit>& phases, std::size_t usable);

}  // namespace ostia::pipeline
