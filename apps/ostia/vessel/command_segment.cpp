#include "commands.h"
#include "input/seeds.h"
#include "options/model_options.h"
#include "output/kept_results.h"
#include "output/outputs.h"
#include "output/refusal.h"
#include "output/told.h"

#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/coronary/aorta_mask.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/smoothing.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/branch_ends.h"
#include "ostia/pipeline/lumen_surface.h"
#include "ostia/pipeline/reached.h"

#include <algorithm>
#include <cmath>

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

constexpr double reach_voxels = 4.0;  // a seed at an end may lie so far outside of it

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
  tell("aorta", {{"length_mm", length}, {"volume_ml", ml_of(mask)}, {"lumen_hu", aorta.lumen_hu}},
       "aorta: " + core::fixed_text(length, 0) + " mm, " + core::fixed_text(ml_of(mask), 1) + " ml, " +
           core::fixed_text(aorta.lumen_hu, 0) + " HU",
       options.json);
  return ExitCode::ok;
}

void tell_lumen(const geometry::TriMesh& surface, const std::vector<pipeline::UnreachedPlace>& missing,
                bool as_json) {
  const double area = geometry::area(surface), volume = geometry::volume(surface);
  tell("segmentation",
       {{"points", surface.points.size()},
        {"triangles", surface.triangles.size()},
        {"area_mm2", area},
        {"volume_mm3", volume},
        {"unreached", json_of(missing)}},
       "lumen: " + counted(surface.triangles.size(), "triangle") + ", " + core::significant_text(area, 4) +
           " mm2, " + core::significant_text(volume, 4) + " mm3",
       as_json);
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
  apply(options.lumen, seed_frame(options.input, source), how);
  geometry::TriMesh surface;
  std::vector<pipeline::UnreachedPlace> missing;
  ExitCode code = ExitCode::ok;
  if (source.mask) {
    if (!options.level_set.empty()) throw InvalidInput("--levelset needs an image: a mask has no level set");
    task.set_stage("surface");
    surface = naming(options.input.input,
                     [&] { return segmentation::segment_mask(*source.mask, {}, task.sub(0.3, 0.9)); });
  } else if (source.image) {
    pipeline::BranchEnds ends = pipeline::ends_of(how.branches);
    task.set_stage("segmentation");
    const auto segmented = naming(options.input.input, [&] {
      return segmentation::segment_vessels(*source.image, how.branches, how.segment, task.sub(0.3, 0.8));
    });
    for (const std::string& warning : segmented.warnings) core::log_warning(warning);
    for (const std::string& reason : pipeline::reasons_of(segmented.left_out)) {
      core::log_warning(reason);
      code = ExitCode::quality_failed;
    }
    if (code != ExitCode::ok) ends = pipeline::ends_of(pipeline::without(how.branches, segmented.left_out));
    std::vector<geometry::Vec3> seeds = ends.targets;
    seeds.push_back(ends.source);
    KeptResults kept(options.keep, options.output);
    kept.add("levelset.nrrd",
             [&](const std::filesystem::path& file) { imaging::write_image(file, segmented.level_set); });
    pipeline::LumenSurface found =
        kept.guard([&] { return pipeline::lumen_surface(segmented.level_set, seeds, task.sub(0.8, 0.9)); });
    for (const std::string& warning : found.warnings) core::log_warning(warning);
    surface = std::move(found.mesh);
    missing = pipeline::unreached(surface, ends.source, ends.targets,
                                  reach_voxels * source.image->geometry.spacing.maxCoeff());
    for (const std::string& text : pipeline::texts_of(missing)) core::log_warning(text);
    if (!missing.empty()) code = ExitCode::quality_failed;
    if (!options.level_set.empty()) imaging::write_image(options.level_set, segmented.level_set);
  } else {
    throw InvalidInput("cannot segment " + options.input.input.string() + ": it is a surface already");
  }
  if (how.smoothing) surface = geometry::taubin_smoothed(surface, *how.smoothing, task.sub(0.9, 1.0));
  task.throw_if_cancelled();
  io::write_surface(options.output, surface);
  task.set_progress(1.0);
  tell_lumen(surface, missing, options.json);
  return code;
}

}  // namespace ostia::app
