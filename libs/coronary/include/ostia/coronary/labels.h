#pragma once
/// \file Which coronary artery is which, by where it runs.

#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::coronary {

using geometry::Vec3;

/// What is known of the heart besides its arteries.
struct HeartLandmarks {
  std::optional<Vec3> long_axis;  ///< base to apex, LPS, any length; estimated where it is not given
};

/// docs/methods/coronary-labels.md gives the rules and where their bounds come from.
struct LabelOptions {
  HeartLandmarks heart;
  double least_confidence = 0.5;  ///< a vessel of less keeps a number for its name, [0, 1]
};
void validate(const LabelOptions& options);  ///< throws InvalidInput

enum class CoronarySide { left, right };
enum class CoronaryDominance { unknown, right, left, balanced };
const char* word(CoronaryDominance dominance);  ///< "unknown", "right", "left", "balanced"

struct VesselLabel {
  std::int32_t vessel = 0;  ///< its id in the tree
  CoronarySide side = CoronarySide::left;
  /// "LAD" (with the left main), "LCX", "RI", "D1", "S1", "OM1", "RCA" (with the posterolateral branch it
  /// goes on to), "CB", "AM", "PDA", "PLB": what analysis::segments_of cuts into the standard segments. What
  /// the geometry says even where it was not sure enough for a name; empty for a branch that fits none.
  std::string likeliest;
  double confidence = 0.0;  ///< [0, 1]; a rank, not a measured frequency
};

struct LabelledTree {
  /// The nodes and segments that were given. A vessel for each end of the tree, parents first: the first
  /// vessel that passes through a segment owns it. Names are each used once; what is not sure is "V1", "V2",
  /// ....
  geometry::VesselTree tree;
  std::vector<VesselLabel> labels;  ///< one a vessel, in the tree's order
  CoronaryDominance dominance = CoronaryDominance::unknown;
  Vec3 long_axis = Vec3::Zero();      ///< unit, that was used
  std::vector<std::string> warnings;  ///< in plain words
};

/// Names by course: which side of the ostia the first centimetres run to, how far a path follows the groove
/// between atria and ventricles, how far towards the apex it ends, and at which angle about the heart's long
/// axis. The axis is first the usual one of a patient who lies on the back, then the normal of the ring that
/// right coronary and circumflex artery form. Vessels of the tree that was given keep their ids where they
/// reach the same end; others get new ones. Deterministic. Throws InvalidInput for options out of range or a
/// tree that is not sound (geometry::find_fault) or has no segments.
LabelledTree label_branches(const geometry::VesselTree& tree, const LabelOptions& options = {});

}  // namespace ostia::coronary
