#include "ostia/pipeline/vessel_forecast.h"

#include "meshes/export_parts.h"

#include "ostia/meshing/caps.h"
#include "ostia/meshing/stenosis_sizing.h"

#include <algorithm>

namespace ostia::pipeline {
namespace {

using geometry::FacedSurface;
using meshing::ForecastPlace;

constexpr double forecast_walls_share = 0.7;  // of the progress

struct Meshing {
  meshing::ClipOptions clip;
  std::optional<meshing::FlowExtensionOptions> extensions;
  meshing::SizingOptions sizing;
  std::optional<meshing::BoundaryLayerOptions> layers;
};

/// A wall with its ends cut and capped, as it is before it is remeshed, and what is wrong with it.
VesselForecast forecast_cut(const geometry::TriMesh& wall, geometry::VesselTree axes, const Meshing& how,
                            const core::TaskContext& task) {
  task.set_stage("ends cut");
  const core::TaskContext ends = task.sub(0.0, 1.0 / 3.0);
  meshing::ClippedSurface clipped = meshing::clip_ends(wall, axes, how.clip, ends);
  if (how.extensions) {
    task.set_stage("flow extensions");
    meshing::ExtendedEnds extended = meshing::extend_ends(clipped, axes, *how.extensions, ends);
    clipped = std::move(extended.surface);
    axes = std::move(extended.tree);
  }
  FacedSurface capped = meshing::cap_ends(clipped, {}, ends);
  meshing::ForecastOptions asked;
  asked.tree = &axes;
  asked.sizing = meshing::at_throats(how.sizing, axes, capped.mesh);
  asked.layers = how.layers;
  VesselForecast made;
  made.forecast = meshing::mesh_forecast(capped, asked, task.sub(1.0 / 3.0, 1.0));
  made.surface = std::move(capped.mesh);
  return made;
}

/// One tree up to its caps.
VesselForecast forecast_of(const RootedModel& part, const MeshExportOptions& options,
                           const core::TaskContext& task) {
  const geometry::TriMesh wall =
      sound_wall(part, cell_for(part.model, options.sizing), task.sub(0.0, forecast_walls_share));
  meshing::ClipOptions clip;
  clip.inset_radii = options.inset_radii;
  return forecast_cut(wall, part.model.tree,
                      {clip, options.extensions, options.sizing, options.volume.layers},
                      task.sub(forecast_walls_share, 1.0));
}

void append(VesselForecast& to, VesselForecast one) {
  const auto points = static_cast<std::int32_t>(to.surface.points.size());
  const auto triangles = static_cast<std::int32_t>(to.surface.triangles.size());
  to.surface.points.insert(to.surface.points.end(), one.surface.points.begin(), one.surface.points.end());
  for (const geometry::Triangle& t : one.surface.triangles)
    to.surface.triangles.push_back({t[0] + points, t[1] + points, t[2] + points});
  for (ForecastPlace& place : one.forecast.places) {
    for (std::int32_t& triangle : place.triangles) triangle += triangles;
    to.forecast.places.push_back(std::move(place));
  }
}

}  // namespace

VesselForecast forecast_model(const LumenWithAxes& lumen, const ModelOptions& options,
                              const core::TaskContext& task) {
  return forecast_cut(
      lumen.model.lumen, lumen.axes,
      {clip_of(lumen.model.source, options), options.extensions, options.sizing, options.volume.layers},
      task);
}

VesselForecast forecast_mesh(const lumen::LumenModel& whole, const MeshExportOptions& options,
                             const core::TaskContext& task) {
  validate(options);
  const std::vector<RootedModel> parts = rooted_parts(part_of(whole, all_or(whole, options.vessels)));
  const std::vector<double> shares = shares_of(parts, options.sizing);
  VesselForecast all;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string tree = parts.size() == 1 ? "" : "the tree of " + parts[i].name + ": ";
    append(all,
           naming(tree, [&] { return forecast_of(parts[i], options, task.sub(shares[i], shares[i + 1])); }));
  }
  std::stable_sort(all.forecast.places.begin(), all.forecast.places.end(),
                   [](const ForecastPlace& a, const ForecastPlace& b) { return a.fails && !b.fails; });
  task.set_progress(1.0);
  return all;
}

}  // namespace ostia::pipeline
