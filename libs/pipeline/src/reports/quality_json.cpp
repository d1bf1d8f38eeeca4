#include "reports/quality_json.h"

#include "ostia/geometry/faces.h"
#include "ostia/pipeline/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace ostia::pipeline {
namespace {

using nlohmann::json;

json element_json(const meshing::ElementQuality& q) {
  return {{"count", q.count},
          {"inverted", q.inverted},
          {"min_scaled_jacobian", q.min_scaled_jacobian},
          {"mean_scaled_jacobian", q.mean_scaled_jacobian},
          {"min_jacobian_ratio", q.min_jacobian_ratio},
          {"min_dihedral_deg", q.min_dihedral_deg},
          {"max_dihedral_deg", q.max_dihedral_deg},
          {"mean_min_dihedral_deg", q.mean_min_dihedral_deg},
          {"min_dihedral_histogram", q.min_dihedral_histogram},
          {"max_dihedral_histogram", q.max_dihedral_histogram},
          {"scaled_jacobian_histogram", q.scaled_jacobian_histogram},
          {"volume_mm3", q.volume_mm3},
          {"worst_at", point_json(q.worst_at)},
          {"sharpest_at", point_json(q.sharpest_at)}};
}

json openfoam_json(const meshing::OpenFoamQuality& q) {
  return {{"max_non_orthogonality_deg", q.max_non_orthogonality_deg},
          {"mean_non_orthogonality_deg", q.mean_non_orthogonality_deg},
          {"severely_non_orthogonal", q.severely_non_orthogonal},
          {"max_skewness", q.max_skewness},
          {"max_aspect_ratio", q.max_aspect_ratio},
          {"min_volume_ratio", q.min_volume_ratio},
          {"max_openness", q.max_openness},
          {"min_volume_mm3", q.min_volume_mm3},
          {"max_volume_mm3", q.max_volume_mm3},
          {"volume_mm3", q.volume_mm3},
          {"least_orthogonal_at", point_json(q.least_orthogonal_at)},
          {"most_skewed_at", point_json(q.most_skewed_at)}};
}

json face_json(const meshing::FaceQuality& face) {
  return {{"id", face.id},
          {"name", face.name},
          {"kind", name_of(face.kind)},
          {"triangles", face.triangles},
          {"quads", face.quads},
          {"area_mm2", face.area_mm2},
          {"mean_normal", point_json(face.mean_normal)},
          {"centre", point_json(face.centre)}};
}

/// As of all elements together.
double weighted(const meshing::MixedQuality& q, double meshing::ElementQuality::*figure) {
  const auto tetrahedra = static_cast<double>(q.tetrahedra.count),
             prisms = static_cast<double>(q.prisms.count);
  const double sum = tetrahedra * q.tetrahedra.*figure + prisms * q.prisms.*figure;
  return sum / std::max(1.0, tetrahedra + prisms);
}

json layer_tetrahedra_json(const meshing::LayerTetrahedra& q) {
  const auto known = [](double value) { return std::isfinite(value) ? json(value) : json(); };
  return {{"count", q.count},
          {"max_dihedral_deg", q.max_dihedral_deg},
          {"bluntest_at", point_json(q.bluntest_at)},
          {"others_min_dihedral_deg", known(q.others_min_dihedral_deg)},
          {"others_min_scaled_jacobian", known(q.others_min_scaled_jacobian)},
          {"others_max_non_orthogonality_deg", q.others_max_non_orthogonality_deg}};
}

json volume_json(const meshing::MixedQuality& q) {
  json faces = json::array();
  for (const meshing::FaceQuality& face : q.faces) faces.push_back(face_json(face));
  json out = {
      {"points", q.points},
      {"tetrahedra", q.tetrahedra.count},
      {"prisms", q.prisms.count},
      {"order", q.quadratic ? 2 : 1},
      {"min_dihedral_deg", least_dihedral_deg(q)},
      {"max_dihedral_deg", std::max(q.tetrahedra.max_dihedral_deg, q.prisms.max_dihedral_deg)},
      {"mean_min_dihedral_deg", weighted(q, &meshing::ElementQuality::mean_min_dihedral_deg)},
      {"min_scaled_jacobian", least_scaled_jacobian(q)},
      {"mean_scaled_jacobian", weighted(q, &meshing::ElementQuality::mean_scaled_jacobian)},
      {"inverted", q.inverted()},
      {"boundary_mismatches", q.boundary_mismatches},
      {"unnamed_facets", q.unnamed_facets},
      {"mean_edge_mm", q.mean_edge_mm},
      {"volume_mm3", q.volume_mm3()},
      {"radius_edge",
       {{"max", q.radius_edge.max}, {"mean", q.radius_edge.mean}, {"histogram", q.radius_edge.histogram}}},
      {"openfoam", openfoam_json(q.openfoam)},
      {"of_tetrahedra", element_json(q.tetrahedra)},
      {"of_prisms", element_json(q.prisms)},
      {"faces", faces}};
  if (q.layers) out["of_layers"] = layer_tetrahedra_json(*q.layers);
  return out;
}

json layers_json(const meshing::BoundaryLayerReport& r) {
  json places = json::array();
  for (const meshing::ThinPlace& place : r.thin_places)
    places.push_back({{"point", point_json(place.point)},
                      {"thickness_mm", place.thickness_mm},
                      {"wanted_mm", place.wanted_mm}});
  return {{"prisms", r.prisms},
          {"inverted", r.inverted},
          {"full_share", r.full_share},
          {"min_scaled_jacobian", r.min_scaled_jacobian},
          {"mean_scaled_jacobian", r.mean_scaled_jacobian},
          {"min_inner_angle_deg", r.min_inner_angle_deg},
          {"rounds", r.rounds},
          {"thin_places", places}};
}

json quadratic_json(const meshing::QuadraticReport& r) {
  json places = json::array();
  for (const meshing::MovedBackNode& place : r.places)
    places.push_back(
        {{"point", point_json(place.point)}, {"share", place.share}, {"distance_mm", place.distance_mm}});
  return {{"wall_nodes", r.wall_nodes},
          {"on_reference", r.on_reference},
          {"moved_back", r.moved_back},
          {"not_projected", r.not_projected},
          {"max_distance_mm", r.max_distance_mm},
          {"mean_distance_mm", r.mean_distance_mm},
          {"max_displacement_mm", r.max_displacement_mm},
          {"inverted", r.inverted},
          {"min_jacobian_ratio", r.min_jacobian_ratio},
          {"straight_volume_mm3", r.straight_volume_mm3},
          {"places", places}};
}

json extension_json(const meshing::FlowExtension& e) {
  return {{"end", e.end},
          {"direction", point_json(e.direction)},
          {"diameter_mm", e.diameter_mm},
          {"length_mm", e.length_mm},
          {"wanted_length_mm", e.wanted_length_mm},
          {"transition_mm", e.transition_mm},
          {"bend_deg", e.bend_deg},
          {"section_area_mm2", e.section_area_mm2},
          {"end_area_mm2", e.end_area_mm2},
          {"seam_angle_deg", e.seam_angle_deg}};
}

json refinement_json(const RefinementReport& r) {
  const auto bound = [](double value) { return std::isfinite(value) ? json(value) : json(); };
  json asked{{"most_refinement", r.asked.most_refinement},
             {"most_coarsening", r.asked.most_coarsening},
             {"gradation", r.asked.gradation},
             {"min_edge_mm", r.asked.min_edge_mm},
             {"max_edge_mm", bound(r.asked.max_edge_mm)}};
  if (r.asked.elements) {
    asked["elements"] = *r.asked.elements;
  } else {
    asked["error_share"] = r.asked.error_share;
  }
  return {{"field", r.field},
          {"at", r.at_elements ? "cells" : "points"},
          {"asked", asked},
          {"range", r.range},
          {"largest_error_before", r.largest_error},
          {"target_error", r.target_error},
          {"largest_error_foretold", r.reached_error},
          {"refined_share", r.refined_share},
          {"held_share", r.held_share},
          {"least_edge_mm", r.least_edge_mm},
          {"largest_edge_mm", r.largest_edge_mm},
          {"elements_before", r.elements_before},
          {"elements_foretold", r.elements_foretold},
          {"elements", r.elements}};
}

json deviation_json(const meshing::WallDeviation& d) {
  return {{"samples", d.samples},
          {"max_mm", d.max_mm},
          {"p95_mm", d.p95_mm},
          {"mean_mm", d.mean_mm},
          {"worst_at", point_json(d.worst_at)}};
}

json one_way_json(const meshing::OneWayDeviation& d) {
  return {{"samples", d.samples}, {"max_mm", d.max_mm},         {"p999_mm", d.p999_mm},
          {"mean_mm", d.mean_mm}, {"p999_share", d.p999_share}, {"worst_at", point_json(d.worst_at)}};
}

json shape_json(const meshing::ShapeKept& s) {
  return {{"mesh_to_surface", one_way_json(s.mesh_to_surface)},
          {"surface_to_mesh", one_way_json(s.surface_to_mesh)},
          {"surface_volume_mm3", s.surface_volume_mm3},
          {"volume_mm3", s.volume_mm3},
          {"volume_change", s.volume_change()}};
}

}  // namespace

json point_json(const geometry::Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

json verdict_json(const meshing::QualityVerdict& verdict) {
  return {{"passed", verdict.ok()}, {"reasons", verdict.reasons}};
}

json surface_json(const meshing::SurfaceQuality& q) {
  return {{"points", q.points},
          {"triangles", q.triangles},
          {"min_angle_deg", q.min_angle_deg},
          {"mean_min_angle_deg", q.mean_min_angle_deg},
          {"max_frobenius_aspect", q.max_frobenius_aspect},
          {"mean_frobenius_aspect", q.mean_frobenius_aspect},
          {"valence", q.valence},
          {"mean_edge_mm", q.mean_edge_mm},
          {"open_edges", q.open_edges},
          {"non_manifold_edges", q.non_manifold_edges},
          {"self_intersections", q.self_intersections},
          {"area_mm2", q.area_mm2},
          {"volume_mm3", q.volume_mm3}};
}

json figures_json(const MeshQuality& quality) {
  json out{{"surface", surface_json(quality.surface)}, {"volume", volume_json(quality.volume)}};
  if (quality.wall_deviation) out["wall_deviation"] = deviation_json(*quality.wall_deviation);
  if (quality.shape) out["shape"] = shape_json(*quality.shape);
  if (quality.layers) out["layers"] = layers_json(*quality.layers);
  if (quality.quadratic) out["quadratic"] = quadratic_json(*quality.quadratic);
  if (quality.refinement) out["refinement"] = refinement_json(*quality.refinement);
  for (const meshing::FlowExtension& extension : quality.extensions)
    out["extensions"].push_back(extension_json(extension));
  return out;
}

std::string quality_json(const meshing::SurfaceQuality& surface, const meshing::QualityVerdict& verdict) {
  return json{{"v", 1}, {"surface", surface_json(surface)}, {"verdict", verdict_json(verdict)}}.dump();
}

std::string quality_json(const MeshQuality& quality) {
  json out = figures_json(quality);
  out["v"] = 1;
  out["verdict"] = verdict_json(quality.verdict);
  return out.dump();
}

}  // namespace ostia::pipeline
