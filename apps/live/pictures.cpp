#include "pictures.h"

#include "look_of_windows.h"
#include "viewer.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/glview/offscreen.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace ostia::live {
namespace {

namespace fs = std::filesystem;

constexpr double ecg_video_s = 10.0, learning_s = 10.0;

std::string numbered(const char* form, int number) {
  char name[64];
  std::snprintf(name, sizeof(name), form, number);
  return name;
}

/// A viewer that draws into memory.
class Easel {
 public:
  Easel(const LiveInput& input, const Options& options)
      : offscreen_(options.width, options.height), viewer(input, options) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(options.width), static_cast<float>(options.height)};
    io.DeltaTime = 1.0F / 60.0F;
    io.MousePos = {-1.0F, -1.0F};
    width_ = options.width;
    height_ = options.height;
    picture();  // sizes settle in the first
  }
  figure::Raster picture() {
    offscreen_.bind();
    viewer.draw(width_, height_, 0.0);
    return offscreen_.read();
  }

 private:
  glview::Offscreen offscreen_;
  Windows windows_;
  int width_ = 0, height_ = 0;

 public:
  Viewer viewer;
};

fs::path program_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  std::error_code ignored;
  for (std::string folder; std::getline(folders, folder, ':');)
    if (fs::is_regular_file(fs::path(folder) / name, ignored)) return fs::path(folder) / name;
  return {};
}

/// Sides of a video are even.
std::string even_sides() {
  return "pad=ceil(iw/2)*2:ceil(ih/2)*2";
}

void make_mp4(const fs::path& folder, double frames_per_second, const core::TaskContext& task) {
  const fs::path ffmpeg = program_on_path("ffmpeg");
  if (ffmpeg.empty()) {
    core::log_info("ffmpeg is not on the PATH: the video is its pictures alone");
    return;
  }
  const fs::path file = folder / "video.mp4";
  core::ChildLimits limits;
  limits.cpu_time = std::chrono::seconds(3600);
  const core::ChildResult result =
      core::run_child(ffmpeg,
                      {"-y", "-loglevel", "error", "-framerate", std::to_string(frames_per_second), "-i",
                       (folder / "frame-%05d.png").string(), "-vf", even_sides(), "-c:v", "libx264", "-crf",
                       "18", "-pix_fmt", "yuv420p", file.string()},
                      limits, task);
  std::error_code ignored;
  if (result.ok()) return;
  fs::remove(file, ignored);
  core::log_warning("ffmpeg " + result.describe() + ": the video is its pictures alone. " +
                    result.standard_error);
}

void write_video(const LiveInput& input, const Options& options, const core::TaskContext& task) {
  Easel easel(input, options);
  const double step = 1.0 / options.frames_per_second;
  const Playback& play = easel.viewer.playback();
  const double seconds = play.follows_ecg() ? ecg_video_s : play.loop_interval_s() / play.speed();
  const int frames =
      options.frames > 0 ? options.frames : std::max(1, static_cast<int>(std::lround(seconds / step)));
  core::StagedFolder folder(options.video);
  for (int k = 0; k < frames; ++k) {
    task.throw_if_cancelled();
    figure::picture_of(easel.picture()).write_png(folder.temporary() / numbered("frame-%05d.png", k));
    easel.viewer.advance(step);
  }
  make_mp4(folder.temporary(), options.frames_per_second, task);
  folder.commit();
}

}  // namespace

std::string Screenshots::take(figure::Raster raster) {
  if (std::string trouble = finish(); !trouble.empty()) return trouble;
  fs::path file;
  std::error_code ignored;
  do file = folder_ / numbered("ostia-live-%04d.png", ++number_);
  while (fs::exists(file, ignored));
  ++count_;
  writing_ = std::async(std::launch::async,
                        [file, picture = std::move(raster)] { figure::picture_of(picture).write_png(file); });
  return "picture: " + file.string();
}

std::string Screenshots::finish() {
  try {
    if (writing_.valid()) writing_.get();
  } catch (const Error& error) {
    --count_;
    return error.what();
  }
  return "";
}

void write_pictures(const LiveInput& input, const Options& options, const core::TaskContext& task) {
  if (!options.video.empty()) {
    write_video(input, options, task);
    return;
  }
  Options settled = options;
  // A stream that has just begun has no phase yet: a picture of one is taken once beats are known.
  if (!options.phase && input.ecg && options.start_s <= 0.0) settled.start_s = learning_s;
  Easel easel(input, settled);
  figure::picture_of(easel.picture()).write_png(options.screenshot);
}

}  // namespace ostia::live
