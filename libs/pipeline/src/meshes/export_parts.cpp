#include "meshes/export_parts.h"

#include "ostia/core/files.h"
#include "ostia/geometry/faces.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

namespace ostia::pipeline {
namespace {

std::string safe_name(const std::string& name) {
  std::string safe;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    safe += plain ? c : '_';
  }
  return safe.empty() ? "tree" : safe.substr(0, 64);
}

/// A tube's mesh by its edge length: area over that of an equilateral triangle, volume inside the layers over
/// that of the tetrahedra as TetGen makes them with the usual bounds.
MeshEstimate estimate_tree(const geometry::VesselTree& tree, const meshing::SizingOptions& sizing,
                           const VolumeOptions& volume) {
  const double layers = volume.layers ? volume.layers->layers : 0.0;
  const double thickness = volume.layers ? volume.layers->thickness : 0.0;
  const double most = volume.layers ? volume.layers->largest_fraction_of_radius : 0.0;
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
      const double triangles = 2.0 * M_PI * radius * length / (triangle * edge * edge);
      const double inside = radius - std::min(thickness * edge, most * radius);
      estimate.triangles += triangles;
      estimate.prisms += layers * triangles;
      // The inner surface has the wall's triangles, narrower around the vessel and as long along it.
      const double edge_inside = edge * std::sqrt(inside / radius);
      estimate.tetrahedra +=
          M_PI * inside * inside * length / (tetrahedron * edge_inside * edge_inside * edge_inside);
    }
  }
  if (volume.split_prisms) {
    estimate.tetrahedra += 3.0 * estimate.prisms;
    estimate.prisms = 0.0;
  }
  return estimate;
}

}  // namespace

MeshEstimate estimate_mesh(const lumen::LumenModel& model, const std::vector<std::int32_t>& vessels,
                           const meshing::SizingOptions& sizing, const VolumeOptions& volume) {
  meshing::validate(sizing);
  return estimate_tree(vessels.empty() ? model.tree : part_of(model, vessels).tree, sizing, volume);
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
      return is_wall(face) && is_wall(other);
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
    shares.push_back(shares.back() + std::max(1.0, estimate_tree(part.model.tree, sizing, {}).triangles));
  const double all = shares.back();
  for (double& share : shares) share /= all;
  return shares;
}

std::string name_of(SurfaceEnds ends) {
  return ends == SurfaceEnds::rounded ? "rounded" : ends == SurfaceEnds::capped ? "capped" : "open";
}

namespace {

/// Of the lengths, so that other ones are another job.
std::string digest_of(const meshing::SizeField& field) {
  const auto bytes = [](const auto& values) {
    return std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
  };
  return core::sha256(std::string(bytes(field.points)) + std::string(bytes(field.edge_mm)));
}

}  // namespace

nlohmann::json sizing_json(const meshing::SizingOptions& sizing) {
  const auto bound = [](double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
  };
  nlohmann::json out{{"edge_ratio", sizing.edge_ratio},
                     {"measure", sizing.measure == meshing::SizeMeasure::distance ? "distance" : "radius"},
                     {"gradation", sizing.gradation},
                     {"min_edge_mm", sizing.min_edge_mm},
                     {"max_edge_mm", bound(sizing.max_edge_mm)},
                     {"most_distance_radii", bound(sizing.most_distance_radii)},
                     {"curvature_ratio", sizing.curvature_ratio},
                     {"throat_share", sizing.throat_share}};
  if (sizing.field) out["field_sha256"] = digest_of(*sizing.field);
  return out;
}

}  // namespace ostia::pipeline
