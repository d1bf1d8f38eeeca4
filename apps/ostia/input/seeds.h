#pragma once
/// \file Seeds: places that a person points at, typed or in a file of points.

#include "commands.h"

#include "ostia/imaging/volume.h"
#include "ostia/pipeline/source.h"
#include "ostia/segmentation/seeds.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::app {

/// In which frame and unit the places are. Files of points that say theirs (3D Slicer's markups) keep it.
struct SeedFrame {
  std::string coords = "lps";               ///< lps, ras, ijk
  const imaging::Geometry* grid = nullptr;  ///< of the input, where it is an image or a mask
  double unit_mm = 1.0;                     ///< of the input's own coordinates, where it is a surface
  std::optional<double> seed_unit_mm = std::nullopt;  ///< of the places, where the user says it
  geometry::Box3 box = {};                            ///< of the input's surface, mm; empty: not known
};
/// `source` must live as long as the frame.
SeedFrame seed_frame(const InputOptions& input, const pipeline::Source& source,
                     const std::string& seed_units = "");

/// Does the text name a file of points (.mrk.json, .json, .fcsv, .csv, .tsv, or a file that is there)?
bool names_point_file(std::string_view text);

/// Places as world LPS, mm: "x,y,z", or all points of a file. What is left out of a file goes to the log.
/// Throws InvalidInput that shows the text, or names the file; IoError.
std::vector<geometry::Vec3> seed_points(const std::string& text, const SeedFrame& frame);
/// The same where one place is wanted; `option` is named where a file has several.
geometry::Vec3 seed_point(const std::string& option, const std::string& text, const SeedFrame& frame);
/// "P:P" or "P:P:P"; or a file, each of whose lists and curves is a vessel: from, through any number of
/// points, to. Where it passes through more than one point, in pieces that meet. Throws as seed_points does,
/// and InvalidInput for a list of one point.
std::vector<segmentation::BranchSeeds> seed_branches(const std::string& text, const SeedFrame& frame);

/// What a job's digest has for a place: the text, or that of the file's content, never its name.
std::string seed_digest(const std::string& text);

}  // namespace ostia::app
