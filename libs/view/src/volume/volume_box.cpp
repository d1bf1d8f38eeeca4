#include "ostia/view/volume_box.h"

#include <algorithm>

namespace ostia::view {
namespace {

constexpr double least_box_share = 0.01;

}  // namespace

std::array<BoxFace, 6> faces_of(const VolumeCrop& crop, const imaging::Geometry& grid) {
  const IndexBox box = index_box(crop, grid);
  const Vec3 middle = 0.5 * (box.low + box.high);
  const std::array<Eigen::Index, 3> patient_axis = patient_axes(grid);
  std::array<BoxFace, 6> faces;
  for (Eigen::Index image_axis = 0; image_axis < 3; ++image_axis) {
    const auto axis = static_cast<std::size_t>(patient_axis[static_cast<std::size_t>(image_axis)]);
    const bool backwards = grid.direction(static_cast<Eigen::Index>(axis), image_axis) < 0.0;
    for (const bool high : {false, true}) {
      Vec3 at = middle;
      at[image_axis] = high != backwards ? box.high[image_axis] : box.low[image_axis];
      BoxFace& face = faces[2 * axis + (high ? 1 : 0)];
      face = {axis, high, grid.world(at), (backwards ? -1.0 : 1.0) * grid.direction.col(image_axis),
              grid.spacing[image_axis] *
                  static_cast<double>(grid.size[static_cast<std::size_t>(image_axis)] - 1)};
    }
  }
  return faces;
}

std::vector<std::array<Vec3, 2>> edges_of(const VolumeCrop& crop, const imaging::Geometry& grid) {
  const IndexBox box = index_box(crop, grid);
  const auto corner = [&](int which) {
    Vec3 at;
    for (int a = 0; a < 3; ++a) at[a] = (which >> a & 1) != 0 ? box.high[a] : box.low[a];
    return grid.world(at);
  };
  std::vector<std::array<Vec3, 2>> edges;
  for (int which = 0; which < 8; ++which)
    for (int a = 0; a < 3; ++a)
      if ((which >> a & 1) == 0) edges.push_back({corner(which), corner(which | 1 << a)});
  return edges;
}

VolumeCrop with_face_moved(const VolumeCrop& crop, const BoxFace& face, double by_mm) {
  validate(crop);
  VolumeCrop moved = crop;
  double &low = moved.low.at(face.axis), &high = moved.high.at(face.axis);
  const double share = face.whole_mm > 0.0 ? by_mm / face.whole_mm : 0.0;
  if (face.high)
    high = std::clamp(high + share, std::min(1.0, low + least_box_share), 1.0);
  else
    low = std::clamp(low + share, 0.0, std::max(0.0, high - least_box_share));
  return moved;
}

VolumeCrop carried(const VolumeCrop& crop, const imaging::Geometry& from, const imaging::Geometry& to) {
  validate(crop);
  const auto faces = faces_of(crop, from), ends = faces_of({}, to);
  VolumeCrop out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BoxFace& first = ends[2 * axis];
    const auto share_of = [&](const BoxFace& side) {
      if (!(first.whole_mm > 0.0)) return side.high ? 1.0 : 0.0;
      return std::clamp((side.middle - first.middle).dot(first.towards) / first.whole_mm, 0.0, 1.0);
    };
    if (crop.low[axis] > 0.0) out.low[axis] = share_of(faces[2 * axis]);
    if (crop.high[axis] < 1.0) out.high[axis] = share_of(faces[2 * axis + 1]);
    if (out.high[axis] - out.low[axis] >= least_box_share) continue;
    out.low[axis] = 0.0;
    out.high[axis] = 1.0;
  }
  return out;
}

}  // namespace ostia::view
