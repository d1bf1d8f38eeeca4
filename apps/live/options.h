#pragma once
/// \file What the live viewer is asked to do.

#include "ostia/glview/carm_camera.h"
#include "ostia/glview/surface_values.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::live {

struct Options {
  std::filesystem::path motion;   ///< a file or a folder with motion.json; empty: the sample heart
  bool tree = false;              ///< `motion` is a file of a vessel tree
  std::filesystem::path surface;  ///< the template; empty: the one that the motion names
  std::filesystem::path ecg;      ///< a header of WFDB; empty: none
  std::string lead;               ///< number from 1, or name; empty: the clearest
  double speed = 1.0;
  double start_s = 0.0;  ///< of the record
  glview::CarmAngles view{30.0, 20.0};
  glview::SurfaceValue value = glview::SurfaceValue::none;
  bool x_ray = false, panels = true, vsync = true, measure = false;
  bool turning = false;  ///< a vessel tree, by itself
  int width = 1024, height = 768;
  std::optional<double> phase;           ///< paused there
  std::optional<double> seconds;         ///< then it ends
  std::filesystem::path pictures = ".";  ///< where screenshots go
  std::filesystem::path screenshot;      ///< one picture, no window
  std::filesystem::path video;           ///< a folder of pictures, no window
  int frames = 0;                        ///< of the video; 0: one cycle, or ten seconds of the ECG
  double frames_per_second = 30.0;
};

/// Throws UsageError. Where only --help or --version was asked for, that is printed and nothing returned.
std::optional<Options> options_of(const std::vector<std::string>& arguments);

}  // namespace ostia::live
