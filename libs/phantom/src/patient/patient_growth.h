#pragma once
/// \file What a patient's mask does not hold: the ends of vessels, and usual branches.

#include "coronaries/coronary_courses.h"

#include "ostia/phantom/heart_warp.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::phantom {

/// The heart that vessels grow on.
struct Ground {
  const HeartShape& heart;
  const HeartWarp& warp;
  Dominance dominance = Dominance::right;
  std::uint64_t seed = 1;
};

/// Where a vessel goes on from its last point, about 4 mm apart: an LAD in its groove to the apex, an RCA in
/// its groove to the crux and the back of the left ventricle, an LCX in its own to the obtuse margin (beyond
/// the crux where it is dominant), others on their way, which turns towards the apex, until they are 0.6 mm
/// in radius, 0.011 mm thinner a mm. Empty where less than 8 mm are missing.
std::vector<Vec3> grown_end(const Ground& ground, const std::string& name, const std::vector<Vec3>& points,
                            double end_radius_mm);

/// The usual course of a vessel on this heart (plan_courses), and its axis behind a parent's (null: from an
/// ostium); points of the world, 1 mm apart. Nothing where there is no such course.
struct UsualVessel {
  Course course;
  std::vector<Vec3> points;
  double parent_s_mm = 0.0;
};
/// `lcx_s_mm`: where the LCX leaves the LAD, from which branches of the LAD are counted.
std::optional<UsualVessel> usual_vessel(const Ground& ground, const std::string& name,
                                        const geometry::Centerline* parent, double lcx_s_mm);

}  // namespace ostia::phantom
