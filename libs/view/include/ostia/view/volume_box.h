#pragma once
/// \file The box that is left of a volume in 3D, as something that a hand can take hold of.

#include "ostia/view/volume_cuts.h"

#include <array>
#include <cstddef>
#include <vector>

namespace ostia::view {

/// One side of the box that a VolumeCrop leaves of an image.
struct BoxFace {
  std::size_t axis = 0;          ///< of VolumeCrop: 0 right to left, 1 front to back, 2 feet to head
  bool high = false;             ///< the side at `high` of it, not that at `low`
  Vec3 middle = Vec3::Zero();    ///< LPS, mm
  Vec3 towards = Vec3::UnitX();  ///< unit, the way in which the share of this axis rises
  double whole_mm = 1.0;         ///< from share 0 to share 1
};
/// Low and high side of the three axes, in this order. Throws InvalidInput as `validate` of a crop does.
std::array<BoxFace, 6> faces_of(const VolumeCrop& crop, const imaging::Geometry& grid);
/// Its twelve edges, LPS, mm. Throws InvalidInput.
std::vector<std::array<Vec3, 2>> edges_of(const VolumeCrop& crop, const imaging::Geometry& grid);
/// The box with one side moved by so many mm along `towards`, as far as the image and the other side let it:
/// 1 % of the image stays between them. Throws InvalidInput for a crop that is none.
VolumeCrop with_face_moved(const VolumeCrop& crop, const BoxFace& face, double by_mm);
/// The same box in the patient, as shares of another grid: sides that cut nothing off stay at its ends, those
/// beyond it come to its ends; whole where nothing would be left. Throws InvalidInput for a crop that is
/// none.
VolumeCrop carried(const VolumeCrop& crop, const imaging::Geometry& from, const imaging::Geometry& to);

}  // namespace ostia::view
