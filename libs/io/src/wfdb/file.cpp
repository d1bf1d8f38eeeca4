#include "wfdb/header.h"
#include "wfdb/samples.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/io/wfdb_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::io {
namespace {

/// The signals of one file: a frame of samples of each, again and again.
class SignalFile {
 public:
  SignalFile(const std::filesystem::path& folder, const WfdbHeader& header, std::size_t first)
      : header_(header), first_(first), path_(folder / header.signals[first].file) {
    const WfdbSignal& one = header.signals[first];
    for (end_ = first; end_ < header.signals.size() && header.signals[end_].file == one.file; ++end_)
      frame_ += static_cast<std::size_t>(header.signals[end_].samples_per_frame);
    const std::string bytes = core::read_file(path_);
    auto samples =
        unpacked_samples(one.format, std::string_view(bytes).substr(std::min(one.offset, bytes.size())));
    if (!samples)
      throw InvalidInput(
          path_.string() + ": has samples of WFDB's format " + std::to_string(one.format) +
          ", which cannot be read; convert it, as with `xform` of the WFDB software, to format 16");
    samples_ = std::move(*samples);
  }
  std::size_t end() const { return end_; }  ///< the first signal of the next file
  std::size_t frames() const { return samples_.size() / frame_; }
  const std::filesystem::path& path() const { return path_; }

  /// Adds its leads, as many frames of each.
  void read(std::size_t frames, WfdbRecord& out) const {
    std::size_t at = 0;
    for (std::size_t s = first_; s < end_; ++s) {
      out.record.leads.push_back(lead(header_.signals[s], at, frames, out.warnings));
      at += static_cast<std::size_t>(header_.signals[s].samples_per_frame);
    }
  }

 private:
  geometry::EcgLead lead(const WfdbSignal& signal, std::size_t at, std::size_t frames,
                         std::vector<std::string>& warnings) const {
    geometry::EcgLead lead{signal.name, signal.unit, {}};
    lead.values.assign(frames, std::numeric_limits<double>::quiet_NaN());
    std::uint32_t sum = 0;
    for (std::size_t f = 0; f < frames; ++f) {
      double total = 0.0;
      int count = 0;
      for (int k = 0; k < signal.samples_per_frame; ++k) {
        const std::int32_t sample = samples_[f * frame_ + at + static_cast<std::size_t>(k)];
        sum += static_cast<std::uint32_t>(sample);
        if (sample == missing_sample) continue;
        total += sample;
        ++count;
      }
      const auto skew = static_cast<std::size_t>(signal.skew);
      if (count > 0 && f >= skew) lead.values[f - skew] = (total / count - signal.baseline) / signal.gain;
    }
    const bool whole = header_.frames == 0 || frames == header_.frames;
    if (whole && signal.checksum && ((sum ^ static_cast<std::uint32_t>(*signal.checksum)) & 0xFFFF) != 0 &&
        std::none_of(lead.values.begin(), lead.values.end(), [](double v) { return std::isnan(v); }))
      warnings.push_back(path_.string() + ": the sum of lead " + signal.name +
                         " is not what the header says: samples may have been changed");
    return lead;
  }

  const WfdbHeader& header_;
  std::size_t first_, end_ = 0, frame_ = 0;
  std::filesystem::path path_;
  std::vector<std::int32_t> samples_;
};

}  // namespace

WfdbRecord read_wfdb(const std::filesystem::path& path) {
  const WfdbHeader header = read_wfdb_header(path);
  std::vector<SignalFile> files;
  for (std::size_t first = 0; first < header.signals.size(); first = files.back().end())
    files.emplace_back(path.parent_path(), header, first);

  WfdbRecord out;
  out.record.samples_per_second = header.frames_per_second;
  std::size_t frames = header.frames == 0 ? std::numeric_limits<std::size_t>::max() : header.frames;
  for (const SignalFile& file : files) {
    if (header.frames > 0 && file.frames() < header.frames)
      out.warnings.push_back(file.path().string() + ": ends early, after " + std::to_string(file.frames()) +
                             " of " + std::to_string(header.frames) + " samples");
    frames = std::min(frames, file.frames());
  }
  if (frames == 0) throw InvalidInput(path.string() + ": its signal files have no samples");
  for (const SignalFile& file : files) file.read(frames, out);
  return out;
}

}  // namespace ostia::io
