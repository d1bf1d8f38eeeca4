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
  /// goes on to), "CB", "AM", "PDA", "PLB": what analysis::segments_of cuts into the standard segments; "SVG"
  /// for a graft from the ascending aorta. What the geometry says even where it was not sure enough for a
  /// name; empty for a branch that fits none.
  std::string likeliest;
  double confidence = 0.0;         ///< probability that it is, [0, 1]; calibrated on synthetic hearts
  std::string second;              ///< what else it may be; empty where nothing else comes near
  double second_confidence = 0.0;  ///< probability of that, [0, 1]
  bool given = false;              ///< whether the tree has `likeliest` as the vessel's name
};

/// How the arteries lie: a mirrored or turned image has those of another heart.
struct HeartLie {
  std::string word = "as given";  ///< or "mirrored left to right", "turned head to foot", ...
  double probability = 1.0;       ///< of that one, [0, 1]
  bool as_given = true;
};

struct LabelledTree {
  /// The nodes and segments that were given. A vessel for each end of the tree, parents first: the first
  /// vessel that passes through a segment owns it. Names are each used once; what is not sure is "V1", "V2",
  /// .... All are where the arteries lie otherwise than they were given.
  geometry::VesselTree tree;
  std::vector<VesselLabel> labels;  ///< one a vessel, in the tree's order
  CoronaryDominance dominance = CoronaryDominance::unknown;
  Vec3 long_axis = Vec3::Zero();      ///< unit, that was used
  HeartLie lie;                       ///< the likeliest; `labels` are those of a heart that lies so
  std::vector<std::string> warnings;  ///< in plain words
};

/// Names by course: which side of the ostia the first centimetres run to, how far a path follows the groove
/// between atria and ventricles, how far towards the apex it ends, and at which angle about the heart's long
/// axis. The axis is first the usual one of a patient who lies on the back, then the normal of the ring that
/// right coronary and circumflex artery form. All eight ways in which an image's axes may run are tried.
/// Vessels of the tree that was given keep their ids where they reach the same end; others get new ones.
/// Deterministic. Throws InvalidInput for options out of range or a tree that is not sound
/// (geometry::find_fault) or has no segments.
LabelledTree label_branches(const geometry::VesselTree& tree, const LabelOptions& options = {});

}  // namespace ostia::coronary
