#include "dicom_decode.h"
#include "dicom_resample.h"
#include "dicom_series.h"
#include "dicom_syntax.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/core/private_folder.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <thread>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t kMaxVoxels = 1LL << 32;
constexpr std::int16_t kAir = -1024;  // HU, where no slice reaches

/// Reports how far the child has come by the size of what it has written.
class FileProgress {
 public:
  FileProgress(fs::path file, double expected_bytes, core::TaskContext task)
      : file_(std::move(file)),
        expected_(expected_bytes),
        task_(std::move(task)),
        thread_([this] { watch(); }) {}
  ~FileProgress() {
    done_ = true;
    thread_.join();
  }
  FileProgress(const FileProgress&) = delete;
  FileProgress& operator=(const FileProgress&) = delete;

 private:
  void watch() {
    while (!done_) {
      std::error_code error;
      const auto size = fs::file_size(file_, error);
      if (!error) task_.set_progress(std::min(1.0, static_cast<double>(size) / expected_));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  fs::path file_;
  double expected_;
  core::TaskContext task_;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

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
DicomSeriesDetail& chosen(DicomScan& scan, const fs::path& from, const DicomReadOptions& options,
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

/// The slice that the child was at, from what it said.
std::size_t slice_reached(const std::string& standard_error) {
  const std::string mark = kDecodeMark;
  const std::size_t at = standard_error.rfind(mark);
  std::size_t index = 0;
  if (at == std::string::npos) return index;
  const char* text = standard_error.data();
  std::from_chars(text + at + mark.size(), text + standard_error.size(), index);
  return index;
}

/// The child's last line that is no mark.
std::string last_words(const std::string& standard_error) {
  std::string last;
  std::size_t at = 0;
  while (at < standard_error.size()) {
    const std::size_t end = std::min(standard_error.find('\n', at), standard_error.size());
    const std::string line = standard_error.substr(at, end - at);
    if (!line.empty() && !line.starts_with(kDecodeMark)) last = line;
    at = end + 1;
  }
  return last;
}

void check_child(const core::ChildResult& result, const std::vector<DicomSlice>& slices) {
  if (result.ok()) return;
  const std::size_t index = std::min(slice_reached(result.standard_error), slices.size() - 1);
  const std::string file = "'" + slices[index].header->path.string() + "'";
  const std::string words = last_words(result.standard_error);
  if (result.out_of_time) throw ResourceError("decoding " + file + ": the decoder " + result.describe());
  if (result.signal != 0) {
    // The kernel kills what takes too much memory; the rest is the library's way with a bad file.
    const std::string text = "cannot decode " + file + ": the decoder " + result.describe();
    if (result.signal == SIGKILL) throw ResourceError(text);
    throw InvalidInput(text);
  }
  if (result.exit_code == static_cast<int>(ExitCode::resources))
    throw ResourceError("decoding " + file + ": " + words);
  throw InvalidInput("cannot decode " + file + ": " + (words.empty() ? result.describe() : words));
}

core::ChildLimits limits_for(const DicomSeries& series) {
  const auto pixels = static_cast<std::uint64_t>(series.geometry.size[0] * series.geometry.size[1]);
  std::uint64_t largest_file = 0;
  for (const fs::path& file : series.files) {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    if (!error) largest_file = std::max<std::uint64_t>(largest_file, size);
  }
  core::ChildLimits limits;
  limits.memory_bytes = (1ULL << 30) + 64 * pixels + 4 * largest_file;
  limits.output_bytes = (pixels * 4 + 64) * series.files.size();
  limits.cpu_time = std::chrono::seconds(60 + 2 * series.files.size() * (1 + pixels / (1u << 20)));
  return limits;
}

struct Rescaled {
  std::int64_t clamped = 0;
  std::int64_t rounded = 0;
};

/// Stored values to HU with this slice's own slope and intercept.
template <class T>
void rescale(const std::vector<T>& stored, const DicomFrame& frame, std::int16_t* to, Rescaled& count) {
  const double slope = frame.slope.value_or(1.0), intercept = frame.intercept.value_or(0.0);
  const bool exact = slope == std::round(slope) && intercept == std::round(intercept);
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const double value = slope * static_cast<double>(stored[i]) + intercept;
    const double nearest = std::round(value);
    if (!exact && nearest != value) ++count.rounded;
    if (nearest < -32768.0 || nearest > 32767.0) ++count.clamped;
    to[i] = static_cast<std::int16_t>(std::clamp(nearest, -32768.0, 32767.0));
  }
}

void read_slices(const fs::path& file, const DicomSeriesDetail& series, ImageVolume& volume, Rescaled& count,
                 const core::TaskContext& task) {
  std::ifstream in(file, std::ios::binary);
  const auto pixels = static_cast<std::size_t>(volume.geometry.size[0] * volume.geometry.size[1]);
  std::vector<std::int16_t> narrow;
  std::vector<std::int32_t> wide;
  for (std::size_t s = 0; s < series.slices.size(); ++s) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(s) / static_cast<double>(series.slices.size()));
    SliceRecord record;
    in.read(reinterpret_cast<char*>(&record), sizeof record);
    const bool right = in && (record.voxel_bytes == 2 || record.voxel_bytes == 4) &&
                       static_cast<std::int64_t>(record.columns) == volume.geometry.size[0] &&
                       static_cast<std::int64_t>(record.rows) == volume.geometry.size[1];
    if (!right) throw InvalidInput("the decoder left out slice " + series.slices[s].name());
    std::int16_t* to = volume.voxels.data() + s * pixels;
    if (record.voxel_bytes == 2) {
      narrow.resize(pixels);
      in.read(reinterpret_cast<char*>(narrow.data()), static_cast<std::streamsize>(2 * pixels));
      rescale(narrow, series.slices[s].info(), to, count);
    } else {
      wide.resize(pixels);
      in.read(reinterpret_cast<char*>(wide.data()), static_cast<std::streamsize>(4 * pixels));
      rescale(wide, series.slices[s].info(), to, count);
    }
    if (!in) throw InvalidInput("the decoder cut short slice " + series.slices[s].name());
  }
}

ImageVolume decoded(const DicomSeriesDetail& series, Rescaled& count, const core::TaskContext& task) {
  const DicomSeries& summary = series.summary;
  ImageVolume volume;
  volume.geometry = summary.geometry;
  if (volume.geometry.voxels() > kMaxVoxels) {
    throw InvalidInput("DICOM series " + in_words(summary) + " has more than " + std::to_string(kMaxVoxels) +
                       " voxels");
  }
  const core::PrivateFolder folder;
  const fs::path list = folder.path() / "slices", output = folder.path() / "voxels";
  std::vector<DecodeItem> items;
  for (const DicomSlice& slice : series.slices)
    items.push_back({fs::absolute(slice.header->path), slice.frame});
  write_decode_list(list, items);
  {
    task.set_stage("decoding DICOM");
    const FileProgress progress(output, 2.0 * static_cast<double>(volume.geometry.voxels()),
                                task.sub(0.0, 0.8));
    const core::ChildResult result = core::run_child(
        core::worker_program(), {"decode", list.string(), output.string()}, limits_for(summary), task);
    check_child(result, series.slices);
  }
  volume.voxels.resize(static_cast<std::size_t>(volume.geometry.voxels()));
  read_slices(output, series, volume, count, task.sub(0.8, 1.0));
  return volume;
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

}  // namespace

LoadedImage<std::int16_t> read_dicom(const fs::path& folder_or_file, const DicomReadOptions& options,
                                     const core::TaskContext& task) {
  task.set_stage("reading DICOM headers");
  DicomScan scan = scan_dicom_slices(folder_or_file, options, task.sub(0.0, 0.1));
  std::vector<std::string> warnings;
  const DicomSeriesDetail& series = chosen(scan, folder_or_file, options, warnings);
  if (!series.summary.faults.empty()) refuse(series.summary);
  if (series.summary.uneven && !options.resample_uneven) {
    throw InvalidInput("DICOM series " + in_words(series.summary) + ": " +
                       listed(series.summary.warnings, 8) +
                       "; pass --resample (resample_uneven) to interpolate there");
  }
  if (!scan.damaged.empty()) {
    warnings.push_back(std::to_string(scan.damaged.size()) + " damaged files in the folder were passed over");
  }
  warnings.insert(warnings.end(), series.summary.warnings.begin(), series.summary.warnings.end());

  LoadedImage<std::int16_t> result;
  Rescaled count;
  result.volume = decoded(series, count, task.sub(0.1, 0.8));
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

}  // namespace ostia::imaging
