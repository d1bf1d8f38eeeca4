#include "commands.h"
#include "outputs.h"
#include "points.h"

#include "ostia/core/log.h"
#include "ostia/geometry/smoothing.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/branch_ends.h"
#include "ostia/pipeline/lumen_surface.h"

namespace ostia::app {

ExitCode run_segment(const SegmentCommand& options, const core::TaskContext& task) {
  require_output(options.output, surface_outputs);
  require_output(options.level_set, image_outputs);
  task.set_stage("reading");
  const pipeline::Source source =
      pipeline::load(options.input.input, source_options(options.input), task.sub(0.0, 0.3));
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  pipeline::ModelOptions how;
  apply(options.lumen, options.input.coords,
        source.image  ? &source.image->geometry
        : source.mask ? &source.mask->geometry
                      : nullptr,
        how);
  geometry::TriMesh surface;
  if (source.mask) {
    if (!options.level_set.empty()) throw InvalidInput("--levelset needs an image: a mask has no level set");
    task.set_stage("surface");
    surface = segmentation::segment_mask(*source.mask, {}, task.sub(0.3, 0.9));
  } else if (source.image) {
    const pipeline::BranchEnds ends = pipeline::ends_of(how.branches);
    task.set_stage("segmentation");
    const auto segmented =
        segmentation::segment_vessels(*source.image, how.branches, how.segment, task.sub(0.3, 0.8));
    for (const std::string& warning : segmented.warnings) core::log_warning(warning);
    std::vector<geometry::Vec3> seeds = ends.targets;
    seeds.push_back(ends.source);
    pipeline::LumenSurface found = pipeline::lumen_surface(segmented.level_set, seeds, task.sub(0.8, 0.9));
    for (const std::string& warning : found.warnings) core::log_warning(warning);
    surface = std::move(found.mesh);
    if (!options.level_set.empty()) imaging::write_image(options.level_set, segmented.level_set);
  } else {
    throw InvalidInput("cannot segment " + options.input.input.string() + ": it is a surface already");
  }
  if (how.smoothing) surface = geometry::taubin_smoothed(surface, *how.smoothing, task.sub(0.9, 1.0));
  task.throw_if_cancelled();
  io::write_surface(options.output, surface);
  task.set_progress(1.0);
  return ExitCode::ok;
}

}  // namespace ostia::app
