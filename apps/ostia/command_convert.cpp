#include "commands.h"
#include "points.h"

#include "ostia/core/log.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/repair.h"

#include <string>

namespace ostia::app {
namespace {

void convert_surface(const ConvertCommand& options, const core::TaskContext& task) {
  io::LoadedSurface loaded = io::read_surface(options.input.input);
  for (const std::string& warning : loaded.warnings) core::log_warning(warning);
  const auto unit = source_options(options.input).unit_mm;
  if (unit) {
    for (geometry::Vec3& p : loaded.surface.mesh.points) p *= *unit;
  }
  if (options.repair) {
    const pipeline::Repaired fixed = pipeline::repaired(loaded.surface.mesh, task);
    for (const std::string& step : fixed.done) core::log_info(step);
    core::log_info("faults left: " + fixed.left);
    io::write_surface(options.output, fixed.mesh);
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
    case pipeline::SourceKind::dicom:
      throw InvalidInput("use `ostia import` for DICOM");
    case pipeline::SourceKind::surface:
      convert_surface(options, task);
      break;
    case pipeline::SourceKind::image:
    case pipeline::SourceKind::mask:
      convert_image(options, kind, task);
      break;
  }
  return ExitCode::ok;
}

}  // namespace ostia::app
