#include "boundary_layer/wall.h"
#include "forecast/surface.h"

#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

using EdgeSet = std::vector<const SurfaceEdge*>;

/// The faulty edges of one kind, those that share a point together.
std::vector<EdgeSet> joined(const std::vector<SurfaceEdge>& edges,
                            const std::function<bool(const SurfaceEdge&)>& of_kind) {
  std::map<std::int32_t, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (of_kind(edges[i])) at[edges[i].a].push_back(i), at[edges[i].b].push_back(i);
  std::vector<char> seen(edges.size(), 0);
  std::vector<EdgeSet> sets;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (seen[start] != 0 || !of_kind(edges[start])) continue;
    EdgeSet set;
    std::vector<std::size_t> todo{start};
    seen[start] = 1;
    while (!todo.empty()) {
      const SurfaceEdge& edge = edges[todo.back()];
      todo.pop_back();
      set.push_back(&edge);
      for (const std::int32_t v : {edge.a, edge.b})
        for (const std::size_t next : at[v])
          if (seen[next] == 0) seen[next] = 1, todo.push_back(next);
    }
    sets.push_back(std::move(set));
  }
  std::stable_sort(sets.begin(), sets.end(),
                   [](const EdgeSet& a, const EdgeSet& b) { return a.size() > b.size(); });
  return sets;
}

std::vector<std::int32_t> points_of(const EdgeSet& set) {
  std::set<std::int32_t> points;
  for (const SurfaceEdge* edge : set) points.insert({edge->a, edge->b});
  return {points.begin(), points.end()};
}

struct Loop {
  Vec3 centre = Vec3::Zero(), area = Vec3::Zero();  // mm2; looks out of the hole
  double radius = 0.0;
};

Loop loop_of(const ForecastSurface& surface, const EdgeSet& set) {
  Loop loop;
  const std::vector<std::int32_t> points = points_of(set);
  for (const std::int32_t v : points) loop.centre += surface.point(v) / static_cast<double>(points.size());
  for (const SurfaceEdge* edge : set) {
    const Vec3 a = surface.point(edge->a) - loop.centre, b = surface.point(edge->b) - loop.centre;
    loop.area += 0.5 * (edge->balance > 0 ? b.cross(a) : a.cross(b));
  }
  loop.radius = std::sqrt(loop.area.norm() / std::numbers::pi);
  return loop;
}

/// Flat and cut across the vessel: the triangles at its border stand up on its plane.
bool is_end(const ForecastSurface& surface, const EdgeSet& set, const Loop& loop) {
  constexpr double flat = 0.1;      // radii, as clipping has it
  constexpr double standing = 0.5;  // cosine between the normals of hole and wall
  if (!(loop.radius > 0.0)) return false;
  const Vec3 normal = loop.area.normalized();
  double sum = 0.0;
  for (const SurfaceEdge* edge : set) {
    for (const std::int32_t v : {edge->a, edge->b})
      if (std::abs((surface.point(v) - loop.centre).dot(normal)) > flat * loop.radius) return false;
    sum += std::abs(surface.area(static_cast<std::size_t>(edge->triangles.front())).normalized().dot(normal));
  }
  return sum <= standing * static_cast<double>(set.size());
}

ForecastPlace place_of(const ForecastSurface& surface, TroubleKind kind, const EdgeSet& set,
                       const std::string& one, const std::string& many, OfferedRepair repair,
                       const std::string& way_out) {
  ForecastPlace place = place_at(surface, kind, true, points_of(set));
  place.count = set.size();
  place.triangles.clear();
  for (const SurfaceEdge* edge : set)
    place.triangles.insert(place.triangles.end(), edge->triangles.begin(), edge->triangles.end());
  std::sort(place.triangles.begin(), place.triangles.end());
  place.triangles.erase(std::unique(place.triangles.begin(), place.triangles.end()), place.triangles.end());
  place.sentence = counted(set.size(), one, many) + " near " + place_text(place.point);
  place.repair = repair;
  place.repair_sentence = way_out;
  return place;
}

std::vector<ForecastPlace> holes(ForecastSurface& surface) {
  std::vector<ForecastPlace> found;
  const auto open = [](const SurfaceEdge& e) { return e.triangles.size() == 1; };
  std::size_t edges = 0;
  for (const SurfaceEdge& edge : surface.faulty_edges) edges += open(edge) ? 1 : 0;
  const bool apart = edges > surface.mesh.triangles.size();
  for (const EdgeSet& set : joined(surface.faulty_edges, open)) {
    const Loop loop = loop_of(surface, set);
    if (surface.options.open_ends && is_end(surface, set, loop)) {
      surface.ends.push_back({"the open end", points_of(set), loop.centre, 2.0 * loop.radius});
      continue;
    }
    ForecastPlace place = place_of(
        surface, TroubleKind::open_edges, set, "open edge: a hole in the wall",
        "open edges: a hole in the wall", apart ? OfferedRepair::repair_surface : OfferedRepair::fill_holes,
        apart ? "weld the points: most triangles are not joined to their neighbours" : "fill the hole");
    if (loop.radius > 0.0) place.extent_mm = std::max(place.extent_mm, loop.radius);
    found.push_back(std::move(place));
  }
  return found;
}

/// Components with the volume that each encloses, holes closed by cones.
struct Piece {
  double volume = 0.0, area = 0.0;
  std::vector<std::int32_t> triangles;
};

std::vector<Piece> pieces_of(const ForecastSurface& surface) {
  const std::vector<std::int32_t> component = geometry::components(surface.mesh);
  std::vector<Piece> pieces;
  const Vec3 origin = surface.mesh.points[static_cast<std::size_t>(surface.mesh.triangles.front()[0])];
  const auto cone = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (a - origin).dot((b - origin).cross(c - origin)) / 6.0;
  };
  for (std::size_t i = 0; i < component.size(); ++i) {
    const auto c = static_cast<std::size_t>(component[i]);
    if (c >= pieces.size()) pieces.resize(c + 1);
    const geometry::Triangle& t = surface.mesh.triangles[i];
    pieces[c].volume += cone(surface.point(t[0]), surface.point(t[1]), surface.point(t[2]));
    pieces[c].area += surface.area(i).norm();
    pieces[c].triangles.push_back(static_cast<std::int32_t>(i));
  }
  const auto open = [](const SurfaceEdge& e) { return e.triangles.size() == 1; };
  for (const EdgeSet& set : joined(surface.faulty_edges, open)) {
    const Loop loop = loop_of(surface, set);
    for (const SurfaceEdge* edge : set) {
      const auto c = static_cast<std::size_t>(component[static_cast<std::size_t>(edge->triangles.front())]);
      const bool forward = edge->balance > 0;
      pieces[c].volume += cone(surface.point(forward ? edge->b : edge->a),
                               surface.point(forward ? edge->a : edge->b), loop.centre);
    }
  }
  return pieces;
}

}  // namespace

void look_at_edges(ForecastSurface& surface, std::vector<ForecastPlace>& places) {
  add_places(holes(surface), surface.options, places);
  std::vector<ForecastPlace> shared, turned;
  for (const EdgeSet& set :
       joined(surface.faulty_edges, [](const SurfaceEdge& e) { return e.triangles.size() > 2; }))
    shared.push_back(place_of(surface, TroubleKind::non_manifold, set, "edge of more than two triangles",
                              "edges of more than two triangles", OfferedRepair::repair_surface,
                              "take the surplus triangles out and fill the hole"));
  for (const EdgeSet& set :
       joined(surface.faulty_edges, [](const SurfaceEdge& e) { return e.triangles.size() == 2; }))
    turned.push_back(place_of(surface, TroubleKind::turned_triangles, set,
                              "edge whose two triangles look to opposite sides",
                              "edges whose two triangles look to opposite sides", OfferedRepair::orient,
                              "turn the triangles so that all look outward"));
  add_places(std::move(shared), surface.options, places);
  add_places(std::move(turned), surface.options, places);
}

void look_at_orientation(const ForecastSurface& surface, std::vector<ForecastPlace>& places) {
  std::vector<ForecastPlace> found;
  for (Piece& piece : pieces_of(surface)) {
    // Flat sheets enclose nothing; triangles turned against each other are told already.
    if (!(piece.volume < -1e-4 * std::pow(piece.area, 1.5))) continue;
    ForecastPlace place;
    place.kind = TroubleKind::inward;
    const geometry::Triangle& t = surface.mesh.triangles[static_cast<std::size_t>(piece.triangles.front())];
    place.point = (surface.point(t[0]) + surface.point(t[1]) + surface.point(t[2])) / 3.0;
    for (const std::int32_t i : piece.triangles)
      for (const std::int32_t v : surface.mesh.triangles[static_cast<std::size_t>(i)])
        place.extent_mm = std::max(place.extent_mm, (surface.point(v) - place.point).norm());
    place.count = piece.triangles.size();
    place.sentence = "a piece of " + std::to_string(place.count) + " triangles near " +
                     place_text(place.point) + " looks inward";
    place.repair = OfferedRepair::orient;
    place.repair_sentence = "turn its triangles so that they look outward";
    place.triangles = std::move(piece.triangles);
    found.push_back(std::move(place));
  }
  add_places(std::move(found), surface.options, places);
}

void look_at_crossings(const ForecastSurface& surface, std::vector<ForecastPlace>& places) {
  constexpr std::size_t enough = 10000;
  const auto pairs = geometry::self_intersections(surface.mesh, enough);
  if (pairs.empty()) return;
  std::vector<char> flagged(surface.mesh.points.size(), 0);
  std::vector<double> hits(surface.mesh.points.size(), 0.0);
  std::vector<std::pair<std::int32_t, std::int32_t>> links;
  for (const auto& [a, b] : pairs) {
    const geometry::Triangle &s = surface.mesh.triangles[static_cast<std::size_t>(a)],
                             &t = surface.mesh.triangles[static_cast<std::size_t>(b)];
    for (const std::int32_t v : {s[0], s[1], s[2], t[0], t[1], t[2]}) {
      flagged[static_cast<std::size_t>(v)] = 1;
      hits[static_cast<std::size_t>(v)] += 1.0;
    }
    links.emplace_back(s[0], t[0]);
  }
  std::vector<ForecastPlace> found;
  for (const auto& cluster : clusters(surface, flagged, hits, links)) {
    ForecastPlace place = place_at(surface, TroubleKind::self_intersections, true, cluster);
    const std::set<std::int32_t> here(cluster.begin(), cluster.end());
    place.count = 0;
    place.triangles.clear();
    for (const auto& [a, b] : pairs)
      if (here.contains(surface.mesh.triangles[static_cast<std::size_t>(a)][0])) {
        ++place.count;
        place.triangles.insert(place.triangles.end(), {a, b});
      }
    std::sort(place.triangles.begin(), place.triangles.end());
    place.triangles.erase(std::unique(place.triangles.begin(), place.triangles.end()), place.triangles.end());
    place.sentence = counted(place.count, "pair of triangles crosses", "pairs of triangles cross") +
                     " near " + place_text(place.point);
    place.repair = OfferedRepair::repair_surface;
    place.repair_sentence = "take the triangles that cross out and fill the hole";
    found.push_back(std::move(place));
  }
  add_places(std::move(found), surface.options, places);
}

}  // namespace ostia::meshing
