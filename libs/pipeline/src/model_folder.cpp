#include "ostia/pipeline/model_folder.h"

#include "ostia/core/files.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/pipeline/report.h"

#include <chrono>

namespace ostia::pipeline {
namespace fs = std::filesystem;
namespace {

void write_meshes(const fs::path& folder, const MeshedLumen& meshed) {
  io::write_surface(folder / "lumen.vtp", meshed.surface);
  io::write_surface(folder / "lumen.stl", meshed.surface.mesh);
  io::write_volume_mesh(folder / "mesh.vtu", meshed.mesh);
}

ExitCode code_of(const MeshedLumen& meshed) {
  return meshed.verdict.ok() ? ExitCode::ok : ExitCode::quality_failed;
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
  write_meshes(staged.temporary(), model.meshed);
  io::write_centerlines(staged.temporary() / "centerlines.vtp", model.meshed.centerlines.tree);
  core::write_file(staged.temporary() / "report.json", report_json(model, options, truth));
  task.throw_if_cancelled();
  const std::vector<ReportPicture> pictures = report_pictures(model, task);
  write_report_html(staged.temporary() / "report.html", model, pictures, truth);
  fs::create_directory(staged.temporary() / "pictures");
  for (const ReportPicture& one : pictures)
    one.picture.write_png(staged.temporary() / "pictures" / (one.name + ".png"), 2.0);
  task.throw_if_cancelled();
  ManifestRecord record{
      key, code_of(model.meshed), seconds_before + since(start), model.warnings,
      quality_json(model.meshed.surface_quality, model.meshed.volume_quality, model.meshed.verdict)};
  write_manifest(staged.temporary(), record);
  staged.commit();
  return record.exit_code;
}

ExitCode write_mesh_folder(const fs::path& folder, const MeshedLumen& meshed, const JobKey& key,
                           double seconds_before) {
  const auto start = std::chrono::steady_clock::now();
  core::StagedFolder staged(folder);
  write_meshes(staged.temporary(), meshed);
  const std::string quality = quality_json(meshed.surface_quality, meshed.volume_quality, meshed.verdict);
  core::write_file(staged.temporary() / "quality.json", quality + "\n");
  ManifestRecord record{key, code_of(meshed), seconds_before + since(start), meshed.warnings, quality};
  write_manifest(staged.temporary(), record);
  staged.commit();
  return record.exit_code;
}

}  // namespace ostia::pipeline
