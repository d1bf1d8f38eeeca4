#pragma once
/// \file Which CT numbers of the volume are seen in 3D, and in which colours.

#include "ostia/figure/color.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <vector>

namespace ostia::view {

enum class VolumePreset {
  coronary,     ///< a closed heart: muscle dark red, contrast light, calcium white
  vessels,      ///< contrast alone: muscle is hardly there, so that vessels are seen through it
  soft_tissue,  ///< all but lung and fat
  bone,         ///< bone, calcium and dense contrast
};

/// A preset as it is, shifted and stretched. The same look shows the same of any scan: CT numbers are HU.
struct VolumeLook {
  VolumePreset preset = VolumePreset::vessels;
  double shift_hu = 0.0;  ///< of all its CT numbers, in [-2000, 2000]; above 0: less is seen
  double stretch = 1.0;   ///< of their distances from the preset's middle, in [0.2, 5]; above 1: softer
  bool operator==(const VolumeLook&) const = default;
};
void validate(const VolumeLook& look);  ///< throws InvalidInput

struct ColorAtHu {
  double hu = 0.0;
  figure::Color color;
};
struct OpacityAtHu {
  double hu = 0.0;
  double opacity = 0.0;  ///< of one millimetre, [0, 1]
};
/// Linear between its points, constant beyond them; HU rise.
struct VolumeTransfer {
  std::vector<ColorAtHu> colors;
  std::vector<OpacityAtHu> opacities;
};
VolumeTransfer transfer_of(const VolumeLook& look);  ///< throws InvalidInput as `validate` does
double opacity_at(const VolumeTransfer& transfer, double hu);
figure::Color color_at(const VolumeTransfer& transfer, double hu);

/// How many voxels are in each of `bins` equal steps of [low_hu, high_hu). Throws InvalidInput for no bins or
/// a range that is empty.
std::vector<std::int64_t> histogram(const imaging::ImageVolume& image, double low_hu, double high_hu,
                                    int bins);

}  // namespace ostia::view
