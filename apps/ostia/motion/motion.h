#pragma once
/// \file `ostia motion`: what it is told.

#include "commands.h"
#include "evaluate/evaluate.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

struct MotionFitCommand {
  std::filesystem::path input;  ///< folder of phases
  std::filesystem::path output;
  /// Surface, mask or case at that phase: carried to the others instead of the folder's own, and looked for
  /// in images. Empty: the folder's own.
  std::filesystem::path shape;
  double template_percent = 75.0;
  int depth = 4;
  std::vector<double> weights;          ///< of length, area and volume, or one of all; none: the library's
  std::string method = "gauss-newton";  ///< how a phase is registered
  std::string surface = "isosurface";   ///< of masks; or "poisson"
  std::string by = "cage";              ///< what carries the template through images; or "b-splines"
  int frames = 0;                       ///< numbers in names count frames, this many a cycle; 0: percent
  std::string units;
  bool json = false;
};
ExitCode run_motion_fit(const MotionFitCommand& options, const core::TaskContext& task);

struct MotionApplyCommand {
  bool json = false;
  std::filesystem::path motion, input, output;
  double percent = 0.0;
  std::string units;  ///< of the input
};
ExitCode run_motion_apply(const MotionApplyCommand& options, const core::TaskContext& task);

struct MotionEvaluateCommand {
  std::filesystem::path motion, reference, surface;
  std::vector<double> keep;  ///< percent
  int every = 0;             ///< 0: all phases
  int frames = 0;
  EvaluateCommand common;  ///< units, sampling, requirements, JSON
};
ExitCode run_motion_evaluate(const MotionEvaluateCommand& options, const core::TaskContext& task);

struct MotionExportCommand {
  std::filesystem::path motion, surface, mesh, output;
  std::vector<std::string> formats;  ///< none: vtp, with a mesh vtu
  int times = 20;
  double rr_seconds = 0.8;
  std::string units;  ///< of `surface`
  bool json = false;
};
ExitCode run_motion_export(const MotionExportCommand& options, const core::TaskContext& task);

struct MotionMeasureCommand {
  std::filesystem::path motion, input, output;
  double rr_seconds = 0.8;
  int times = 50;
  std::optional<double> reach_mm, rest_mm;  ///< nothing: the library's default
  bool json = false;
};
ExitCode run_motion_measure(const MotionMeasureCommand& options, const core::TaskContext& task);

struct MotionCommands {
  MotionFitCommand fit;
  MotionApplyCommand apply;
  MotionEvaluateCommand evaluate;
  MotionExportCommand out;
  MotionMeasureCommand measure;
};
/// Adds `motion` and its subcommands.
void define_motion(CLI::App& app, MotionCommands& commands,
                   std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
