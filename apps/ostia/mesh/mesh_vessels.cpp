#include "mesh/mesh_vessels.h"

#include "flow/solver_case.h"
#include "mesh/mesh_input.h"
#include "mesh/told_mesh.h"
#include "options/model_options.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/pipeline/vessel_export.h"

#include <optional>

namespace ostia::app {

ExitCode mesh_vessels(const lumen::LumenModel& model, const VesselMesh& wanted,
                      const pipeline::ModelOptions& how, const core::TaskContext& task) {
  pipeline::MeshExportOptions options;
  options.sizing = how.sizing;
  options.extensions = how.extensions;
  options.volume = how.volume;
  options.planes = placed_planes(wanted.options, wanted.coords, nullptr);
  if (how.inset_radii) options.inset_radii = *how.inset_radii;
  pipeline::require_free_folder(wanted.output);
  std::optional<ExitCode> code = pipeline::already_done(wanted.output, pipeline::mesh_job(model, options));
  if (code) {
    core::log_info("done already with the same vessels and parameters; nothing to do");
  } else {
    const auto made = pipeline::export_mesh(wanted.output, model, options, task);
    for (const std::string& warning : made.warnings) core::log_warning(warning);
    code = made.verdict.ok() ? ExitCode::ok : ExitCode::quality_failed;
    if (!made.verdict.ok()) core::log_warning("quality control failed: " + made.verdict.summary());
    if (made.trees == 1) tell_case(how.volume, wanted.output);
  }
  tell_mesh(wanted.output, wanted.json);
  return *code;
}

ExitCode mesh_mask(const MaskInput& mask, const VesselMesh& wanted,
                   const std::function<void(const lumen::LumenModel&, pipeline::ModelOptions&)>& refined,
                   const core::TaskContext& task) {
  if (!wanted.options.size_array.empty()) throw UsageError("--size-array is for surfaces (.vtp)");
  pipeline::ModelOptions how;
  apply(wanted.options, how);
  pipeline::require_free_folder(wanted.output);
  const MaskCase found = mask_case(mask, {}, task.sub(0.0, 0.1));
  for (const std::string& warning : found.model.found.found.warnings) core::log_warning(warning);
  const lumen::LumenModel& model = found.model.found.model;
  if (refined) refined(model, how);
  return mesh_vessels(model, wanted, how, task.sub(0.1, 1.0));
}

}  // namespace ostia::app
