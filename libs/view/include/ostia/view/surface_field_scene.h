#pragma once
/// \file A surface coloured by one of its arrays, such as the wall shear stress, in the 3D scene.

#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/view/scene_guest.h"

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace ostia::view {

enum class FieldAt { points, triangles };

/// A surface and what is needed to find places on it. Takes its time to make; immutable, so that another
/// thread can.
class FieldSurface {
 public:
  /// Throws InvalidInput for no triangles, points that are not finite, a corner that is not there.
  explicit FieldSurface(geometry::TriMesh surface);
  const geometry::TriMesh& mesh() const { return mesh_; }
  const geometry::AabbTree& tree() const { return tree_; }

 private:
  geometry::TriMesh mesh_;
  geometry::AabbTree tree_;
};

/// The range of colours that most of the values fill: from their 2nd to their 98th percentile (nearest rank;
/// values that are not finite do not count), so that a few cells with a spike do not take the colours from
/// all others. Where both are the same, and where there is no value, a range about it that is not empty.
std::pair<double, double> automatic_range(std::span<const double> values);

class SurfaceFieldScene final : public SceneGuest {
 public:
  explicit SurfaceFieldScene(std::shared_ptr<const FieldSurface> surface);  ///< throws InvalidInput for null
  ~SurfaceFieldScene() override;
  /// Values that are not finite are grey. At points they are straight over a triangle; those of triangles
  /// have an edge there. Throws InvalidInput for another number of values, or a scale that is none.
  void set_values(std::vector<double> values, FieldAt at, const ValueScale& scale);
  /// The value where the ray first meets the surface: between points straight, NaN where one corner has none.
  /// Nothing where it misses, and before there are values.
  std::optional<double> value_at(const SceneRay& ray) const;

  vtkProp& prop() override;
  vtkSmartPointer<vtkProp> twin() const override;
  std::vector<geometry::Vec3> outline() const override;
  std::optional<ValueScale> bar() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::view
