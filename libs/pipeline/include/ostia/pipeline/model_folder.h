#pragma once
/// \file The folder that `ostia model` and `ostia mesh` leave behind.

#include "ostia/pipeline/manifest.h"
#include "ostia/pipeline/model.h"
#include "ostia/pipeline/truth.h"

#include <filesystem>
#include <optional>

namespace ostia::pipeline {

/// Writes lumen.vtp, lumen.stl, centerlines.vtp, mesh.vtu and the formats asked for, report.json,
/// report.html, pictures/*.png and, last, manifest.json; the folder appears whole or not at all. Returns
/// quality_failed when the gate did not pass, ok otherwise.
ExitCode write_model_folder(const std::filesystem::path& folder, const Model& model,
                            const ModelOptions& options, const JobKey& key,
                            const std::optional<TruthErrors>& truth, double seconds_before,
                            const core::TaskContext& task = core::no_task());

/// lumen.vtp, lumen.stl, mesh.vtu and the formats asked for, quality.json and manifest.json.
ExitCode write_mesh_folder(const std::filesystem::path& folder, const MeshedLumen& meshed,
                           const ModelOptions& options, const JobKey& key, double seconds_before,
                           const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
