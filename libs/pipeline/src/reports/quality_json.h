#pragma once
/// \file The figures of a mesh as JSON (docs/schemas/quality.schema.json).

#include "ostia/pipeline/volume_mesh.h"

#include <nlohmann/json_fwd.hpp>

namespace ostia::pipeline {

nlohmann::json point_json(const geometry::Vec3& p);
nlohmann::json verdict_json(const meshing::QualityVerdict& verdict);
nlohmann::json surface_json(const meshing::SurfaceQuality& quality);
/// `surface`, `volume`, and where they are known `wall_deviation`, `layers`, `quadratic` and `extensions`.
nlohmann::json figures_json(const MeshQuality& quality);

}  // namespace ostia::pipeline
