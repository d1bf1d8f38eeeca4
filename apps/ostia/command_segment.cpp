#include "commands.h"
#include "outputs.h"
#include "points.h"
#include "refusal.h"

#include "ostia/core/log.h"
#include "ostia/coronary/aorta_mask.h"
#include "ostia/geometry/smoothing.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/branch_ends.h"
#include "ostia/pipeline/lumen_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ostia::app {
namespace {

double ml_of(const imaging::MaskVolume& mask) {
  const auto inside = std::count_if(mask.voxels.begin(), mask.voxels.end(), [](auto v) { return v != 0; });
  return static_cast<double>(inside) * mask.geometry.spacing.prod() / 1000.0;
}

constexpr double shortest_in_a_chest_mm = 40.0;  // the ascending part and the arch measure 100 and more

double length_mm(const coronary::Aorta& aorta) {
  double length = 0.0;
  for (std::size_t i = 1; i < aorta.stations.size(); ++i)
    length += (aorta.stations[i].centre - aorta.stations[i - 1].centre).norm();
  return length;
}

/// Without seeds: the aorta's lumen as a mask on the image's grid, or as a surface.
ExitCode segment_aorta(const SegmentCommand& options, const core::TaskContext& task) {
  const bool as_mask = has_extension(options.output, image_outputs);
  if (as_mask && options.lumen.smooth > 0)
    throw UsageError("--smooth is for a surface, " + options.output.string() + " will be a mask");
  task.set_stage("reading");
  const pipeline::Source source =
      pipeline::load_ct(options.input.input, source_options(options.input), task.sub(0.0, 0.3));
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  task.set_stage("finding the aorta");
  const coronary::Aorta aorta = naming(
      options.input.input, [&] { return coronary::find_aorta(*source.image, {}, task.sub(0.3, 0.7)); },
      " (`ostia segment` with --branch)");
  const double length = length_mm(aorta);
  if (length < shortest_in_a_chest_mm)
    core::log_warning(
        own_name(options.input.input) + ": no more than " + std::to_string(std::lround(length)) +
        " mm of aorta were found; look whether it is the heart's, or name its ends with --branch");
  task.set_stage("segmentation");
  const imaging::MaskVolume mask = coronary::aorta_mask(*source.image, aorta, {}, task.sub(0.7, 0.9));
  if (as_mask) {
    task.throw_if_cancelled();
    imaging::write_image(options.output, mask);
  } else {
    geometry::TriMesh surface = segmentation::segment_mask(mask, {}, task.sub(0.9, 0.95));
    if (options.lumen.smooth > 0)
      surface = geometry::taubin_smoothed(surface, {.iterations = options.lumen.smooth}, task.sub(0.95, 1.0));
    task.throw_if_cancelled();
    io::write_surface(options.output, surface);
  }
  task.set_progress(1.0);
  std::printf("aorta: %.0f mm, %.1f ml, %.0f HU\n", length, ml_of(mask), aorta.lumen_hu);
  return ExitCode::ok;
}

}  // namespace

ExitCode run_segment(const SegmentCommand& options, const core::TaskContext& task) {
  require_output(options.output, options.aorta ? aorta_outputs : surface_outputs);
  require_output(options.level_set, image_outputs);
  if (options.aorta) return segment_aorta(options, task);
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
    surface = naming(options.input.input,
                     [&] { return segmentation::segment_mask(*source.mask, {}, task.sub(0.3, 0.9)); });
  } else if (source.image) {
    const pipeline::BranchEnds ends = pipeline::ends_of(how.branches);
    task.set_stage("segmentation");
    const auto segmented = naming(options.input.input, [&] {
      return segmentation::segment_vessels(*source.image, how.branches, how.segment, task.sub(0.3, 0.8));
    });
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
