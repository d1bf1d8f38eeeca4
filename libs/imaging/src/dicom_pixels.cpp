#include "dicom_pixels.h"

#include "dicom_decode.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/core/private_folder.h"
#include "ostia/core/worker_program.h"

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
  std::string file = "'";
  file += slices[index].header->path.string();
  file += '\'';
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

core::ChildLimits limits_for(const std::vector<DicomSlice>& slices, const Geometry& geometry) {
  const auto pixels = static_cast<std::uint64_t>(geometry.size[0] * geometry.size[1]);
  std::uint64_t largest_file = 0;
  for (const DicomSlice& slice : slices) {
    std::error_code error;
    const auto size = fs::file_size(slice.header->path, error);
    if (!error) largest_file = std::max<std::uint64_t>(largest_file, size);
  }
  core::ChildLimits limits;
  limits.memory_bytes = (1ULL << 30) + 64 * pixels + 4 * largest_file;
  limits.output_bytes = (pixels * 4 + 64) * slices.size();
  limits.cpu_time = std::chrono::seconds(60 + 2 * slices.size() * (1 + pixels / (1u << 20)));
  return limits;
}

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

void read_slices(const fs::path& file, const std::vector<DicomSlice>& slices, ImageVolume& volume,
                 Rescaled& count, const core::TaskContext& task) {
  std::ifstream in(file, std::ios::binary);
  const auto pixels = static_cast<std::size_t>(volume.geometry.size[0] * volume.geometry.size[1]);
  std::vector<std::int16_t> narrow;
  std::vector<std::int32_t> wide;
  for (std::size_t s = 0; s < slices.size(); ++s) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(s) / static_cast<double>(slices.size()));
    SliceRecord record;
    in.read(reinterpret_cast<char*>(&record), sizeof record);
    const bool right = in && (record.voxel_bytes == 2 || record.voxel_bytes == 4) &&
                       static_cast<std::int64_t>(record.columns) == volume.geometry.size[0] &&
                       static_cast<std::int64_t>(record.rows) == volume.geometry.size[1];
    if (!right) throw InvalidInput("the decoder left out slice " + slices[s].name());
    std::int16_t* to = volume.voxels.data() + s * pixels;
    if (record.voxel_bytes == 2) {
      narrow.resize(pixels);
      in.read(reinterpret_cast<char*>(narrow.data()), static_cast<std::streamsize>(2 * pixels));
      rescale(narrow, slices[s].info(), to, count);
    } else {
      wide.resize(pixels);
      in.read(reinterpret_cast<char*>(wide.data()), static_cast<std::streamsize>(4 * pixels));
      rescale(wide, slices[s].info(), to, count);
    }
    if (!in) throw InvalidInput("the decoder cut short slice " + slices[s].name());
  }
}

}  // namespace

ImageVolume decode_slices(const std::vector<DicomSlice>& slices, const Geometry& geometry, Rescaled& count,
                          const core::TaskContext& task) {
  ImageVolume volume;
  volume.geometry = geometry;
  const core::PrivateFolder folder;
  const fs::path list = folder.path() / "slices", output = folder.path() / "voxels";
  std::vector<DecodeItem> items;
  for (const DicomSlice& slice : slices) items.push_back({fs::absolute(slice.header->path), slice.frame});
  write_decode_list(list, items);
  {
    task.set_stage("decoding DICOM");
    const FileProgress progress(output, 2.0 * static_cast<double>(volume.geometry.voxels()),
                                task.sub(0.0, 0.8));
    const core::ChildResult result =
        core::run_child(core::worker_program(), {"decode", list.string(), output.string()},
                        limits_for(slices, geometry), task);
    check_child(result, slices);
  }
  volume.voxels.resize(static_cast<std::size_t>(volume.geometry.voxels()));
  read_slices(output, slices, volume, count, task.sub(0.8, 1.0));
  return volume;
}

}  // namespace ostia::imaging
