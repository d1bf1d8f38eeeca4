#pragma once
/// \file Pictures as files.

#include "live_heart.h"

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
  /// What became of a picture.
  struct News {
    std::string text;
    bool failed = false;
  };
  /// Writes it while the window goes on. Where the one before is still being written it waits for that one.
  std::vector<News> take(figure::Raster raster);
  std::vector<News> news();             ///< of the one that has been written since; does not wait
  std::vector<News> finish();           ///< waits
  int count() const { return count_; }  ///< that have been written

 private:
  std::filesystem::path folder_;
  std::filesystem::path file_;
  std::future<void> writing_;
  int number_ = 0, count_ = 0;
};

/// Without a window: --screenshot and --video. Throws ResourceError where there is no OpenGL 3.3, IoError,
/// Cancelled.
void write_pictures(const LiveHeart& heart, const Options& options, const core::TaskContext& task);

}  // namespace ostia::live
