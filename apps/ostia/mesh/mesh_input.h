#pragma once
/// \file What a mesh's options say of the surface: placed planes, an array of edge lengths, a forecast.

#include "commands.h"

#include "ostia/imaging/volume.h"
#include "ostia/meshing/mesh_forecast.h"
#include "ostia/pipeline/model.h"

#include <string>

namespace ostia::app {

/// --plane and --planes. Throws InvalidInput that shows the text, or names the table and its line.
std::vector<meshing::PlacedPlane> placed_planes(const MeshOptions& options, const std::string& coords,
                                                const imaging::Geometry* grid);

/// --size-array: nothing where it is left out. `unit_mm` is that of `input`. Throws InvalidInput for
/// an input without such an array, naming those it has, and for lengths that are not positive, with the
/// place.
void apply_size_array(const MeshOptions& options, const InputOptions& input, double unit_mm,
                      pipeline::ModelOptions& to);

/// What `how` would meet on this surface; sizes follow `tree` where there is one.
meshing::MeshForecast forecast_of(const geometry::FacedSurface& surface, const geometry::VesselTree* tree,
                                  const pipeline::ModelOptions& how, const core::TaskContext& task);
/// The place's sentence and the way out, as the command line has it.
std::string forecast_text(const meshing::ForecastPlace& place);
/// Logs the worst place of each kind, of the surface itself, of sizes and layers, or of both.
void warn_of(const meshing::MeshForecast& forecast, bool of_the_surface, bool of_sizes);
/// A JSON object: `fails`, `places`.
std::string forecast_json(const meshing::MeshForecast& forecast);
/// A JSON object of a surface's quality with the forecast as the member `forecast`.
std::string with_forecast(const std::string& quality, const meshing::MeshForecast& forecast);

}  // namespace ostia::app
