#include "ostia/pipeline/source.h"

#include "ostia/core/background_task.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/dicom/label_object.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/archive.h"
#include "ostia/imaging/foreign_image.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/surface_intake.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>

namespace ostia::pipeline {
namespace fs = std::filesystem;
namespace {

constexpr double widest_vessel_mm = 100.0;
constexpr double thinnest_vessel_mm = 0.1;

bool has_dicom_mark(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, 132> start{};
  in.read(start.data(), start.size());
  return in.gcount() == static_cast<std::streamsize>(start.size()) &&
         std::string_view(start.data() + 128, 4) == "DICM";
}

bool is_image_name(const fs::path& path) {
  const std::string name = path.filename().string();
  for (const std::string_view end : {".nrrd", ".nhdr", ".mhd", ".mha", ".nii", ".nii.gz", ".hdr"}) {
    if (name.size() > end.size() && name.ends_with(end)) return true;
  }
  return false;
}

void append_warnings(std::vector<std::string>& to, const std::vector<std::string>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// 0 and 1.
imaging::LoadedImage<std::uint8_t> mask_in(const fs::path& path, const core::TaskContext& task) {
  if (!dicom::label_object_in(path)) return imaging::read_mask(path, task);
  auto loaded = dicom::read_labels(path, task);
  for (std::uint8_t& voxel : loaded.volume.voxels) voxel = voxel != 0;
  return loaded;
}

void load_surface(const fs::path& path, const SourceOptions& options, Source& source,
                  const core::TaskContext& task) {
  io::LoadedSurface loaded = io::read_surface(path);
  append_warnings(source.warnings, loaded.warnings);
  TakenSurface taken = take_surface(std::move(loaded.surface), path.string(),
                                    {options.unit_mm, options.strict, options.for_axes}, task);
  for (const std::string& line : taken.told) source.warnings.push_back("the surface: " + line);
  source.surface = std::move(taken.lumen);
  source.ends = std::move(taken.ends);
  source.lost = std::move(taken.lost);
  source.known = std::move(taken.known);
  source.unit_mm = taken.unit_mm;
  source.unit_given = options.unit_mm.has_value();
}

}  // namespace

std::string name_of(SourceKind kind) {
  switch (kind) {
    case SourceKind::dicom:
      return "DICOM series";
    case SourceKind::image:
      return "image";
    case SourceKind::mask:
      return "mask";
    case SourceKind::surface:
      break;
  }
  return "surface";
}

void check_vessel_size(double width_mm, const std::string& what) {
  if (width_mm > widest_vessel_mm || width_mm < thinnest_vessel_mm) {
    throw InvalidInput(what + " would be a vessel " +
                       (width_mm > widest_vessel_mm ? "wider than 100 mm" : "thinner than 0.1 mm") +
                       ": its unit is hardly the millimetre; say which it is with --units m, cm or mm");
  }
}

SourceKind classify(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw IoError("cannot read " + path.string() + ": there is no such file or folder");
  if (dicom::label_object_in(path)) return SourceKind::mask;
  if (fs::is_directory(path)) return SourceKind::dicom;
  if (!fs::is_regular_file(path))
    throw InvalidInput("cannot read " + path.string() + ": it is neither a file nor a folder");
  if (io::is_surface_file(path)) return SourceKind::surface;
  if (is_image_name(path) || !imaging::foreign_image_format(path).empty())
    return imaging::looks_like_mask(path) || imaging::looks_like_probabilities(path) ? SourceKind::mask
                                                                                     : SourceKind::image;
  if (path.extension() == ".dcm" || has_dicom_mark(path) || imaging::is_zip_archive(path))
    return SourceKind::dicom;
  if (io::is_graph_file(path))
    throw InvalidInput(
        "cannot read " + path.string() +
        " here: it holds lines of vessels, and an image, a mask or a surface is needed (what has "
        "--centerline takes lines there)");
  throw InvalidInput(
      "cannot read " + path.string() +
      ": it is no DICOM folder, file or zip, no image (.nrrd .nhdr .mhd .mha .nii .nii.gz) and no surface "
      "(.stl .ply .obj .vtp .vtk)");
}

Source load(const fs::path& path, const SourceOptions& options, const core::TaskContext& task) {
  Source source;
  source.kind = classify(path);
  core::redact_in_logs(path.string(), "image");  // until its pseudonym is known
  std::optional<core::BackgroundTask<std::string>> sha256;
  if (source.kind != SourceKind::dicom) {
    const fs::path file = dicom::label_object_in(path).value_or(path);  // a folder may hold a segmentation
    sha256.emplace([file](const core::TaskContext&) { return core::sha256_file(file); });
  }
  switch (source.kind) {
    case SourceKind::dicom: {
      auto loaded = imaging::read_dicom(path, options.dicom, task, [&](const imaging::DicomSeries& series) {
        sha256.emplace([series](const core::TaskContext& beside) { return series_digest(series, beside); });
        source.technique = imaging::scan_technique(series);
        if (!series.archive && !series.files.empty()) source.series_file = series.files.front();
      });
      append_warnings(source.warnings, loaded.header.warnings);
      source.image = std::make_shared<const imaging::ImageVolume>(std::move(loaded.volume));
      break;
    }
    case SourceKind::image: {
      auto loaded = imaging::read_image(path, task);
      append_warnings(source.warnings, loaded.header.warnings);
      source.image = std::make_shared<const imaging::ImageVolume>(std::move(loaded.volume));
      break;
    }
    case SourceKind::mask: {
      auto loaded = mask_in(path, task);
      append_warnings(source.warnings, loaded.header.warnings);
      source.mask = std::make_shared<const imaging::MaskVolume>(std::move(loaded.volume));
      break;
    }
    case SourceKind::surface:
      load_surface(path, options, source, task);
      break;
  }
  source.sha256 = sha256->get();
  source.pseudonym = "image-" + source.sha256.substr(0, 8);
  core::redact_in_logs(path.string(), source.pseudonym);
  task.throw_if_cancelled();
  task.set_progress(1.0);
  return source;
}

Source load_ct(const fs::path& path, const SourceOptions& options, const core::TaskContext& task) {
  const SourceKind kind = classify(path);
  if (kind == SourceKind::mask || kind == SourceKind::surface)
    throw InvalidInput(path.string() + " is a " + name_of(kind) + " and no CT image");
  return load(path, options, task);
}

}  // namespace ostia::pipeline
