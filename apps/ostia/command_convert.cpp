#include "commands.h"
#include "points.h"
#include "tree_commands.h"

#include "ostia/core/log.h"
#include "ostia/geometry/smoothing.h"
#include "ostia/geometry/subdivision.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/repair.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>

namespace ostia::app {
namespace {

using Json = nlohmann::ordered_json;

Json told(const pipeline::Repaired& fixed) {
  Json steps = Json::array();
  for (const pipeline::RepairStep& step : fixed.steps)
    steps.push_back({{"what", step.what}, {"count", step.count}, {"text", step.text}});
  return {{"steps", steps}, {"left", fixed.left}};
}

void repair(const ConvertCommand& options, geometry::FacedSurface& surface, Json& done,
            const core::TaskContext& task) {
  pipeline::RepairOptions how;
  how.fill_holes_up_to_mm = options.fill_holes_mm;
  how.keep_parts = options.keep_parts;
  const pipeline::Repaired fixed = pipeline::repaired(surface.mesh, how, task);
  for (const std::string& step : fixed.done) core::log_info(step);
  core::log_info("faults left: " + fixed.left);
  done["repair"] = told(fixed);
  surface = {fixed.mesh, {}, {}};
}

/// Smoothed, then subdivided: steps between voxels go before there are more triangles on them.
void refine(const ConvertCommand& options, geometry::FacedSurface& surface, Json& done,
            const core::TaskContext& task) {
  if (options.smooth == 0 && options.subdivide == 0) return;
  if (surface.faces.size() > 1)
    throw InvalidInput("the surface has " + std::to_string(surface.faces.size()) +
                       " faces, whose edges --smooth and --subdivide would round off; use them before the "
                       "ends are capped");
  if (options.smooth > 0) {
    geometry::TaubinOptions how;
    how.iterations = options.smooth;
    surface.mesh = geometry::taubin_smoothed(surface.mesh, how, task.sub(0.3, 0.6));
    done["smoothed"] = options.smooth;
  }
  if (options.subdivide > 0) {
    geometry::SubdivisionOptions how;
    how.levels = options.subdivide;
    surface.mesh = geometry::loop_subdivided(surface.mesh, how, task.sub(0.6, 0.9));
    if (!surface.face_ids.empty())
      surface.face_ids.assign(surface.mesh.triangles.size(), surface.face_ids[0]);
    done["subdivided"] = options.subdivide;
  }
}

void convert_surface(const ConvertCommand& options, const core::TaskContext& task) {
  io::LoadedSurface loaded = io::read_surface(options.input.input);
  for (const std::string& warning : loaded.warnings) core::log_warning(warning);
  const auto unit = source_options(options.input).unit_mm;
  if (unit) {
    for (geometry::Vec3& p : loaded.surface.mesh.points) p *= *unit;
  }
  Json done = Json::object();
  const bool repairs = options.tree.repair || options.keep_parts || options.fill_holes_mm > 0.0;
  if (repairs) repair(options, loaded.surface, done, task.sub(0.0, 0.3));
  refine(options, loaded.surface, done, task);
  if (repairs) {
    io::write_surface(options.output, loaded.surface.mesh);
  } else {
    io::write_surface(options.output, loaded.surface);
  }
  done["points"] = loaded.surface.mesh.points.size();
  done["triangles"] = loaded.surface.mesh.triangles.size();
  if (options.json) std::fputs((done.dump(2) + "\n").c_str(), stdout);
}

/// Options for surfaces say nothing about images and lines.
void refuse_surface_options(const ConvertCommand& options) {
  if (options.tree.repair || options.keep_parts || options.json || options.fill_holes_mm > 0.0 ||
      options.smooth > 0 || options.subdivide > 0)
    throw UsageError(
        "--repair, --fill-holes, --keep-parts, --smooth, --subdivide and --json are for surfaces");
}

void convert_image(const ConvertCommand& options, pipeline::SourceKind kind, const core::TaskContext& task) {
  if (kind == pipeline::SourceKind::mask) {
    imaging::write_image(options.output, imaging::read_mask(options.input.input, task).volume);
  } else {
    imaging::write_image(options.output, imaging::read_image(options.input.input, task).volume);
  }
}

bool is_lines(const std::filesystem::path& path) {
  return path.extension() == ".csv" || path.extension() == ".vtk";
}

}  // namespace

ExitCode run_convert(const ConvertCommand& options, const core::TaskContext& task) {
  const std::filesystem::path& input = options.input.input;
  if (converts_tree(options)) return convert_tree(options, task);
  if (!options.tree.roots.empty() || options.tree.merge_mm > 0.0 || options.tree.keep_directions ||
      !options.tree.radius_units.empty())
    throw UsageError("--root, --join-within, --keep-directions and --radius-units are for trees");
  if (is_lines(input) || options.output.extension() == ".csv") {
    refuse_surface_options(options);
    io::write_centerlines(options.output, io::read_centerlines(input));
    return ExitCode::ok;
  }
  const pipeline::SourceKind kind = pipeline::classify(input);
  switch (kind) {
    case pipeline::SourceKind::dicom:
      throw InvalidInput("use `ostia import` for DICOM");
    case pipeline::SourceKind::surface:
      convert_surface(options, task);
      break;
    case pipeline::SourceKind::image:
    case pipeline::SourceKind::mask:
      refuse_surface_options(options);
      convert_image(options, kind, task);
      break;
  }
  return ExitCode::ok;
}

}  // namespace ostia::app
