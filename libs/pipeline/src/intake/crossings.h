#pragma once
/// \file Where a surface crosses itself: handed on by the steps of a repair, which do not move what they find
/// sound.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace ostia::pipeline {

/// Pairs of triangles, as geometry::self_intersections gives them.
using Crossings = std::vector<std::pair<std::int32_t, std::int32_t>>;
/// Of a mesh as it is now; nothing: it has moved since they were looked for.
using KnownCrossings = std::optional<Crossings>;

}  // namespace ostia::pipeline
