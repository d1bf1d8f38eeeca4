#pragma once
/// \file Pictures as files.

#include "live_input.h"

#include "ostia/core/task_context.h"
#include "ostia/figure/picture.h"

#include <filesystem>
#include <future>
#include <string>
#include <vector>

namespace ostia::live {

/// Writes screenshots beside the frame loop: ostia-live-0001.png and on, never over one that is there.
class Screenshots {
 public:
  explicit Screenshots(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// Returns at once, with what is to be told.
  std::string take(figure::Raster raster);
  /// Waits; what the last one failed with, or empty.
  std::string finish();
  int count() const { return count_; }

 private:
  std::filesystem::path folder_;
  std::future<void> writing_;
  int number_ = 0, count_ = 0;
};

/// Without a window: --screenshot and --video. Throws ResourceError where there is no OpenGL 3.3, IoError,
/// Cancelled.
void write_pictures(const LiveInput& input, const Options& options, const core::TaskContext& task);

}  // namespace ostia::live
