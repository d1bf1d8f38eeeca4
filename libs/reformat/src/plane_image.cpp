#include "ostia/reformat/plane_image.h"

#include "slab_rows.h"

#include "ostia/core/error.h"

#include <string>

namespace ostia::reformat {
namespace {

constexpr double thickest_slab_mm = 100.0;

template <class T>
PlaneImage sliced(const imaging::Volume<T>& image, const Plane& plane, const SlabShape& shape,
                  imaging::Interpolation how, const core::TaskContext& task) {
  validate(plane);
  require_voxels(image, "slice");
  if (shape.slab != Slab::none && !(shape.thickness_mm > 0.0 && shape.thickness_mm <= thickest_slab_mm)) {
    throw InvalidInput("a slab of " + std::to_string(shape.thickness_mm) +
                       " mm cannot be pictured; give more than 0 and at most " +
                       std::to_string(thickest_slab_mm) + " mm, or no slab");
  }
  const auto row_of = [&](std::size_t j) {
    return StraightRow{world(plane, Vec2(0.5, static_cast<double>(j) + 0.5)), plane.pixel_mm * plane.u,
                       plane.normal()};
  };
  return {plane, sampled_rows(image, static_cast<std::size_t>(plane.width),
                              static_cast<std::size_t>(plane.height), row_of, shape, how, task)};
}

}  // namespace

PlaneImage slice(const imaging::ImageVolume& image, const Plane& plane, imaging::Interpolation how,
                 const core::TaskContext& task) {
  return sliced(image, plane, {}, how, task);
}

PlaneImage slice(const imaging::MaskVolume& image, const Plane& plane, imaging::Interpolation how,
                 const core::TaskContext& task) {
  return sliced(image, plane, {}, how, task);
}

PlaneImage slice(const imaging::FloatVolume& image, const Plane& plane, imaging::Interpolation how,
                 const core::TaskContext& task) {
  return sliced(image, plane, {}, how, task);
}

PlaneImage slab_slice(const imaging::ImageVolume& image, const Plane& plane, Slab slab, double slab_mm,
                      imaging::Interpolation how, const core::TaskContext& task) {
  return sliced(image, plane, {slab, slab_mm}, how, task);
}

PlaneImage slab_slice(const imaging::FloatVolume& image, const Plane& plane, Slab slab, double slab_mm,
                      imaging::Interpolation how, const core::TaskContext& task) {
  return sliced(image, plane, {slab, slab_mm}, how, task);
}

}  // namespace ostia::reformat
