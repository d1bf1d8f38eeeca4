#pragma once
/// \file Meshes of vessels whose axes and walls are known: those of a case, and of a mask.

#include "commands.h"
#include "input/mask_input.h"

#include "ostia/lumen/lumen_model.h"
#include "ostia/pipeline/model.h"

#include <filesystem>
#include <functional>
#include <string>

namespace ostia::app {

struct VesselMesh {
  const MeshOptions& options;
  std::string coords;  ///< of planes
  std::filesystem::path output;
  bool json = false;
};

/// As the window's export does it: a folder, or one a tree. `how` is what `options` say.
ExitCode mesh_vessels(const lumen::LumenModel& model, const VesselMesh& wanted,
                      const pipeline::ModelOptions& how, const core::TaskContext& task);

/// The vessels of a mask as `ostia extract` has them, meshed. `refined` may change what is wanted once the
/// vessels are known. Throws UsageError for an array of sizes, which is of a surface.
ExitCode mesh_mask(const MaskInput& mask, const VesselMesh& wanted,
                   const std::function<void(const lumen::LumenModel&, pipeline::ModelOptions&)>& refined,
                   const core::TaskContext& task);

}  // namespace ostia::app
