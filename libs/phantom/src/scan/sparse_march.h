#pragma once
/// \file The zero set of a function that is worth sampling in few places only.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

namespace ostia::phantom {

using geometry::Vec3;

/// A function of space, negative inside, whose gradient is about one near its zero set.
class ImplicitField {
 public:
  virtual ~ImplicitField() = default;
  virtual double operator()(const Vec3& point) const = 0;  ///< asked from many threads
  virtual bool near(const geometry::Box3& box) const = 0;  ///< false: positive in all of the box
};

/// The closed surface where the function is zero, outward; vertices lie on it to 1e-9 mm but where a crease
/// keeps them from it. Marching cubes in bricks of the grid that the function is near to; the same for any
/// number of threads.
geometry::TriMesh sparse_march(const ImplicitField& f, const geometry::Box3& box, double spacing_mm,
                               const core::TaskContext& task);

/// Follows the function's gradient (by differences) to its zero set; false, and the point as it was, where
/// that is farther than `reach_mm` or not found.
bool project(const ImplicitField& f, Vec3& point, double reach_mm);

}  // namespace ostia::phantom
