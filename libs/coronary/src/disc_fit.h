#pragma once
/// \file A disc of contrast in a plane: the section of a large vessel.

#include "ostia/imaging/volume.h"

#include <optional>

namespace ostia::coronary {

using geometry::Vec3;

/// A plane through a place, by two unit vectors.
struct SectionPlane {
  Vec3 centre = Vec3::Zero();
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();
};

struct DiscFit {
  Vec3 centre = Vec3::Zero();
  double radius_mm = 0.0;
  double hu = 0.0;        ///< mean inside 0.7 radii
  double sd_hu = 0.0;     ///< about it
  double round = 0.0;     ///< share of the rays whose edge lies on the circle, [0, 1]
  double residual = 0.0;  ///< root mean square of those edges' distance from the circle, in radii
};

struct DiscFitOptions {
  double smallest_radius_mm = 7.0, largest_radius_mm = 26.0;
  double least_hu = 150.0;  ///< at the centre
  double wall_hu = 60.0;    ///< what the contrast is counted from
  double fall = 0.35;       ///< share of the contrast by which an edge is lower than the inside
  double tolerance = 0.15;  ///< how far off the circle an edge may lie, in radii
  int rays = 36;
};

/// The circle through the first falls of intensity on rays from about `plane.centre`, fitted again without
/// what lies far from it, and again about its own centre. Nothing where there is no contrast or too few edges
/// lie on one circle (fewer than half).
std::optional<DiscFit> fit_disc(const imaging::ImageVolume& image, const SectionPlane& plane,
                                const DiscFitOptions& options);

}  // namespace ostia::coronary
