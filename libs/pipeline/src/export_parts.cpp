#include "export_parts.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace ostia::pipeline {
namespace {

/// As if `b` had been counted together with `a`.
double weighted(double a, std::size_t count_a, double b, std::size_t count_b) {
  const auto wa = static_cast<double>(count_a), wb = static_cast<double>(count_b);
  return wa + wb > 0.0 ? (wa * a + wb * b) / (wa + wb) : 0.0;
}

void add_surface(meshing::SurfaceQuality& all, const meshing::SurfaceQuality& one) {
  if (all.triangles == 0) {
    all = one;
    return;
  }
  const auto mean = [&](double a, double b) { return weighted(a, all.triangles, b, one.triangles); };
  all.min_angle_deg = std::min(all.min_angle_deg, one.min_angle_deg);
  all.max_frobenius_aspect = std::max(all.max_frobenius_aspect, one.max_frobenius_aspect);
  all.mean_min_angle_deg = mean(all.mean_min_angle_deg, one.mean_min_angle_deg);
  all.mean_frobenius_aspect = mean(all.mean_frobenius_aspect, one.mean_frobenius_aspect);
  all.mean_edge_mm = mean(all.mean_edge_mm, one.mean_edge_mm);
  for (std::size_t i = 0; i < all.valence.size(); ++i) all.valence[i] += one.valence[i];
  all.points += one.points;
  all.triangles += one.triangles;
  all.open_edges += one.open_edges;
  all.non_manifold_edges += one.non_manifold_edges;
  all.inconsistent_edges += one.inconsistent_edges;
  all.self_intersections += one.self_intersections;
  all.area_mm2 += one.area_mm2;
  all.volume_mm3 += one.volume_mm3;
}

void add_volume(meshing::VolumeQuality& all, const meshing::VolumeQuality& one) {
  if (all.tetrahedra == 0) {
    all = one;
    return;
  }
  const auto mean = [&](double a, double b) { return weighted(a, all.tetrahedra, b, one.tetrahedra); };
  all.min_dihedral_deg = std::min(all.min_dihedral_deg, one.min_dihedral_deg);
  all.max_dihedral_deg = std::max(all.max_dihedral_deg, one.max_dihedral_deg);
  all.min_scaled_jacobian = std::min(all.min_scaled_jacobian, one.min_scaled_jacobian);
  all.mean_min_dihedral_deg = mean(all.mean_min_dihedral_deg, one.mean_min_dihedral_deg);
  all.mean_scaled_jacobian = mean(all.mean_scaled_jacobian, one.mean_scaled_jacobian);
  all.mean_edge_mm = mean(all.mean_edge_mm, one.mean_edge_mm);
  for (std::size_t i = 0; i < all.min_dihedral_histogram.size(); ++i)
    all.min_dihedral_histogram[i] += one.min_dihedral_histogram[i];
  all.points += one.points;
  all.tetrahedra += one.tetrahedra;
  all.boundary_triangles += one.boundary_triangles;
  all.inverted += one.inverted;
  all.boundary_mismatches += one.boundary_mismatches;
  all.volume_mm3 += one.volume_mm3;
}

std::string safe_name(const std::string& name) {
  std::string safe;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    safe += plain ? c : '_';
  }
  return safe.empty() ? "tree" : safe.substr(0, 64);
}

/// A tube's mesh by its edge length: area over that of an equilateral triangle, volume over that of the
/// tetrahedra as TetGen makes them with the usual bounds.
MeshEstimate estimate_tree(const geometry::VesselTree& tree, const meshing::SizingOptions& sizing) {
  constexpr double triangle = 0.433;     // sqrt(3) / 4 of a squared edge
  constexpr double tetrahedron = 0.118;  // sqrt(2) / 12 of a cubed edge
  MeshEstimate estimate;
  for (const geometry::TreeSegment& segment : tree.segments) {
    const geometry::Centerline& axis = segment.axis;
    for (std::size_t i = 0; i + 1 < axis.points.size(); ++i) {
      const double length = (axis.points[i + 1] - axis.points[i]).norm();
      const double radius = 0.5 * (axis.radius[i] + axis.radius[i + 1]);
      const double edge = std::clamp(sizing.edge_ratio * radius, sizing.min_edge_mm, sizing.max_edge_mm);
      if (!(edge > 0.0)) continue;
      estimate.triangles += 2.0 * M_PI * radius * length / (triangle * edge * edge);
      estimate.tetrahedra += M_PI * radius * radius * length / (tetrahedron * edge * edge * edge);
    }
  }
  return estimate;
}

}  // namespace

MeshEstimate estimate_mesh(const lumen::LumenModel& model, const std::vector<std::int32_t>& vessels,
                           const meshing::SizingOptions& sizing) {
  meshing::validate(sizing);
  return estimate_tree(vessels.empty() ? model.tree : part_of(model, vessels).tree, sizing);
}

void append(geometry::FacedSurface& to, const geometry::FacedSurface& surface) {
  const auto first = static_cast<std::int32_t>(to.mesh.points.size());
  to.mesh.points.insert(to.mesh.points.end(), surface.mesh.points.begin(), surface.mesh.points.end());
  for (geometry::Triangle t : surface.mesh.triangles) {
    for (std::int32_t& p : t) p += first;
    to.mesh.triangles.push_back(t);
  }
  std::int32_t next = 1;
  for (const geometry::Face& face : to.faces) next = std::max(next, face.id + 1);
  std::vector<std::pair<std::int32_t, std::int32_t>> ids;
  for (geometry::Face face : surface.faces) {
    const auto same = std::find_if(to.faces.begin(), to.faces.end(), [&](const geometry::Face& other) {
      return face.kind == geometry::FaceKind::wall && other.kind == face.kind;
    });
    const std::int32_t id = same != to.faces.end() ? same->id : next;
    ids.emplace_back(face.id, id);
    if (same != to.faces.end()) continue;
    face.id = next++;
    to.faces.push_back(std::move(face));
  }
  for (const std::int32_t old : surface.face_ids)
    to.face_ids.push_back(
        std::find_if(ids.begin(), ids.end(), [&](const auto& one) { return one.first == old; })->second);
}

std::vector<std::string> folder_names(const std::vector<RootedModel>& parts) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const RootedModel& part : parts) {
    const std::string first = safe_name(part.name);
    std::string name = first;
    for (int number = 2; !taken.insert(name).second; ++number) name = first + "-" + std::to_string(number);
    names.push_back(name);
  }
  return names;
}

std::vector<double> shares_of(const std::vector<RootedModel>& parts, const meshing::SizingOptions& sizing) {
  std::vector<double> shares{0.0};
  for (const RootedModel& part : parts)
    shares.push_back(shares.back() + std::max(1.0, estimate_tree(part.model.tree, sizing).triangles));
  const double all = shares.back();
  for (double& share : shares) share /= all;
  return shares;
}

void MeshTotals::add(const MeshedLumen& meshed) {
  add_surface(surface, meshed.surface_quality);
  add_volume(volume, meshed.volume_quality);
}

std::string name_of(SurfaceEnds ends) {
  return ends == SurfaceEnds::rounded ? "rounded" : ends == SurfaceEnds::capped ? "capped" : "open";
}

nlohmann::json sizing_json(const meshing::SizingOptions& sizing) {
  return {{"edge_ratio", sizing.edge_ratio},
          {"measure", sizing.measure == meshing::SizeMeasure::distance ? "distance" : "radius"},
          {"gradation", sizing.gradation},
          {"min_edge_mm", sizing.min_edge_mm},
          {"max_edge_mm",
           std::isfinite(sizing.max_edge_mm) ? nlohmann::json(sizing.max_edge_mm) : nlohmann::json()}};
}

}  // namespace ostia::pipeline
