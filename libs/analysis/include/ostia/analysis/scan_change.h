#pragma once
/// \file What changed between two scans of one patient (docs/methods/compare.md).

#include "ostia/analysis/aha_segments.h"
#include "ostia/analysis/lesions.h"
#include "ostia/analysis/lumen_profile.h"
#include "ostia/analysis/plaque.h"
#include "ostia/analysis/repeatability.h"
#include "ostia/analysis/stenosis.h"
#include "ostia/analysis/tree_match.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::analysis {

/// A vessel of one scan as it was measured.
struct ScannedVessel {
  std::int32_t vessel = 0;
  std::string name;
  double own_from_mm = 0.0;
  LumenProfile profile;
  ReferenceLine reference;
  std::optional<PlaqueProfile> plaque = {};  ///< nothing: no image, or no outer wall was found
  std::optional<double> fat_hu = {};         ///< of RCA, LAD, LCX, where it was measured
};
struct ScannedLesion {
  std::string label;  ///< "S1"
  Stenosis stenosis;
  bool narrows = true;
};
/// A checked tree with its measures.
struct ScannedTree {
  geometry::VesselTree tree;
  std::vector<ScannedVessel> vessels;   ///< in the tree's order
  std::vector<ScannedLesion> lesions;   ///< each at the vessel that owns its throat
  std::vector<VesselSegment> segments;  ///< segments_of
};

/// All measures of a stretch, in the order of change_measures.
using StretchChange = std::array<Difference, change_measure_count>;
const Difference& of(const StretchChange& change, ChangeMeasure measure);

/// A stretch of a vessel of one scan.
struct PlacedStretch {
  std::int32_t vessel = 0;
  double from_mm = 0.0, to_mm = 0.0;
};

enum class LesionFate {
  both,           ///< it is in both scans
  appeared,       ///< the former scan shows its place, and no lesion there
  gone,           ///< the later scan shows its place, and no lesion there
  before_unseen,  ///< of the later scan alone: the former tree does not reach it
  after_unseen,   ///< of the former scan alone: the later tree does not reach it
};
std::string to_string(LesionFate fate);  ///< "both", "new", "gone", "not reached before", "not reached now"

struct LesionChange {
  LesionFate fate = LesionFate::both;
  /// Indices of ScannedTree::lesions. Where one scan has two lesions in the stretch of one, all of them.
  std::vector<std::size_t> before, after;
  std::string vessel_name, segment;  ///< the former's, else the later's
  /// What was measured in both: from the first to the last place of all its lesions. Nothing on a side that
  /// does not reach it.
  std::optional<PlacedStretch> before_stretch, after_stretch;
  StretchChange change;
};

/// A standard segment, or a vessel's own part, of the former scan where both reach it.
struct PlacedChange {
  std::string label;  ///< "pLAD (6)", the vessel's name
  std::int32_t before_vessel = 0;
  double covered_share = 0.0;  ///< of the stretch; the measures are of that part
  PlacedStretch before_stretch, after_stretch;
  StretchChange change;
};

struct ScanChange {
  TreeMatch match;
  std::vector<LesionChange> lesions;   ///< by the former's order, then what appeared
  std::vector<PlacedChange> segments;  ///< those of which at least half is in both
  std::vector<PlacedChange> vessels;   ///< likewise
  StretchChange patient;               ///< plaque and burden of all `vessels` together
  std::vector<std::string> unmatched;  ///< what is not compared and why, a sentence each
};

struct ScanChangeOptions {
  TreeMatchOptions match;
  Repeatability repeatability = phantom_repeatability();
  double least_covered = 0.5;  ///< of a segment or vessel, to be compared, (0, 1]
};
void validate(const ScanChangeOptions& options);  ///< throws InvalidInput

/// Both scans are measured over the same tissue: a lesion's stretch (of all that overlap it), a segment of
/// the former scan, are carried along the matched axes, and what one scan does not reach is left out of
/// both. `map`: from the former scan to the later. Throws InvalidInput for bad options, a map that is not
/// finite, and trees without their vessels' measures.
ScanChange compare_scans(const ScannedTree& before, const ScannedTree& after, const PointMap& map,
                         const ScanChangeOptions& options = {});

}  // namespace ostia::analysis
