#pragma once
/// \file What a person and a program read of a model.

#include <filesystem>
#include <optional>
#include <string>

#include "ostia/pipeline/model.h"
#include "ostia/pipeline/truth.h"

namespace ostia::pipeline {

/// `report.json` (docs/schemas/report.schema.json). Holds no path and nothing of the patient.
std::string report_json(const Model& model, const ModelOptions& options, const std::optional<TruthErrors>& truth);

/// `report.html`: one file with three slices and the lumen's contour, the surface with its centerlines, the mesh cut open, the diameter along
/// each vessel, and the figures in tables.
void write_report_html(const std::filesystem::path& path, const Model& model, const std::optional<TruthErrors>& truth,
                       const core::TaskContext& task = core::no_task());

/// Canonical JSON of all options that decide the result; part of the manifest.
std::string parameters_json(const ModelOptions& options, const SourceOptions& reading = {});

/// JSON objects of the two qualities with the names that scripts rely on.
std::string quality_json(const meshing::SurfaceQuality& quality);
std::string quality_json(const meshing::SurfaceQuality& surface, const meshing::VolumeQuality& volume,
                         const meshing::QualityVerdict& verdict);

}  // namespace ostia::pipeline
