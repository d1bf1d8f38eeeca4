#include "commands.h"
#include "convert/convert_kinds.h"
#include "convert/convert_markups.h"
#include "convert/label_export.h"
#include "options/model_options.h"
#include "output/outputs.h"
#include "tree/tree_commands.h"

#include "ostia/core/log.h"
#include "ostia/dicom/label_object.h"
#include "ostia/geometry/faces.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/smoothing.h"
#include "ostia/geometry/subdivision.h"
#include "ostia/imaging/foreign_image.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/markups_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/model.h"
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
  return {{"steps", steps}, {"left", fixed.left}, {"meshable", fixed.meshable}};
}

/// Whether what came of it can be meshed.
bool repair(const ConvertCommand& options, geometry::FacedSurface& surface, Json& done,
            const core::TaskContext& task) {
  pipeline::RepairOptions how;
  how.fill_holes_up_to_mm = options.fill_holes_mm;
  if (options.keep_parts) how.parts = pipeline::KeptParts::all;
  if (options.largest_part) how.parts = pipeline::KeptParts::largest;
  const pipeline::Repaired fixed = pipeline::repaired(surface.mesh, how, task);
  for (const std::string& step : fixed.done) core::log_info(step);
  core::log_info("faults left: " + fixed.left);
  done["repair"] = told(fixed);
  if (surface.faces.size() > 1)
    core::log_warning(
        "the names of its " + std::to_string(surface.faces.size()) +
        " faces are left out, since repairing makes other triangles; ends are found by their shape");
  surface = {fixed.mesh, {}, {}};
  if (!fixed.meshable && options.smooth == 0 && options.subdivide == 0)
    core::log_warning("what is left keeps the surface from being meshed. " +
                      pipeline::cure_of_crossings(fixed.mesh));
  return fixed.meshable;
}

/// Smoothed, then subdivided: steps between voxels go before there are more triangles on them.
void refine(const ConvertCommand& options, geometry::FacedSurface& surface, Json& done,
            const core::TaskContext& task) {
  if (options.smooth == 0 && options.subdivide == 0) return;
  if (surface.faces.size() > 1 && options.subdivide > 0)
    throw InvalidInput("the surface has " + std::to_string(surface.faces.size()) +
                       " faces, whose edges --subdivide would round off; use it before the ends are capped");
  if (options.smooth > 0) {
    geometry::VolumeSmoothingOptions how;
    how.filter.iterations = options.smooth;
    how.borders_move = true;  // a rim is as rough as its wall
    if (surface.faces.size() > 1) how.free = geometry::points_of_wall_alone(surface);
    surface.mesh = geometry::smoothed_in_volume(surface.mesh, how, task.sub(0.3, 0.6));
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

/// With the faces, where there are any and the format holds them.
void write_converted(const std::filesystem::path& file, const geometry::FacedSurface& surface,
                     bool faces_lost) {
  if (!faces_lost && has_extension(file, {".vtp"})) return io::write_surface(file, surface);
  if (!faces_lost && surface.faces.size() > 1)
    core::log_warning("the names of its " + std::to_string(surface.faces.size()) +
                      " faces are left out: .vtp holds them");
  io::write_surface(file, surface.mesh);
}

/// After smoothing, faults that were left may be gone.
bool still_meshable(const ConvertCommand& options, bool meshable, const geometry::TriMesh& mesh) {
  if (meshable || (options.smooth == 0 && options.subdivide == 0)) return meshable;
  geometry::SurfaceFaults faults = geometry::find_faults(mesh, true);
  faults.open_edges = 0;
  if (faults.closed_manifold()) return true;
  core::log_warning("faults left after smoothing: " + faults.summary() +
                    "; they keep the surface from being meshed. Try --smooth 200 without --repair");
  return false;
}

ExitCode convert_surface(const ConvertCommand& options, const core::TaskContext& task) {
  io::LoadedSurface loaded = io::read_surface(options.input.input);
  for (const std::string& warning : loaded.warnings) core::log_warning(warning);
  const auto unit = source_options(options.input).unit_mm;
  if (unit) {
    for (geometry::Vec3& p : loaded.surface.mesh.points) p *= *unit;
  }
  Json done{{"v", 1}, {"kind", "conversion"}};
  const bool repairs =
      options.tree.repair || options.keep_parts || options.largest_part || options.fill_holes_mm > 0.0;
  bool meshable = !repairs || repair(options, loaded.surface, done, task.sub(0.0, 0.3));
  refine(options, loaded.surface, done, task);
  meshable = still_meshable(options, meshable, loaded.surface.mesh);
  write_converted(options.output, loaded.surface, repairs);
  done["points"] = loaded.surface.mesh.points.size();
  done["triangles"] = loaded.surface.mesh.triangles.size();
  if (options.json) std::fputs((done.dump(2) + "\n").c_str(), stdout);
  return meshable ? ExitCode::ok : ExitCode::quality_failed;
}

/// Options for surfaces say nothing about images and lines.
void refuse_surface_options(const ConvertCommand& options) {
  if (options.tree.repair || options.keep_parts || options.largest_part || options.fill_holes_mm > 0.0 ||
      options.smooth > 0 || options.subdivide > 0)
    throw UsageError("--repair, --fill-holes, --keep-parts, --smooth and --subdivide are for surfaces");
}

void print_done(const ConvertCommand& options, const Json& facts) {
  if (!options.json) return;
  Json done{{"v", 1}, {"kind", "conversion"}};
  done.update(facts);
  std::fputs((done.dump(2) + "\n").c_str(), stdout);
}

void convert_lines(const ConvertCommand& options) {
  const geometry::VesselTree tree = io::read_centerlines(options.input.input);
  io::write_centerlines(options.output, tree);
  std::size_t points = 0;
  for (const geometry::TreeSegment& segment : tree.segments) points += segment.axis.size();
  print_done(options, {{"points", points}, {"vessels", tree.vessels.size()}});
}

void convert_image(const ConvertCommand& options, pipeline::SourceKind kind, const core::TaskContext& task) {
  if (kind == pipeline::SourceKind::mask &&
      (dicom::label_object_in(options.input.input) || imaging::looks_like_labels(options.input.input))) {
    const auto labels = dicom::read_labels(options.input.input, task).volume;
    imaging::write_image(options.output, labels);
    print_done(options, {{"size", labels.geometry.size}});
  } else if (kind == pipeline::SourceKind::mask) {
    const imaging::MaskVolume mask = imaging::read_mask(options.input.input, task).volume;
    imaging::write_image(options.output, mask);
    print_done(options, {{"size", mask.geometry.size}});
  } else {
    const imaging::ImageVolume image = imaging::read_image(options.input.input, task).volume;
    imaging::write_image(options.output, image);
    print_done(options, {{"size", image.geometry.size}});
  }
}

bool is_lines(const std::filesystem::path& path) {
  if (path.extension() == ".vtk")
    return !io::is_surface_file(path) && imaging::foreign_image_format(path).empty();
  return path.extension() == ".csv" || path.extension() == ".txt" || io::is_markups_file(path);
}

}  // namespace

ExitCode run_convert(const ConvertCommand& options, const core::TaskContext& task) {
  const std::filesystem::path& input = options.input.input;
  if (converts_to_labels(options)) return convert_to_labels(options, task);
  if (converts_to_markups(options)) return convert_to_markups(options, task);
  if (options.landmarks)
    throw UsageError("--landmarks goes into markups: name the output .mrk.json or .fcsv");
  if (converts_own_kind(options)) return convert_own_kind(options, task);
  if (!options.format.empty()) throw UsageError("--format is for volume meshes");
  if (converts_tree(options)) return convert_tree(options, task);
  if (!options.tree.roots.empty() || options.tree.merge_mm > 0.0 || options.tree.keep_directions ||
      !options.tree.radius_units.empty())
    throw UsageError("--root, --join-within, --keep-directions and --radius-units are for trees");
  if (is_lines(input) || options.output.extension() == ".csv") {
    refuse_surface_options(options);
    convert_lines(options);
    return ExitCode::ok;
  }
  const pipeline::SourceKind kind = pipeline::classify(input);
  switch (kind) {
    case pipeline::SourceKind::dicom:
      throw InvalidInput("use `ostia import` for DICOM");
    case pipeline::SourceKind::surface:
      return convert_surface(options, task);
    case pipeline::SourceKind::image:
    case pipeline::SourceKind::mask:
      refuse_surface_options(options);
      convert_image(options, kind, task);
      break;
  }
  return ExitCode::ok;
}

}  // namespace ostia::app
