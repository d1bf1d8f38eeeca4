#include "commands.h"
#include "mesh_input.h"
#include "points.h"
#include "refinement.h"
#include "solver_case.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/pipeline/model_folder.h"
#include "ostia/pipeline/report.h"
#include "ostia/pipeline/vessel_export.h"
#include "ostia/session/case_file.h"

#include <chrono>
#include <cstdio>
#include <optional>
#include <utility>

namespace ostia::app {
namespace {

ExitCode verdict(const meshing::QualityVerdict& verdict) {
  if (verdict.ok()) return ExitCode::ok;
  core::log_warning("quality control failed: " + verdict.summary());
  return ExitCode::quality_failed;
}

/// As it stands in the file, in the unit that is given.
geometry::FacedSurface surface_in(const std::filesystem::path& file, const InputOptions& input) {
  geometry::FacedSurface surface = io::read_surface(file).surface;
  if (const auto unit_mm = source_options(input).unit_mm)
    for (geometry::Vec3& p : surface.mesh.points) p *= *unit_mm;
  return surface;
}

ExitCode check_file(const MeshCommand& options, const core::TaskContext& task) {
  task.set_stage("reading");
  if (io::is_volume_mesh(options.check)) {
    const io::LayeredMesh read = io::read_layered_mesh(options.check);
    const pipeline::MeshQuality quality = pipeline::judged(read.mesh, read.in_layers, task);
    std::fputs((pipeline::quality_json(quality) + "\n").c_str(), stdout);
    const bool could_tell = options.check.extension() == ".vtu";
    if (!quality.verdict.ok() && read.mesh.prisms.empty() && read.in_layers.empty() && !could_tell)
      core::log_warning(
          options.check.string() +
          " does not say which tetrahedra are prisms of layers that were split, and all are "
          "judged as tetrahedra; if there are such, check the mesh.vtu that was written beside it");
    return verdict(quality.verdict);
  }
  if (!io::is_surface_file(options.check))
    throw InvalidInput("cannot check " + options.check.string() + ": volume meshes are read as " +
                       io::readable_volume_meshes() +
                       ", surfaces as STL, PLY, OBJ and VTP; export the mesh as one of these besides");
  const geometry::FacedSurface surface = surface_in(options.check, options.input);
  const meshing::MeshForecast forecast = forecast_of(surface, nullptr, {}, task.sub(0.0, 0.5));
  warn_of(forecast, true, true);
  const auto quality = meshing::surface_quality(surface.mesh, true, task.sub(0.5, 1.0));
  const meshing::QualityVerdict judged = meshing::check(quality);
  std::fputs((with_forecast(pipeline::quality_json(quality, judged), forecast) + "\n").c_str(), stdout);
  return forecast.fails() ? ExitCode::quality_failed : verdict(judged);
}

/// What meshing would meet, in words or as JSON; nothing is made.
ExitCode forecast(const MeshCommand& options, const core::TaskContext& task) {
  if (options.input.input.empty() || options.input.input.extension() == ".ostia")
    throw UsageError("--forecast looks at a surface: `ostia mesh SURFACE --forecast`");
  pipeline::ModelOptions how;
  apply(options.mesh, how);
  task.set_stage("reading");
  const geometry::FacedSurface surface = surface_in(options.input.input, options.input);
  apply_size_array(options.mesh, options.input, surface.mesh, how);
  std::optional<geometry::VesselTree> tree;
  if (!options.centerline.empty()) tree = io::read_centerlines(options.centerline);
  const meshing::MeshForecast found = forecast_of(surface, tree ? &*tree : nullptr, how, task);
  if (options.json) {
    std::fputs((forecast_json(found) + "\n").c_str(), stdout);
  } else {
    for (const meshing::ForecastPlace& place : found.places)
      std::printf("%s: %s\n", place.fails ? "fails" : "poor", forecast_text(place).c_str());
    if (found.places.empty()) std::printf("nothing found that would fail or come out poor\n");
  }
  return found.fails() ? ExitCode::quality_failed : ExitCode::ok;
}

geometry::VesselTree tree_for(const MeshCommand& options, const pipeline::Source& source,
                              const pipeline::ModelOptions& how, const core::TaskContext& task) {
  if (!options.centerline.empty()) return io::read_centerlines(options.centerline);
  task.set_stage("centerlines");
  return centerline::extract_centerlines(source.surface, how.source, how.targets, how.centerline, task).tree;
}

geometry::Box3 box_of(const geometry::VesselTree& tree) {
  geometry::Box3 box;
  for (const geometry::TreeSegment& segment : tree.segments)
    for (const geometry::Vec3& p : segment.axis.points) box.extend(p);
  return box;
}

/// All vessels of a case, as the window's export does it.
ExitCode mesh_case(const MeshCommand& options, const core::TaskContext& task) {
  if (!options.centerline.empty() || !options.ends.source.empty() || !options.ends.targets.empty())
    throw UsageError("a case has its axes: --centerline, --source and --target are for surfaces");
  if (!options.mesh.size_array.empty()) throw UsageError("--size-array is for surfaces (.vtp)");
  pipeline::ModelOptions how;
  apply(options.mesh, how);
  task.set_stage("reading");
  const auto opened = session::CaseFile::open(options.input.input, session::OpenMode::read_only);
  apply_refinement(options, box_of(opened.model()->tree), how, task);
  pipeline::MeshExportOptions wanted;
  wanted.sizing = how.sizing;
  wanted.extensions = how.extensions;
  wanted.volume = how.volume;
  wanted.planes = placed_planes(options.mesh, options.input.coords, nullptr);
  if (how.inset_radii) wanted.inset_radii = *how.inset_radii;
  pipeline::require_free_folder(options.output);
  std::optional<ExitCode> code =
      pipeline::already_done(options.output, pipeline::mesh_job(*opened.model(), wanted));
  if (code) {
    core::log_info("done already with the same case and parameters; nothing to do");
  } else {
    const auto made = pipeline::export_mesh(options.output, *opened.model(), wanted, task);
    for (const std::string& warning : made.warnings) core::log_warning(warning);
    code = verdict(made.verdict);
    if (made.trees == 1) tell_case(how.volume, options.output);
  }
  if (options.json) std::fputs(core::read_file(options.output / "quality.json").c_str(), stdout);
  return *code;
}

}  // namespace

ExitCode run_mesh(const MeshCommand& options, const core::TaskContext& task) {
  check_refinement(options);
  if (!options.check.empty()) return check_file(options, task);
  if (options.forecast) return forecast(options, task);
  if (options.input.input.empty() || options.output.empty())
    throw UsageError(
        "`ostia mesh` needs a surface or a case and -o DIR, or --check FILE, or a surface and --forecast");
  if (options.input.input.extension() == ".ostia") return mesh_case(options, task);
  pipeline::ModelOptions how;
  apply(options.mesh, how);
  how.clip.planes = placed_planes(options.mesh, options.input.coords, nullptr);
  pipeline::require_free_folder(options.output);
  const auto start = std::chrono::steady_clock::now();
  task.set_stage("reading");
  const pipeline::Source source =
      pipeline::load(options.input.input, source_options(options.input), task.sub(0.0, 0.1));
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  if (source.kind != pipeline::SourceKind::surface)
    throw InvalidInput("cannot mesh " + options.input.input.string() +
                       ": it is no surface; `ostia model` goes all the way from an image");
  apply(options.ends, options.input.coords, nullptr, how);
  apply_size_array(options.mesh, options.input, source.surface, how);
  apply_refinement(options, geometry::bounds(source.surface.points), how, task.sub(0.05, 0.1));
  pipeline::JobKey key{
      "mesh", {{"surface", source.sha256}}, pipeline::parameters_json(how, source_options(options.input))};
  if (how.sizing.array) key.inputs["size_array"] = core::sha256(options.mesh.size_array);
  if (!options.centerline.empty()) key.inputs["centerline"] = core::sha256_file(options.centerline);
  if (const auto code = pipeline::already_done(options.output, key)) {
    core::log_info("done already with the same input and parameters; nothing to do");
    if (options.json) std::fputs(core::read_file(options.output / "quality.json").c_str(), stdout);
    return *code;
  }
  const geometry::FacedSurface wall{source.surface, {}, {}};
  // What is wrong with the surface itself is told before its centerlines are sought, sizes once they are
  // known.
  warn_of(forecast_of(wall, nullptr, how, task.sub(0.1, 0.12)), true, false);
  pipeline::require_sound_surface(source.surface, options.input.input.string());
  const geometry::VesselTree tree = tree_for(options, source, how, task.sub(0.12, 0.28));
  warn_of(forecast_of(wall, &tree, how, task.sub(0.28, 0.3)), false, true);
  const pipeline::MeshedLumen meshed = pipeline::mesh_lumen(source.surface, tree, how, task.sub(0.3, 0.95));
  for (const std::string& warning : meshed.warnings) core::log_warning(warning);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pipeline::write_mesh_folder(options.output, meshed, how, key, seconds, task.sub(0.95, 1.0));
  if (options.json) std::fputs((pipeline::quality_json(meshed.quality) + "\n").c_str(), stdout);
  tell_case(how.volume, options.output);
  task.set_progress(1.0);
  return verdict(meshed.quality.verdict);
}

}  // namespace ostia::app
