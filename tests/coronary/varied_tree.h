#pragma once
/// \file Synthetic trees as they are found: turned, scaled, cut, thinned out, with branches that have no
/// name.

#include "ostia/phantom/coronary_tree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>

namespace ostia::testing {

struct VariedTree {
  geometry::VesselTree tree;
  std::map<std::int32_t, std::string> kinds;  ///< of each vessel: its name without number; empty: no name
};

/// A draw that is the same everywhere.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double uniform(double from, double to) {
    return from + (to - from) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 engine_;
};

inline void shorten(phantom::CoronaryVessel& vessel, std::size_t count) {
  vessel.axis.points.resize(count);
  vessel.axis.radius.resize(count);
  vessel.axis.abscissa.resize(count);
  vessel.axis.frames.resize(count);
}

/// Each vessel only as far as it is as wide as this.
inline phantom::CoronaryTree wide_part(const phantom::CoronaryTree& tree, double least_radius_mm) {
  phantom::CoronaryTree rest;
  rest.dominance = tree.dominance;
  for (phantom::CoronaryVessel vessel : tree.vessels) {
    const auto parent = std::find_if(rest.vessels.begin(), rest.vessels.end(),
                                     [&](const auto& other) { return other.id == vessel.parent; });
    std::size_t count = vessel.axis.size();
    while (count > 0 && vessel.axis.radius[count - 1] < least_radius_mm) --count;
    if (count < 100) continue;  // 10 mm
    if (vessel.parent >= 0 &&
        (parent == rest.vessels.end() || parent->axis.abscissa.back() < vessel.parent_s_mm + 2.0))
      continue;
    shorten(vessel, count);
    rest.vessels.push_back(std::move(vessel));
  }
  return rest;
}

/// Each vessel's first part, and the branches that leave it there.
inline phantom::CoronaryTree first_part(const phantom::CoronaryTree& tree, double share) {
  phantom::CoronaryTree rest;
  rest.dominance = tree.dominance;
  for (phantom::CoronaryVessel vessel : tree.vessels) {
    shorten(vessel, static_cast<std::size_t>(share * static_cast<double>(vessel.axis.size())));
    bool hangs = vessel.parent < 0;
    for (const phantom::CoronaryVessel& parent : rest.vessels)
      hangs = hangs || (parent.id == vessel.parent && parent.axis.abscissa.back() > vessel.parent_s_mm + 2.0);
    if (hangs) rest.vessels.push_back(std::move(vessel));
  }
  return rest;
}

/// A branch of an atrium: off a main vessel, away from the apex.
inline phantom::CoronaryVessel atrial_branch(const phantom::CoronaryVessel& parent, std::int32_t id,
                                             const geometry::Vec3& long_axis, Draw& draw) {
  phantom::CoronaryVessel branch;
  branch.id = id;
  branch.parent = parent.id;
  const double share = draw.uniform(0.25, 0.8);
  const auto at = static_cast<std::size_t>(share * static_cast<double>(parent.axis.size() - 1));
  branch.parent_s_mm = parent.axis.abscissa[at];
  const geometry::Vec3 aside(draw.uniform(-0.6, 0.6), draw.uniform(-0.6, 0.6), draw.uniform(-0.6, 0.6));
  const geometry::Vec3 way = (-long_axis + aside).normalized();
  const double length = draw.uniform(8.0, 25.0);
  for (double s = 0.0; s <= length; s += 0.1) {
    branch.axis.points.push_back(parent.axis.points[at] + s * way);
    branch.axis.radius.push_back(0.6);
  }
  geometry::complete(branch.axis);
  return branch;
}

/// Of a healthy heart: turned by up to 25 degrees about any axis, 0.85 to 1.15 as large, each vessel 50 to
/// 100 % as long, one branch in seven not there, and two branches of the atria.
inline VariedTree varied_tree(std::uint64_t seed) {
  Draw draw(seed);
  const phantom::HeartShape heart = phantom::draw_heart(seed);
  const phantom::CoronaryTree drawn = phantom::draw_coronaries(heart, {.seed = seed, .disease = 0.0});
  const auto is_main = [](const std::string& name) {
    return name == "LAD" || name == "LCX" || name == "RCA";
  };
  phantom::CoronaryTree kept;
  kept.dominance = drawn.dominance;
  VariedTree varied;
  for (phantom::CoronaryVessel vessel : drawn.vessels) {
    const double share = draw.uniform(0.5, 1.0);
    const bool missing = draw.uniform(0.0, 7.0) < 1.0;
    shorten(vessel, static_cast<std::size_t>(share * static_cast<double>(vessel.axis.size())));
    bool hangs = vessel.parent < 0;
    for (const phantom::CoronaryVessel& parent : kept.vessels)
      hangs = hangs || (parent.id == vessel.parent && parent.axis.abscissa.back() > vessel.parent_s_mm + 2.0);
    if (!hangs || (missing && !is_main(vessel.name)) || vessel.axis.size() < 80) continue;
    kept.vessels.push_back(std::move(vessel));
  }
  std::int32_t id = 1000;
  for (const char* name : {"RCA", "LCX"})
    for (std::size_t i = 0; i < kept.vessels.size(); ++i)
      if (kept.vessels[i].name == name) {
        kept.vessels.push_back(atrial_branch(kept.vessels[i], id++, heart.long_axis, draw));
        break;
      }
  varied.tree = phantom::vessel_tree(kept);
  for (const geometry::Vessel& vessel : varied.tree.vessels)
    varied.kinds[vessel.id] = vessel.name.substr(0, vessel.name.find_first_of("0123456789"));
  const geometry::Vec3 axis(draw.uniform(-1.0, 1.0), draw.uniform(-1.0, 1.0), draw.uniform(-1.0, 1.0));
  const double angle = draw.uniform(-25.0, 25.0) * std::numbers::pi / 180.0;
  const geometry::Mat3 turn =
      draw.uniform(0.85, 1.15) * Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  for (geometry::TreeNode& node : varied.tree.nodes) node.position = turn * node.position;
  for (geometry::TreeSegment& segment : varied.tree.segments) {
    for (geometry::Vec3& point : segment.axis.points) point = turn * point;
    geometry::complete(segment.axis);
  }
  return varied;
}

}  // namespace ostia::testing
