#pragma once
/// \file Axes of one scan, mapped to another and pulled to the vessels that it shows.

#include "ostia/session/carry.h"

#include <cstddef>
#include <string>
#include <vector>

namespace ostia::session {

/// A vessel's own part, point by point; of each point of the former axis the carried one, as far as it is
/// kept.
struct CarriedLine {
  std::size_t vessel = 0;              ///< index in the former tree
  std::vector<std::int32_t> segments;  ///< its own ones
  std::vector<std::size_t> last;       ///< index of each one's last point
  std::vector<geometry::Vec3> points;  ///< in the former scan, then in the later one
  std::vector<double> radius_mm;
  std::vector<char> seen;  ///< the later scan shows lumen there
  std::size_t kept = 0;    ///< points from the first on; 0: left out
  CarriedVessel told;
};

struct CarriedTree {
  geometry::VesselTree tree;       ///< sound; ids are the former tree's
  std::vector<CarriedLine> lines;  ///< one a vessel of the former tree, in its order
};

/// Throws InvalidInput for a map that gives what is not finite, and where no vessel is seen; Cancelled.
CarriedTree carried_tree(const geometry::VesselTree& before, const imaging::ImageVolume& image,
                         const analysis::PointMap& map, const CarryOptions& options,
                         const core::TaskContext& task);

}  // namespace ostia::session
