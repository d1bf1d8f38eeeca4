#pragma once
/// \file What a drag over the 3D picture means in the patient.

#include "ostia/geometry/vec.h"
#include "ostia/view/tree_scene.h"

namespace ostia::workstation {

/// How far along the unit vector `normal` at `point` a drag from one place of the picture to another leads,
/// mm. Where the normal points at the viewer, or nearly so, a drag upwards leads away from them.
double dragged_mm(const view::TreeScene& scene, const geometry::Vec3& point, const geometry::Vec3& normal,
                  const geometry::Vec2& from, const geometry::Vec2& to);

}  // namespace ostia::workstation
