#include "pictures.h"

#include "look_of_windows.h"
#include "tree_viewer.h"
#include "tree_window.h"
#include "viewer.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/glview/offscreen.h"
#include "ostia/pipeline/manifest.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>

namespace ostia::live {
namespace {

namespace fs = std::filesystem;

constexpr double ecg_video_s = 10.0;
constexpr double turn_s = 10.0;  // about a tree

std::string numbered(const char* form, int number) {
  char name[64];
  std::snprintf(name, sizeof(name), form, number);
  return name;
}

/// A Viewer or TreeViewer that draws into memory.
template <class Shows, class Input>
class Easel {
 public:
  Easel(const Input& input, const Options& options)
      : offscreen_(options.width, options.height), viewer(input, options) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(options.width), static_cast<float>(options.height)};
    io.DeltaTime = 1.0F / 60.0F;
    io.MousePos = {-1.0F, -1.0F};
    width_ = options.width;
    height_ = options.height;
    if constexpr (requires { viewer.settle(); }) viewer.settle();
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
  Shows viewer;
};
using HeartEasel = Easel<Viewer, LiveHeart>;
using TreeEasel = Easel<TreeViewer, TreeInput>;

/// For ffmpeg, to which a percent in the folder's name would be a number's place.
std::string pattern_in(const fs::path& folder) {
  std::string pattern;
  for (const char c : fs::absolute(folder).string()) pattern += c == '%' ? "%%" : std::string(1, c);
  return pattern + "/frame-%05d.png";
}

/// Sides of a video are even.
std::string even_sides() {
  return "pad=ceil(iw/2)*2:ceil(ih/2)*2";
}

void make_mp4(const fs::path& folder, double frames_per_second, const core::TaskContext& task) {
  const std::optional<fs::path> ffmpeg = core::program_on_path("ffmpeg");
  if (!ffmpeg) {
    core::log_info("ffmpeg is not on the PATH: the video is its pictures alone");
    return;
  }
  const fs::path file = folder / "video.mp4";
  core::ChildLimits limits;
  limits.cpu_time = std::chrono::seconds(3600);
  const core::ChildResult result = core::run_child(
      *ffmpeg,
      {"-y", "-loglevel", "error", "-framerate", std::to_string(frames_per_second), "-i", pattern_in(folder),
       "-vf", even_sides(), "-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", file.string()},
      limits, task);
  std::error_code ignored;
  if (result.ok()) return;
  fs::remove(file, ignored);
  core::log_warning("ffmpeg " + result.describe() + ": the video is its pictures alone. " +
                    result.standard_error);
}

pipeline::JobKey key_of(const Options& o) {
  pipeline::JobKey key{"ostia-live --video", {}, ""};
  const auto add = [&](const char* role, const fs::path& file) {
    if (!file.empty()) key.inputs[role] = core::sha256_file(file);
  };
  add(o.tree ? "tree" : "motion", o.tree ? o.motion : motion_file(o));
  add("template", o.surface);
  add("ecg", o.ecg);
  nlohmann::json said{{"lead", o.lead},
                      {"speed", o.speed},
                      {"start_s", o.start_s},
                      {"view_deg", {o.view.lao_deg, o.view.cranial_deg}},
                      {"color", glview::title(o.value)},
                      {"x_ray", o.x_ray},
                      {"panels", o.panels},
                      {"size_px", {o.width, o.height}},
                      {"frames", o.frames},
                      {"frames_per_second", o.frames_per_second}};
  if (o.phase) said["phase"] = *o.phase;
  key.parameters = said.dump();
  return key;
}

struct VideoNews {
  ExitCode code = ExitCode::ok;
  std::vector<std::string> warnings;
};

/// Pictures, and `advance` between them, as a whole or not at all.
template <class Canvas, class Advance>
void write_video(Canvas& easel, const Options& options, int frames, const VideoNews& news,
                 const Advance& advance, const core::TaskContext& task) {
  pipeline::ManifestRecord record{key_of(options), news.code, 0.0, news.warnings, ""};
  const auto start = std::chrono::steady_clock::now();
  core::StagedFolder folder(options.video);
  for (int k = 0; k < frames; ++k) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(k) / frames);
    figure::picture_of(easel.picture()).write_png(folder.temporary() / numbered("frame-%05d.png", k));
    advance();
  }
  make_mp4(folder.temporary(), options.frames_per_second, task);
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pipeline::write_manifest(folder.temporary(), record);
  folder.commit();
}

void write_heart_video(const LiveHeart& heart, const Options& options, const core::TaskContext& task) {
  pipeline::require_free_folder(options.video);  // it is replaced as a whole
  HeartEasel easel(heart, options);
  const double step = 1.0 / options.frames_per_second;
  const Playback& play = easel.viewer.playback();
  const double seconds = play.follows_ecg() ? ecg_video_s : play.loop_interval_s() / play.speed();
  const int frames =
      options.frames > 0 ? options.frames : std::max(1, static_cast<int>(std::lround(seconds / step)));
  write_video(
      easel, options, frames,
      {heart.input.ecg_failed ? ExitCode::quality_failed : ExitCode::ok, heart.input.warnings},
      [&] { easel.viewer.advance(step); }, task);
}

void write_tree_video(const TreeInput& input, const Options& options, const core::TaskContext& task) {
  pipeline::require_free_folder(options.video);
  TreeEasel easel(input, options);
  const int frames = options.frames > 0
                         ? options.frames
                         : std::max(1, static_cast<int>(std::lround(turn_s * options.frames_per_second)));
  write_video(
      easel, options, frames, {ExitCode::ok, input.warnings},
      [&] { easel.viewer.turn(glview::whole_turn_px / frames); }, task);
}

}  // namespace

std::vector<Screenshots::News> Screenshots::take(figure::Raster raster) {
  std::vector<News> news = finish();
  std::error_code ignored;
  do file_ = folder_ / numbered("ostia-live-%04d.png", ++number_);
  while (fs::exists(file_, ignored));
  writing_ = std::async(std::launch::async, [file = file_, picture = std::move(raster)] {
    figure::picture_of(picture).write_png(file);
  });
  return news;
}

std::vector<Screenshots::News> Screenshots::news() {
  if (!writing_.valid() || writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
  return finish();
}

std::vector<Screenshots::News> Screenshots::finish() {
  if (!writing_.valid()) return {};
  try {
    writing_.get();
  } catch (const Error& error) {
    return {{error.what(), true}};
  }
  ++count_;
  return {{"picture: " + file_.string(), false}};
}

void write_pictures(const LiveHeart& heart, const Options& options, const core::TaskContext& task) {
  Options settled = options;
  settled.start_s = first_picture_s(heart.input, options);
  if (!options.video.empty()) {
    write_heart_video(heart, settled, task);
    return;
  }
  HeartEasel easel(heart, settled);
  const figure::Picture picture = figure::picture_of(easel.picture());
  task.throw_if_cancelled();
  picture.write_png(options.screenshot);
}

void write_tree_pictures(const TreeInput& input, const Options& options, const core::TaskContext& task) {
  if (!options.video.empty()) {
    write_tree_video(input, options, task);
    return;
  }
  TreeEasel easel(input, options);
  const figure::Picture picture = figure::picture_of(easel.picture());
  task.throw_if_cancelled();
  picture.write_png(options.screenshot);
}

}  // namespace ostia::live
