#pragma once
/// \file A patient's coronary arteries, as they were found: what a synthetic heart is built around.

#include "ostia/geometry/vec.h"
#include "ostia/phantom/coronary_tree.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::phantom {

/// A vessel from its ostium, or from its parent's axis, to where it was lost.
struct PatientVessel {
  std::string name;          ///< "LAD" (with the left main), "RCA", "D1", ...; empty where that is not sure
  std::int32_t parent = -1;  ///< its place in the list; -1: from an ostium
  std::vector<Vec3> points;  ///< mm, LPS, at most 1 mm apart
  std::vector<double> radius_mm;  ///< of a circle as large as the cross-section, one a point
};

struct PatientTree {
  std::vector<PatientVessel> vessels;  ///< parents before children
  Vec3 long_axis = Vec3::Zero();       ///< base to apex, LPS; zero: the usual one
  std::optional<Dominance> dominance;  ///< nothing where it is not known
  /// How much of each radius is no lumen: labels drawn by hand hold the wall and what is dim beside it
  /// (docs/methods/phantom-trees.md), [0, 1] mm.
  double rim_mm = 0.0;
  std::string digest;                ///< SHA-256 of the file that it comes from
  std::vector<std::string> remarks;  ///< what was mended on the way, in plain words
};
/// Throws InvalidInput for a tree without vessels, arrays of different lengths, fewer than four points,
/// numbers that are not finite, radii that are not positive, a parent that does not come before.
void validate(const PatientTree& patient);

}  // namespace ostia::phantom
