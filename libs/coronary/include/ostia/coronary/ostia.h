#pragma once
/// \file Where the coronary arteries leave the aorta.

#include "ostia/coronary/aorta.h"

#include <vector>

namespace ostia::coronary {

/// docs/methods/coronary-aorta.md gives the method and where the defaults come from.
struct OstiaOptions {
  double upwards_mm = 60.0;           ///< of aorta that is searched from its lower end, [10, 120]
  double wall_hu = 60.0;              ///< usual intensity of vessels' walls and muscle, [-100, 150]
  double level = 0.5;                 ///< share of the contrast above that, which an artery has, [0.3, 0.8]
  double smallest_radius_mm = 0.7;    ///< of an artery's section at the wall, [0.3, 2]
  double largest_radius_mm = 4.0;     ///< (smallest, 8]
  double least_reach_mm = 10.0;       ///< how far from the wall contrast has to go on, [3, 30]
  double largest_section_mm2 = 45.0;  ///< mean section of what goes on, [5, 200]
};
void validate(const OstiaOptions& options);  ///< throws InvalidInput

struct Ostium {
  Vec3 place = Vec3::Zero();       ///< on the aorta's wall, mm
  Vec3 direction = Vec3::UnitX();  ///< unit, out of the aorta, towards what goes on
  double radius_mm = 0.0;          ///< of a circle as large as its section at the wall
  double hu = 0.0;                 ///< mean there
  double height_mm = 0.0;          ///< above the lower end of the aorta that was found
  double reach_mm = 0.0;           ///< farthest place from it that was looked at, at most 20
  double section_mm2 = 0.0;        ///< mean section of what goes on: its volume over its reach
  double beyond_mm = 0.0;          ///< without lumen between the aorta and it; 0: it lies on the aorta's wall
};

/// The wall of root and ascending aorta is unrolled, and small bright spots just outside it are arteries that
/// pass, where contrast goes on from them as a thin tube. Lowest section first (the likeliest tube).
/// Deterministic. Throws InvalidInput for options out of range or an aorta of fewer than three stations,
/// Cancelled.
std::vector<Ostium> find_ostia(const imaging::ImageVolume& image, const Aorta& aorta,
                               const OstiaOptions& options = {},
                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::coronary
