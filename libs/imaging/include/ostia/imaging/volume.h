#pragma once
/// \file Images in world space.

#include "ostia/geometry/vec.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::imaging {

using geometry::Mat3;
using geometry::Vec3;

/// Where voxels lie: centre of voxel (i, j, k) = origin + direction * (spacing .* (i, j, k)), LPS, mm.
struct Geometry {
  std::array<std::int64_t, 3> size{0, 0, 0};
  Vec3 spacing = Vec3::Ones();        ///< mm, > 0
  Vec3 origin = Vec3::Zero();         ///< centre of voxel (0, 0, 0)
  Mat3 direction = Mat3::Identity();  ///< orthonormal, right-handed; columns are the axes

  std::int64_t voxels() const { return size[0] * size[1] * size[2]; }
  Vec3 world(const Vec3& index) const { return origin + direction * spacing.cwiseProduct(index); }
  Vec3 index(const Vec3& world_mm) const {
    return (direction.transpose() * (world_mm - origin)).cwiseQuotient(spacing);
  }
  std::int64_t offset(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return i + size[0] * (j + size[1] * k);
  }
  /// Inside the hull of the voxel centres, give or take half a voxel.
  bool contains(const Vec3& world_mm) const;
};
/// Same size, and no corner voxel's centre further apart than `tolerance_mm`.
bool same_grid(const Geometry& a, const Geometry& b, double tolerance_mm = 1e-3);

/// A scalar image, x fastest. Immutable once shared.
template <class T>
struct Volume {
  Geometry geometry;
  std::vector<T> voxels;
  T operator()(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return voxels[geometry.offset(i, j, k)];
  }
  T& operator()(std::int64_t i, std::int64_t j, std::int64_t k) { return voxels[geometry.offset(i, j, k)]; }
};
using ImageVolume = Volume<std::int16_t>;  ///< CT, in HU
using MaskVolume = Volume<std::uint8_t>;   ///< 0 outside
using FloatVolume = Volume<float>;

/// A box of voxels [lower, upper).
struct Region {
  std::array<std::int64_t, 3> lower{0, 0, 0}, upper{0, 0, 0};
};
/// Throws InvalidInput when the region is empty or reaches beyond the image.
template <class T>
Volume<T> cropped(const Volume<T>& image, const Region& region);
extern template ImageVolume cropped(const ImageVolume&, const Region&);
extern template MaskVolume cropped(const MaskVolume&, const Region&);
extern template FloatVolume cropped(const FloatVolume&, const Region&);

}  // namespace ostia::imaging
