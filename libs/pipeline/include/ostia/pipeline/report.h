#pragma once
/// \file What a person and a program read of a model.

#include "ostia/figure/picture.h"
#include "ostia/pipeline/model.h"
#include "ostia/pipeline/truth.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// `report.json` (docs/schemas/report.schema.json). Holds no path and nothing of the patient.
std::string report_json(const Model& model, const ModelOptions& options,
                        const std::optional<TruthErrors>& truth);

/// A picture of the report, and what it is called as a file.
struct ReportPicture {
  std::string name;  ///< "slices", "surface", "mesh", "diameter"
  std::string heading, caption;
  figure::Picture picture;
};
/// Three slices with the lumen's contour (where there is an image), the surface with its centerlines, the
/// mesh cut open, the diameter along each vessel.
std::vector<ReportPicture> report_pictures(const Model& model,
                                           const core::TaskContext& task = core::no_task());

/// `pictures/<name>.png` and `.svg` in the folder. Throws IoError, Cancelled.
void write_pictures(const std::filesystem::path& folder, const std::vector<ReportPicture>& pictures,
                    const core::TaskContext& task = core::no_task());

/// `report.html`: one file with the pictures and the figures in tables.
void write_report_html(const std::filesystem::path& path, const Model& model,
                       const std::vector<ReportPicture>& pictures, const std::optional<TruthErrors>& truth);

/// Canonical JSON of all options that decide the result; part of the manifest.
std::string parameters_json(const ModelOptions& options, const SourceOptions& reading = {});

/// JSON objects of a surface's and a mesh's quality with the names that scripts rely on
/// (docs/schemas/quality.schema.json).
std::string quality_json(const meshing::SurfaceQuality& surface, const meshing::QualityVerdict& verdict);
std::string quality_json(const MeshQuality& quality);

}  // namespace ostia::pipeline
