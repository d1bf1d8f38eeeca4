#include "quality/mixed_boundary.h"

#include "quality/mixed_elements.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace ostia::meshing {

using geometry::MixedMesh;
using geometry::Vec3;

namespace {

using TriangleNodes = std::array<Vec3, 6>;  // corners, then on 01 12 20
using QuadNodes = std::array<Vec3, 9>;      // corners, on 01 12 23 30, in the middle

TriangleNodes triangle_nodes(const MixedMesh& mesh, std::size_t i) {
  TriangleNodes nodes;
  for (std::size_t k = 0; k < 3; ++k) nodes[k] = mesh.points[static_cast<std::size_t>(mesh.triangles[i][k])];
  for (std::size_t k = 0; k < 3; ++k)
    nodes[3 + k] = mesh.triangle_nodes.empty()
                       ? Vec3(0.5 * (nodes[k] + nodes[(k + 1) % 3]))
                       : mesh.points[static_cast<std::size_t>(mesh.triangle_nodes[i][k])];
  return nodes;
}

QuadNodes quad_nodes(const MixedMesh& mesh, std::size_t i) {
  QuadNodes nodes;
  for (std::size_t k = 0; k < 4; ++k) nodes[k] = mesh.points[static_cast<std::size_t>(mesh.quads[i][k])];
  if (!mesh.quad_nodes.empty()) {
    for (std::size_t k = 0; k < 5; ++k)
      nodes[4 + k] = mesh.points[static_cast<std::size_t>(mesh.quad_nodes[i][k])];
    return nodes;
  }
  for (std::size_t k = 0; k < 4; ++k) nodes[4 + k] = 0.5 * (nodes[k] + nodes[(k + 1) % 4]);
  nodes[8] = 0.25 * (nodes[0] + nodes[1] + nodes[2] + nodes[3]);
  return nodes;
}

struct BoundarySample {
  Vec3 position = Vec3::Zero(), normal = Vec3::Zero();  // the normal with the map's size
};

BoundarySample sample(const TriangleNodes& n, double u, double v) {
  const std::array<double, 3> l{1.0 - u - v, u, v};
  Vec3 along_u = Vec3::Zero(), along_v = Vec3::Zero();
  BoundarySample s;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    // Weight l (2l - 1) of a corner, 4 l l' of a middle; u moves from corner 0 to 1, v from 0 to 2.
    const auto slope = [&](std::size_t i, double du0, double du1, double du2) {
      const std::array<double, 3> d{du0, du1, du2};
      return Vec3((4.0 * l[i] - 1.0) * d[i] * n[i] +
                  4.0 * (l[i] * d[(i + 1) % 3] + l[(i + 1) % 3] * d[i]) * n[3 + i]);
    };
    s.position += l[k] * (2.0 * l[k] - 1.0) * n[k] + 4.0 * l[k] * l[next] * n[3 + k];
    along_u += slope(k, -1.0, 1.0, 0.0);
    along_v += slope(k, -1.0, 0.0, 1.0);
  }
  s.normal = along_u.cross(along_v);
  return s;
}

BoundarySample sample(const QuadNodes& n, double u, double v) {
  struct Line {
    std::array<double, 3> value, slope;
  };
  // Functions of the nodes at 0, 1 and 1/2.
  const auto line = [](double t) {
    return Line{{(1.0 - t) * (1.0 - 2.0 * t), t * (2.0 * t - 1.0), 4.0 * t * (1.0 - t)},
                {4.0 * t - 3.0, 4.0 * t - 1.0, 4.0 - 8.0 * t}};
  };
  constexpr std::array<std::array<std::size_t, 2>, 9> places{
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {1, 2}, {2, 1}, {0, 2}, {2, 2}}};
  const Line a = line(u), b = line(v);
  Vec3 along_u = Vec3::Zero(), along_v = Vec3::Zero();
  BoundarySample s;
  for (std::size_t k = 0; k < 9; ++k) {
    const auto& [i, j] = places[k];
    s.position += a.value[i] * b.value[j] * n[k];
    along_u += a.slope[i] * b.value[j] * n[k];
    along_v += a.value[i] * b.slope[j] * n[k];
  }
  s.normal = along_u.cross(along_v);
  return s;
}

struct Weighted {
  double u, v, weight;
};

/// Seven points, exact to degree 5 (Radon).
std::vector<Weighted> triangle_rule() {
  const double root = std::sqrt(15.0);
  std::vector<Weighted> rule{{1.0 / 3.0, 1.0 / 3.0, 9.0 / 80.0}};
  for (const double sign : {-1.0, 1.0}) {
    const double a = (6.0 + sign * root) / 21.0, weight = (155.0 + sign * root) / 2400.0;
    rule.insert(rule.end(), {{a, a, weight}, {1.0 - 2.0 * a, a, weight}, {a, 1.0 - 2.0 * a, weight}});
  }
  return rule;
}

std::vector<Weighted> quad_rule() {
  const double d = std::sqrt(0.15);
  const std::array<std::array<double, 2>, 3> line{
      {{0.5 - d, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + d, 5.0 / 18.0}}};
  std::vector<Weighted> rule;
  for (const auto& [u, wu] : line)
    for (const auto& [v, wv] : line) rule.push_back({u, v, wu * wv});
  return rule;
}

/// The areas' vectors and moments are summed in `mean_normal` and `centre`.
template <class Nodes>
void add(FaceQuality& face, const Nodes& nodes, const std::vector<Weighted>& rule) {
  for (const auto& [u, v, weight] : rule) {
    const BoundarySample s = sample(nodes, u, v);
    const double area = weight * s.normal.norm();
    face.area_mm2 += area;
    face.mean_normal += weight * s.normal;
    face.centre += area * s.position;
  }
}

}  // namespace

void measure_faces(const MixedMesh& mesh, MixedQuality& quality) {
  static const std::vector<Weighted> of_triangles = triangle_rule(), of_quads = quad_rule();
  std::map<std::int32_t, std::size_t> place;
  for (const geometry::Face& face : mesh.faces) {
    place.emplace(face.id, quality.faces.size());
    FaceQuality measure;
    measure.id = face.id;
    measure.name = face.name;
    measure.kind = face.kind;
    quality.faces.push_back(std::move(measure));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto found = place.find(mesh.triangle_face_ids[i]);
    if (found == place.end()) {
      ++quality.unnamed_facets;
      continue;
    }
    ++quality.faces[found->second].triangles;
    add(quality.faces[found->second], triangle_nodes(mesh, i), of_triangles);
  }
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    const auto found = place.find(mesh.quad_face_ids[i]);
    if (found == place.end()) {
      ++quality.unnamed_facets;
      continue;
    }
    ++quality.faces[found->second].quads;
    add(quality.faces[found->second], quad_nodes(mesh, i), of_quads);
  }
  for (FaceQuality& face : quality.faces)
    if (face.area_mm2 > 0.0) face.mean_normal /= face.area_mm2, face.centre /= face.area_mm2;
}

WallDeviation wall_deviation(const MixedMesh& mesh, const geometry::AabbTree& reference,
                             const core::TaskContext& task) {
  check_lists(mesh, "wall deviation");
  const geometry::FacesByKind faces(mesh.faces);
  std::vector<std::int32_t> used;
  std::vector<Vec3> samples;
  const auto use = [&](const auto& nodes) { used.insert(used.end(), nodes.begin(), nodes.end()); };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!faces.wall(mesh.triangle_face_ids[i])) continue;
    use(mesh.triangles[i]);
    if (mesh.quadratic()) use(mesh.triangle_nodes[i]);
    samples.push_back(sample(triangle_nodes(mesh, i), 1.0 / 3.0, 1.0 / 3.0).position);
  }
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    if (!faces.wall(mesh.quad_face_ids[i])) continue;
    use(mesh.quads[i]);
    if (mesh.quadratic()) use(mesh.quad_nodes[i]);
    samples.push_back(sample(quad_nodes(mesh, i), 0.5, 0.5).position);
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::int32_t v : used) samples.push_back(mesh.points[static_cast<std::size_t>(v)]);
  WallDeviation result;
  if (samples.empty()) return result;
  std::vector<double> distances(samples.size());
  core::parallel_chunks(samples.size(), 512, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i) distances[i] = reference.closest(samples[i]).distance;
  });
  result.samples = samples.size();
  const auto worst = std::max_element(distances.begin(), distances.end()) - distances.begin();
  result.worst_at = samples[static_cast<std::size_t>(worst)];
  for (const double d : distances) result.mean_mm += d / static_cast<double>(distances.size());
  std::sort(distances.begin(), distances.end());
  result.max_mm = distances.back();
  const double rank = std::ceil(0.95 * static_cast<double>(distances.size()));
  result.p95_mm = distances[static_cast<std::size_t>(rank) - 1];
  return result;
}

WallDeviation wall_deviation(const MixedMesh& mesh, const geometry::TriMesh& reference,
                             const core::TaskContext& task) {
  if (reference.triangles.empty())
    throw InvalidInput("wall deviation: the reference surface has no triangles");
  return wall_deviation(mesh, geometry::AabbTree(reference), task);
}

}  // namespace ostia::meshing
