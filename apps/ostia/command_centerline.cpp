#include "commands.h"
#include "outputs.h"
#include "points.h"
#include "surface_axes.h"

#include "ostia/centerline/canal_surface.h"
#include "ostia/core/log.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"

#include <algorithm>

namespace ostia::app {

centerline::CenterlineResult axes_of_surface(const InputOptions& input, const EndOptions& ends,
                                             const core::TaskContext& task) {
  task.set_stage("reading");
  const pipeline::Source source = pipeline::load(input.input, source_options(input), task.sub(0.0, 0.1));
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  if (source.kind != pipeline::SourceKind::surface)
    throw InvalidInput("cannot take centerlines of " + input.input.string() +
                       ": it is no surface; `ostia segment` makes one of an image");
  pipeline::ModelOptions how;
  apply(ends, input.coords, nullptr, how);
  task.set_stage("centerlines");
  centerline::CenterlineResult result = centerline::extract_centerlines(
      source.surface, how.source, how.targets, how.centerline, task.sub(0.1, 1.0));
  for (const std::string& warning : result.diagnostics.warnings) core::log_warning(warning);
  return result;
}

ExitCode run_centerline(const CenterlineCommand& options, const core::TaskContext& task) {
  require_output(options.output, line_outputs);
  require_output(options.canal, surface_outputs);
  const centerline::CenterlineResult result =
      axes_of_surface(options.input, options.ends, task.sub(0.0, 0.8));
  if (!options.canal.empty()) {
    task.set_stage("canal surface");
    double least = result.source_radius;
    for (const geometry::Centerline& line : result.lines) {
      for (const double r : line.radius) least = std::min(least, r);
    }
    io::write_surface(options.canal,
                      centerline::canal_surface(result.tree, 0.25 * least, task.sub(0.8, 0.95)));
  }
  task.throw_if_cancelled();
  io::write_centerlines(options.output, result.tree);
  task.set_progress(1.0);
  return ExitCode::ok;
}

}  // namespace ostia::app
