#include "forecast/surface.h"

#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/geometry/disjoint_sets.h"
#include "ostia/geometry/faces.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

std::vector<char> wall_triangles(const geometry::FacedSurface& surface) {
  const geometry::FacesByKind faces(surface.faces);
  std::vector<char> wall(surface.mesh.triangles.size(), 1);
  for (std::size_t i = 0; i < surface.face_ids.size(); ++i)
    if (faces.cap(surface.face_ids[i])) wall[i] = 0;
  return wall;
}

std::vector<SurfaceEdge> faulty_edges_of(const geometry::TriMesh& mesh) {
  struct Use {
    std::int32_t a, b, triangle, way;
  };
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
      if (a != b)
        uses.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(i), a < b ? 1 : -1});
    }
  std::sort(uses.begin(), uses.end(), [](const Use& x, const Use& y) {
    return std::tie(x.a, x.b, x.triangle) < std::tie(y.a, y.b, y.triangle);
  });
  std::vector<SurfaceEdge> faulty;
  for (std::size_t i = 0; i < uses.size();) {
    SurfaceEdge edge{uses[i].a, uses[i].b, {}, 0};
    std::size_t j = i;
    for (; j < uses.size() && uses[j].a == edge.a && uses[j].b == edge.b; ++j) edge.balance += uses[j].way;
    if (j - i != 2 || edge.balance != 0) {
      for (std::size_t k = i; k < j; ++k) edge.triangles.push_back(uses[k].triangle);
      faulty.push_back(std::move(edge));
    }
    i = j;
  }
  return faulty;
}

std::vector<double> own_edges(const geometry::TriMesh& mesh,
                              const std::vector<std::vector<std::int32_t>>& neighbours) {
  std::vector<double> edges(mesh.points.size(), 0.0);
  for (std::size_t v = 0; v < edges.size(); ++v) {
    for (const std::int32_t u : neighbours[v])
      edges[v] += (mesh.points[static_cast<std::size_t>(u)] - mesh.points[v]).norm();
    if (!neighbours[v].empty()) edges[v] /= static_cast<double>(neighbours[v].size());
  }
  return edges;
}

/// Caps with their points; the diameter is that of a circle of equal area.
std::vector<SurfaceEnd> caps_of(const geometry::FacedSurface& surface) {
  std::vector<SurfaceEnd> ends;
  for (const geometry::Face& face : surface.faces) {
    if (is_wall(face)) continue;
    SurfaceEnd end;
    end.name = face.name;
    double area = 0.0;
    std::set<std::int32_t> points;
    for (std::size_t i = 0; i < surface.face_ids.size(); ++i) {
      if (surface.face_ids[i] != face.id) continue;
      const geometry::Triangle& t = surface.mesh.triangles[i];
      const Vec3 &a = surface.mesh.points[static_cast<std::size_t>(t[0])],
                 &b = surface.mesh.points[static_cast<std::size_t>(t[1])],
                 &c = surface.mesh.points[static_cast<std::size_t>(t[2])];
      const double size = 0.5 * (b - a).cross(c - a).norm();
      area += size;
      end.centre += size * (a + b + c) / 3.0;
      points.insert(t.begin(), t.end());
    }
    if (points.empty() || !(area > 0.0)) continue;
    end.centre /= area;
    end.diameter_mm = 2.0 * std::sqrt(area / std::numbers::pi);
    end.points.assign(points.begin(), points.end());
    ends.push_back(std::move(end));
  }
  return ends;
}

}  // namespace

ForecastSurface::ForecastSurface(const geometry::FacedSurface& faced, const ForecastOptions& o,
                                 const core::TaskContext& task)
    : mesh(faced.mesh),
      options(o),
      wall(wall_triangles(faced)),
      neighbours(geometry::vertex_neighbours(mesh)),
      triangles_of(mesh.points.size()),
      normals(geometry::vertex_normals(mesh)),
      faulty_edges(faulty_edges_of(mesh)),
      ends(caps_of(faced)),
      tree(mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::int32_t v : mesh.triangles[i])
      triangles_of[static_cast<std::size_t>(v)].push_back(static_cast<std::int32_t>(i));
  if (!o.edge_lengths_mm.empty())
    edge_mm = o.edge_lengths_mm;
  else if (o.tree)
    edge_mm = target_edge_lengths(mesh, TubeFunction(*o.tree), o.sizing, task);
  else
    edge_mm = own_edges(mesh, neighbours);
}

Vec3 ForecastSurface::area(std::size_t triangle) const {
  const geometry::Triangle& t = mesh.triangles[triangle];
  return 0.5 * (point(t[1]) - point(t[0])).cross(point(t[2]) - point(t[0]));
}

bool ForecastSurface::on_wall(std::size_t v) const {
  return !triangles_of[v].empty() &&
         std::all_of(triangles_of[v].begin(), triangles_of[v].end(),
                     [&](std::int32_t t) { return wall[static_cast<std::size_t>(t)] != 0; });
}

std::vector<std::vector<std::int32_t>> clusters(
    const ForecastSurface& surface, const std::vector<char>& flagged, const std::vector<double>& badness,
    const std::vector<std::pair<std::int32_t, std::int32_t>>& links) {
  geometry::DisjointSets sets(flagged.size());
  for (std::size_t v = 0; v < flagged.size(); ++v)
    if (flagged[v] != 0)
      for (const std::int32_t u : surface.neighbours[v])
        if (flagged[static_cast<std::size_t>(u)] != 0) sets.join(static_cast<std::int32_t>(v), u);
  for (const auto& [a, b] : links) sets.join(a, b);
  std::map<std::int32_t, std::vector<std::int32_t>> by_root;
  for (std::size_t v = 0; v < flagged.size(); ++v)
    if (flagged[v] != 0)
      by_root[sets.find(static_cast<std::int32_t>(v))].push_back(static_cast<std::int32_t>(v));
  std::vector<std::vector<std::int32_t>> result;
  const auto worse = [&](std::int32_t a, std::int32_t b) {
    return badness[static_cast<std::size_t>(a)] > badness[static_cast<std::size_t>(b)];
  };
  for (auto& [root, points] : by_root) {
    std::iter_swap(points.begin(), std::min_element(points.begin(), points.end(), worse));
    result.push_back(std::move(points));
  }
  std::stable_sort(result.begin(), result.end(),
                   [&](const auto& a, const auto& b) { return worse(a.front(), b.front()); });
  return result;
}

ForecastPlace place_at(const ForecastSurface& surface, TroubleKind kind, bool fails,
                       const std::vector<std::int32_t>& points) {
  ForecastPlace place;
  place.kind = kind;
  place.fails = fails;
  place.point = surface.point(points.front());
  place.count = points.size();
  std::set<std::int32_t> triangles;
  for (const std::int32_t v : points) {
    place.extent_mm = std::max(place.extent_mm, (surface.point(v) - place.point).norm());
    const auto& around = surface.triangles_of[static_cast<std::size_t>(v)];
    triangles.insert(around.begin(), around.end());
  }
  place.triangles.assign(triangles.begin(), triangles.end());
  return place;
}

void add_places(std::vector<ForecastPlace> found, const ForecastOptions& options,
                std::vector<ForecastPlace>& places) {
  if (found.size() > options.max_places) {
    const std::size_t more = found.size() - options.max_places;
    found.resize(options.max_places);
    found.back().sentence += " (and " + std::to_string(more) + " more places)";
  }
  std::move(found.begin(), found.end(), std::back_inserter(places));
}

std::string millimetres(double value) {
  return core::significant_text(value, 3) + " mm";
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace ostia::meshing
