#pragma once
/// \file How likely it is that what was found is a coronary artery: of each vessel, and of each centimetre.

#include "ostia/coronary/aorta.h"
#include "ostia/geometry/vessel_tree.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace ostia::coronary {

/// What a piece of a vessel looks like, in numbers without units; docs/methods/certainty.md says each.
inline constexpr std::array<std::string_view, 13> piece_looks{
    "brightness", "darkest", "edges",  "fat",      "unevenness", "noise", "size",
    "bend",       "way",     "to end", "upstream", "wider",      "length"};
inline constexpr std::array<std::string_view, 3> vessel_looks{"mean", "lowest", "length"};

/// A piece of a vessel's own part, about a centimetre long.
struct VesselPiece {
  double from_mm = 0.0, to_mm = 0.0;  ///< on the vessel's axis
  Vec3 place = Vec3::Zero();          ///< half-way on it, LPS, mm
  std::array<double, piece_looks.size()> looks{};
  double probability = 0.0;  ///< [0, 1]: that four fifths of it lie within the lumen of coronary arteries
};

struct VesselCertainty {
  std::int32_t vessel = 0;          ///< its id in the tree
  std::vector<VesselPiece> pieces;  ///< of what it does not share with a vessel before it, proximal first
  std::array<double, vessel_looks.size()> looks{};
  double probability = 0.0;  ///< the same of all of them together; 1 without any
};

/// One a vessel, in the tree's order. What the image shows along the axes is weighed by a logistic model,
/// fitted to phantoms (`ostia experiment certainty`). `tree`: sound, with parents before their branches and
/// radii, as label_branches gives it. Deterministic. Throws InvalidInput for an empty image.
std::vector<VesselCertainty> certainty_of(const imaging::ImageVolume& image, const geometry::VesselTree& tree,
                                          const Aorta& aorta);

/// Of the piece that a place of a vessel lies in, on the shared way that of the vessel before it; NaN where
/// nothing is known.
double probability_at(const std::vector<VesselCertainty>& certainty, const geometry::VesselTree& tree,
                      std::int32_t vessel, double s_mm);

/// The looks of a vessel whose pieces have these logits, bounded to +-6: surer than that nothing is.
std::array<double, vessel_looks.size()> looks_of_vessel(const std::vector<VesselPiece>& pieces,
                                                        const std::vector<double>& logits);

}  // namespace ostia::coronary
