#include "commands.h"
#include "points.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
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

namespace ostia::app {
namespace {

ExitCode verdict(const meshing::QualityVerdict& verdict) {
  if (verdict.ok()) return ExitCode::ok;
  core::log_warning("quality control failed: " + verdict.summary());
  return ExitCode::quality_failed;
}

ExitCode check_file(const MeshCommand& options, const core::TaskContext& task) {
  task.set_stage("reading");
  if (io::is_volume_mesh(options.check)) {
    const pipeline::MeshQuality quality = pipeline::judged(io::read_volume_mesh(options.check), task);
    std::fputs((pipeline::quality_json(quality) + "\n").c_str(), stdout);
    return verdict(quality.verdict);
  }
  if (!io::is_surface_file(options.check))
    throw InvalidInput("cannot check " + options.check.string() + ": volume meshes are read as " +
                       io::readable_volume_meshes() +
                       ", surfaces as STL, PLY, OBJ and VTP; export the mesh as one of these besides");
  const auto quality = meshing::surface_quality(io::read_surface(options.check).surface.mesh, true, task);
  const meshing::QualityVerdict judged = meshing::check(quality);
  std::fputs((pipeline::quality_json(quality, judged) + "\n").c_str(), stdout);
  return verdict(judged);
}

geometry::VesselTree tree_for(const MeshCommand& options, const pipeline::Source& source,
                              const pipeline::ModelOptions& how, const core::TaskContext& task) {
  if (!options.centerline.empty()) return io::read_centerlines(options.centerline);
  task.set_stage("centerlines");
  return centerline::extract_centerlines(source.surface, how.source, how.targets, how.centerline, task).tree;
}

/// All vessels of a case, as the window's export does it.
ExitCode mesh_case(const MeshCommand& options, const core::TaskContext& task) {
  if (!options.centerline.empty() || !options.ends.source.empty() || !options.ends.targets.empty())
    throw UsageError("a case has its axes: --centerline, --source and --target are for surfaces");
  pipeline::ModelOptions how;
  apply(options.mesh, how);
  task.set_stage("reading");
  const auto opened = session::CaseFile::open(options.input.input, session::OpenMode::read_only);
  pipeline::MeshExportOptions wanted;
  wanted.sizing = how.sizing;
  wanted.extensions = how.extensions;
  wanted.volume = how.volume;
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
  }
  if (options.json) std::fputs(core::read_file(options.output / "quality.json").c_str(), stdout);
  return *code;
}

}  // namespace

ExitCode run_mesh(const MeshCommand& options, const core::TaskContext& task) {
  if (!options.check.empty()) return check_file(options, task);
  if (options.input.input.empty() || options.output.empty())
    throw UsageError("`ostia mesh` needs a surface or a case and -o DIR, or --check FILE");
  if (options.input.input.extension() == ".ostia") return mesh_case(options, task);
  pipeline::ModelOptions how;
  apply(options.mesh, how);
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
  pipeline::JobKey key{
      "mesh", {{"surface", source.sha256}}, pipeline::parameters_json(how, source_options(options.input))};
  if (!options.centerline.empty()) key.inputs["centerline"] = core::sha256_file(options.centerline);
  if (const auto code = pipeline::already_done(options.output, key)) {
    core::log_info("done already with the same input and parameters; nothing to do");
    if (options.json) std::fputs(core::read_file(options.output / "quality.json").c_str(), stdout);
    return *code;
  }
  pipeline::require_sound_surface(source.surface, options.input.input.string());
  const geometry::VesselTree tree = tree_for(options, source, how, task.sub(0.1, 0.3));
  const pipeline::MeshedLumen meshed = pipeline::mesh_lumen(source.surface, tree, how, task.sub(0.3, 0.95));
  for (const std::string& warning : meshed.warnings) core::log_warning(warning);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pipeline::write_mesh_folder(options.output, meshed, how, key, seconds, task.sub(0.95, 1.0));
  if (options.json) std::fputs((pipeline::quality_json(meshed.quality) + "\n").c_str(), stdout);
  task.set_progress(1.0);
  return verdict(meshed.quality.verdict);
}

}  // namespace ostia::app
