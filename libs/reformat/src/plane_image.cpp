#include "ostia/reformat/plane_image.h"

#include "slab_rows.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace ostia::reformat {
namespace {

constexpr double thickest_slab_mm = 100.0;
constexpr int draft_pixels = 2;  // a coarse pixel's side
constexpr double draft_layer_spacings = 1.0;

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

/// Linear between coarse pixels along one direction: the one before, and how far on.
struct Between {
  std::size_t before, after;
  float share;
};
std::vector<Between> between_coarse(int fine, int coarse) {
  std::vector<Between> out;
  for (int i = 0; i < fine; ++i) {
    const double at = std::clamp((i + 0.5) / draft_pixels - 0.5, 0.0, coarse - 1.0);
    const auto before = static_cast<std::size_t>(at);
    out.push_back({before, std::min(before + 1, static_cast<std::size_t>(coarse) - 1),
                   static_cast<float>(at - static_cast<double>(before))});
  }
  return out;
}

/// Beside what lies outside the image the nearer one counts alone.
inline float mixed_or_nearer(float a, float b, float share) {
  const float mixed = a + share * (b - a);
  return std::isnan(mixed) ? (share < 0.5F ? a : b) : mixed;
}

std::vector<float> spread_out(const PlaneImage& coarse, const Plane& plane) {
  const std::vector<Between> across = between_coarse(plane.width, coarse.plane.width),
                             down = between_coarse(plane.height, coarse.plane.height);
  const auto wide = static_cast<std::size_t>(coarse.plane.width);
  std::vector<float> values(across.size() * down.size());
  core::parallel_chunks(down.size(), 32, [&](std::size_t first, std::size_t last) {
    std::vector<float> row(wide);
    for (std::size_t j = first; j < last; ++j) {
      const float* above = coarse.values.data() + down[j].before * wide;
      const float* below = coarse.values.data() + down[j].after * wide;
      for (std::size_t i = 0; i < wide; ++i) row[i] = mixed_or_nearer(above[i], below[i], down[j].share);
      float* out = values.data() + j * across.size();
      for (std::size_t i = 0; i < across.size(); ++i)
        out[i] = mixed_or_nearer(row[across[i].before], row[across[i].after], across[i].share);
    }
  });
  return values;
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

PlaneImage slab_draft(const imaging::ImageVolume& image, const Plane& plane, Slab slab, double slab_mm,
                      const core::TaskContext& task) {
  validate(plane);
  Plane coarse = plane;
  coarse.pixel_mm = draft_pixels * plane.pixel_mm;
  coarse.width = (plane.width + draft_pixels - 1) / draft_pixels;
  coarse.height = (plane.height + draft_pixels - 1) / draft_pixels;
  const PlaneImage made =
      sliced(image, coarse, {slab, slab_mm, draft_layer_spacings}, imaging::Interpolation::trilinear, task);
  return {plane, spread_out(made, plane)};
}

}  // namespace ostia::reformat
