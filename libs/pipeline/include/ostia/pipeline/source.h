#pragma once
/// \file What a job starts from: a DICOM folder or a zip of one, an image, a mask or a surface.

#include "ostia/centerline/known_surface.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/dicom.h"
#include "ostia/imaging/scan_technique.h"
#include "ostia/imaging/volume.h"
#include "ostia/meshing/flat_caps.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

enum class SourceKind { dicom, image, mask, surface };
std::string name_of(SourceKind kind);

/// By what is there: a folder, a file with a DICOM header or a zip, a surface's or an image's extension; an
/// image of few different values is a mask, and so is a DICOM segmentation or structure set, or a folder of
/// one. Throws IoError when there is nothing, InvalidInput when it is
/// none of these.
SourceKind classify(const std::filesystem::path& path);

struct SourceOptions {
  imaging::DicomReadOptions dicom;
  /// mm in the file's unit of length; nothing: told by the vessels' calibre (unit_by_calibre).
  std::optional<double> unit_mm;
  bool strict = false;    ///< a surface with faults is refused instead of mended
  bool for_axes = false;  ///< of a surface centerlines are taken next (IntakeOptions::for_axes)
};

/// The content, and how it is known in everything that is saved.
struct Source {
  SourceKind kind = SourceKind::image;
  std::string sha256;     ///< of the file; of a DICOM series: imaging::series_digest
  std::string pseudonym;  ///< "image-1a2b3c4d"
  std::shared_ptr<const imaging::ImageVolume> image;  ///< dicom and image
  std::shared_ptr<const imaging::MaskVolume> mask;    ///< mask
  geometry::TriMesh surface;            ///< surface: mended, outward, its flat caps off (take_surface)
  std::vector<meshing::GivenEnd> ends;  ///< surface: caps that were taken off
  std::vector<meshing::GivenEnd> lost;  ///< surface: TakenSurface::lost
  std::shared_ptr<const centerline::KnownSurface> known;  ///< surface: TakenSurface::known
  double unit_mm = 1.0;     ///< surface: of the file, in which points are given, too
  bool unit_given = false;  ///< surface: the user said which unit it is in
  std::vector<std::string> warnings;
  std::optional<imaging::ScanTechnique> technique = {};  ///< dicom: as its headers say
  std::filesystem::path series_file = {};  ///< dicom: the first of the series that was read; of a zip none
};

/// Reads it. From here on the log knows the path by the pseudonym alone. Throws what the readers throw;
/// InvalidInput for a surface of a size that no vessel has in any unit. What was mended on a surface is among
/// the warnings.
Source load(const std::filesystem::path& path, const SourceOptions& options = {},
            const core::TaskContext& task = core::no_task());

/// A DICOM series or an image. Throws as `load` does, and InvalidInput for a mask or a surface before it is
/// read.
Source load_ct(const std::filesystem::path& path, const SourceOptions& options = {},
               const core::TaskContext& task = core::no_task());

/// Throws InvalidInput when a vessel's surface is wider than 100 mm or thinner than 0.1 mm as it stands
/// ("give --units").
void check_vessel_size(double width_mm, const std::string& what);

}  // namespace ostia::pipeline
