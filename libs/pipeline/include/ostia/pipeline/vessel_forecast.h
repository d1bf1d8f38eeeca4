#pragma once
/// \file Will the vessels of a lumen model mesh? See docs/methods/mesh-quality.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/meshing/mesh_forecast.h"
#include "ostia/pipeline/model.h"
#include "ostia/pipeline/vessel_export.h"

namespace ostia::pipeline {

/// What export_mesh would fail at or make poorly, with the surface that it would remesh.
struct VesselForecast {
  geometry::TriMesh surface;       ///< of all trees, between the cut ends, with extensions and caps
  meshing::MeshForecast forecast;  ///< triangles are those of `surface`
};

/// The same of a lumen that mesh_model is to mesh: does what it does up to the caps. Throws as it does where
/// an end cannot be cut or extended; Cancelled.
VesselForecast forecast_model(const LumenWithAxes& lumen, const ModelOptions& options,
                              const core::TaskContext& task = core::no_task());

/// Looks before anything is meshed: does what export_mesh does up to the caps, and asks mesh_forecast with
/// the same sizes and layers. Throws as export_mesh does where a tree does not come as far as its caps (a
/// wall in pieces, an end that cannot be cut or extended), InvalidInput (options), Cancelled.
VesselForecast forecast_mesh(const lumen::LumenModel& model, const MeshExportOptions& options = {},
                             const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
