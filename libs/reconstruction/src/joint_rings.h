#pragma once
/// \file How the sphere about a joint is divided among its branches: one ring of directions each.

#include "field.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace ostia::reconstruction {

struct JointRings {
  std::vector<Vec3> points;
  std::vector<std::vector<std::int32_t>>
      rings;  ///< of each slot: `sides` of them, counter-clockwise about it
  /// How far along each slot's direction its first own section may lie, mm; empty: beyond its ring.
  std::vector<double> clearance;
};

/// The point of the joint's surface in a direction from its centre.
using SurfacePoint = std::function<Vec3(const Vec3&)>;

struct JointSurface {
  Vec3 centre = Vec3::Zero();
  SurfacePoint at;                        ///< in a direction
  std::function<Vec3(const Vec3&)> onto;  ///< the nearest point of the surface
};

/// What may be tried where a joint's surface crosses itself.
struct JointStyle {
  bool four_poles = true;  ///< where there are four branches
  bool disc = true;        ///< where a thin branch leaves a wide vessel: see thin_branch.h
  bool even = true;        ///< arcs' points evenly along the surface, else evenly in angle
  double blend = 1.0;      ///< of the options' rounding
  double gap = 0.7;        ///< from the joint's ring to the branch's first own section, in radii
  bool flat = false;       ///< beyond level 1 its quadrilaterals are divided as they are
  bool operator==(const JointStyle&) const = default;
};

/// Rings of neighbours share the points between them, so that each edge of a ring belongs to two of them.
///
/// Two poles on an axis across the branches, and from pole to pole an arc between each two neighbours. Where
/// four branches do not lie in one plane: four poles, each between three of the branches, and an arc between
/// each two. Arcs that have no pole in common are made of equally many edges, a, b and c of the three pairs;
/// then every ring has a + b + c = `sides` of them. Two poles' arcs run through the crotch where
/// the walls of neighbours meet, four poles' along the border of directions that are as near to one branch as
/// to the other.
JointRings rings_about(const std::vector<Slot>& slots, int sides, const JointStyle& style,
                       const JointSurface& surface);

}  // namespace ostia::reconstruction
