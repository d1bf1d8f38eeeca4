#include "options.h"

#include "description_files.h"

#include "ostia/core/error.h"
#include "ostia/core/version.h"
#include "ostia/io/graph_file.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

namespace ostia::live {
namespace {

using glview::SurfaceValue;

constexpr const char* examples = R"(Examples:
  ostia-live --demo                                         a sample heart, in a loop
  ostia-live motion/ --ecg 100.hea                          a fitted motion, by the ECG as it runs
  ostia-live motion/ --view LAO30CRA20 --x-ray              as on the monitor of the catheter laboratory
  ostia-live motion/ --screenshot systole.png --phase 38    a picture at 38 % of the cycle; needs no display
  ostia-live motion/ --ecg 100.hea --video beats --frames 300
  ostia-live grown.vtp                                      a vessel tree, to look into and to measure)";

const std::map<std::string, SurfaceValue> values{{"plain", SurfaceValue::none},
                                                 {"displacement", SurfaceValue::displacement},
                                                 {"velocity", SurfaceValue::velocity},
                                                 {"stretch", SurfaceValue::stretch},
                                                 {"curvature", SurfaceValue::bending}};

struct Words {
  std::string view, color = "plain";
  double phase = -1.0, seconds = -1.0;
  bool demo = false, no_panels = false, no_vsync = false;
};

void add_input(CLI::App& app, Options& o, Words& words) {
  app.add_option(
      "motion", o.motion,
      "The motion: motion.json, or the folder that has it; or a vessel tree (.vtp .vtk .swc .csv .gxl "
      ".xml .dat) of up to millions of segments");
  app.add_flag("--demo", words.demo, "A sample heart instead of a motion");
  app.add_option("--template", o.surface, "The surface that it carries, at the template's phase")
      ->type_name("FILE");
  app.add_option("--ecg", o.ecg, "An electrocardiogram (WFDB) that runs at the rate it was recorded at")
      ->type_name("FILE.hea");
  app.add_option("--lead", o.lead, "Its lead: a number from 1, or a name; the clearest where not told");
  app.add_option("--start", o.start_s, "Seconds into the record at the start")->check(CLI::Range(0.0, 1e7));
  app.add_option("--speed", o.speed, "1 is as it was recorded")->check(CLI::Range(0.05, 8.0));
}

void add_view(CLI::App& app, Options& o, Words& words) {
  app.add_option("--view", words.view, "Angles of the C-arm: LAO30CRA20, RAO30CAU25, AP, LAT");
  app.add_flag("--x-ray", o.x_ray, "The projection of the angiography monitor");
  app.add_option("--color", words.color, "What colours the wall")
      ->check(CLI::IsMember({"plain", "displacement", "velocity", "stretch", "curvature"}));
  app.add_option("--phase", words.phase, "Per cent of the cycle at which to stand still")
      ->check(CLI::Range(0.0, 100.0));
  app.add_option("--width", o.width, "Of the window or picture, pixels")->check(CLI::Range(320, 8192));
  app.add_option("--height", o.height, "Of the window or picture, pixels")->check(CLI::Range(240, 8192));
  app.add_flag("--no-panels", words.no_panels, "The tree alone");
  app.add_flag("--turn", o.turning, "A vessel tree turns by itself until something in it is chosen");
}

void add_output(CLI::App& app, Options& o, Words& words) {
  app.add_option("--screenshot", o.screenshot, "Writes one picture, without a window")->type_name("FILE.png");
  app.add_option("--video", o.video, "Writes pictures, and video.mp4 where ffmpeg is found, without a window")
      ->type_name("FOLDER");
  app.add_option("--frames", o.frames, "Pictures of the video; one cycle, or 10 s of the ECG, where not told")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--fps", o.frames_per_second, "Pictures a second of the video")
      ->check(CLI::Range(1.0, 240.0));
  app.add_option("--pictures", o.pictures, "Where screenshots of the window go")->type_name("FOLDER");
  app.add_option("--seconds", words.seconds, "Ends by itself after so long")->check(CLI::Range(0.01, 1e7));
  app.add_flag("--no-vsync", words.no_vsync, "Draws as fast as it can");
  app.add_flag("--measure", o.measure,
               "Draws as fast as it can, and prints times and the last state as JSON at the end");
}

/// What has no meaning for a tree that stands still.
void require_of_tree(const Options& o, const Words& words) {
  for (const auto& [name, given] : {std::pair("--template", !o.surface.empty()),
                                    {"--ecg", !o.ecg.empty()},
                                    {"--lead", !o.lead.empty()},
                                    {"--start", o.start_s != 0.0},
                                    {"--speed", o.speed != 1.0},
                                    {"--phase", words.phase >= 0.0},
                                    {"--color", words.color != "plain"},
                                    {"--x-ray", o.x_ray}})
    if (given)
      throw UsageError(std::string(name) + " is of hearts that beat, and " + o.motion.string() +
                       " is a vessel tree: leave it out");
}

void settle(Options& o, const Words& words) {
  // A range's check lets pass what is no number.
  for (const auto& [name, value] : {std::pair("--start", o.start_s),
                                    {"--speed", o.speed},
                                    {"--phase", words.phase},
                                    {"--fps", o.frames_per_second},
                                    {"--seconds", words.seconds}})
    if (!std::isfinite(value)) throw UsageError(std::string(name) + " is not a number");
  if (words.demo != o.motion.empty())
    throw UsageError(words.demo ? "give a motion or --demo, not both"
                                : "which motion is to be shown? Give its file or folder, or --demo");
  o.tree = !o.motion.empty() && std::filesystem::is_regular_file(o.motion) && io::is_graph_file(o.motion);
  if (o.tree) require_of_tree(o, words);
  if (o.turning && !o.tree) throw UsageError("--turn is of vessel trees; a heart beats: leave it out");
  if (words.demo && !o.surface.empty())
    throw UsageError("--demo has a surface of its own: leave out --template");
  if (!o.screenshot.empty() && !o.video.empty()) throw UsageError("give --screenshot or --video, not both");
  if (!words.view.empty()) o.view = glview::carm_angles(words.view);
  o.value = values.at(words.color);
  if (words.phase >= 0.0) o.phase = words.phase / 100.0;
  if (words.seconds > 0.0) o.seconds = words.seconds;
  o.panels = !words.no_panels;
  o.vsync = !words.no_vsync && !o.measure;
}

}  // namespace

std::optional<Options> options_of(const std::vector<std::string>& arguments) {
  Options o;
  Words words;
  CLI::App app(
      "Shows a coronary tree that beats, by an electrocardiogram or in a loop, or a vessel tree of "
      "up to millions of segments.",
      "ostia-live");
  app.set_version_flag("--version", "ostia-live " + core::version());
  app.footer(examples);
  add_input(app, o, words);
  add_view(app, o, words);
  add_output(app, o, words);
  if (const auto folder = command_line::described_into(arguments)) {
    command_line::write_description_files(command_line::describe(app), *folder);
    return {};
  }
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    app.parse(reversed);
  } catch (const CLI::Success& asked) {
    app.exit(asked);
    return {};
  } catch (const CLI::ParseError& error) {
    throw UsageError(std::string(error.what()) + " (ostia-live --help tells)");
  }
  settle(o, words);
  return o;
}

}  // namespace ostia::live
