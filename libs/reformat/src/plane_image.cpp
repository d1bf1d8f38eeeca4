#include "ostia/reformat/plane_image.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <limits>

namespace ostia::reformat {
namespace {

template <class T>
PlaneImage sliced(const imaging::Volume<T>& image, const Plane& plane, imaging::Interpolation how,
                  const core::TaskContext& task) {
  validate(plane);
  if (image.voxels.empty() || static_cast<std::int64_t>(image.voxels.size()) != image.geometry.voxels()) {
    throw InvalidInput("cannot slice an image of " + std::to_string(image.voxels.size()) +
                       " voxels whose size says " + std::to_string(image.geometry.voxels()));
  }
  PlaneImage result{plane, {}};
  const auto width = static_cast<std::size_t>(plane.width);
  const auto height = static_cast<std::size_t>(plane.height);
  result.values.assign(width * height, std::numeric_limits<float>::quiet_NaN());
  core::parallel_for(height, 8, [&](std::size_t row) {
    task.throw_if_cancelled();
    for (std::size_t column = 0; column < width; ++column) {
      const Vec3 point =
          world(plane, Vec2(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5));
      if (!image.geometry.contains(point)) continue;
      result.values[row * width + column] = static_cast<float>(imaging::sample(image, point, how));
    }
  });
  return result;
}

}  // namespace

PlaneImage slice(const imaging::ImageVolume& image, const Plane& plane, imaging::Interpolation how,
                 const core::TaskContext& task) {
  return sliced(image, plane, how, task);
}

PlaneImage slice(const imaging::MaskVolume& image, const Plane& plane, imaging::Interpolation how,
                 const core::TaskContext& task) {
  return sliced(image, plane, how, task);
}

PlaneImage slice(const imaging::FloatVolume& image, const Plane& plane, imaging::Interpolation how,
                 const core::TaskContext& task) {
  return sliced(image, plane, how, task);
}

}  // namespace ostia::reformat
