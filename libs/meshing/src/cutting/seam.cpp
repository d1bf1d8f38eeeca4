#include "cutting/seam.h"

#include "cutting/plane_triangulation.h"
#include "remeshing/remesher.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/quality.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

namespace ostia::meshing {

using geometry::TriMesh;
using geometry::Vec3;

namespace {

constexpr double edges_in_band = 5.0;
constexpr double fewest_on_loop = 16.0;  // edges of the ring that a circle is made of
constexpr double good_angle_deg = 30.0;  // a seam is left alone from here on ...
constexpr double even_edges = 1.6;       // ... when its longest edge is this much longer than its shortest
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Neighbours of the points in the loop's box, widened by `reach`: the rest of a large surface is not looked
/// at.
std::unordered_map<std::int32_t, std::vector<std::int32_t>> neighbours_near(
    const TriMesh& mesh, const std::vector<std::int32_t>& loop, double reach) {
  geometry::Box3 box = geometry::bounds(loop_points(mesh, loop));
  box.min().array() -= reach;
  box.max().array() += reach;
  std::unordered_map<std::int32_t, std::vector<std::int32_t>> neighbours;
  for (const geometry::Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (box.contains(mesh.points[static_cast<std::size_t>(t[k])])) {
        neighbours[t[k]].push_back(t[(k + 1) % 3]);
        neighbours[t[k]].push_back(t[(k + 2) % 3]);
      }
  return neighbours;
}

/// Length along edges to the loop, infinite beyond `reach`.
std::vector<double> distances(const TriMesh& mesh, const std::vector<std::int32_t>& loop, double reach) {
  const auto neighbours = neighbours_near(mesh, loop, reach);
  std::vector<double> distance(mesh.points.size(), infinite);
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  for (const std::int32_t v : loop) {
    distance[static_cast<std::size_t>(v)] = 0.0;
    front.emplace(0.0, v);
  }
  while (!front.empty()) {
    const auto [d, v] = front.top();
    front.pop();
    const auto found = neighbours.find(v);
    if (d > distance[static_cast<std::size_t>(v)] || found == neighbours.end()) continue;
    for (const std::int32_t n : found->second) {
      const double far =
          d + (mesh.points[static_cast<std::size_t>(n)] - mesh.points[static_cast<std::size_t>(v)]).norm();
      if (far > reach || far >= distance[static_cast<std::size_t>(n)]) continue;
      distance[static_cast<std::size_t>(n)] = far;
      front.emplace(far, n);
    }
  }
  return distance;
}

std::vector<bool> within(const TriMesh& mesh, const std::vector<double>& distance) {
  std::vector<bool> inside;
  inside.reserve(mesh.triangles.size());
  for (const geometry::Triangle& t : mesh.triangles)
    inside.push_back(std::all_of(t.begin(), t.end(), [&](std::int32_t v) {
      return distance[static_cast<std::size_t>(v)] < infinite;
    }));
  return inside;
}

/// Edge of the equilateral triangle of the mean area, which needles do not distort.
double typical_edge(const TriMesh& mesh) {
  return std::sqrt(4.0 / std::sqrt(3.0) * geometry::area(mesh) /
                   static_cast<double>(std::max<std::size_t>(1, mesh.triangles.size())));
}

/// The band as a mesh of its own, with the numbers its points have in the whole.
struct SeamBand {
  TriMesh mesh;
  std::vector<std::int32_t> whole;
  std::vector<double> sizes;
};

SeamBand band_of(const TriMesh& mesh, const std::vector<bool>& inside, const std::vector<double>& distance,
                 double edge_on_loop, double width) {
  SeamBand band;
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (!inside[i]) continue;
    geometry::Triangle t = mesh.triangles[i];
    for (std::int32_t& v : t) {
      const auto old = static_cast<std::size_t>(v);
      if (number[old] < 0) {
        number[old] = static_cast<std::int32_t>(band.whole.size());
        band.whole.push_back(v);
        band.mesh.points.push_back(mesh.points[old]);
      }
      v = number[old];
    }
    band.mesh.triangles.push_back(t);
  }
  const double beyond = typical_edge(band.mesh);
  for (const std::int32_t v : band.whole) {
    const double part = std::min(1.0, distance[static_cast<std::size_t>(v)] / width);
    band.sizes.push_back(edge_on_loop + part * (beyond - edge_on_loop));
  }
  return band;
}

void run(Remesher& remesher) {
  constexpr int rounds = 8, mendings = 8;
  for (int i = 0; i < rounds; ++i) {
    remesher.split_long();
    remesher.collapse_short();
    if (i + 2 < rounds)
      remesher.flip_for_valence();
    else
      remesher.flip_for_angle();
    remesher.relax();
  }
  for (int i = 0; i < mendings; ++i)
    if (remesher.mend(good_angle_deg + 4.0) == 0) break;
}

/// The whole with its band exchanged for the remeshed one.
EvenSeam exchanged(const TriMesh& mesh, const std::vector<bool>& inside, const SeamBand& band,
                   const Remesher& remesher, std::int32_t own) {
  std::vector<std::int32_t> kept(mesh.points.size(), -1);  // old numbers that stay in use
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (!inside[i])
      for (const std::int32_t v : mesh.triangles[i]) kept[static_cast<std::size_t>(v)] = 0;
  EvenSeam out;
  for (std::size_t v = 0; v < kept.size(); ++v) {
    if (kept[v] < 0) continue;
    kept[v] = static_cast<std::int32_t>(out.mesh.points.size());
    out.mesh.points.push_back(mesh.points[v]);
  }
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (inside[i]) continue;
    geometry::Triangle t = mesh.triangles[i];
    for (std::int32_t& v : t) v = kept[static_cast<std::size_t>(v)];
    out.mesh.triangles.push_back(t);
  }
  const EditMesh& made = remesher.mesh();
  std::vector<std::int32_t> number(static_cast<std::size_t>(made.vertex_count()), -1);
  for (std::int32_t v = 0; v < made.vertex_count(); ++v) {
    const auto i = static_cast<std::size_t>(v);
    if (!made.alive_vertex(v)) continue;
    // Frozen points keep their places, so those of the band's border are the whole's own.
    if (i < band.whole.size()) {
      std::int32_t& old = kept[static_cast<std::size_t>(band.whole[i])];
      if (old < 0 && remesher.curve(v) != EditMesh::none && remesher.curve(v) != own)
        old = static_cast<std::int32_t>(out.mesh.points.size()), out.mesh.points.push_back(made.at(v));
      number[i] = old;
    }
    if (number[i] >= 0) continue;
    number[i] = static_cast<std::int32_t>(out.mesh.points.size());
    if (i < band.whole.size()) kept[static_cast<std::size_t>(band.whole[i])] = number[i];
    out.mesh.points.push_back(made.at(v));
  }
  for (std::int32_t f = 0; f < made.face_count(); ++f) {
    if (!made.alive_face(f)) continue;
    geometry::Triangle t{};
    for (std::int32_t k = 0; k < 3; ++k)
      t[static_cast<std::size_t>(k)] = number[static_cast<std::size_t>(made.origin(3 * f + k))];
    out.mesh.triangles.push_back(t);
  }
  for (const BorderCurve& curve : border_curves(made))
    if (remesher.curve(curve.vertices[0]) == own)
      for (const std::int32_t v : curve.vertices) out.loop.push_back(number[static_cast<std::size_t>(v)]);
  out.number = std::move(kept);
  return out;
}

/// Does an edge of the band, whose triangles begin at `first`, run between two points that have an edge the
/// same way beyond it?
bool doubles_an_edge(const TriMesh& mesh, std::size_t first) {
  std::vector<bool> in_band(mesh.points.size(), false);
  for (std::size_t t = first; t < mesh.triangles.size(); ++t)
    for (const std::int32_t v : mesh.triangles[t]) in_band[static_cast<std::size_t>(v)] = true;
  std::vector<std::pair<std::int32_t, std::int32_t>> beyond;
  const auto edge = [&](std::size_t t, std::size_t k) {
    return std::pair(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
  };
  for (std::size_t t = 0; t < first; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto e = edge(t, k);
      if (in_band[static_cast<std::size_t>(e.first)] && in_band[static_cast<std::size_t>(e.second)])
        beyond.push_back(e);
    }
  std::sort(beyond.begin(), beyond.end());
  for (std::size_t t = first; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (std::binary_search(beyond.begin(), beyond.end(), edge(t, k))) return true;
  return false;
}

}  // namespace

double seam_angle_deg(const TriMesh& mesh, const std::vector<std::int32_t>& loop) {
  std::vector<bool> on(mesh.points.size(), false);
  for (const std::int32_t v : loop) on[static_cast<std::size_t>(v)] = true;
  double least = 180.0;
  const auto at = [&](std::int32_t v) -> const Vec3& { return mesh.points[static_cast<std::size_t>(v)]; };
  for (const geometry::Triangle& t : mesh.triangles)
    if (std::any_of(t.begin(), t.end(), [&](std::int32_t v) { return on[static_cast<std::size_t>(v)]; }))
      least = std::min(least, min_angle_deg(at(t[0]), at(t[1]), at(t[2])));
  return least;
}

std::optional<EvenSeam> even_seam(const TriMesh& mesh, const std::vector<std::int32_t>& loop) {
  const std::vector<Vec3> points = loop_points(mesh, loop);
  double shortest = infinite, longest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double edge = (points[(i + 1) % points.size()] - points[i]).norm();
    shortest = std::min(shortest, edge);
    longest = std::max(longest, edge);
  }
  if (longest <= even_edges * shortest && seam_angle_deg(mesh, loop) >= good_angle_deg &&
      static_cast<double>(loop.size()) >= fewest_on_loop)
    return std::nullopt;
  const double around = mean_edge(points) * static_cast<double>(points.size());
  double width = edges_in_band * mean_edge(points);
  const TriMesh near = geometry::subset(mesh, within(mesh, distances(mesh, loop, width)));
  const double edge =
      std::min(near.triangles.empty() ? infinite : typical_edge(near), around / fewest_on_loop);
  width = edges_in_band * edge;
  for (int attempt = 0; attempt < 5; ++attempt, width *= 1.3) {
    const std::vector<double> distance = distances(mesh, loop, width);
    const std::vector<bool> inside = within(mesh, distance);
    const SeamBand band = band_of(mesh, inside, distance, edge, width);
    if (band.mesh.triangles.empty()) continue;
    try {
      Remesher remesher(band.mesh, band.sizes);
      const auto first = std::find(band.whole.begin(), band.whole.end(), loop[0]);
      if (first == band.whole.end()) continue;
      const std::int32_t own = remesher.curve(static_cast<std::int32_t>(first - band.whole.begin()));
      for (std::int32_t c = 0; c < static_cast<std::int32_t>(remesher.curves().size()); ++c)
        if (c != own) remesher.freeze(c);
      if (own == EditMesh::none ||
          remesher.curves()[static_cast<std::size_t>(own)].vertices.size() != loop.size())
        continue;  // the band's own border runs into the loop
      run(remesher);
      const auto kept_count = static_cast<std::size_t>(std::count(inside.begin(), inside.end(), false));
      EvenSeam seam = exchanged(mesh, inside, band, remesher, own);
      if (!doubles_an_edge(seam.mesh, kept_count)) return seam;
    } catch (const GeometryError&) {
      // The band touches itself: a wider one may not.
    }
  }
  return std::nullopt;
}

std::optional<EvenSeam> mended_seam(const TriMesh& mesh, const std::vector<std::int32_t>& loop) {
  const double before = seam_angle_deg(mesh, loop);
  const double edge = mean_edge(loop_points(mesh, loop));
  for (const double width : {4.0 * edge, 5.5 * edge, 7.0 * edge}) {
    const std::vector<double> distance = distances(mesh, loop, width);
    const std::vector<bool> inside = within(mesh, distance);
    const SeamBand band = band_of(mesh, inside, distance, edge, width);
    try {
      Remesher remesher(band.mesh, band.sizes);
      for (std::int32_t c = 0; c < static_cast<std::int32_t>(remesher.curves().size()); ++c)
        remesher.freeze(c);
      remesher.flip_for_angle();
      for (int i = 0; i < 12; ++i)
        if (remesher.mend(good_angle_deg + 4.0) == 0) break;
      const auto kept_count = static_cast<std::size_t>(std::count(inside.begin(), inside.end(), false));
      EvenSeam seam = exchanged(mesh, inside, band, remesher, EditMesh::none);
      for (const std::int32_t v : loop)
        if (seam.number[static_cast<std::size_t>(v)] >= 0)
          seam.loop.push_back(seam.number[static_cast<std::size_t>(v)]);
      if (doubles_an_edge(seam.mesh, kept_count)) continue;
      if (seam.loop.empty() || seam_angle_deg(seam.mesh, seam.loop) <= before) return std::nullopt;
      return seam;
    } catch (const GeometryError&) {
      // The band touches itself: a wider one may not.
    }
  }
  return std::nullopt;
}

}  // namespace ostia::meshing
