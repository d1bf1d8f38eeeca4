#pragma once
/// \file Where the heart lies in a scan without contrast agent, and what of it is where.

#include "ostia/analysis/calcium_score.h"

#include <optional>

namespace ostia::analysis {

/// The heart's bulk: chambers and muscle, without the great vessels, which are thinner.
struct HeartBulk {
  Vec3 centre = Vec3::Zero();  ///< LPS, mm
  double radius_mm = 0.0;      ///< of the ball with its volume
  imaging::MaskVolume mask;    ///< on a grid of some 4 mm
  double bright_hu = 0.0;      ///< a fifth of it is brighter: blood with contrast agent is
  /// In radii from the centre.
  Vec3 place(const Vec3& world_mm) const { return (world_mm - centre) / radius_mm; }
};
/// The thickest part of what is neither lung nor fat. Nothing where it is too small or too large for a heart.
std::optional<HeartBulk> heart_bulk(const imaging::FloatVolume& image, const core::TaskContext& task);

/// What lies at a place, by the courses of usual arteries, valves and aorta about the heart's bulk; how sure.
struct PlaceGuess {
  CalciumPlace place = CalciumPlace::other;
  double confidence = 0.0;
};
PlaceGuess guess_place(const Vec3& place_in_radii);

}  // namespace ostia::analysis
