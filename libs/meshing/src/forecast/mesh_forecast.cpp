#include "ostia/meshing/mesh_forecast.h"

#include "forecast/surface.h"

#include "ostia/core/error.h"

#include <algorithm>

namespace ostia::meshing {

std::string_view name_of(TroubleKind kind) {
  switch (kind) {
    case TroubleKind::units:
      return "units";
    case TroubleKind::not_finite:
      return "not_finite";
    case TroubleKind::open_edges:
      return "open_edges";
    case TroubleKind::non_manifold:
      return "non_manifold";
    case TroubleKind::turned_triangles:
      return "turned_triangles";
    case TroubleKind::inward:
      return "inward";
    case TroubleKind::self_intersections:
      return "self_intersections";
    case TroubleKind::touching_walls:
      return "touching_walls";
    case TroubleKind::narrow_lumen:
      return "narrow_lumen";
    case TroubleKind::edge_size:
      return "edge_size";
    case TroubleKind::small_end:
      return "small_end";
    case TroubleKind::sharp_fold:
      return "sharp_fold";
    case TroubleKind::no_room_for_layers:
      return "no_room_for_layers";
  }
  return "";
}

std::string_view name_of(OfferedRepair repair) {
  switch (repair) {
    case OfferedRepair::none:
      return "none";
    case OfferedRepair::convert_units:
      return "convert_units";
    case OfferedRepair::fill_holes:
      return "fill_holes";
    case OfferedRepair::repair_surface:
      return "repair_surface";
    case OfferedRepair::orient:
      return "orient";
    case OfferedRepair::smaller_edges:
      return "smaller_edges";
    case OfferedRepair::smooth:
      return "smooth";
    case OfferedRepair::thinner_layers:
      return "thinner_layers";
    case OfferedRepair::drop_layers:
      return "drop_layers";
  }
  return "";
}

void validate(const ForecastOptions& o) {
  const auto refuse = [](const std::string& what) { throw InvalidInput("mesh forecast: " + what); };
  if (!(o.min_edges_across >= 0.0 && o.min_edges_across <= 20.0))
    refuse("min_edges_across " + std::to_string(o.min_edges_across) + " must lie in [0, 20]");
  if (o.max_places < 1) refuse("max_places must be at least 1");
  if (o.tree) validate(o.sizing);
  if (o.layers) validate(*o.layers);
}

bool MeshForecast::fails() const {
  return std::any_of(places.begin(), places.end(), [](const ForecastPlace& p) { return p.fails; });
}

std::string MeshForecast::summary() const {
  if (places.empty()) return "nothing found";
  std::string text;
  for (const ForecastPlace& place : places) text += (text.empty() ? "" : "; ") + place.sentence;
  return text;
}

namespace {

void check_lists(const geometry::FacedSurface& surface, const ForecastOptions& options) {
  const auto refuse = [](const std::string& what) { throw InvalidInput("mesh forecast: " + what); };
  const geometry::TriMesh& mesh = surface.mesh;
  if (mesh.triangles.empty()) refuse("the surface has no triangles");
  if (!surface.face_ids.empty() && surface.face_ids.size() != mesh.triangles.size())
    refuse(std::to_string(surface.face_ids.size()) + " face ids for " +
           std::to_string(mesh.triangles.size()) + " triangles; one a triangle is needed, or none");
  if (!options.edge_lengths_mm.empty() && options.edge_lengths_mm.size() != mesh.points.size())
    refuse(std::to_string(options.edge_lengths_mm.size()) + " edge lengths for " +
           std::to_string(mesh.points.size()) + " points; one a point is needed, or none");
  for (const geometry::Triangle& t : mesh.triangles)
    for (const std::int32_t v : t)
      if (v < 0 || static_cast<std::size_t>(v) >= mesh.points.size())
        refuse("a triangle refers to point " + std::to_string(v) + ", which does not exist");
}

/// Whether all points have a place; nothing else can be looked at where not.
bool look_at_points(const geometry::TriMesh& mesh, std::vector<ForecastPlace>& places) {
  const auto count = static_cast<std::size_t>(std::count_if(
      mesh.points.begin(), mesh.points.end(), [](const geometry::Vec3& p) { return !p.allFinite(); }));
  if (count == 0) return true;
  ForecastPlace place;
  place.kind = TroubleKind::not_finite;
  place.count = count;
  place.sentence = std::to_string(count) + " points have coordinates that are no numbers";
  place.repair = OfferedRepair::repair_surface;
  place.repair_sentence = "drop the triangles there and fill the holes";
  places.push_back(place);
  return false;
}

}  // namespace

MeshForecast mesh_forecast(const geometry::FacedSurface& faced, const ForecastOptions& options,
                           const core::TaskContext& task) {
  validate(options);
  check_lists(faced, options);
  task.set_stage("mesh forecast");
  MeshForecast forecast;
  std::vector<ForecastPlace>& places = forecast.places;
  if (!look_at_points(faced.mesh, places)) return forecast;
  ForecastSurface surface(faced, options, task);
  task.set_progress(0.3);
  look_at_edges(surface, places);
  look_at_orientation(surface, places);
  task.throw_if_cancelled();
  look_at_crossings(surface, places);
  task.set_progress(0.6);
  const WallDistances distances = wall_distances(surface, task);
  task.set_progress(0.8);
  if (!look_at_units(surface, distances, places)) {
    look_at_sizes(surface, distances, places);
    look_at_neighbours(surface, distances, places);
    task.throw_if_cancelled();
    if (options.layers) look_at_layers(surface, places, task);
  }
  std::stable_sort(places.begin(), places.end(), [](const ForecastPlace& a, const ForecastPlace& b) {
    return a.fails != b.fails ? a.fails : a.kind < b.kind;
  });
  task.set_progress(1.0);
  return forecast;
}

}  // namespace ostia::meshing
