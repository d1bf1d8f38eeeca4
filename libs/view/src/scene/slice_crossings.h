#pragma once
// Where vessels meet a slice.

#include "ostia/lumen/lumen_model.h"
#include "ostia/lumen/scalar_field.h"
#include "ostia/reformat/plane.h"

#include <cstdint>
#include <vector>

namespace ostia::session {
class ShownPhase;
}

namespace ostia::view {

using geometry::Vec2;
using geometry::Vec3;

/// Where an axis crosses a plane: in pixels, with the vessel.
struct AxisCrossing {
  Vec2 px = Vec2::Zero();
  std::int32_t vessel = 0;
};
/// Those within the picture, of axes as the model has them, or where a phase of the heart has carried them.
std::vector<AxisCrossing> crossings(const lumen::LumenModel& model, const reformat::Plane& plane,
                                    const session::ShownPhase* phase = nullptr);

/// Places of the picture from which the lines of all lumens are found that the plane cuts: where axes cross
/// it and, of an axis that runs beside it within its lumen, the foot of the nearest point and others some
/// millimetres apart. Within its lumen: no farther from the plane than its radius, or with a foot that `wall`
/// has inside, since lumens are not round.
std::vector<Vec2> slice_seeds(const lumen::LumenModel& model, const lumen::ScalarField& wall,
                              const reformat::Plane& plane);

}  // namespace ostia::view
