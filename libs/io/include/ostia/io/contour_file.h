#pragma once
/// \file Contour files: JSON, docs/schemas/contours.schema.json and docs/reference/contours.md.

#include "ostia/geometry/contour_set.h"

#include <filesystem>

namespace ostia::io {

/// Throws InvalidInput ("FILE: field: what is wrong, the way out") for a file that is empty, not this format,
/// of another version, unit or axis convention, or holds a section with a fault (geometry::find_fault).
geometry::ContourSet read_contours(const std::filesystem::path& path);
/// Whole or not at all. Numbers with 6 decimals. Throws IoError.
void write_contours(const std::filesystem::path& path, const geometry::ContourSet& contours);

/// How a foreign, column-wise text file of contours is read: which column (from 0) holds what.
struct ContourColumns {
  int section = 0, s_mm = 1, x = 2, y = 3, z = 4;
  int observer = -1, vessel = -1, health = -1;  ///< -1: not there; then the names below are taken
  std::string default_observer = "observer1", default_vessel = "vessel0";
  std::string diseased_word = "diseased";  ///< what the health column says for a diseased section
  char separator = ' ';                    ///< ' ' is any run of blanks
  bool ras = false;                        ///< x and y negated at the door
  double unit_mm = 1.0;                    ///< 10 for centimetres
};
/// One point a line, `#` starts a comment; points of equal section, observer and s_mm in a row are one
/// contour. Contours that run clockwise are reversed; the first point stays.
geometry::ContourSet read_contour_table(const std::filesystem::path& path, const ContourColumns& columns);

}  // namespace ostia::io
