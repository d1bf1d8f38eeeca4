#include "coronaries/surface_refine.h"
#include "scan/sparse_march.h"

#include "ostia/core/error.h"
#include "ostia/phantom/vessel_field.h"

#include <string>

namespace ostia::phantom {
namespace {

/// The signed distance of one boundary, clamped to a reach.
class BoundaryField final : public ImplicitField {
 public:
  BoundaryField(const VesselField& field, Boundary boundary, double reach_mm)
      : field_(field), boundary_(boundary), reach_mm_(reach_mm) {}
  double operator()(const Vec3& point) const override { return field_.value(boundary_, point, reach_mm_); }
  bool near(const geometry::Box3& box) const override { return field_.near(box, reach_mm_); }

 private:
  const VesselField& field_;
  Boundary boundary_;
  double reach_mm_;
};

}  // namespace

geometry::TriMesh tree_surface(const VesselField& field, Boundary boundary, double spacing_mm,
                               const core::TaskContext& task) {
  if (!(spacing_mm >= 0.02 && spacing_mm <= 1.0))
    throw InvalidInput("the spacing of a tree's surface must lie in [0.02, 1] mm, not " +
                       std::to_string(spacing_mm));
  if (field.box().isEmpty()) return {};
  const BoundaryField f(field, boundary, 4.0 * spacing_mm);
  geometry::TriMesh mesh = sparse_march(f, field.box(), spacing_mm, task.sub(0.0, 0.75));
  refine_to(f, mesh, 0.3 * spacing_mm, task.sub(0.75, 1.0));
  return mesh;
}

}  // namespace ostia::phantom
