#pragma once
/// \file The state and the passes of the remesher.

#include "remeshing/edit_mesh.h"

#include "ostia/core/task_context.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/meshing/remesh.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace ostia::meshing {

/// A border loop of the input: the curve on which its points must stay.
struct BorderCurve {
  std::vector<geometry::Vec3> points;  ///< along the border half-edges, not closed by a repeated point
  std::vector<std::int32_t> vertices;  ///< the input's points
  std::vector<double> arc;             ///< length up to each point
  double length = 0.0;
  geometry::Vec3 at(double s) const;  ///< s of any size: taken modulo the length
};
/// The border loops in the order of their lowest half-edge.
std::vector<BorderCurve> border_curves(const EditMesh& mesh);

/// The input surface: where points go back to, with its normals and target lengths.
class ReferenceSurface {
 public:
  ReferenceSurface(const geometry::TriMesh& mesh, const std::vector<double>& sizes);
  struct Sample {
    geometry::Vec3 point, normal;
    double size;
  };
  Sample project(const geometry::Vec3& p) const;
  const std::vector<geometry::Vec3>& normals() const { return normals_; }

 private:
  geometry::AabbTree tree_;
  std::vector<geometry::Triangle> triangles_;
  std::vector<geometry::Vec3> normals_;
  std::vector<double> sizes_;
};

/// Works on a copy of the surface; every pass leaves it a manifold of the same kind with no triangle turned
/// over.
class Remesher {
 public:
  Remesher(const geometry::TriMesh& surface, const std::vector<double>& sizes);

  std::size_t split_long();
  std::size_t collapse_short();
  std::size_t flip_for_valence();
  std::size_t flip_for_angle();
  void relax();
  /// Adapts the factor between thresholds and targets so that the number of triangles comes to the integral
  /// of 1 / A(u), equation 9.
  void calibrate();
  /// One round over the triangles with an angle below the bound; returns how many there were.
  std::size_t mend(double below_angle_deg);

  void set_task(const core::TaskContext& task) { task_ = &task; }
  /// From now on the points of this border curve stay as they are, and its edges are not split.
  void freeze(std::int32_t curve) { frozen_[static_cast<std::size_t>(curve)] = true; }
  const EditMesh& mesh() const { return mesh_; }
  const std::vector<BorderCurve>& curves() const { return curves_; }
  std::int32_t curve(std::int32_t v) const { return curve_[static_cast<std::size_t>(v)]; }
  double target_length(std::int32_t h) const { return 0.5 * (size(mesh_.origin(h)) + size(mesh_.target(h))); }
  std::size_t splits = 0, collapses = 0, flips = 0;

 private:
  struct Place {  // where a vertex may go
    geometry::Vec3 point, normal;
    double size, arc;
  };
  double size(std::int32_t v) const { return size_[static_cast<std::size_t>(v)]; }
  bool frozen(std::int32_t v) const {
    return curve(v) != EditMesh::none && frozen_[static_cast<std::size_t>(curve(v))];
  }
  const geometry::Vec3& normal(std::int32_t v) const { return normal_[static_cast<std::size_t>(v)]; }
  double ratio(std::int32_t h) const { return mesh_.length(h) / (scale_ * target_length(h)); }
  /// Cosine between a triangle and the surface's normals at its corners; -1 when it has no area.
  double facing(const geometry::Vec3& a, const geometry::Vec3& b, const geometry::Vec3& c,
                const geometry::Vec3& reference) const;
  geometry::Vec3 reference_normal(std::int32_t a, std::int32_t b, std::int32_t c) const;
  bool flip_keeps_shape(std::int32_t h) const;
  bool collapse_is_good(std::int32_t h, bool mending) const;
  bool try_collapse(std::int32_t h, bool mending);
  void split_edge(std::int32_t h);
  std::size_t flip_sweep(bool for_valence);
  bool flip_raises_angle(std::int32_t h) const;
  bool flip_lowers_valence_deviation(std::int32_t h) const;
  Place border_place(std::int32_t v) const;
  Place relaxed_place(std::int32_t v) const;
  bool move_is_safe(std::int32_t v, const Place& place) const;
  void move(std::int32_t v, const Place& place);
  double worst_angle_cosine(std::int32_t v, const geometry::Vec3& p) const;
  bool optimise_vertex(std::int32_t v);
  bool mend_face(std::int32_t f);
  std::vector<std::pair<double, std::int32_t>> edges_beyond(double threshold, bool longer) const;

  EditMesh mesh_;
  ReferenceSurface reference_;
  std::vector<BorderCurve> curves_;
  std::vector<double> size_, arc_;
  std::vector<geometry::Vec3> normal_;
  std::vector<std::int32_t> curve_;
  std::vector<std::size_t> curve_points_;
  std::vector<bool> frozen_;  // one a curve
  double scale_ = 1.0;
  const core::TaskContext* task_ = &core::no_task();
};

/// Largest cosine of the three angles' cosines, that is of the smallest angle: 1 when degenerate.
double min_angle_cosine(const geometry::Vec3& a, const geometry::Vec3& b, const geometry::Vec3& c);

}  // namespace ostia::meshing
