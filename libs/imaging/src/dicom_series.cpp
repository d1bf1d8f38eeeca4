#include "dicom_series.h"

#include "dicom_syntax.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/archive.h"
#include "ostia/imaging/files_below.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

using SharedHeader = std::shared_ptr<const DicomHeader>;

struct Files {
  std::vector<SharedHeader> images;
  std::vector<SharedHeader> damaged;
  std::size_t skipped = 0;
};

Files read_headers(const std::vector<fs::path>& paths, const core::TaskContext& task) {
  std::vector<SharedHeader> headers(paths.size());
  const std::size_t block = 64;
  for (std::size_t first = 0; first < paths.size(); first += block) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(first) / static_cast<double>(paths.size()));
    core::parallel_for(std::min(block, paths.size() - first), 4, [&](std::size_t i) {
      try {
        if (auto file = parse_dicom(paths[first + i])) {
          headers[first + i] = std::make_shared<const DicomHeader>(std::move(file->header));
        }
      } catch (const IoError& error) {
        DicomHeader unread;
        unread.path = paths[first + i];
        unread.damage = error.what();
        headers[first + i] = std::make_shared<const DicomHeader>(std::move(unread));
      }
    });
  }
  Files files;
  for (const SharedHeader& header : headers) {
    if (header && !header->damage.empty()) {
      files.damaged.push_back(header);
    } else if (header && header->is_image()) {
      files.images.push_back(header);
    } else {
      ++files.skipped;
    }
  }
  return files;
}

bool is_localizer(const DicomHeader& header) {
  return header.image_type.find("LOCALIZER") != std::string::npos;
}

template <std::size_t n>
bool near(const std::optional<std::array<double, n>>& a, const std::optional<std::array<double, n>>& b,
          double tolerance) {
  if (!a || !b) return !a && !b;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(std::abs((*a)[i] - (*b)[i]) <= tolerance)) return false;
  }
  return true;
}

/// Two patients, or two studies, whose files lie in one folder, even where they share a series' number: what
/// takes names out of files sometimes gives all of them one. What a file does not say parts nothing.
bool of_two(const DicomWhose& a, const DicomWhose& b) {
  const auto differ = [](std::uint64_t p, std::uint64_t q) { return p != 0 && q != 0 && p != q; };
  const bool ids = a.patient_id != 0 && b.patient_id != 0;
  return differ(a.study, b.study) || differ(a.patient_id, b.patient_id) ||
         (!ids && differ(a.patient_name, b.patient_name));
}

/// Whether two frames may be slices of one volume.
bool belong_together(const DicomSlice& a, const DicomSlice& b) {
  const DicomHeader &h = *a.header, &g = *b.header;
  if (of_two(h.whose, g.whose)) return false;
  if (h.rows != g.rows || h.columns != g.columns || h.bits_allocated != g.bits_allocated ||
      h.samples != g.samples || h.is_signed != g.is_signed || is_localizer(h) != is_localizer(g)) {
    return false;
  }
  return near(a.info().orientation, b.info().orientation, 1e-3) &&
         near(a.info().pixel_spacing, b.info().pixel_spacing, 1e-4);
}

std::vector<std::vector<DicomSlice>> grouped(const std::vector<SharedHeader>& headers) {
  std::map<std::string, std::vector<std::vector<DicomSlice>>> by_uid;
  for (const SharedHeader& header : headers) {
    auto& groups = by_uid[header->series_uid];
    for (std::int64_t frame = 0; frame < header->frame_count; ++frame) {
      DicomSlice slice;
      slice.header = header;
      slice.frame = frame;
      const auto found = std::find_if(groups.begin(), groups.end(), [&](const std::vector<DicomSlice>& g) {
        return belong_together(g.front(), slice);
      });
      if (found != groups.end()) {
        found->push_back(slice);
      } else {
        groups.push_back({slice});
      }
    }
  }
  std::vector<std::vector<DicomSlice>> result;
  for (auto& [uid, groups] : by_uid) {
    std::stable_sort(groups.begin(), groups.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    for (auto& group : groups) result.push_back(std::move(group));
  }
  return result;
}

/// The same fault in many files is said once.
void add_pixel_faults(DicomSeriesDetail& series) {
  std::map<std::string, std::pair<std::string, std::size_t>> first_and_count;
  const DicomHeader* last = nullptr;
  for (const DicomSlice& slice : series.slices) {
    if (slice.header.get() == last) continue;
    last = slice.header.get();
    std::string fault = pixel_fault(*last);
    if (fault.empty() && slice.info().slope.value_or(1.0) == 0.0) fault = "RescaleSlope is 0";
    if (fault.empty()) continue;
    auto& entry =
        first_and_count.try_emplace(fault, "'" + last->path.filename().string() + "'", 0).first->second;
    ++entry.second;
  }
  for (const auto& [fault, entry] : first_and_count) {
    std::string text = entry.first;
    if (entry.second > 1) text += " and " + std::to_string(entry.second - 1) + " more";
    series.summary.faults.push_back(text + ": " + fault);
  }
}

/// What the user gave in the place of missing attributes.
SharedHeader completed(const SharedHeader& header, const DicomReadOptions& options) {
  const bool lacks_spacing =
      std::any_of(header->frames.begin(), header->frames.end(), [](const DicomFrame& f) {
        return !f.pixel_spacing || !((*f.pixel_spacing)[0] > 0.0 && (*f.pixel_spacing)[1] > 0.0);
      });
  const bool lacks_position = header->frame_count == 1 && !header->frames.front().position;
  const bool spacing = options.pixel_spacing_mm && lacks_spacing;
  const bool place = options.slice_spacing_mm && lacks_position && header->instance_number;
  const bool lie = options.assume_axial && std::any_of(header->frames.begin(), header->frames.end(),
                                                       [](const DicomFrame& f) { return !f.orientation; });
  if (!spacing && !place && !lie) return header;
  DicomHeader copy = *header;
  for (DicomFrame& frame : copy.frames) {
    if (spacing) frame.pixel_spacing = {*options.pixel_spacing_mm, *options.pixel_spacing_mm};
    if (lie && !frame.orientation) frame.orientation = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0};
    if (!place) continue;
    if (!frame.orientation) frame.orientation = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0};
    const auto& o = *frame.orientation;
    const Vec3 normal = Vec3(o[0], o[1], o[2]).cross(Vec3(o[3], o[4], o[5]));
    frame.position = normal * (*options.slice_spacing_mm * *header->instance_number);
  }
  return std::make_shared<const DicomHeader>(std::move(copy));
}

DicomSeriesDetail described(std::vector<DicomSlice> slices, const std::string& label) {
  DicomSeriesDetail series;
  series.slices = std::move(slices);
  const DicomHeader& header = *series.slices.front().header;
  DicomSeries& summary = series.summary;
  summary.uid = header.series_uid.empty() ? "unnamed" : header.series_uid;
  summary.modality = header.modality;
  summary.description = header.description;
  summary.transfer_syntax = transfer_syntax_name(header.transfer_syntax);
  summary.phase = label;
  summary.patient_number = header.whose.patient_id ? header.whose.patient_id : header.whose.patient_name;
  summary.study_number = header.whose.study;
  add_pixel_faults(series);
  if (is_localizer(header)) summary.faults.push_back("a localizer (scout) image, not a volume");
  if (summary.modality != "CT") {
    summary.warnings.push_back("modality " + (summary.modality.empty() ? "unknown" : summary.modality) +
                               ": values are not Hounsfield units");
  } else if (!series.slices.front().info().intercept) {
    summary.warnings.push_back("no RescaleIntercept: stored values are taken as Hounsfield units");
  }
  place_slices(series);
  const std::optional<double> percent = series.slices.front().info().cardiac_percent;
  if (std::all_of(series.slices.begin(), series.slices.end(),
                  [&](const DicomSlice& slice) { return slice.info().cardiac_percent == percent; }))
    summary.cardiac_percent = percent;
  std::map<const DicomHeader*, std::int64_t> frames;
  for (const DicomSlice& slice : series.slices) {
    summary.files.push_back(slice.header->path);
    summary.frames.push_back(slice.frame);
    ++frames[slice.header.get()];
  }
  summary.whole_files = std::all_of(frames.begin(), frames.end(),
                                    [](const auto& file) { return file.second == file.first->frame_count; });
  return series;
}

std::vector<DicomSeriesDetail> series_of(const Files& files, const DicomReadOptions& options) {
  std::vector<SharedHeader> images;
  bool stacked = false;
  for (const SharedHeader& header : files.images) {
    images.push_back(completed(header, options));
    stacked = stacked || (!header->frames.front().position && images.back()->frames.front().position);
  }
  std::vector<DicomSeriesDetail> all;
  std::map<std::string, int> count;
  for (std::vector<DicomSlice>& group : grouped(images)) {
    DicomPhases phases;
    if (set_depths(group)) {
      phases = split_phases(std::move(group));
    } else {
      phases.parts.push_back(std::move(group));
      phases.labels.emplace_back();
    }
    for (std::size_t i = 0; i < phases.parts.size(); ++i) {
      DicomSeriesDetail series = described(std::move(phases.parts[i]), phases.labels[i]);
      auto& warnings = series.summary.warnings;
      warnings.insert(warnings.end(), phases.warnings.begin(), phases.warnings.end());
      if (stacked)
        warnings.emplace_back(
            "slices were stacked by instance number: the order along the axis is not certain");
      const int number = ++count[series.summary.uid];
      if (number > 1) series.summary.uid += "#" + std::to_string(number);
      all.push_back(std::move(series));
    }
  }
  return all;
}

void check_options(const DicomReadOptions& options) {
  for (const auto& value : {options.pixel_spacing_mm, options.slice_spacing_mm}) {
    if (value && !(*value > 0.0 && std::isfinite(*value))) {
      throw InvalidInput("a spacing given for DICOM images must be positive, in mm; it is " +
                         std::to_string(*value));
    }
  }
}

/// A file asked for by name is not passed over in silence.
void check_file(const fs::path& path) {
  const auto file = parse_dicom(path);
  if (!file) throw InvalidInput("'" + path.string() + "' is not a DICOM file");
  if (!file->header.damage.empty())
    throw InvalidInput("'" + path.string() + "' is damaged: " + file->header.damage);
  if (!file->header.is_image()) throw InvalidInput("'" + path.string() + "' is DICOM, but holds no image");
}

}  // namespace

DicomScan scan_dicom_slices(const fs::path& folder_or_file, const DicomReadOptions& options,
                            const core::TaskContext& task) {
  check_options(options);
  std::error_code error;
  if (!fs::exists(folder_or_file, error)) throw IoError("'" + folder_or_file.string() + "' does not exist");
  const bool is_folder = fs::is_directory(folder_or_file, error);
  fs::path folder = folder_or_file;
  if (!is_folder) {
    check_file(folder_or_file);
    folder = folder_or_file.parent_path().empty() ? fs::path(".") : folder_or_file.parent_path();
  }
  const Files files = read_headers(files_below(folder, is_folder), task);
  DicomScan scan;
  scan.skipped = files.skipped;
  scan.series = series_of(files, options);
  for (const SharedHeader& header : files.damaged) {
    const std::string message = "'" + header->path.filename().string() + "' is damaged: " + header->damage;
    bool known = false;
    for (DicomSeriesDetail& series : scan.series) {
      if (series.slices.front().header->series_uid != header->series_uid || header->series_uid.empty())
        continue;
      series.summary.faults.push_back(message);
      series.summary.lacks_orientation = false;  // it is not all that is wrong
      known = true;
    }
    if (!known) scan.damaged.push_back(message);
  }
  if (!is_folder) {
    const auto other = [&](const DicomSeriesDetail& series) {
      return std::none_of(series.summary.files.begin(), series.summary.files.end(),
                          [&](const fs::path& file) { return file.filename() == folder_or_file.filename(); });
    };
    std::erase_if(scan.series, other);
  }
  std::stable_sort(scan.series.begin(), scan.series.end(),
                   [](const DicomSeriesDetail& a, const DicomSeriesDetail& b) {
                     return a.summary.geometry.voxels() > b.summary.geometry.voxels();
                   });
  task.set_progress(1.0);
  return scan;
}

DicomSeriesDetail scan_dicom_series(const DicomSeries& series, const DicomReadOptions& options,
                                    const core::TaskContext& task) {
  check_options(options);
  std::vector<fs::path> paths = series.files;
  std::sort(paths.begin(), paths.end());
  paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
  std::error_code error;
  for (const fs::path& path : paths) {
    if (!fs::is_regular_file(path, error))
      throw IoError("'" + path.string() + "' of the series is gone; open its folder again");
  }
  for (DicomSeriesDetail& found : series_of(read_headers(paths, task), options)) {
    const bool same =
        found.summary.files.size() == series.files.size() &&
        std::is_permutation(found.summary.files.begin(), found.summary.files.end(), series.files.begin()) &&
        std::is_permutation(found.summary.frames.begin(), found.summary.frames.end(), series.frames.begin());
    if (!same) continue;
    found.summary.uid = series.uid;
    // What the whole folder told of it (a damaged file of the same series) still holds.
    for (const std::string& fault : series.faults) {
      auto& faults = found.summary.faults;
      const bool cured = options.pixel_spacing_mm || options.slice_spacing_mm ||
                         (options.assume_axial && series.lacks_orientation);
      if (!cured && std::find(faults.begin(), faults.end(), fault) == faults.end()) faults.push_back(fault);
    }
    return std::move(found);
  }
  throw InvalidInput("the files of DICOM series " + series.uid + " have changed; open their folder again");
}

std::size_t patients_in(const std::vector<DicomSeries>& series) {
  std::set<std::uint64_t> known;
  for (const DicomSeries& one : series)
    if (one.patient_number != 0) known.insert(one.patient_number);
  return known.size();
}

DicomFolder scan_dicom(const fs::path& folder_or_file, const core::TaskContext& task) {
  const bool zipped = is_zip_archive(folder_or_file);
  std::shared_ptr<const UnpackedArchive> archive;
  if (zipped) {
    archive = std::make_shared<const UnpackedArchive>(unpack_archive(folder_or_file, {}, task.sub(0.0, 0.7)));
  }
  DicomScan scan =
      scan_dicom_slices(zipped ? archive->folder() : folder_or_file, {}, zipped ? task.sub(0.7, 1.0) : task);
  DicomFolder folder;
  folder.skipped = scan.skipped;
  folder.damaged = std::move(scan.damaged);
  for (DicomSeriesDetail& series : scan.series) {
    folder.series.push_back(std::move(series.summary));
    folder.series.back().archive = archive;
  }
  return folder;
}

}  // namespace ostia::imaging
