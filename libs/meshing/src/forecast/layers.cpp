#include "boundary_layer/march.h"
#include "boundary_layer/wall.h"
#include "forecast/surface.h"

#include "ostia/core/parallel.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

/// The wall alone, with the surface's points, without rings: for `room`.
LayerWall bare_wall(const ForecastSurface& surface) {
  LayerWall wall;
  wall.mesh.points = surface.mesh.points;
  wall.triangles_of.resize(wall.mesh.points.size());
  for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i) {
    if (surface.wall[i] == 0 || !(surface.area(i).norm() > 0.0)) continue;
    for (const std::int32_t v : surface.mesh.triangles[i])
      wall.triangles_of[static_cast<std::size_t>(v)].push_back(
          static_cast<std::int32_t>(wall.mesh.triangles.size()));
    wall.mesh.triangles.push_back(surface.mesh.triangles[i]);
  }
  return wall;
}

/// Inward unit normals around each point. The size of a corner is left out: needles are remeshed, folds stay.
std::vector<SightCone> inward_normals(const LayerWall& wall) {
  std::vector<Vec3> normals;
  for (const geometry::Triangle& t : wall.mesh.triangles)
    normals.push_back(
        -(wall.point(t[1]) - wall.point(t[0])).cross(wall.point(t[2]) - wall.point(t[0])).normalized());
  std::vector<SightCone> cones(wall.mesh.points.size());
  for (std::size_t v = 0; v < cones.size(); ++v)
    for (const std::int32_t t : wall.triangles_of[v])
      cones[v].push_back(normals[static_cast<std::size_t>(t)]);
  return cones;
}

std::string percent(double share) {
  const double percents = 100.0 * share;
  return (share < 0.0995 ? core::significant_text(percents, 2) : core::fixed_text(percents, 0)) + " %";
}

void add_folds(const ForecastSurface& surface, const std::vector<double>& sight,
               std::vector<ForecastPlace>& places) {
  constexpr double least_sight = 0.2;  // a wedge of 23 degrees
  std::vector<char> flagged(sight.size(), 0);
  std::vector<double> badness(sight.size(), 0.0);
  for (std::size_t v = 0; v < sight.size(); ++v)
    if (sight[v] < least_sight) flagged[v] = 1, badness[v] = -sight[v];
  std::vector<ForecastPlace> found;
  for (const auto& cluster : clusters(surface, flagged, badness)) {
    const double worst = sight[static_cast<std::size_t>(cluster.front())];
    ForecastPlace place = place_at(surface, TroubleKind::sharp_fold, worst <= 0.0, cluster);
    place.sentence = "the wall folds so sharply near " + place_text(place.point) +
                     (worst <= 0.0 ? " that no direction sees both sides: layers cannot grow there"
                                   : " that layers there will be badly shaped");
    place.repair = OfferedRepair::smooth;
    place.repair_sentence = "smooth the wall there, or mesh without layers";
    found.push_back(std::move(place));
  }
  add_places(std::move(found), surface.options, places);
}

void add_thin(const ForecastSurface& surface, const LayerWall& wall, const std::vector<double>& share,
              std::vector<ForecastPlace>& places) {
  constexpr double half = 0.5;
  constexpr std::size_t least_points = 3;
  double thin = 0.0, all = 0.0;
  std::vector<char> flagged(share.size(), 0);
  std::vector<double> badness(share.size(), 0.0);
  for (std::size_t v = 0; v < share.size(); ++v) {
    double area = 0.0;
    for (const std::int32_t t : wall.triangles_of[v]) {
      const geometry::Triangle& c = wall.mesh.triangles[static_cast<std::size_t>(t)];
      area += (wall.point(c[1]) - wall.point(c[0])).cross(wall.point(c[2]) - wall.point(c[0])).norm();
    }
    all += area;
    if (!(share[v] < half)) continue;
    thin += area;
    flagged[v] = 1;
    badness[v] = -share[v];
  }
  std::vector<ForecastPlace> found;
  for (const auto& cluster : clusters(surface, flagged, badness)) {
    if (cluster.size() < least_points) continue;
    const double worst = share[static_cast<std::size_t>(cluster.front())];
    ForecastPlace place = place_at(surface, TroubleKind::no_room_for_layers, false, cluster);
    place.sentence = "there is room for " + percent(worst) + " of the layers' thickness near " +
                     place_text(place.point) + "; for less than half of it on " + percent(thin / all) +
                     " of the wall";
    place.repair = OfferedRepair::thinner_layers;
    place.factor = std::clamp(worst, 0.01, 0.99);
    place.repair_sentence =
        "ask for thinner layers or shorter edges; else they get thinner there by themselves";
    found.push_back(std::move(place));
  }
  add_places(std::move(found), surface.options, places);
}

}  // namespace

void look_at_layers(const ForecastSurface& surface, std::vector<ForecastPlace>& places,
                    const core::TaskContext& task) {
  const BoundaryLayerOptions& options = *surface.options.layers;
  const LayerWall wall = bare_wall(surface);
  if (wall.mesh.triangles.empty()) return;
  const std::vector<SightCone> cones = inward_normals(wall);
  std::vector<Vec3> directions(cones.size(), Vec3::UnitX());
  std::vector<double> sight(cones.size(), 1.0), most(cones.size(), 0.0);
  core::parallel_for(cones.size(), 256, [&](std::size_t v) {
    if (cones[v].empty()) return;
    constexpr double plain_is_enough = 0.7;
    Vec3 sum = Vec3::Zero();
    for (const Vec3& normal : cones[v]) sum += normal;
    const Vec3 plain = sum.squaredNorm() > 0.0 ? Vec3(sum.normalized()) : cones[v].front();
    sight[v] = least_product(cones[v], plain);
    directions[v] = plain;
    if (sight[v] < plain_is_enough) {
      directions[v] = most_visible(cones[v]);
      sight[v] = std::max(sight[v], least_product(cones[v], directions[v]));
    }
    const double wanted = options.thickness * surface.edge_mm[v];
    if (wanted > 0.0 && std::isfinite(wanted)) most[v] = wanted / options.largest_fraction_of_radius;
  });
  add_folds(surface, sight, places);
  task.throw_if_cancelled();
  const std::vector<double> radii = room(wall, directions, most, task);
  std::vector<double> share(radii.size(), 1.0);
  for (std::size_t v = 0; v < radii.size(); ++v)
    if (most[v] > 0.0 && !cones[v].empty()) share[v] = radii[v] / most[v];
  add_thin(surface, wall, share, places);
}

}  // namespace ostia::meshing
