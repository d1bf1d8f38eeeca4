#include "ostia/geometry/subdivision.h"

#include "edge_table.h"
#include "mesh_checks.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace ostia::geometry {
namespace {

using detail::HalfEdge;

std::string place(const Vec3& p) {
  return "(" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ", " + std::to_string(p.z()) + ") mm";
}

/// Sums over a point's neighbours; of a border point over its two neighbours on the border alone.
struct Around {
  Vec3 sum = Vec3::Zero();
  std::int32_t count = 0;
  bool border = false;
};

/// Loop's weight of each neighbour of an inner point with n of them.
double neighbour_weight(std::int32_t n) {
  const double c = 0.375 + 0.25 * std::cos(2.0 * std::numbers::pi / n);
  return (0.625 - c * c) / n;
}

const Vec3& at(const TriMesh& mesh, std::int32_t v) {
  return mesh.points[static_cast<std::size_t>(v)];
}

void refuse_edge(const TriMesh& mesh, const HalfEdge& edge, const std::string& what) {
  throw GeometryError("subdivision: " + what + " near " + place(at(mesh, edge.low)) +
                      "; repair the surface first");
}

std::vector<Around> neighbourhoods(const TriMesh& mesh, const std::vector<HalfEdge>& table) {
  std::vector<Around> around(mesh.points.size());
  detail::for_each_edge(table, [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first > 2) refuse_edge(mesh, *first, "an edge with more than two triangles");
    if (last - first == 2 && first[0].ascending == first[1].ascending)
      refuse_edge(mesh, *first, "two triangles turned against each other");
    if (last - first == 1)
      for (const std::int32_t v : {first->low, first->high})
        around[static_cast<std::size_t>(v)].border = true;
  });
  detail::for_each_edge(table, [&](const HalfEdge* first, const HalfEdge* last) {
    const bool on_border = last - first == 1;
    const auto use = [&](std::int32_t v, std::int32_t other) {
      Around& a = around[static_cast<std::size_t>(v)];
      if (a.border && !on_border) return;
      a.sum += at(mesh, other);
      ++a.count;
    };
    use(first->low, first->high);
    use(first->high, first->low);
  });
  for (std::size_t v = 0; v < around.size(); ++v)
    if (around[v].border && around[v].count != 2)
      throw GeometryError("subdivision: more than one border runs through " + place(mesh.points[v]) +
                          "; repair the surface first");
  return around;
}

TriMesh subdivided_once(const TriMesh& mesh) {
  const std::vector<HalfEdge> table = detail::half_edges(mesh);
  const std::vector<Around> around = neighbourhoods(mesh, table);
  TriMesh out;
  out.points.reserve(mesh.points.size() + table.size() / 2);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Around& a = around[v];
    const double w = a.border ? 0.125 : a.count > 0 ? neighbour_weight(a.count) : 0.0;
    out.points.push_back((1.0 - a.count * w) * mesh.points[v] + w * a.sum);
  }
  std::vector<std::array<std::int32_t, 3>> middle(mesh.triangles.size());
  const auto apex = [&](const HalfEdge& h) {
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(h.triangle)];
    return at(mesh, t[static_cast<std::size_t>((h.side + 2) % 3)]);
  };
  detail::for_each_edge(table, [&](const HalfEdge* first, const HalfEdge* last) {
    const Vec3 ends = at(mesh, first->low) + at(mesh, first->high);
    for (const HalfEdge* h = first; h != last; ++h)
      middle[static_cast<std::size_t>(h->triangle)][static_cast<std::size_t>(h->side)] =
          static_cast<std::int32_t>(out.points.size());
    out.points.push_back(last - first == 1 ? Vec3(0.5 * ends)
                                           : Vec3(0.375 * ends + 0.125 * (apex(first[0]) + apex(first[1]))));
  });
  out.triangles.reserve(4 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto& [ab, bc, ca] = middle[t];
    out.triangles.insert(out.triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return out;
}

/// Points where endless subdivision would bring them: eigenvectors of the scheme at each point.
void move_to_limit(TriMesh& mesh) {
  const std::vector<Around> around = neighbourhoods(mesh, detail::half_edges(mesh));
  std::vector<Vec3> points = mesh.points;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Around& a = around[v];
    if (a.count == 0) continue;
    const double w = a.border ? 1.0 / 6.0 : 1.0 / (0.375 / neighbour_weight(a.count) + a.count);
    points[v] = (1.0 - a.count * w) * mesh.points[v] + w * a.sum;
  }
  mesh.points = std::move(points);
}

}  // namespace

void validate(const SubdivisionOptions& options) {
  if (options.levels < 0 || options.levels > 8)
    throw InvalidInput("subdivision: levels " + std::to_string(options.levels) + " must lie in [0, 8]");
  if (options.max_triangles < 1) throw InvalidInput("subdivision: max_triangles must be at least 1");
}

TriMesh loop_subdivided(const TriMesh& mesh, const SubdivisionOptions& options,
                        const core::TaskContext& task) {
  validate(options);
  detail::check_indices(mesh, "subdivision");
  detail::check_finite(mesh, "subdivision");
  const std::size_t most =
      std::min(options.max_triangles, static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()));
  std::size_t count = mesh.triangles.size();
  for (int i = 0; i < options.levels; ++i) {
    count *= 4;
    if (count > most)
      throw InvalidInput("subdivision: " + std::to_string(options.levels) + " levels make more than " +
                         std::to_string(most) + " triangles of " + std::to_string(mesh.triangles.size()) +
                         "; take fewer levels");
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (detail::repeats_a_corner(mesh.triangles[t]))
      throw GeometryError("subdivision: triangle " + std::to_string(t) +
                          " repeats a corner; repair the surface first");
  TriMesh result = mesh;
  for (int i = 0; i < options.levels; ++i) {
    task.throw_if_cancelled();
    result = subdivided_once(result);
    task.set_progress(static_cast<double>(i + 1) / options.levels);
  }
  if (options.to_limit) move_to_limit(result);
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::geometry
