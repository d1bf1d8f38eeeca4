#pragma once
/// \file Places in the heart's own coordinates, and where arteries usually run in them.

#include "ostia/phantom/heart.h"

#include <string>

namespace ostia::phantom {

/// Such that HeartShape::epicardium(phi, depth, outwards) is the place: its nearest point on the epicardium.
struct HeartPlace {
  double phi_rad = 0.0;  ///< in (-pi, pi]
  double depth = 0.0;
  double outwards_mm = 0.0;
};
HeartPlace heart_place(const HeartShape& heart, const Vec3& point);

/// What an artery follows.
enum class Groove {
  none,              ///< the epicardium alone
  anterior,          ///< LAD
  posterior,         ///< PDA
  atrioventricular,  ///< RCA and LCX
  within             ///< septal branches: none of it
};
Groove groove_of(const std::string& vessel);

/// Where a groove is, beside a place in it: its angle at a depth (interventricular), its depth at an angle
/// (atrioventricular); the place itself without one.
HeartPlace in_groove(const HeartShape& heart, Groove groove, const HeartPlace& place);
/// How far above the epicardium an artery's axis usually is.
double usual_height_mm(const HeartShape& heart, Groove groove, const HeartPlace& place);

}  // namespace ostia::phantom
