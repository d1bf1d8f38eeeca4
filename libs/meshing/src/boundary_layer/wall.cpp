#include "boundary_layer/wall.h"

#include "cutting/plane_triangulation.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/faces.h"
#include "ostia/geometry/mesh_topology.h"

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

using DirectedEdges = std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t>;

const geometry::Face& wall_face(const geometry::FacedSurface& surface, std::int32_t id) {
  return geometry::face_of(surface, id, "boundary layers");
}

bool of_wall(const geometry::FacedSurface& surface, std::size_t triangle) {
  return is_wall(wall_face(surface, surface.face_ids[triangle]));
}

void check_surface(const geometry::FacedSurface& surface) {
  const geometry::TriMesh& mesh = surface.mesh;
  if (mesh.triangles.empty()) throw InvalidInput("boundary layers: the surface has no triangles");
  if (surface.face_ids.size() != mesh.triangles.size())
    throw InvalidInput("boundary layers: " + std::to_string(surface.face_ids.size()) + " face ids for " +
                       std::to_string(mesh.triangles.size()) + " triangles; one a triangle is needed");
  const geometry::SurfaceFaults faults = geometry::find_faults(mesh, true);
  if (!faults.closed_manifold() || faults.self_intersections > 0)
    throw GeometryError("boundary layers cannot grow on the surface: " + faults.summary() +
                        (faults.examples.empty() ? "" : ", e.g. near " + place_text(faults.examples[0])) +
                        "; cap its ends and repair it first");
  if (!(geometry::volume(mesh) > 0.0))
    throw GeometryError(
        "boundary layers cannot grow on the surface: it points inward; orient it outward first");
}

/// The wall's triangles with points in the surface's order. `numbers` receives the wall's number of each of
/// the surface's points.
void take_wall(const geometry::FacedSurface& surface, LayerWall& wall, std::vector<std::int32_t>& numbers) {
  numbers.assign(surface.mesh.points.size(), -1);
  for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i) {
    if (!of_wall(surface, i)) continue;
    wall.mesh.triangles.push_back(surface.mesh.triangles[i]);
    wall.face_ids.push_back(surface.face_ids[i]);
    for (const std::int32_t v : surface.mesh.triangles[i]) numbers[static_cast<std::size_t>(v)] = 0;
  }
  if (wall.mesh.triangles.empty())
    throw InvalidInput("boundary layers: no triangle of the surface belongs to a wall");
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] < 0) continue;
    numbers[i] = static_cast<std::int32_t>(wall.mesh.points.size());
    wall.mesh.points.push_back(surface.mesh.points[i]);
  }
  for (geometry::Triangle& t : wall.mesh.triangles)
    for (std::int32_t& v : t) v = numbers[static_cast<std::size_t>(v)];
}

/// Ids of the caps by their edges along the rings, in the wall's numbers.
DirectedEdges cap_edges(const geometry::FacedSurface& surface, const std::vector<std::int32_t>& numbers) {
  DirectedEdges edges;
  for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i) {
    if (of_wall(surface, i)) continue;
    const geometry::Triangle& t = surface.mesh.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = numbers[static_cast<std::size_t>(t[k])],
                         b = numbers[static_cast<std::size_t>(t[(k + 1) % 3])];
      if (a >= 0 && b >= 0) edges[{a, b}] = surface.face_ids[i];
    }
  }
  return edges;
}

void check_flat(const LayerWall& wall, const WallRing& ring, const std::vector<Vec3>& points) {
  constexpr double max_deviation = 0.02;  // of the ring's size, as remeshing demands
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : points) centre += p / static_cast<double>(points.size());
  for (const Vec3& p : points)
    if (!(std::abs((p - centre).dot(ring.normal)) <=
          max_deviation * mean_edge(points) * static_cast<double>(points.size()) / 3.0))
      throw GeometryError("boundary layers: " + ring.cap.name + " is not flat (a point of its ring " +
                          std::to_string(std::abs((p - centre).dot(ring.normal))) +
                          " mm off its plane); clip the end first");
  for (const std::int32_t v : ring.loop)
    if (wall.neighbours[static_cast<std::size_t>(v)].size() < 2)
      throw GeometryError("boundary layers: the ring of " + ring.cap.name + " is not closed");
}

void find_rings(const geometry::FacedSurface& surface, const std::vector<std::int32_t>& numbers,
                LayerWall& wall) {
  const DirectedEdges edges = cap_edges(surface, numbers);
  std::set<std::int32_t> seen;
  wall.ring_of.assign(wall.mesh.points.size(), -1);
  for (std::vector<std::int32_t>& loop : geometry::boundary_loops(wall.mesh)) {
    WallRing ring;
    std::set<std::int32_t> ids;
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      ids.insert(edges.at({loop[(i + 1) % loop.size()], loop[i]}));  // is there: the surface is closed
      points.push_back(wall.point(loop[i]));
      wall.ring_of[static_cast<std::size_t>(loop[i])] = static_cast<std::int32_t>(wall.rings.size());
    }
    ring.cap = wall_face(surface, *ids.begin());
    if (ids.size() > 1)
      throw GeometryError("boundary layers: faces " + ring.cap.name + " and " +
                          wall_face(surface, *ids.rbegin()).name +
                          " share a ring; a cap needs a ring of its own");
    if (!seen.insert(ring.cap.id).second)
      throw GeometryError("boundary layers: " + ring.cap.name + " has more than one ring");
    ring.loop = std::move(loop);
    ring.normal = -loop_normal(points).normalized();  // the cap runs against the wall's winding
    check_flat(wall, ring, points);
    wall.rings.push_back(std::move(ring));
  }
  if (wall.rings.empty())
    throw InvalidInput(
        "boundary layers: the wall has no caps, so that nothing flows in or out; cut its ends and cap them");
}

std::vector<double> local_edges(const LayerWall& wall) {
  std::vector<double> edges(wall.mesh.points.size(), 0.0);
  for (std::size_t v = 0; v < edges.size(); ++v) {
    for (const std::int32_t u : wall.neighbours[v]) edges[v] += (wall.point(u) - wall.mesh.points[v]).norm();
    edges[v] /= static_cast<double>(wall.neighbours[v].size());
  }
  for (int round = 0; round < 2; ++round) {
    const std::vector<double> old = edges;
    for (std::size_t v = 0; v < edges.size(); ++v) {
      for (const std::int32_t u : wall.neighbours[v]) edges[v] += old[static_cast<std::size_t>(u)];
      edges[v] /= static_cast<double>(wall.neighbours[v].size() + 1);
    }
  }
  return edges;
}

}  // namespace

std::string place_text(const Vec3& p) {
  return "(" + core::fixed_text(p.x(), 2) + ", " + core::fixed_text(p.y(), 2) + ", " +
         core::fixed_text(p.z(), 2) + ") mm";
}

Vec3 LayerWall::admissible(std::int32_t v, const Vec3& direction) const {
  const std::int32_t ring = ring_of[static_cast<std::size_t>(v)];
  if (ring < 0) return direction.normalized();
  const Vec3& normal = rings[static_cast<std::size_t>(ring)].normal;
  return (direction - direction.dot(normal) * normal).normalized();
}

LayerWall layer_wall(const geometry::FacedSurface& surface, std::vector<std::int32_t>* numbers_out) {
  check_surface(surface);
  LayerWall wall;
  std::vector<std::int32_t> numbers;
  take_wall(surface, wall, numbers);
  wall.neighbours = geometry::vertex_neighbours(wall.mesh);
  wall.triangles_of.resize(wall.mesh.points.size());
  for (std::size_t i = 0; i < wall.mesh.triangles.size(); ++i)
    for (const std::int32_t v : wall.mesh.triangles[i])
      wall.triangles_of[static_cast<std::size_t>(v)].push_back(static_cast<std::int32_t>(i));
  find_rings(surface, numbers, wall);
  wall.local_edge_mm = local_edges(wall);
  if (numbers_out != nullptr) *numbers_out = std::move(numbers);
  return wall;
}

}  // namespace ostia::meshing
