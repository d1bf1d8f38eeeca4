#pragma once
/// \file Long calcium and closed stretches in a coronary tree whose sections are chosen.

#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/obstacles.h"
#include "ostia/phantom/sections.h"

#include <cstdint>
#include <vector>

namespace ostia::phantom {

/// Clear of the annotated sections, bifurcations and lesions; less than asked for where there is no room.
void add_obstacles(CoronaryTree& tree, const Obstacles& obstacles,
                   const std::vector<AnnotatedSection>& sections, std::uint64_t seed);

}  // namespace ostia::phantom
