#pragma once
/// \file Points, lines and curves that a person placed: 3D Slicer's markups (.mrk.json of schema 1.x, .fcsv)
/// and tables of points (.csv, .tsv). World LPS, mm; see MarkupsFile for files that do not say theirs.
/// https://slicer.readthedocs.io/en/latest/developer_guide/modules/markups.html

#include "ostia/geometry/vessel_tree.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::io {

enum class MarkupKind { fiducials, line, curve, closed_curve };

/// A list of points with a name.
struct Markup {
  MarkupKind kind = MarkupKind::fiducials;
  std::string name;                    ///< may be empty
  std::vector<geometry::Vec3> points;  ///< in the order they were placed
  std::vector<std::string> labels;     ///< as many as points, each may be empty; or none
  std::vector<double> radius;          ///< mm, as many as points; or none
};

struct MarkupsFile {
  std::vector<Markup> markups;  ///< one at least, each of one point at least
  /// Slicer's files say RAS or LPS, a table may by its columns (`r,a,s`, `l,p,s`). False: points are as the
  /// file has them, in whichever frame that is.
  bool frame_told = true;
  /// mm in the file's unit of length, where it says one: points have been brought to mm. Nothing: they are as
  /// the file has them.
  std::optional<double> unit_mm;
  std::vector<std::string> warnings;  ///< what was left out: points whose position is not defined, planes
};

/// By its name: .mrk.json or .fcsv, in any case.
bool is_markups_file(const std::filesystem::path& path);

/// By its name: one that `read_markups` takes?
bool is_point_file(const std::filesystem::path& path);

/// Reads by extension: .json (.mrk.json), .fcsv (of Slicer 3 to 5), .csv and .tsv. Of markups, fiducials,
/// lines, curves and angles are taken, and a measurement `Radius` of each point; points without a defined
/// position are left out. Tables: x,y,z[,label] without a header, or by one that names `x,y,z`, `r,a,s` or
/// `l,p,s` in any order, `label` and `vessel` where they are there; commas, semicolons or tabs; lists are
/// told apart by an empty row or another `vessel`. Throws InvalidInput that names file and place for what is
/// no such file, another schema, frame or unit, points that are not finite or 1e9 mm away, one without its
/// position, more than a million points, and for a file without a point; IoError, ResourceError (over 256
/// MB).
MarkupsFile read_markups(const std::filesystem::path& path);

/// Whole or not at all. .mrk.json: LPS, mm, schema 1.0.3, with a measurement `Radius` where there are radii;
/// .fcsv: all points as one list, RAS, without radii. Throws InvalidInput for another extension, nothing to
/// write, points that are not finite, labels or radii that are not one a point; IoError, ResourceError.
void write_markups(const std::filesystem::path& path, const std::vector<Markup>& markups);

/// A curve for each vessel, from its root to its end, with its radii.
std::vector<Markup> curves_of(const geometry::VesselTree& tree);
/// A tree of the curves and lines: joined where they run through one place (1e-6 mm), the way that several
/// share once, named after the curve that runs to each end. Points at the place of the one before are left
/// out. Throws InvalidInput, naming `what`, where there is none, or one without a radius or of one place.
geometry::VesselTree tree_of(const std::vector<Markup>& markups, const std::string& what);

/// Lists of the places where vessels begin ("ostia"), divide ("bifurcations") and end ("ends"), labelled by
/// the vessels' names; without those that would be empty.
std::vector<Markup> landmarks_of(const geometry::VesselTree& tree);

}  // namespace ostia::io
