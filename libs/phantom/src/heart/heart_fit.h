#pragma once
/// \file How a patient's arteries are laid onto the phantom's heart.

#include "heart/heart_place.h"

#include "ostia/phantom/patient_tree.h"

#include <vector>

namespace ostia::phantom {

/// A place on an artery that says where the heart is.
struct CourseMark {
  Vec3 world = Vec3::Zero();  ///< in the patient first, then where the patient was put
  Groove groove = Groove::none;
  std::size_t vessel = 0;
  double weight = 1.0;
};

/// The patient is moved as a whole; the phantom's heart is as much longer and wider as `size` says before it
/// is bent.
struct HeartFit {
  geometry::Mat3 rotation = geometry::Mat3::Identity();
  Vec3 shift = Vec3::Zero();
  Vec3 size = Vec3::Ones();  ///< of the patient's heart over the phantom's: right, up, along the long axis
  double height_mm = 0.0;    ///< root mean square of the arteries' distances from where they usually are
                             ///< above the epicardium
  double groove_mm = 0.0;    ///< the same of the way from their grooves
  Vec3 placed(const Vec3& patient) const { return rotation * patient + shift; }
};
/// In the phantom's own heart, before it is bent: what is beside the base is as much nearer as it is smaller.
Vec3 resized(const HeartShape& heart, const HeartFit& fit, const Vec3& placed);
Vec3 unresized(const HeartShape& heart, const HeartFit& fit, const Vec3& own);

/// Where the ostia of the phantom's own arteries are.
struct Ostia {
  Vec3 left = Vec3::Zero(), right = Vec3::Zero();
};
Ostia usual_ostia(const AorticRoot& root);

/// The shortest turn that brings a long axis to the heart's; none for a zero axis.
geometry::Mat3 turned_to_heart(const HeartShape& heart, const Vec3& long_axis);

/// Rotation, shift and three sizes by least squares over marks and ostia (Levenberg 1944, Marquardt 1963):
/// 3 mm for an artery's height, 6 mm for the way from its groove, 6 mm for an ostium, 8 % for a size.
HeartFit fit_heart(const HeartShape& heart, const std::vector<CourseMark>& marks, const Ostia* patient_ostia,
                   const Vec3& long_axis);

}  // namespace ostia::phantom
