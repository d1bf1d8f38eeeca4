#pragma once
/// \file Points as they are typed.

#include "ostia/geometry/vec.h"
#include "ostia/imaging/volume.h"

#include <string>
#include <string_view>
#include <vector>

namespace ostia::app {

/// The parts of a text between separators; one for a text without.
std::vector<std::string_view> parts_of(std::string_view text, char separator);

/// "x,y,z" in the frame that `coords` names: lps and ras in mm, ijk in voxels of `grid` (needed for ijk
/// alone). Throws InvalidInput that shows the text.
geometry::Vec3 parse_point(std::string_view text, const std::string& coords, const imaging::Geometry* grid);

/// Numbers in the frame that `coords` names, as world LPS. Throws InvalidInput for ijk without a grid.
geometry::Vec3 world_of(const geometry::Vec3& given, const std::string& coords,
                        const imaging::Geometry* grid);

}  // namespace ostia::app
