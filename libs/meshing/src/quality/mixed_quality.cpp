#include "ostia/meshing/mixed_quality.h"

#include "quadratic/jacobian.h"
#include "quality/mixed_boundary.h"
#include "quality/mixed_elements.h"
#include "quality/mixed_openfoam.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/mixed_mesh_sides.h"
#include "ostia/meshing/boundary_layer.h"
#include "ostia/meshing/element_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::meshing {

using geometry::MixedMesh;
using geometry::Vec3;

namespace {

constexpr std::size_t grain = 2048;

struct ElementValues {
  double scaled_jacobian = 0.0, ratio = 1.0, volume = 0.0, edges = 0.0, edge_count = 6.0, radius_edge = 0.0;
  std::array<double, 2> dihedral{};
  bool inverted = false;
  Vec3 centre = Vec3::Zero();
};

template <class Nodes, class Edges>
double sum_of_edges(const Nodes& p, const Edges& edges) {
  double sum = 0.0;
  for (const auto& [a, b] : edges) sum += (p[a] - p[b]).norm();
  return sum;
}

void set_jacobian(ElementValues& values, const ElementJacobian& j) {
  values.inverted = !(j.lower > 0.0);
  values.volume = j.volume_mm3;
  values.ratio = j.ratio();
  values.scaled_jacobian *= std::min(1.0, values.ratio);
}

double radius_edge(const TetrahedronNodes& p) {
  // The circumcentre from corner 0: half of (|u|^2 v x w + ...) over the determinant.
  const Vec3 u = p[1] - p[0], v = p[2] - p[0], w = p[3] - p[0];
  const double six_volumes = u.cross(v).dot(w);
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : tetrahedron_edges) shortest = std::min(shortest, (p[a] - p[b]).norm());
  const Vec3 centre =
      u.squaredNorm() * v.cross(w) + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v);
  const double radius = 0.5 * centre.norm() / std::abs(six_volumes);
  return std::isfinite(radius / shortest) ? radius / shortest : std::numeric_limits<double>::max();
}

/// Smallest and largest angle between neighbouring sides; a bent quadrilateral counts with its mean normal.
std::array<double, 2> prism_dihedral_deg(const PrismNodes& p) {
  std::array<Vec3, 5> normals;  // of the two triangles first
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& side = geometry::prism_sides[i];
    const auto at = [&](std::size_t k) -> const Vec3& { return p[static_cast<std::size_t>(side[k])]; };
    normals[i] = (side[3] < 0 ? (at(1) - at(0)).cross(at(2) - at(0)) : (at(2) - at(0)).cross(at(3) - at(1)))
                     .normalized();
  }
  std::array<double, 2> range{180.0, 0.0};
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = std::max<std::size_t>(i + 1, 2); j < 5; ++j) {
      const double between = std::atan2(normals[i].cross(normals[j]).norm(), normals[i].dot(normals[j]));
      const double angle = 180.0 - 180.0 / std::numbers::pi * between;
      range = {std::min(range[0], angle), std::max(range[1], angle)};
    }
  return range;
}

template <std::size_t N>
Vec3 centre_of(const auto& p) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < N; ++i) sum += p[i];
  return sum / static_cast<double>(N);
}

ElementValues tetrahedron_values(const MixedMesh& mesh, std::size_t i) {
  const TetrahedronNodes p = tetrahedron_nodes(mesh, i);
  ElementValues values;
  values.scaled_jacobian = scaled_jacobian(p[0], p[1], p[2], p[3]);
  set_jacobian(values, element_jacobian(p));
  values.dihedral = dihedral_range_deg(p[0], p[1], p[2], p[3]);
  values.radius_edge = radius_edge(p);
  values.edges = sum_of_edges(p, tetrahedron_edges);
  values.centre = centre_of<4>(p);
  return values;
}

ElementValues prism_values(const MixedMesh& mesh, std::size_t i) {
  const PrismNodes p = prism_nodes(mesh, i);
  ElementValues values;
  values.scaled_jacobian = prism_scaled_jacobian({p[0], p[1], p[2], p[3], p[4], p[5]});
  set_jacobian(values, element_jacobian(p));
  values.dihedral = prism_dihedral_deg(p);
  values.edges = sum_of_edges(p, prism_edges);
  values.edge_count = static_cast<double>(prism_edges.size());
  values.centre = centre_of<6>(p);
  return values;
}

struct Sums {
  ElementQuality quality;  // means are sums
  RadiusEdgeQuality radius_edge;
  double edges = 0.0;
};

template <std::size_t N>
void count(std::array<std::size_t, N>& histogram, double value, double first, double width) {
  const double bin = std::floor((value - first) / width);
  ++histogram[bin > 0.0 ? std::min<std::size_t>(static_cast<std::size_t>(std::min(bin, 1e6)), N - 1) : 0];
}

Sums nothing() {
  Sums sums;
  sums.quality.min_scaled_jacobian = sums.quality.min_jacobian_ratio = sums.quality.min_dihedral_deg =
      std::numeric_limits<double>::infinity();
  return sums;
}

void add(Sums& sums, const ElementValues& v) {
  ElementQuality& q = sums.quality;
  ++q.count;
  q.inverted += v.inverted ? 1 : 0;
  if (v.scaled_jacobian < q.min_scaled_jacobian)
    q.min_scaled_jacobian = v.scaled_jacobian, q.worst_at = v.centre;
  if (v.dihedral[0] < q.min_dihedral_deg) q.min_dihedral_deg = v.dihedral[0], q.sharpest_at = v.centre;
  q.mean_scaled_jacobian += v.scaled_jacobian;
  q.min_jacobian_ratio = std::min(q.min_jacobian_ratio, v.ratio);
  q.max_dihedral_deg = std::max(q.max_dihedral_deg, v.dihedral[1]);
  q.mean_min_dihedral_deg += v.dihedral[0];
  count(q.min_dihedral_histogram, v.dihedral[0], 0.0, 5.0);
  count(q.max_dihedral_histogram, v.dihedral[1], 0.0, 10.0);
  count(q.scaled_jacobian_histogram, v.scaled_jacobian, 0.0, 0.05);
  q.volume_mm3 += v.volume;
  sums.edges += v.edges;
  sums.radius_edge.max = std::max(sums.radius_edge.max, v.radius_edge);
  sums.radius_edge.mean += v.radius_edge;
  count(sums.radius_edge.histogram, v.radius_edge, 0.5, 0.25);
}

template <std::size_t N>
void add(std::array<std::size_t, N>& a, const std::array<std::size_t, N>& b) {
  for (std::size_t i = 0; i < N; ++i) a[i] += b[i];
}

Sums operator+(Sums a, const Sums& b) {
  ElementQuality& q = a.quality;
  const ElementQuality& r = b.quality;
  q.count += r.count;
  q.inverted += r.inverted;
  if (r.min_scaled_jacobian < q.min_scaled_jacobian)
    q.min_scaled_jacobian = r.min_scaled_jacobian, q.worst_at = r.worst_at;
  if (r.min_dihedral_deg < q.min_dihedral_deg)
    q.min_dihedral_deg = r.min_dihedral_deg, q.sharpest_at = r.sharpest_at;
  q.mean_scaled_jacobian += r.mean_scaled_jacobian;
  q.min_jacobian_ratio = std::min(q.min_jacobian_ratio, r.min_jacobian_ratio);
  q.max_dihedral_deg = std::max(q.max_dihedral_deg, r.max_dihedral_deg);
  q.mean_min_dihedral_deg += r.mean_min_dihedral_deg;
  add(q.min_dihedral_histogram, r.min_dihedral_histogram);
  add(q.max_dihedral_histogram, r.max_dihedral_histogram);
  add(q.scaled_jacobian_histogram, r.scaled_jacobian_histogram);
  q.volume_mm3 += r.volume_mm3;
  a.edges += b.edges;
  a.radius_edge.max = std::max(a.radius_edge.max, b.radius_edge.max);
  a.radius_edge.mean += b.radius_edge.mean;
  add(a.radius_edge.histogram, b.radius_edge.histogram);
  return a;
}

/// Measures `count` elements; the means are means then.
template <class Values>
Sums measured(std::size_t count, const Values& values_of, const core::TaskContext& task) {
  Sums sums = core::parallel_reduce(
      count, grain, nothing(),
      [&](std::size_t first, std::size_t last) {
        task.throw_if_cancelled();
        Sums part = nothing();
        for (std::size_t i = first; i < last; ++i) add(part, values_of(i));
        return part;
      },
      [](const Sums& a, const Sums& b) { return a + b; });
  if (count == 0) return {};
  const auto n = static_cast<double>(count);
  sums.quality.mean_scaled_jacobian /= n;
  sums.quality.mean_min_dihedral_deg /= n;
  sums.radius_edge.mean /= n;
  return sums;
}

}  // namespace

MixedQuality mixed_quality(const MixedMesh& mesh, const core::TaskContext& task) {
  check_lists(mesh, "mesh quality");
  task.set_stage("mesh quality");
  MixedQuality q;
  q.points = mesh.points.size();
  q.quadratic = mesh.quadratic();
  const Sums tetrahedra = measured(
      mesh.tetrahedra.size(), [&](std::size_t i) { return tetrahedron_values(mesh, i); }, task);
  task.set_progress(0.3);
  const Sums prisms = measured(
      mesh.prisms.size(), [&](std::size_t i) { return prism_values(mesh, i); }, task);
  task.set_progress(0.5);
  q.tetrahedra = tetrahedra.quality;
  q.radius_edge = tetrahedra.radius_edge;
  q.prisms = prisms.quality;
  const double edges =
      6.0 * static_cast<double>(q.tetrahedra.count) + 9.0 * static_cast<double>(q.prisms.count);
  if (edges > 0.0) q.mean_edge_mm = (tetrahedra.edges + prisms.edges) / edges;
  measure_sides(mesh, q, task.sub(0.5, 0.95));
  measure_faces(mesh, q);
  task.set_progress(1.0);
  return q;
}

namespace {

/// One number of each element, tetrahedra first.
template <class Pick>
std::vector<double> each_element(const MixedMesh& mesh, const Pick& pick, const core::TaskContext& task) {
  check_lists(mesh, "mesh quality");
  const std::size_t tetrahedra = mesh.tetrahedra.size();
  std::vector<double> values(tetrahedra + mesh.prisms.size());
  core::parallel_chunks(values.size(), grain, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i)
      values[i] = pick(i < tetrahedra ? tetrahedron_values(mesh, i) : prism_values(mesh, i - tetrahedra));
  });
  return values;
}

}  // namespace

std::vector<double> element_scaled_jacobians(const MixedMesh& mesh, const core::TaskContext& task) {
  return each_element(
      mesh, [](const ElementValues& v) { return v.scaled_jacobian; }, task);
}

ElementMeasures element_measures(const MixedMesh& mesh, const core::TaskContext& task) {
  task.set_stage("mesh quality");
  ElementMeasures all;
  const auto take = [&](ElementMeasure measure) -> std::vector<double>& {
    return all[static_cast<std::size_t>(measure)];
  };
  take(ElementMeasure::least_dihedral_deg) = each_element(
      mesh, [](const ElementValues& v) { return v.dihedral[0]; }, task);
  task.set_progress(0.2);
  take(ElementMeasure::scaled_jacobian) = element_scaled_jacobians(mesh, task);
  task.set_progress(0.4);
  take(ElementMeasure::mean_edge_mm) = each_element(
      mesh, [](const ElementValues& v) { return v.edges / v.edge_count; }, task);
  task.set_progress(0.6);
  measure_sides_of_elements(mesh, take(ElementMeasure::non_orthogonality_deg), take(ElementMeasure::skewness),
                            task.sub(0.6, 1.0));
  return all;
}

bool larger_is_worse(ElementMeasure measure) {
  return measure == ElementMeasure::non_orthogonality_deg || measure == ElementMeasure::skewness;
}

}  // namespace ostia::meshing
