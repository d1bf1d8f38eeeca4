#include "ostia/meshing/volume_keeping.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/faces.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ostia::meshing {
namespace {

using geometry::Triangle;
using geometry::TriMesh;
using geometry::Vec3;

constexpr int most_rounds = 4;
constexpr double most_move = 0.1;     // of a point's shortest edge
constexpr double good_enough = 1e-4;  // of the volume

/// Places inside a triangle and their weights: exact for polynomials of degree 2 (Strang and Fix).
constexpr std::array<std::array<double, 3>, 3> rule{{{2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0},
                                                     {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0},
                                                     {1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0}}};

Vec3 doubled_normal(const TriMesh& mesh, const Triangle& t) {
  const auto at = [&](std::size_t k) -> const Vec3& { return mesh.points[static_cast<std::size_t>(t[k])]; };
  return (at(1) - at(0)).cross(at(2) - at(0));
}

/// What one wall and the surface it stands for need in each round.
class Keeper {
 public:
  Keeper(geometry::FacedSurface& surface, const geometry::FacedSurface& reference)
      : mesh_(surface.mesh), reference_(wall_triangles(reference)), tree_(reference_) {
    const geometry::FacesByKind faces(surface.faces);
    free_.assign(mesh_.points.size(), false);
    shortest_.assign(mesh_.points.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (!faces.wall(surface.face_ids[i])) continue;
      wall_.push_back(mesh_.triangles[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = static_cast<std::size_t>(mesh_.triangles[i][k]),
                   b = static_cast<std::size_t>(mesh_.triangles[i][(k + 1) % 3]);
        free_[a] = true;
        const double length = (mesh_.points[a] - mesh_.points[b]).norm();
        shortest_[a] = std::min(shortest_[a], length);
        shortest_[b] = std::min(shortest_[b], length);
      }
    }
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      if (!faces.wall(surface.face_ids[i]))
        for (const std::int32_t v : mesh_.triangles[i]) free_[static_cast<std::size_t>(v)] = false;
    moved_.assign(mesh_.points.size(), 0.0);
  }

  void round(const core::TaskContext& task) {
    std::vector<double> mean(wall_.size()), area(wall_.size());
    core::parallel_chunks(wall_.size(), 256, [&](std::size_t first, std::size_t last) {
      task.throw_if_cancelled();
      for (std::size_t i = first; i < last; ++i) {
        area[i] = 0.5 * doubled_normal(mesh_, wall_[i]).norm();
        for (const auto& [u, v, w] : rule) mean[i] += height_at(wall_[i], u, v, w) / 3.0;
      }
    });
    std::vector<double> sum(mesh_.points.size(), 0.0), weight(mesh_.points.size(), 0.0);
    std::vector<Vec3> normal(mesh_.points.size(), Vec3::Zero());
    for (std::size_t i = 0; i < wall_.size(); ++i)
      for (const std::int32_t p : wall_[i]) {
        sum[static_cast<std::size_t>(p)] += area[i] * mean[i];
        weight[static_cast<std::size_t>(p)] += area[i];
        normal[static_cast<std::size_t>(p)] += doubled_normal(mesh_, wall_[i]);
      }
    for (std::size_t p = 0; p < mesh_.points.size(); ++p) {
      if (!free_[p] || !(weight[p] > 0.0) || normal[p].isZero()) continue;
      const double most = most_move * shortest_[p];
      const double to = std::clamp(moved_[p] - sum[p] / weight[p], -most, most);
      mesh_.points[p] += (to - moved_[p]) * normal[p].normalized();
      moved_[p] = to;
    }
  }
  double largest_move() const {
    double most = 0.0;
    for (const double m : moved_) most = std::max(most, std::abs(m));
    return most;
  }

 private:
  static TriMesh wall_triangles(const geometry::FacedSurface& surface) {
    const geometry::FacesByKind faces(surface.faces);
    std::vector<bool> keep;
    for (const std::int32_t id : surface.face_ids) keep.push_back(faces.wall(id));
    return geometry::subset(surface.mesh, keep);
  }
  /// Above the reference: positive outside.
  double height_at(const Triangle& t, double u, double v, double w) const {
    const Vec3 p = u * mesh_.points[static_cast<std::size_t>(t[0])] +
                   v * mesh_.points[static_cast<std::size_t>(t[1])] +
                   w * mesh_.points[static_cast<std::size_t>(t[2])];
    const geometry::SurfacePoint near = tree_.closest(p);
    const Vec3 out =
        doubled_normal(reference_, reference_.triangles[static_cast<std::size_t>(near.triangle)]);
    return (p - near.point).dot(out) < 0.0 ? -near.distance : near.distance;
  }

  TriMesh& mesh_;
  TriMesh reference_;
  geometry::AabbTree tree_;
  std::vector<Triangle> wall_;
  std::vector<bool> free_;        // points of walls alone
  std::vector<double> shortest_;  // edge at each point
  std::vector<double> moved_;     // along its normal, so far
};

void check_faces(const geometry::FacedSurface& surface) {
  if (surface.mesh.triangles.empty() || surface.face_ids.size() != surface.mesh.triangles.size())
    throw InvalidInput("volume keeping: a surface has no triangles, or not a face id for each");
}

}  // namespace

VolumeKept keep_volume(geometry::FacedSurface& remeshed, const geometry::FacedSurface& reference,
                       const core::TaskContext& task) {
  check_faces(remeshed);
  check_faces(reference);
  VolumeKept kept;
  kept.before_mm3 = geometry::volume(remeshed.mesh);
  kept.reference_mm3 = geometry::volume(reference.mesh);
  Keeper keeper(remeshed, reference);
  for (; kept.rounds < most_rounds; ++kept.rounds) {
    keeper.round(task.sub(static_cast<double>(kept.rounds) / most_rounds, 1.0));
    kept.after_mm3 = geometry::volume(remeshed.mesh);
    if (std::abs(kept.after_mm3 - kept.reference_mm3) < good_enough * kept.reference_mm3) break;
  }
  kept.largest_move_mm = keeper.largest_move();
  return kept;
}

}  // namespace ostia::meshing
