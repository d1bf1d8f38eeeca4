#include "ostia/meshing/shape_kept.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/faces.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace ostia::meshing {
namespace {

using geometry::MixedMesh;
using geometry::Triangle;
using geometry::TriMesh;
using geometry::Vec3;

constexpr double allowed_radii = 0.05, allowed_mm = 0.05;

TriMesh wall_as_mesh(const geometry::FacedSurface& surface) {
  const geometry::FacesByKind faces(surface.faces);
  TriMesh wall;
  wall.points = surface.mesh.points;
  for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i)
    if (faces.wall(surface.face_ids[i])) wall.triangles.push_back(surface.mesh.triangles[i]);
  return wall;
}

TriMesh wall_as_mesh(const MixedMesh& mesh) {
  const geometry::FacesByKind faces(mesh.faces);
  TriMesh wall;
  wall.points = mesh.points;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!faces.wall(mesh.triangle_face_ids[i])) continue;
    const Triangle& t = mesh.triangles[i];
    if (!mesh.quadratic()) {
      wall.triangles.push_back(t);
      continue;
    }
    const auto& m = mesh.triangle_nodes[i];  // on the edges 01, 12, 20
    wall.triangles.insert(wall.triangles.end(),
                          {{t[0], m[0], m[2]}, {m[0], t[1], m[1]}, {m[2], m[1], t[2]}, {m[0], m[1], m[2]}});
  }
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    if (!faces.wall(mesh.quad_face_ids[i])) continue;
    const auto& q = mesh.quads[i];
    wall.triangles.insert(wall.triangles.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
  }
  return wall;
}

/// Points that triangles use, and the triangles' centres.
std::vector<Vec3> samples_of(const TriMesh& wall) {
  std::vector<bool> used(wall.points.size(), false);
  std::vector<Vec3> samples;
  for (const Triangle& t : wall.triangles) {
    Vec3 centre = Vec3::Zero();
    for (const std::int32_t v : t) {
      used[static_cast<std::size_t>(v)] = true;
      centre += wall.points[static_cast<std::size_t>(v)] / 3.0;
    }
    samples.push_back(centre);
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) samples.push_back(wall.points[i]);
  return samples;
}

double percentile(std::vector<double>& values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size()))) - 1;
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

/// Distances of samples from another wall, and their shares of what is allowed.
struct Shares {
  std::vector<double> distance, share;
  std::vector<geometry::SurfacePoint> near;
};

using RadiusAt = std::function<double(const Vec3&, const geometry::SurfacePoint&)>;

Shares shares_of(const std::vector<Vec3>& samples, const geometry::AabbTree& other, const RadiusAt& radius_at,
                 const core::TaskContext& task) {
  Shares out{std::vector<double>(samples.size()), std::vector<double>(samples.size()),
             std::vector<geometry::SurfacePoint>(samples.size())};
  core::parallel_chunks(samples.size(), 512, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i) {
      out.near[i] = other.closest(samples[i]);
      out.distance[i] = out.near[i].distance;
      out.share[i] = out.distance[i] / (allowed_radii * radius_at(samples[i], out.near[i]) + allowed_mm);
    }
  });
  return out;
}

OneWayDeviation one_way(const std::vector<Vec3>& samples, Shares shares) {
  OneWayDeviation out;
  out.samples = samples.size();
  out.worst_at =
      samples[static_cast<std::size_t>(std::ranges::max_element(shares.share) - shares.share.begin())];
  for (const double d : shares.distance) out.mean_mm += d / static_cast<double>(samples.size());
  out.max_mm = *std::ranges::max_element(shares.distance);
  out.p999_mm = percentile(shares.distance, 0.999);
  out.p999_share = percentile(shares.share, 0.999);
  return out;
}

/// Both walls, prepared for distances both ways.
struct TwoWalls {
  TriMesh before, after;
  const std::vector<double>& radii;
  geometry::AabbTree before_tree, after_tree;

  TwoWalls(const geometry::FacedSurface& surface, TriMesh other, const std::vector<double>& radii_mm)
      : before(checked(surface, radii_mm)),
        after(std::move(other)),
        radii(radii_mm),
        before_tree(before),
        after_tree(some(after)) {}
  double radius_on(const geometry::SurfacePoint& near) const {
    const Triangle& t = before.triangles[static_cast<std::size_t>(near.triangle)];
    double radius = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      radius += near.barycentric[static_cast<Eigen::Index>(k)] * radii[static_cast<std::size_t>(t[k])];
    return radius;
  }
  Shares from_mesh(const std::vector<Vec3>& samples, const core::TaskContext& task) const {
    return shares_of(
        samples, before_tree,
        [&](const Vec3&, const geometry::SurfacePoint& near) { return radius_on(near); }, task);
  }
  Shares from_surface(const std::vector<Vec3>& samples, const core::TaskContext& task) const {
    return shares_of(
        samples, after_tree,
        [&](const Vec3& p, const geometry::SurfacePoint&) { return radius_on(before_tree.closest(p)); },
        task);
  }

 private:
  static TriMesh checked(const geometry::FacedSurface& surface, const std::vector<double>& radii_mm) {
    if (radii_mm.size() != surface.mesh.points.size() ||
        surface.face_ids.size() != surface.mesh.triangles.size())
      throw InvalidInput("shape: a radius for each point and a face id for each triangle are needed");
    return some(wall_as_mesh(surface));
  }
  static TriMesh some(TriMesh wall) {
    if (wall.triangles.empty()) throw InvalidInput("shape: the surface or the mesh has no wall");
    return wall;
  }
};

std::string way_reason(const char* what, const OneWayDeviation& way, double most) {
  return std::string(what) + core::fixed_text(way.p999_mm, 2) + " mm at the 99.9th percentile, at most " +
         core::fixed_text(way.max_mm, 2) + " mm: " + core::fixed_text(way.p999_share, 2) +
         " times what is allowed (0.05 radii + 0.05 mm; bound " + core::significant_text(most, 3) +
         "), worst near (" + core::fixed_text(way.worst_at.x(), 1) + ", " +
         core::fixed_text(way.worst_at.y(), 1) + ", " + core::fixed_text(way.worst_at.z(), 1) + ") mm";
}

}  // namespace

void validate(const ShapeBounds& bounds) {
  if (!(bounds.max_volume_change > 0.0 && bounds.max_volume_change <= 1.0))
    throw InvalidInput("shape: max_volume_change " + std::to_string(bounds.max_volume_change) +
                       " must lie in (0, 1]");
  if (!(bounds.max_p999_share > 0.0))
    throw InvalidInput("shape: max_p999_share " + std::to_string(bounds.max_p999_share) +
                       " must be positive");
}

ShapeKept shape_kept(const MixedMesh& mesh, const geometry::FacedSurface& surface,
                     const std::vector<double>& radii_mm, const core::TaskContext& task) {
  const TwoWalls walls(surface, wall_as_mesh(mesh), radii_mm);
  ShapeKept kept;
  const std::vector<Vec3> of_mesh = samples_of(walls.after), of_surface = samples_of(walls.before);
  kept.mesh_to_surface = one_way(of_mesh, walls.from_mesh(of_mesh, task.sub(0.0, 0.4)));
  kept.surface_to_mesh = one_way(of_surface, walls.from_surface(of_surface, task.sub(0.4, 1.0)));
  kept.surface_volume_mm3 = geometry::volume(surface.mesh);
  return kept;
}

std::size_t shorten_where_off(const geometry::FacedSurface& surface, const geometry::FacedSurface& remeshed,
                              const std::vector<double>& radii_mm, double most_share,
                              std::vector<double>& edge_lengths_mm, const core::TaskContext& task) {
  if (edge_lengths_mm.size() != surface.mesh.points.size())
    throw InvalidInput("shape: an edge length for each point of the surface is needed");
  const TwoWalls walls(surface, wall_as_mesh(remeshed), radii_mm);
  const std::vector<Vec3> of_mesh = samples_of(walls.after), of_surface = samples_of(walls.before);
  const Shares mesh = walls.from_mesh(of_mesh, task.sub(0.0, 0.4)),
               back = walls.from_surface(of_surface, task.sub(0.4, 1.0));
  std::vector<double> sorted_mesh = mesh.share, sorted_back = back.share;
  if (percentile(sorted_mesh, 0.999) <= most_share && percentile(sorted_back, 0.999) <= most_share) return 0;
  std::vector<bool> off(surface.mesh.points.size(), false);
  const auto mark = [&](std::int32_t triangle) {
    for (const std::int32_t v : walls.before.triangles[static_cast<std::size_t>(triangle)])
      off[static_cast<std::size_t>(v)] = true;
  };
  for (std::size_t i = 0; i < of_mesh.size(); ++i)
    if (mesh.share[i] > most_share) mark(mesh.near[i].triangle);
  for (std::size_t i = 0; i < of_surface.size(); ++i)
    if (back.share[i] > most_share) mark(walls.before_tree.closest(of_surface[i]).triangle);
  for (std::size_t i = 0; i < off.size(); ++i)
    if (off[i]) edge_lengths_mm[i] *= 0.5;
  return static_cast<std::size_t>(std::ranges::count(off, true));
}

QualityVerdict check(const ShapeKept& shape, const ShapeBounds& bounds) {
  validate(bounds);
  QualityVerdict verdict;
  if (std::abs(shape.volume_change()) > bounds.max_volume_change)
    verdict.reasons.push_back("the mesh holds " + core::fixed_text(shape.volume_mm3, 1) +
                              " mm3 where the surface holds " +
                              core::fixed_text(shape.surface_volume_mm3, 1) + " mm3 (" +
                              core::signed_text(100.0 * shape.volume_change(), 2) + " %, bound " +
                              core::significant_text(100.0 * bounds.max_volume_change, 3) +
                              " %): take shorter edges (--edge-ratio), or see to branches without an axis");
  if (shape.surface_to_mesh.p999_share > bounds.max_p999_share)
    verdict.reasons.push_back(way_reason("parts of the surface are not in the mesh, ", shape.surface_to_mesh,
                                         bounds.max_p999_share));
  if (shape.mesh_to_surface.p999_share > bounds.max_p999_share)
    verdict.reasons.push_back(
        way_reason("the mesh's wall is off the surface, ", shape.mesh_to_surface, bounds.max_p999_share));
  return verdict;
}

}  // namespace ostia::meshing
