#pragma once
/// \file Directions of view as they are told in the catheter laboratory.

#include "ostia/geometry/vec.h"

namespace ostia::geometry {

/// Where a C-arm's image receptor stands, seen from an anterior one. The picture is what one who stands at
/// the receptor sees, the patient's left on its right.
struct CarmAngles {
  double lao_deg = 0.0;      ///< to the patient's left; negative: RAO
  double cranial_deg = 0.0;  ///< towards the head; negative: caudal
};

/// The way from the heart to the receptor in LPS (x to the patient's left, y to the back, z to the head):
/// (sin lao cos cra, -cos lao cos cra, sin cra). LAO 90 is the patient's left side, +x. Unit length.
Vec3 towards_receptor(const CarmAngles& angles);
/// The picture's upward direction, where the head is: orthogonal to it, of unit length.
Vec3 receptor_up(const CarmAngles& angles);

}  // namespace ostia::geometry
