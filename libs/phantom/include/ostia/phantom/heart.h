#pragma once
/// \file Where the heart lies and how large it is: what the coronary tree's courses and the tissues build on.

#include "ostia/geometry/vec.h"

#include <cstdint>

namespace ostia::phantom {

using geometry::Vec3;

/// The aortic root: a tube with three sinuses between annulus and sinotubular junction.
struct AorticRoot {
  Vec3 annulus = Vec3::Zero();  ///< centre of the valve's plane, mm
  Vec3 axis = Vec3::UnitZ();    ///< unit, from the left ventricle to the ascending aorta
  double annulus_radius_mm = 12.0;
  double sinus_radius_mm = 16.5;  ///< in the middle of a sinus
  double sinus_height_mm = 20.0;  ///< annulus to sinotubular junction
  double ascending_radius_mm = 15.0;
  Vec3 left_sinus = Vec3::UnitX();  ///< unit, across the axis: towards the middle of the left sinus
  Vec3 right_sinus = -Vec3::UnitY();
};

/// Ventricles as half an ellipsoid from the base (the plane of the atrioventricular valves) to the apex, in
/// LPS mm. Angles phi run about the long axis from `right` (the middle of the right ventricle's free wall)
/// towards `up` (anterior and superior); 180 degrees is the left ventricle's lateral wall.
struct HeartShape {
  Vec3 base = Vec3::Zero();
  Vec3 long_axis = -Vec3::UnitZ();  ///< unit, base to apex: to the left, front and below
  Vec3 right = -Vec3::UnitX();      ///< unit, across
  Vec3 up = Vec3::UnitY();          ///< right x long_axis
  double length_mm = 92.0;          ///< base to apex on the epicardium
  double half_width_right_mm = 46.0, half_width_up_mm = 40.0;       ///< at the base
  double anterior_groove_rad = 2.02, posterior_groove_rad = -1.75;  ///< interventricular grooves
  AorticRoot root;

  /// A place on the epicardium, `outwards_mm` along its normal. `depth` is 0 at the base and 1 at the apex;
  /// below 0 (to -0.4) it continues above the base, where the atria are.
  Vec3 epicardium(double phi_rad, double depth, double outwards_mm = 0.0) const;
  Vec3 epicardial_normal(double phi_rad, double depth) const;  ///< unit, outward
  /// About the distance to the epicardium in mm, negative inside (first order: f / |grad f| of the
  /// ellipsoid).
  double epicardial_distance(const Vec3& point) const;
};

/// Sizes and directions about their usual values (normal adult, diastole), drawn from the seed.
HeartShape draw_heart(std::uint64_t seed);

}  // namespace ostia::phantom
