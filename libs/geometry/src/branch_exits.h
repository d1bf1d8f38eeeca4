#pragma once
/// \file Where vessels leave each other's tubes.

#include "ostia/geometry/ball_line.h"
#include "ostia/geometry/vessel_tree.h"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace ostia::geometry {

/// A vessel as one line.
struct VesselLine {
  const Vessel* vessel = nullptr;
  std::int32_t root = 0;          ///< node
  std::vector<std::size_t> ends;  ///< of each segment: its last point
  Centerline axis;
  std::unique_ptr<BallLine> tube;
};
std::vector<VesselLine> vessel_lines(const VesselTree& tree);

/// A fork on a vessel's way.
struct ForkOnLine {
  std::int32_t node = 0;
  LinePlace from, to;  ///< of the bifurcation on this vessel
};

/// The forks of all vessels, in each vessel's order.
class BranchExits {
 public:
  BranchExits(const VesselTree& tree, const std::vector<VesselLine>& lines);
  std::vector<ForkOnLine> forks(std::size_t line);

 private:
  struct Exit {
    LinePlace place;
    bool of_all = false;  ///< true for all vessels that go on by the same two segments
  };
  Exit exit(const VesselLine& line, const VesselLine& other, std::size_t first, std::size_t segment) const;
  LinePlace exit_from(std::size_t line, std::size_t segment, std::int32_t other,
                      const std::vector<std::size_t>& through);

  const VesselTree& tree_;
  const std::vector<VesselLine>& lines_;
  std::map<std::int32_t, std::vector<std::size_t>> of_root_, through_;  // lines, by node and by segment
  std::map<std::pair<std::int32_t, std::int32_t>, LinePlace> known_;    // by both segments
};

}  // namespace ostia::geometry
