#include "boundary_layer/wall.h"
#include "forecast/surface.h"

#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>

namespace ostia::meshing {

using core::significant_text;
using geometry::Vec3;

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::size_t least_points = 3;  // of a place: less is a needle

/// The first wall seen along a direction, which must face the one that looks.
std::optional<geometry::RayHit> facing(const ForecastSurface& surface, std::size_t v, const Vec3& direction,
                                       double sense) {
  constexpr double off_the_wall = 1e-3;  // of the edges there, so that the point's own triangles are not met
  constexpr double least_alignment = 0.5;
  double length = 0.0;
  for (const std::int32_t u : surface.neighbours[v])
    length = std::max(length, (surface.point(u) - surface.mesh.points[v]).norm());
  auto hit = surface.tree.first_hit(surface.mesh.points[v] + off_the_wall * length * direction, direction);
  if (!hit) return std::nullopt;
  const Vec3 normal = surface.area(static_cast<std::size_t>(hit->triangle)).normalized();
  if (!(sense * normal.dot(direction) >= least_alignment)) return std::nullopt;
  hit->t += off_the_wall * length;
  return hit;
}

/// Whether the wall at a triangle is reached from a point along edges of at most `reach` mm together.
bool joined_within(const ForecastSurface& surface, std::int32_t from, std::int32_t triangle, double reach) {
  const geometry::Triangle& target = surface.mesh.triangles[static_cast<std::size_t>(triangle)];
  using Item = std::pair<double, std::int32_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  std::map<std::int32_t, double> best{{from, 0.0}};
  queue.emplace(0.0, from);
  while (!queue.empty()) {
    const auto [distance, v] = queue.top();
    queue.pop();
    if (distance > best[v]) continue;
    if (std::find(target.begin(), target.end(), v) != target.end()) return true;
    for (const std::int32_t u : surface.neighbours[static_cast<std::size_t>(v)]) {
      const double next = distance + (surface.point(u) - surface.point(v)).norm();
      if (next > reach) continue;
      const auto [known, added] = best.emplace(u, next);
      if (!added && known->second <= next) continue;
      known->second = next;
      queue.emplace(next, u);
    }
  }
  return false;
}

/// In a crotch two walls face each other and are one vessel: the way along the wall is short there.
bool is_another_wall(const ForecastSurface& surface, std::int32_t v, std::int32_t triangle, double gap) {
  constexpr double gaps = 12.0, edges = 8.0;  // a crotch of 15 degrees has a way of 7.7 gaps
  const double edge = surface.edge_mm[static_cast<std::size_t>(v)];
  return !joined_within(surface, v, triangle, std::max(gaps * gap, edges * edge));
}

double median(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void look_at_edge_lengths(const ForecastSurface& surface, std::vector<ForecastPlace>& places) {
  std::vector<std::int32_t> wrong;
  for (std::size_t v = 0; v < surface.edge_mm.size(); ++v)
    if (!surface.triangles_of[v].empty() && !(surface.edge_mm[v] > 0.0 && std::isfinite(surface.edge_mm[v])))
      wrong.push_back(static_cast<std::int32_t>(v));
  if (wrong.empty()) return;
  ForecastPlace place = place_at(surface, TroubleKind::edge_size, true, wrong);
  place.sentence = "the edge length asked for is no positive number at " + std::to_string(wrong.size()) +
                   " points, e.g. near " + place_text(place.point);
  place.repair_sentence = "give an edge length above 0";
  places.push_back(std::move(place));
}

/// A factor that shortens, as it is told with two digits too.
double shorter(double factor) {
  return std::min(factor, 0.99);
}

void look_at_ends(const ForecastSurface& surface, std::vector<ForecastPlace>& places) {
  constexpr double fewest_edges = 2.0;  // across
  std::vector<ForecastPlace> found;
  for (const SurfaceEnd& end : surface.ends) {
    double edge = 0.0;
    for (const std::int32_t v : end.points)
      edge += surface.edge_mm[static_cast<std::size_t>(v)] / static_cast<double>(end.points.size());
    if (!(end.diameter_mm < fewest_edges * edge)) continue;
    ForecastPlace place = place_at(surface, TroubleKind::small_end, end.diameter_mm < edge, end.points);
    place.point = end.centre;
    place.extent_mm = end.diameter_mm;
    place.sentence = end.name + " is " + millimetres(end.diameter_mm) + " across and an edge there " +
                     millimetres(edge) + " long, near " + place_text(end.centre);
    place.repair = OfferedRepair::smaller_edges;
    place.factor =
        shorter(end.diameter_mm / (std::max(fewest_edges, surface.options.min_edges_across) * edge));
    place.repair_sentence = "mesh with " + significant_text(place.factor, 2) +
                            " times the edge length, or cut the end farther inside";
    found.push_back(std::move(place));
  }
  add_places(std::move(found), surface.options, places);
}

}  // namespace

WallDistances wall_distances(const ForecastSurface& surface, const core::TaskContext& task) {
  const std::size_t count = surface.mesh.points.size();
  WallDistances d{std::vector<double>(count, never), std::vector<double>(count, never),
                  std::vector<std::int32_t>(count, -1)};
  core::parallel_chunks(count, 512, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t v = first; v < last; ++v) {
      const Vec3& normal = surface.normals[v];
      if (normal.isZero() || !surface.on_wall(v)) continue;
      if (const auto hit = facing(surface, v, -normal, 1.0)) d.across[v] = hit->t;
      if (const auto hit = facing(surface, v, normal, -1.0)) {
        d.outside[v] = hit->t;
        d.outside_triangle[v] = hit->triangle;
      }
    }
  });
  return d;
}

bool look_at_units(const ForecastSurface& surface, const WallDistances& distances,
                   std::vector<ForecastPlace>& places) {
  constexpr double thinnest = 0.1, widest = 100.0;  // mm, of vessels that have been seen
  constexpr double largest = 2000.0;                // mm, of a person
  const double width = median(distances.across);
  if (!(width > 0.0) || (width >= thinnest && width <= widest)) return false;
  const geometry::Box3 box = geometry::bounds(surface.mesh.points);
  const Vec3 size = box.sizes();
  struct Unit {
    const char* name;
    double factor;
  };
  constexpr std::array<Unit, 3> units{{{"metres", 1000.0}, {"centimetres", 10.0}, {"micrometres", 0.001}}};
  const auto* unit = std::find_if(units.begin(), units.end(), [&](const Unit& u) {
    return width * u.factor >= 0.5 && width * u.factor <= 50.0 && size.norm() * u.factor <= largest;
  });
  if (unit == units.end()) return false;
  ForecastPlace place;
  place.kind = TroubleKind::units;
  place.point = box.center();
  place.extent_mm = 0.5 * size.norm();
  place.count = surface.mesh.points.size();
  place.sentence = "the vessel is " + millimetres(width) + " wide and the whole " +
                   significant_text(size.x(), 3) + " x " + significant_text(size.y(), 3) + " x " +
                   millimetres(size.z()) + ": that looks like " + unit->name;
  place.factor = unit->factor;
  place.repair = OfferedRepair::convert_units;
  place.repair_sentence =
      std::string("read it in ") + unit->name + " (times " + significant_text(unit->factor, 6) + ")";
  places.push_back(std::move(place));
  return true;
}

void look_at_sizes(const ForecastSurface& surface, const WallDistances& distances,
                   std::vector<ForecastPlace>& places) {
  look_at_edge_lengths(surface, places);
  look_at_ends(surface, places);
  const std::size_t count = surface.mesh.points.size();
  std::vector<char> flagged(count, 0);
  std::vector<double> badness(count, 0.0);
  for (std::size_t v = 0; v < count; ++v) {
    const double edges_across = distances.across[v] / surface.edge_mm[v];
    if (!(edges_across < surface.options.min_edges_across)) continue;
    flagged[v] = 1;
    badness[v] = -edges_across;
  }
  std::vector<ForecastPlace> narrow, too_large;
  for (const auto& cluster : clusters(surface, flagged, badness)) {
    if (cluster.size() < std::min(least_points, count / 10)) continue;
    const auto worst = static_cast<std::size_t>(cluster.front());
    const double edges_across = -badness[worst];
    // The surface's own edges are not those that it will be meshed with.
    const bool asked_for = surface.options.tree || !surface.options.edge_lengths_mm.empty();
    const bool larger = asked_for && edges_across < 1.0;
    ForecastPlace place =
        place_at(surface, larger ? TroubleKind::edge_size : TroubleKind::narrow_lumen, larger, cluster);
    place.sentence = "the lumen is " + millimetres(distances.across[worst]) + " wide and an edge " +
                     millimetres(surface.edge_mm[worst]) + " long near " + place_text(place.point) +
                     (larger ? ": the edge is larger than the vessel"
                             : ": " + significant_text(edges_across, 2) + " edges across");
    place.repair = OfferedRepair::smaller_edges;
    place.factor = shorter(edges_across / std::max(surface.options.min_edges_across, 1.0));
    place.repair_sentence = "mesh with " + significant_text(place.factor, 2) + " times the edge length there";
    (larger ? too_large : narrow).push_back(std::move(place));
  }
  add_places(std::move(too_large), surface.options, places);
  add_places(std::move(narrow), surface.options, places);
}

void look_at_neighbours(const ForecastSurface& surface, const WallDistances& distances,
                        std::vector<ForecastPlace>& places) {
  const std::size_t count = surface.mesh.points.size();
  std::vector<char> flagged(count, 0);
  std::vector<double> badness(count, 0.0);
  for (std::size_t v = 0; v < count; ++v)
    if (distances.outside[v] < surface.edge_mm[v]) flagged[v] = 1, badness[v] = -distances.outside[v];
  // Both sides of a gap are one place.
  std::vector<std::pair<std::int32_t, std::int32_t>> links;
  const auto link = [&](std::size_t v, std::int32_t u) {
    if (flagged[static_cast<std::size_t>(u)] != 0) links.emplace_back(static_cast<std::int32_t>(v), u);
  };
  for (std::size_t v = 0; v < count; ++v) {
    if (flagged[v] == 0) continue;
    for (const std::int32_t u :
         surface.mesh.triangles[static_cast<std::size_t>(distances.outside_triangle[v])]) {
      link(v, u);
      for (const std::int32_t next : surface.neighbours[static_cast<std::size_t>(u)]) link(v, next);
    }
  }
  std::vector<ForecastPlace> found;
  for (auto& cluster : clusters(surface, flagged, badness, links)) {
    std::stable_sort(cluster.begin(), cluster.end(), [&](std::int32_t a, std::int32_t b) {
      return badness[static_cast<std::size_t>(a)] > badness[static_cast<std::size_t>(b)];
    });
    constexpr std::size_t looks = 8;
    bool other = false;
    for (std::size_t k = 0; k < std::min(looks, cluster.size()) && !other; ++k) {
      const std::int32_t v = cluster[k * cluster.size() / std::min(looks, cluster.size())];
      const auto i = static_cast<std::size_t>(v);
      other = is_another_wall(surface, v, distances.outside_triangle[i], distances.outside[i]);
    }
    if (!other) continue;
    ForecastPlace place = place_at(surface, TroubleKind::touching_walls, true, cluster);
    const auto worst = static_cast<std::size_t>(cluster.front());
    place.sentence = "two walls come as close as " + millimetres(distances.outside[worst]) +
                     " outside, edges are " + millimetres(surface.edge_mm[worst]) + " long, near " +
                     place_text(place.point);
    place.repair = OfferedRepair::smaller_edges;
    place.factor = shorter(std::max(distances.outside[worst] / surface.edge_mm[worst], 0.01));
    place.repair_sentence = "part the vessels there by an edit of the wall, or mesh with shorter edges";
    found.push_back(std::move(place));
  }
  add_places(std::move(found), surface.options, places);
}

}  // namespace ostia::meshing
