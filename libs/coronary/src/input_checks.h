#pragma once
/// \file What an image must be like before coronary arteries are looked for in it
/// (docs/methods/coronary-input.md has the table).

#include "ostia/imaging/volume.h"

#include <string>
#include <vector>

namespace ostia::coronary {

/// How an image's intensities are distributed, from some 400,000 voxels spread evenly.
struct Intensities {
  double lowest = 0.0, highest = 0.0;
  double dark = 0.0, median = 0.0, bright = 0.0;  ///< 0.5, 50 and 99.5 percent are below
  double below_air = 0.0;  ///< share below -1150 HU that is not the lowest value (which may be padding)
  double lung = 0.0;       ///< share from -940 to -400 HU
  double metal_ml = 0.0;   ///< above 2500 HU
  /// Lung's share of the middle third from front to back, over that of the middle third from side to side. A
  /// chest has 2 to 3: its lungs lie at the sides.
  double lung_at_sides = 0.0;
  double kinship = 0.0;  ///< correlation of places 3 mm apart along each axis; 1 where all are equal
};
Intensities intensities_of(const imaging::ImageVolume& image);

/// Throws InvalidInput for an image of too few or too coarse voxels, or too small a field.
void require_grid(const imaging::Geometry& grid);
/// Throws InvalidInput where the values cannot be a CT's in HU: all the same, scaled, shifted, noise alone,
/// lungs too bright.
void require_ct_numbers(const Intensities& values);
/// Throws GeometryError where a field as wide as a chest holds no lung.
void require_chest(const Intensities& values, const imaging::Geometry& grid);

struct InputNotes {
  std::vector<std::string>
      warnings;         ///< what a person should know all the same: coarse voxels, metal, turned
  bool turned = false;  ///< about the body's length, or x and y exchanged: names are not to be trusted
};
/// All of these.
InputNotes check_input(const imaging::ImageVolume& image);

}  // namespace ostia::coronary
