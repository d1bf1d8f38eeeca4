#pragma once
/// \file A cage over the cycle of the heart as JSON: docs/schemas/cage-motion.schema.json. World LPS, mm.

#include "ostia/geometry/cage_motion.h"

#include <filesystem>
#include <string>

namespace ostia::io {

struct CageMotionFile {
  geometry::CageMotion motion;
  /// Name of the template's surface, a file beside this one; empty: none.
  std::string surface;
};

/// A phase as the percent of the cycle that files have, to nine digits behind the point; never 100, which is
/// the next cycle's 0.
double percent_of(double phase);

/// Throws InvalidInput that names the file and the field (no JSON, another version, unit or axes, a member
/// that is missing or of another kind, fewer than 3 or more than 1000 phases, what geometry::validate
/// refuses, a surface's name with a folder), IoError.
CageMotionFile read_cage_motion(const std::filesystem::path& path);

/// Whole or not at all. Numbers are read back as they were; phases, written as percent of the cycle, to
/// within 1e-11. Throws InvalidInput for what could not be read again (geometry::validate, the number of
/// phases, a surface's name with a folder); IoError, ResourceError.
void write_cage_motion(const std::filesystem::path& path, const CageMotionFile& file);

}  // namespace ostia::io
