#include "ostia/imaging/volume.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <string>

namespace ostia::imaging {

bool Geometry::contains(const Vec3& world_mm) const {
  const Vec3 at = index(world_mm);
  for (int axis = 0; axis < 3; ++axis)
    if (!(at[axis] >= -0.5 && at[axis] <= static_cast<double>(size[axis]) - 0.5)) return false;
  return true;
}

bool same_grid(const Geometry& a, const Geometry& b, double tolerance_mm) {
  if (a.size != b.size) return false;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = ((corner >> axis) & 1) ? static_cast<double>(a.size[axis] - 1) : 0.0;
    if (!((a.world(at) - b.world(at)).norm() <= tolerance_mm)) return false;
  }
  return true;
}

template <class T>
Volume<T> cropped(const Volume<T>& image, const Region& region) {
  const Geometry& from = image.geometry;
  Volume<T> result;
  result.geometry = from;
  for (int axis = 0; axis < 3; ++axis) {
    if (region.lower[axis] < 0 || region.upper[axis] > from.size[axis] ||
        region.lower[axis] >= region.upper[axis])
      throw InvalidInput("crop: the region [" + std::to_string(region.lower[axis]) + ", " +
                         std::to_string(region.upper[axis]) + ") of axis " + std::to_string(axis) +
                         " is empty or not within the image's " + std::to_string(from.size[axis]) +
                         " voxels");
    result.geometry.size[axis] = region.upper[axis] - region.lower[axis];
  }
  result.geometry.origin =
      from.world(Vec3(static_cast<double>(region.lower[0]), static_cast<double>(region.lower[1]),
                      static_cast<double>(region.lower[2])));
  result.voxels.resize(static_cast<std::size_t>(result.geometry.voxels()));
  auto out = result.voxels.begin();
  for (std::int64_t k = region.lower[2]; k < region.upper[2]; ++k)
    for (std::int64_t j = region.lower[1]; j < region.upper[1]; ++j)
      out = std::copy_n(image.voxels.begin() + from.offset(region.lower[0], j, k), result.geometry.size[0],
                        out);
  return result;
}
template ImageVolume cropped(const ImageVolume&, const Region&);
template MaskVolume cropped(const MaskVolume&, const Region&);
template FloatVolume cropped(const FloatVolume&, const Region&);

}  // namespace ostia::imaging
