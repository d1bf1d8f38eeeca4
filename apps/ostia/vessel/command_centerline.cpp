#include "commands.h"
#include "input/seeds.h"
#include "input/surface_axes.h"
#include "options/model_options.h"
#include "output/outputs.h"
#include "output/told.h"

#include "ostia/centerline/canal_surface.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace ostia::app {

SurfaceAxes axes_of_surface(const InputOptions& input, const EndOptions& ends,
                            const core::TaskContext& task) {
  task.set_stage("reading");
  pipeline::SourceOptions read_how = source_options(input);
  read_how.for_axes = true;
  const pipeline::Source source = pipeline::load(input.input, read_how, task.sub(0.0, 0.1));
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  if (source.kind != pipeline::SourceKind::surface)
    throw InvalidInput("cannot take centerlines of " + input.input.string() +
                       ": it is no surface; `ostia segment` makes one of an image");
  pipeline::ModelOptions how;
  apply(ends, seed_frame(input, source, ends.seed_units), how);
  task.set_stage("centerlines");
  pipeline::AxesRequest request;
  if (how.source) request.sources = {*how.source};
  request.targets = how.targets;
  request.ends = source.ends;
  request.known = source.known;
  request.side_branches = pipeline::SideBranches::asked_only;  // lines to the targets that were asked for
  request.centerline = how.centerline;
  pipeline::LumenAxes result = pipeline::lumen_axes(source.surface, request, task.sub(0.1, 1.0));
  for (const std::string& line : result.told) core::log_warning(line);
  for (const std::string& warning : result.diagnostics.warnings) core::log_warning(warning);
  std::vector<pipeline::UnreachedPlace> missing = pipeline::unreached(result.tree, how.targets);
  for (const std::string& text : pipeline::texts_of(missing)) core::log_warning(text);
  return {std::move(result), std::move(missing)};
}

namespace {

void tell_lines(const geometry::VesselTree& tree, const std::vector<pipeline::UnreachedPlace>& missing,
                bool as_json) {
  ToldJson vessels = ToldJson::array();
  std::string line = counted(tree.vessels.size(), "vessel");
  for (const geometry::Vessel& vessel : tree.vessels) {
    const geometry::Centerline axis = geometry::vessel_axis(tree, vessel);
    const auto [least, largest] = std::minmax_element(axis.radius.begin(), axis.radius.end());
    vessels.push_back({{"name", vessel.name},
                       {"length_mm", axis.abscissa.back()},
                       {"least_radius_mm", *least},
                       {"largest_radius_mm", *largest}});
    line += (vessels.size() == 1 ? ": " : ", ") + vessel.name + " " +
            core::significant_text(axis.abscissa.back(), 4) + " mm";
  }
  tell("centerlines", {{"vessels", std::move(vessels)}, {"unreached", json_of(missing)}}, line, as_json);
}

}  // namespace

ExitCode run_centerline(const CenterlineCommand& options, const core::TaskContext& task) {
  require_output(options.output, line_outputs);
  require_output(options.canal, surface_outputs);
  const auto [result, missing] = axes_of_surface(options.input, options.ends, task.sub(0.0, 0.8));
  if (!options.canal.empty()) {
    task.set_stage("canal surface");
    double least = std::numeric_limits<double>::infinity();
    for (const geometry::Centerline& line : result.lines) {
      for (const double r : line.radius) least = std::min(least, r);
    }
    io::write_surface(options.canal,
                      centerline::canal_surface(result.tree, 0.25 * least, task.sub(0.8, 0.95)));
  }
  task.throw_if_cancelled();
  io::write_centerlines(options.output, result.tree);
  task.set_progress(1.0);
  tell_lines(result.tree, missing, options.json);
  return missing.empty() ? ExitCode::ok : ExitCode::quality_failed;
}

}  // namespace ostia::app
