#pragma once
/// \file Where coronary arteries run: axes over the epicardium.

#include "ostia/geometry/centerline.h"
#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/heart.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::phantom {

/// A place of a course in the heart's own coordinates.
struct Waypoint {
  double phi_deg = 0.0;      ///< about the long axis
  double depth = 0.0;        ///< 0 base, 1 apex
  double outwards_mm = 3.0;  ///< above the epicardium
};

inline constexpr double at_crux = -1.0;

/// What a vessel is before it is drawn.
struct Course {
  std::string name;
  std::string parent;        ///< empty: from an ostium
  double parent_s_mm = 0.0;  ///< where it leaves its parent; `at_crux` for where the parent passes the crux
  std::vector<Vec3> beginning;  ///< world points before the first waypoint, the ostium first
  std::vector<Waypoint> way;
  double start_radius_mm = 0.0;  ///< at the ostium; for a branch its share of the parent's radius there
  double end_radius_mm = 0.7;    ///< at the distal end, when branches leave more than that
  bool keep = true;              ///< false: may be left out where it comes too near to another vessel
  /// How late the vessel narrows: 1 evenly from its start, more where it keeps its width up to the crux.
  double taper_power = 1.0;
  std::string joins = {};  ///< a vessel drawn before, half way along whose axis this one ends; empty: none
};

/// The courses of a heart, parents first: dominance and variants drawn from the seed.
struct CoursePlan {
  Dominance dominance = Dominance::right;
  std::vector<Course> courses;
};
CoursePlan plan_courses(const HeartShape& heart, std::uint64_t seed);

/// Other origins than the usual ones (anatomy.cpp).
void change_origins(CoursePlan& plan, const HeartShape& heart, Anatomy anatomy);

/// The axis of a course at 0.1 mm steps, with frames and without radii. `parent` is the parent's axis, or
/// nothing; `end` a place after the last waypoint. It is smoothed until its radius of curvature is nowhere
/// below `least_bend_mm`, if eight times harder smoothing each time can do it.
geometry::Centerline draw_axis(const HeartShape& heart, const Course& course,
                               const geometry::Centerline* parent, double least_bend_mm, std::uint64_t seed,
                               const std::optional<Vec3>& end = {});

/// The least radius of curvature along an axis of 0.1 mm steps.
double least_bend_mm(const geometry::Centerline& axis);

}  // namespace ostia::phantom
