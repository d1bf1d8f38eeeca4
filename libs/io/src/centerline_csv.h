#pragma once
/// \file Centerlines as tables.

#include "ostia/io/centerline_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::io {

/// Whether its first row names x, y, z and radius of points along lines: no segments, no samples with
/// parents.
bool is_table_of_lines(const std::filesystem::path& path);
/// Throws InvalidInput that names the file and the row.
geometry::VesselTree read_centerline_table(const std::filesystem::path& path);
std::string centerline_table_text(const geometry::VesselTree& tree, const std::vector<AlongVessels>& along);

}  // namespace ostia::io
