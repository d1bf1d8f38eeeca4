#include "dicom_pixels.h"
#include "dicom_resample.h"
#include "dicom_series.h"
#include "dicom_syntax.h"

#include "ostia/core/error.h"
#include "ostia/imaging/archive.h"

#include <algorithm>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t kMaxVoxels = 1LL << 32;
constexpr std::int16_t kAir = -1024;  // HU, where no slice reaches

std::string listed(const std::vector<std::string>& lines, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, lines.size()); ++i) text += (i > 0 ? "; " : "") + lines[i];
  if (lines.size() > most) text += "; and " + std::to_string(lines.size() - most) + " more";
  return text;
}

std::string in_words(const DicomSeries& s) {
  return s.uid + " (" + s.modality + (s.phase.empty() ? "" : ", " + s.phase) + ", " +
         std::to_string(s.geometry.size[0]) + " x " + std::to_string(s.geometry.size[1]) + ", " +
         std::to_string(s.files.size()) + " slices)";
}

[[noreturn]] void refuse(const DicomSeries& series) {
  throw InvalidInput("DICOM series " + in_words(series) + " cannot be read: " + listed(series.faults, 4));
}

/// The series asked for, or the only one that can be read.
DicomSeriesDetail& chosen_of(DicomScan& scan, const fs::path& from, const DicomReadOptions& options,
                             std::vector<std::string>& warnings) {
  if (scan.series.empty()) {
    std::string text = "no DICOM image in '" + from.string() + "'";
    if (!scan.damaged.empty()) text += ": " + listed(scan.damaged, 4);
    throw InvalidInput(text);
  }
  std::vector<DicomSeriesDetail*> readable;
  std::vector<std::string> names;
  for (DicomSeriesDetail& series : scan.series) {
    if (!options.series_uid.empty() && series.summary.uid == options.series_uid) return series;
    if (series.summary.faults.empty()) readable.push_back(&series);
    names.push_back(in_words(series.summary));
  }
  if (!options.series_uid.empty()) {
    throw InvalidInput("no series " + options.series_uid + " in '" + from.string() + "'; there are " +
                       listed(names, 20));
  }
  if (readable.empty()) refuse(scan.series.front().summary);
  if (readable.size() > 1) {
    names.clear();
    for (const DicomSeriesDetail* series : readable) names.push_back(in_words(series->summary));
    throw InvalidInput(std::to_string(names.size()) + " series in '" + from.string() +
                       "'; choose one (--series UID): " + listed(names, 20));
  }
  if (scan.series.size() > 1) {
    warnings.push_back(std::to_string(scan.series.size() - 1) +
                       " other series cannot be read and were passed over");
  }
  return *readable.front();
}

/// Sheared or uneven slices onto an even orthogonal grid.
ImageVolume evened(const DicomSeriesDetail& series, const ImageVolume& volume,
                   const core::TaskContext& task) {
  SliceStack stack;
  const DicomSlice& first = series.slices.front();
  for (const DicomSlice& slice : series.slices) {
    stack.depth_mm.push_back(slice.depth_mm - first.depth_mm);
    stack.shift_x_mm.push_back(series.sheared ? slice.shift_mm[0] : 0.0);
    stack.shift_y_mm.push_back(series.sheared ? slice.shift_mm[1] : 0.0);
  }
  const std::int64_t slices = series.summary.uneven ? series.even_slices : volume.geometry.size[2];
  task.set_stage("resampling DICOM");
  const std::int16_t outside = series.summary.modality == "CT" ? kAir : 0;
  return restacked(volume, stack, slices, outside, task);
}

/// The image of one series; `warnings` are what was said before of the folder.
LoadedImage<std::int16_t> read_one(const DicomSeriesDetail& series, const DicomReadOptions& options,
                                   std::vector<std::string> warnings, const core::TaskContext& task) {
  if (!series.summary.faults.empty()) refuse(series.summary);
  if (series.summary.uneven && !options.resample_uneven) {
    throw InvalidInput("DICOM series " + in_words(series.summary) + ": " +
                       listed(series.summary.warnings, 8) +
                       "; pass --resample (resample_uneven) to interpolate there");
  }
  if (series.summary.geometry.voxels() > kMaxVoxels) {
    throw InvalidInput("DICOM series " + in_words(series.summary) + " has more than " +
                       std::to_string(kMaxVoxels) + " voxels");
  }
  warnings.insert(warnings.end(), series.summary.warnings.begin(), series.summary.warnings.end());

  LoadedImage<std::int16_t> result;
  Rescaled count;
  result.volume = decode_slices(series.slices, series.summary.geometry, count, task.sub(0.0, 0.8));
  if (series.sheared || series.summary.uneven)
    result.volume = evened(series, result.volume, task.sub(0.8, 1.0));
  if (count.clamped > 0) {
    warnings.push_back(std::to_string(count.clamped) +
                       " voxels lie outside [-32768, 32767] HU and were clamped");
  }
  if (count.rounded > 0)
    warnings.push_back(std::to_string(count.rounded) + " voxels were rounded to whole HU");
  if (series.summary.uneven) {
    warnings.push_back("resampled to even slices, " + std::to_string(series.even_spacing_mm) + " mm apart");
  }
  ImageHeader& header = result.header;
  header.format = "DICOM";
  header.geometry = result.volume.geometry;
  header.pixel_type = PixelType::int16;
  header.slope = series.slices.front().info().slope.value_or(1.0);
  header.intercept = series.slices.front().info().intercept.value_or(0.0);
  header.warnings = std::move(warnings);
  task.set_progress(1.0);
  return result;
}

}  // namespace

LoadedImage<std::int16_t> read_dicom(const fs::path& from, const DicomReadOptions& options,
                                     const core::TaskContext& task,
                                     const std::function<void(const DicomSeries&)>& chosen) {
  if (is_zip_archive(from)) {
    const auto archive =
        std::make_shared<const UnpackedArchive>(unpack_archive(from, {}, task.sub(0.0, 0.3)));
    return read_dicom(archive->folder(), options, task.sub(0.3, 1.0), [&](DicomSeries series) {
      series.archive = archive;
      if (chosen) chosen(series);
    });
  }
  task.set_stage("reading DICOM headers");
  DicomScan scan = scan_dicom_slices(from, options, task.sub(0.0, 0.1));
  std::vector<std::string> warnings;
  const DicomSeriesDetail& series = chosen_of(scan, from, options, warnings);
  if (chosen) chosen(series.summary);
  if (!scan.damaged.empty()) {
    warnings.push_back(std::to_string(scan.damaged.size()) + " damaged files in the folder were passed over");
  }
  return read_one(series, options, std::move(warnings), task.sub(0.1, 1.0));
}

LoadedImage<std::int16_t> read_dicom_series(const DicomSeries& series, const DicomReadOptions& options,
                                            const core::TaskContext& task) {
  task.set_stage("reading DICOM headers");
  const DicomSeriesDetail detail = scan_dicom_series(series, options, task.sub(0.0, 0.1));
  return read_one(detail, options, {}, task.sub(0.1, 1.0));
}

}  // namespace ostia::imaging
