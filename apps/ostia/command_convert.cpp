#include <string>

#include "commands.h"
#include "ostia/core/log.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "points.h"

namespace ostia::app {
namespace {

geometry::TriMesh without_bad_points(const geometry::TriMesh& mesh) {
  std::vector<bool> keep;
  for (const geometry::Triangle& t : mesh.triangles) {
    keep.push_back(mesh.points[t[0]].allFinite() && mesh.points[t[1]].allFinite() && mesh.points[t[2]].allFinite());
  }
  return geometry::subset(mesh, keep);
}

/// Everything that can be mended without moving the wall, and a word on what was found.
geometry::TriMesh repaired(const geometry::TriMesh& mesh) {
  core::log_info("before the repair: " + geometry::find_faults(mesh, true).summary());
  geometry::TriMesh out = geometry::oriented(geometry::welded(without_bad_points(mesh)));
  if (!geometry::boundary_loops(out).empty()) out = geometry::fill_holes(out).mesh;
  core::log_info("after the repair: " + geometry::find_faults(out, true).summary());
  return out;
}

void convert_surface(const ConvertCommand& options) {
  io::LoadedSurface loaded = io::read_surface(options.input.input);
  for (const std::string& warning : loaded.warnings) core::log_warning(warning);
  const auto unit = source_options(options.input).unit_mm;
  if (unit) {
    for (geometry::Vec3& p : loaded.surface.mesh.points) p *= *unit;
  }
  if (options.repair) {
    io::write_surface(options.output, repaired(loaded.surface.mesh));
  } else {
    io::write_surface(options.output, loaded.surface);
  }
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
  if (is_lines(input) || options.output.extension() == ".csv") {
    io::write_centerlines(options.output, io::read_centerlines(input));
    return ExitCode::ok;
  }
  const pipeline::SourceKind kind = pipeline::classify(input);
  switch (kind) {
    case pipeline::SourceKind::dicom: throw InvalidInput("use `ostia import` for DICOM");
    case pipeline::SourceKind::surface: convert_surface(options); break;
    case pipeline::SourceKind::image:
    case pipeline::SourceKind::mask: convert_image(options, kind, task); break;
  }
  return ExitCode::ok;
}

}  // namespace ostia::app
