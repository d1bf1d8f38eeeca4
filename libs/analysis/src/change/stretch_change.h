#pragma once
/// \file Measures of the same stretch of a vessel in two scans.

#include "ostia/analysis/scan_change.h"

#include <functional>
#include <optional>

namespace ostia::analysis {

using PlaceToOther = std::function<std::optional<double>(double s_mm)>;

/// One side of a stretch: where it was measured, and how its places are found on the other side.
struct StretchSide {
  const ScannedVessel* vessel = nullptr;
  double from_mm = 0.0, to_mm = 0.0;
  PlaceToOther to_other;
};
struct StretchPair {
  StretchSide before, after;
};

/// What a stretch is narrowest by, and what its stenosis is told from.
struct StretchMeasures {
  std::optional<double> least_diameter_mm, least_area_mm2, stenosis_percent;
};
/// Of sections that say something in both scans: within a radius of a vessel's ends, and between a joint and
/// its ostium, a wall is no calibre.
StretchMeasures lumen_measures(const StretchSide& side, const ScannedVessel& other);

/// Volumes of the part whose outer wall both scans know; nothing where that is less than half of it.
struct PlaquePair {
  PlaqueVolumes before, after;
};
std::optional<PlaquePair> plaque_of_both(const StretchPair& pair);

/// MLD, MLA, stenosis, plaque and burden; the others are left open.
StretchChange measured_change(const StretchPair& pair, ChangeScope scope, const Repeatability& repeatability);
/// Plaque and burden of volumes.
void set_plaque(StretchChange& change, const PlaquePair& plaque, ChangeScope scope,
                const Repeatability& repeatability);

}  // namespace ostia::analysis
