#pragma once
/// \file Points, and polygons or lines, with arrays under names of the caller's choice, for tools that read
/// VTK's files.

#include "ostia/io/surface_fields.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ostia::io {

/// Arrays by name: numbers, and whole numbers of one component.
struct PolydataArrays {
  PointFields numbers;
  std::map<std::string, std::vector<std::int32_t>> whole;
};

struct Polydata {
  std::vector<geometry::Vec3> points;
  std::vector<std::vector<std::int32_t>> polygons;  ///< none, and no lines: each point is a vertex of its own
  PolydataArrays at_points, at_cells;
  std::vector<std::vector<std::int32_t>> lines = {};  ///< instead of polygons
};

/// VTP. Throws InvalidInput for a polygon or line with a point that is not there, for both together, or an
/// array of another length; IoError.
void write_polydata(const std::filesystem::path& path, const Polydata& data);

}  // namespace ostia::io
