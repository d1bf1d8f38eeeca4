#pragma once
/// \file The layers of voxels about a moving surface.

#include "ostia/imaging/volume.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::segmentation::detail {

/// A sparse field (Whitaker, Int. J. Comput. Vis. 29:203-231, 1998): the active layer holds every voxel with
/// a neighbour across the surface; two layers on either side carry the distance onwards, as the differences
/// need them. Unlike in the original the layers get their values from the eikonal equation in the grid's
/// spacing rather than by adding one.
class SparseField {
 public:
  explicit SparseField(const imaging::FloatVolume& initial);

  const imaging::Geometry& geometry() const { return geometry_; }
  const std::vector<std::int64_t>& active() const { return layers_[0]; }
  const float* values() const { return values_.data(); }
  float value(std::int64_t n) const { return values_[static_cast<std::size_t>(n)]; }
  const std::array<std::int64_t, 3>& strides() const { return strides_; }
  double far_mm() const { return far_; }

  /// These voxels, inside now, stay at least some tenths of a voxel inside from now on.
  void hold_inside(std::vector<std::int64_t> voxels);
  /// Values of the active layer plus these changes; then the layers about the surface are made anew.
  void advance(const std::vector<float>& changes);
  imaging::FloatVolume take() &&;

 private:
  enum Mark : std::uint8_t { kFar = 0, kBorder = 255 };  // 1, 2, 3: active, first, second layer

  bool is_active(std::int64_t n) const;
  void restrain();
  void start(const imaging::FloatVolume& initial);
  float distance_from(std::int64_t n, const std::vector<std::uint8_t>& marks, std::uint8_t known) const;
  void grow_layers();

  imaging::Geometry geometry_;
  std::array<std::int64_t, 3> strides_{};
  std::array<double, 3> inverse_spacing_{};
  double far_ = 0.0;
  std::vector<float> values_;
  std::vector<std::uint8_t> marks_;
  std::array<std::vector<std::int64_t>, 3> layers_;
  std::vector<std::int64_t> held_;
};

}  // namespace ostia::segmentation::detail
