#pragma once
/// \file Which vessel a place belongs to, and how far from its boundary it is.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/scene.h"

#include <memory>
#include <optional>
#include <vector>

namespace ostia::phantom {

enum class Boundary { lumen, wall };

/// A tree made ready for questions. Immutable; asked from many threads.
class VesselField {
 public:
  explicit VesselField(const CoronaryTree& tree);
  ~VesselField();
  VesselField(VesselField&&) noexcept;
  VesselField& operator=(VesselField&&) noexcept;

  /// Where a place is in a vessel's own coordinates: foot on the axis, angle, distance from the axis and the
  /// radii there.
  struct Place {
    std::int32_t vessel = -1;
    double s_mm = 0.0, theta = 0.0, rho_mm = 0.0;
    double lumen_mm = 0.0, wall_mm = 0.0;
  };
  /// For each vessel within `reach_mm` of its outer wall, its place (the foot that lies deepest in the
  /// lumen).
  void places(const Vec3& point, double reach_mm, std::vector<Place>& out) const;
  /// Negative inside the union of the lumina (or outer walls), zero on its boundary: min over vessels of rho
  /// - r, with the ends cut flat. `reach_mm` when farther than that from all.
  double value(Boundary boundary, const Vec3& point, double reach_mm) const;
  /// Lumen, plaque or wall; nothing outside the outer walls.
  std::optional<Material> material(const Vec3& point) const;
  bool near(const geometry::Box3& box, double reach_mm) const;  ///< false: surely none within reach
  geometry::Box3 box() const;                                   ///< around all outer walls

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The boundary of the whole tree, one closed surface a connected tree (flat caps at ostia and ends):
/// marching cubes near the vessels with every vertex on the exact boundary to 1e-6 mm, and edges split until
/// triangles are within 0.01 mm of it away from the creases where vessels meet and the rims of caps. The same
/// for any number of threads. Throws InvalidInput for a spacing outside [0.02, 1] mm; Cancelled.
geometry::TriMesh tree_surface(const VesselField& field, Boundary boundary, double spacing_mm = 0.15,
                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::phantom
