#pragma once
/// \file A phantom's tree without one of its vessels, which is then to be found again in the image.

#include "ostia/geometry/polyline.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/segmentation/minimal_path.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ostia::segmentation::testing {

/// The true tree without one vessel and what leaves it.
inline geometry::VesselTree without(const phantom::CoronaryTree& tree, std::int32_t gone) {
  phantom::CoronaryTree rest;
  rest.dominance = tree.dominance;
  std::vector<std::int32_t> removed{gone};
  for (const phantom::CoronaryVessel& v : tree.vessels) {
    const auto is_gone = [&](std::int32_t id) {
      return std::find(removed.begin(), removed.end(), id) != removed.end();
    };
    if (is_gone(v.id)) continue;
    if (is_gone(v.parent)) {
      removed.push_back(v.id);
    } else {
      rest.vessels.push_back(v);
    }
  }
  return phantom::vessel_tree(rest);
}

struct FoundBranch {
  MinimalPath path;
  double off_axis_mm = 0.0;      ///< in the mean, from the true axis
  double off_junction_mm = 0.0;  ///< from the axis' beginning
  double off_parent_mm = 0.0;    ///< of the junction, from the true parent's axis
};

/// By a click at the `last` point of its axis.
inline FoundBranch found_again(const imaging::ImageVolume& image, const phantom::CoronaryTree& tree,
                               const phantom::CoronaryVessel& vessel, std::size_t last) {
  const auto& axis = vessel.axis;
  FoundBranch found{
      .path = path_to_tree(image, axis.points[std::min(last, axis.size() - 1)], without(tree, vessel.id))};
  for (const Vec3& p : found.path.points)
    found.off_axis_mm += (geometry::closest(axis.points, p).point - p).norm();
  found.off_axis_mm /= static_cast<double>(found.path.points.size());
  const Vec3 junction = found.path.junction->point;
  found.off_junction_mm = (junction - axis.points.front()).norm();
  const auto parent = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                   [&](const phantom::CoronaryVessel& v) { return v.id == vessel.parent; });
  found.off_parent_mm = (geometry::closest(parent->axis.points, junction).point - junction).norm();
  return found;
}

}  // namespace ostia::segmentation::testing
