#include "ostia/pipeline/model_folder.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/report.h"

#include <chrono>

namespace ostia::pipeline {
namespace fs = std::filesystem;
namespace {

/// All meshes; what the writers have to say goes into `warnings`.
void write_meshes(const fs::path& folder, const MeshedLumen& meshed, const VolumeOptions& options,
                  std::vector<std::string>& warnings, const core::TaskContext& task) {
  io::write_surface(folder / "lumen.vtp", meshed.surface);
  io::write_surface(folder / "lumen.stl", meshed.surface.mesh);
  const auto more = write_volume_mesh(folder, meshed.mesh, meshed.in_layers, options, task);
  for (const std::string& warning : more) core::log_warning(warning);
  warnings.insert(warnings.end(), more.begin(), more.end());
}

ExitCode code_of(const MeshedLumen& meshed) {
  return meshed.quality.verdict.ok() ? ExitCode::ok : ExitCode::quality_failed;
}

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

ExitCode write_model_folder(const fs::path& folder, const Model& model, const ModelOptions& options,
                            const JobKey& key, const std::optional<TruthErrors>& truth, double seconds_before,
                            const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  task.set_stage("report");
  core::StagedFolder staged(folder);
  std::vector<std::string> warnings = model.warnings;
  write_meshes(staged.temporary(), model.meshed, options.volume, warnings, task.sub(0.0, 0.5));
  io::write_centerlines(staged.temporary() / "centerlines.vtp", model.meshed.centerlines.tree);
  core::write_file(staged.temporary() / "report.json", report_json(model, options, truth));
  task.throw_if_cancelled();
  const std::vector<ReportPicture> pictures = report_pictures(model, task.sub(0.5, 1.0));
  write_report_html(staged.temporary() / "report.html", model, pictures, truth);
  fs::create_directory(staged.temporary() / "pictures");
  for (const ReportPicture& one : pictures)
    one.picture.write_png(staged.temporary() / "pictures" / (one.name + ".png"), 2.0);
  task.throw_if_cancelled();
  ManifestRecord record{key, code_of(model.meshed), seconds_before + since(start), warnings,
                        quality_json(model.meshed.quality)};
  write_manifest(staged.temporary(), record);
  staged.commit();
  return record.exit_code;
}

ExitCode write_mesh_folder(const fs::path& folder, const MeshedLumen& meshed, const ModelOptions& options,
                           const JobKey& key, double seconds_before, const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  task.set_stage("writing");
  core::StagedFolder staged(folder);
  std::vector<std::string> warnings = meshed.warnings;
  write_meshes(staged.temporary(), meshed, options.volume, warnings, task);
  const std::string quality = quality_json(meshed.quality);
  core::write_file(staged.temporary() / "quality.json", quality + "\n");
  ManifestRecord record{key, code_of(meshed), seconds_before + since(start), warnings, quality};
  write_manifest(staged.temporary(), record);
  task.throw_if_cancelled();
  staged.commit();
  return record.exit_code;
}

}  // namespace ostia::pipeline
