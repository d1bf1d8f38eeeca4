// Qualities of separate meshes as of one: counts, areas and volumes are added, means weighted by counts,
// extremes kept with their places.

#include "meshes/export_parts.h"

#include <algorithm>

namespace ostia::pipeline {
namespace {

/// As if `b` had been counted together with `a`.
double weighted(double a, std::size_t count_a, double b, std::size_t count_b) {
  const auto wa = static_cast<double>(count_a), wb = static_cast<double>(count_b);
  return wa + wb > 0.0 ? (wa * a + wb * b) / (wa + wb) : 0.0;
}

template <std::size_t N>
void add(std::array<std::size_t, N>& all, const std::array<std::size_t, N>& one) {
  for (std::size_t i = 0; i < N; ++i) all[i] += one[i];
}

void add(meshing::SurfaceQuality& all, const meshing::SurfaceQuality& one) {
  const auto mean = [&](double a, double b) { return weighted(a, all.triangles, b, one.triangles); };
  all.min_angle_deg = std::min(all.min_angle_deg, one.min_angle_deg);
  all.max_frobenius_aspect = std::max(all.max_frobenius_aspect, one.max_frobenius_aspect);
  all.mean_min_angle_deg = mean(all.mean_min_angle_deg, one.mean_min_angle_deg);
  all.mean_frobenius_aspect = mean(all.mean_frobenius_aspect, one.mean_frobenius_aspect);
  all.mean_edge_mm = mean(all.mean_edge_mm, one.mean_edge_mm);
  add(all.valence, one.valence);
  all.points += one.points;
  all.triangles += one.triangles;
  all.open_edges += one.open_edges;
  all.non_manifold_edges += one.non_manifold_edges;
  all.inconsistent_edges += one.inconsistent_edges;
  all.self_intersections += one.self_intersections;
  all.area_mm2 += one.area_mm2;
  all.volume_mm3 += one.volume_mm3;
}

void add(meshing::ElementQuality& all, const meshing::ElementQuality& one) {
  if (one.count == 0) return;
  if (all.count == 0) {
    all = one;
    return;
  }
  const auto mean = [&](double a, double b) { return weighted(a, all.count, b, one.count); };
  if (one.min_scaled_jacobian < all.min_scaled_jacobian) all.worst_at = one.worst_at;
  if (one.min_dihedral_deg < all.min_dihedral_deg) all.sharpest_at = one.sharpest_at;
  all.min_scaled_jacobian = std::min(all.min_scaled_jacobian, one.min_scaled_jacobian);
  all.min_jacobian_ratio = std::min(all.min_jacobian_ratio, one.min_jacobian_ratio);
  all.min_dihedral_deg = std::min(all.min_dihedral_deg, one.min_dihedral_deg);
  all.max_dihedral_deg = std::max(all.max_dihedral_deg, one.max_dihedral_deg);
  all.mean_scaled_jacobian = mean(all.mean_scaled_jacobian, one.mean_scaled_jacobian);
  all.mean_min_dihedral_deg = mean(all.mean_min_dihedral_deg, one.mean_min_dihedral_deg);
  add(all.min_dihedral_histogram, one.min_dihedral_histogram);
  add(all.max_dihedral_histogram, one.max_dihedral_histogram);
  add(all.scaled_jacobian_histogram, one.scaled_jacobian_histogram);
  all.inverted += one.inverted;
  all.volume_mm3 += one.volume_mm3;
  all.count += one.count;
}

/// Means are weighted by cells, of which there are about half as many as faces.
void add(meshing::OpenFoamQuality& all, const meshing::OpenFoamQuality& one, std::size_t cells_all,
         std::size_t cells_one) {
  if (one.max_non_orthogonality_deg > all.max_non_orthogonality_deg)
    all.least_orthogonal_at = one.least_orthogonal_at;
  if (one.max_skewness > all.max_skewness) all.most_skewed_at = one.most_skewed_at;
  all.max_non_orthogonality_deg = std::max(all.max_non_orthogonality_deg, one.max_non_orthogonality_deg);
  all.mean_non_orthogonality_deg =
      weighted(all.mean_non_orthogonality_deg, cells_all, one.mean_non_orthogonality_deg, cells_one);
  all.severely_non_orthogonal += one.severely_non_orthogonal;
  all.max_skewness = std::max(all.max_skewness, one.max_skewness);
  all.max_aspect_ratio = std::max(all.max_aspect_ratio, one.max_aspect_ratio);
  all.min_volume_ratio = std::min(all.min_volume_ratio, one.min_volume_ratio);
  all.max_openness = std::max(all.max_openness, one.max_openness);
  all.min_volume_mm3 = std::min(all.min_volume_mm3, one.min_volume_mm3);
  all.max_volume_mm3 = std::max(all.max_volume_mm3, one.max_volume_mm3);
  all.volume_mm3 += one.volume_mm3;
}

void add(meshing::LayerTetrahedra& all, const meshing::LayerTetrahedra& one) {
  if (one.max_dihedral_deg > all.max_dihedral_deg) all.bluntest_at = one.bluntest_at;
  if (one.others_min_dihedral_deg < all.others_min_dihedral_deg)
    all.others_sharpest_at = one.others_sharpest_at;
  if (one.others_min_scaled_jacobian < all.others_min_scaled_jacobian)
    all.others_worst_at = one.others_worst_at;
  if (one.others_max_non_orthogonality_deg > all.others_max_non_orthogonality_deg)
    all.others_least_orthogonal_at = one.others_least_orthogonal_at;
  all.max_dihedral_deg = std::max(all.max_dihedral_deg, one.max_dihedral_deg);
  all.others_min_dihedral_deg = std::min(all.others_min_dihedral_deg, one.others_min_dihedral_deg);
  all.others_min_scaled_jacobian = std::min(all.others_min_scaled_jacobian, one.others_min_scaled_jacobian);
  all.others_max_non_orthogonality_deg =
      std::max(all.others_max_non_orthogonality_deg, one.others_max_non_orthogonality_deg);
  all.count += one.count;
}

void add(meshing::MixedQuality& all, const meshing::MixedQuality& one) {
  const std::size_t cells_all = all.tetrahedra.count + all.prisms.count,
                    cells_one = one.tetrahedra.count + one.prisms.count;
  all.mean_edge_mm = weighted(all.mean_edge_mm, cells_all, one.mean_edge_mm, cells_one);
  all.radius_edge.mean =
      weighted(all.radius_edge.mean, all.tetrahedra.count, one.radius_edge.mean, one.tetrahedra.count);
  all.radius_edge.max = std::max(all.radius_edge.max, one.radius_edge.max);
  add(all.radius_edge.histogram, one.radius_edge.histogram);
  add(all.openfoam, one.openfoam, cells_all, cells_one);
  add(all.tetrahedra, one.tetrahedra);
  add(all.prisms, one.prisms);
  if (all.layers && one.layers) add(*all.layers, *one.layers);
  all.points += one.points;
  all.boundary_mismatches += one.boundary_mismatches;
  all.unnamed_facets += one.unnamed_facets;
  all.faces.insert(all.faces.end(), one.faces.begin(), one.faces.end());
}

void add(meshing::WallDeviation& all, const meshing::WallDeviation& one) {
  if (one.max_mm > all.max_mm) all.worst_at = one.worst_at;
  all.max_mm = std::max(all.max_mm, one.max_mm);
  all.p95_mm = std::max(all.p95_mm, one.p95_mm);  // no less than that of all samples together
  all.mean_mm = weighted(all.mean_mm, all.samples, one.mean_mm, one.samples);
  all.samples += one.samples;
}

/// Percentiles become no less than those of all samples together.
void add(meshing::OneWayDeviation& all, const meshing::OneWayDeviation& one) {
  if (one.p999_share > all.p999_share) all.worst_at = one.worst_at;
  all.max_mm = std::max(all.max_mm, one.max_mm);
  all.p999_mm = std::max(all.p999_mm, one.p999_mm);
  all.p999_share = std::max(all.p999_share, one.p999_share);
  all.mean_mm = weighted(all.mean_mm, all.samples, one.mean_mm, one.samples);
  all.samples += one.samples;
}

void add(meshing::ShapeKept& all, const meshing::ShapeKept& one) {
  add(all.mesh_to_surface, one.mesh_to_surface);
  add(all.surface_to_mesh, one.surface_to_mesh);
  all.surface_volume_mm3 += one.surface_volume_mm3;
  all.volume_mm3 += one.volume_mm3;
}

/// Shares of the wall are weighted by prisms, of which each triangle of the wall carries as many.
void add(meshing::BoundaryLayerReport& all, const meshing::BoundaryLayerReport& one) {
  const auto mean = [&](double a, double b) { return weighted(a, all.prisms, b, one.prisms); };
  all.full_share = mean(all.full_share, one.full_share);
  all.mean_scaled_jacobian = mean(all.mean_scaled_jacobian, one.mean_scaled_jacobian);
  all.min_scaled_jacobian = std::min(all.min_scaled_jacobian, one.min_scaled_jacobian);
  all.min_inner_angle_deg = std::min(all.min_inner_angle_deg, one.min_inner_angle_deg);
  all.thin_places.insert(all.thin_places.end(), one.thin_places.begin(), one.thin_places.end());
  all.rounds = std::max(all.rounds, one.rounds);
  all.prisms += one.prisms;
  all.inverted += one.inverted;
}

void add(meshing::QuadraticReport& all, const meshing::QuadraticReport& one) {
  all.mean_distance_mm = weighted(all.mean_distance_mm, all.wall_nodes, one.mean_distance_mm, one.wall_nodes);
  all.wall_nodes += one.wall_nodes;
  all.on_reference += one.on_reference;
  all.moved_back += one.moved_back;
  all.not_projected += one.not_projected;
  all.max_distance_mm = std::max(all.max_distance_mm, one.max_distance_mm);
  all.max_displacement_mm = std::max(all.max_displacement_mm, one.max_displacement_mm);
  all.places.insert(all.places.end(), one.places.begin(), one.places.end());
  all.inverted += one.inverted;
  all.min_jacobian_ratio = std::min(all.min_jacobian_ratio, one.min_jacobian_ratio);
  all.rounds = std::max(all.rounds, one.rounds);
  all.volume_mm3 += one.volume_mm3;
  all.straight_volume_mm3 += one.straight_volume_mm3;
}

template <class Report>
void add_where_known(std::optional<Report>& all, const std::optional<Report>& one) {
  if (all && one) add(*all, *one);
}

}  // namespace

void add(const MeshQuality& one, MeshQuality& all) {
  if (all.volume.points == 0) {
    all = one;
    return;
  }
  add(all.surface, one.surface);
  add(all.volume, one.volume);
  add_where_known(all.wall_deviation, one.wall_deviation);
  add_where_known(all.shape, one.shape);
  add_where_known(all.layers, one.layers);
  add_where_known(all.quadratic, one.quadratic);
  if (all.refinement && one.refinement) all.refinement->elements += one.refinement->elements;
  all.extensions.insert(all.extensions.end(), one.extensions.begin(), one.extensions.end());
}

}  // namespace ostia::pipeline
