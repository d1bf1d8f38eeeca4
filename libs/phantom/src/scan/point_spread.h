#pragma once
/// \file Weights of the point-spread function over the samples of a voxel, along one axis.

#include <cstddef>
#include <vector>

namespace ostia::phantom {

/// A point-spread function along one axis of the grid, for voxels that are cut into `parts` equal pieces.
/// Voxel n pieces away at offset d (-reach..reach) gives its piece p the weight `piece(d, p)`; all weights
/// together are 1, so that a uniform object keeps its value.
class AxisSpread {
 public:
  /// A Gaussian of `fwhm_mm` as the finished image shows it: the box of a piece is part of it. 0: the voxel's
  /// own box.
  AxisSpread(double fwhm_mm, double spacing_mm, int parts);
  int reach() const { return reach_; }
  int parts() const { return parts_; }
  float piece(int offset, int part) const {
    return pieces_[static_cast<std::size_t>((offset + reach_) * parts_ + part)];
  }
  float voxel(int offset) const { return voxels_[static_cast<std::size_t>(offset + reach_)]; }

 private:
  int reach_ = 0, parts_ = 1;
  std::vector<float> pieces_, voxels_;
};

constexpr double fwhm_per_sigma = 2.3548200450309493;

/// A slice with room around it for the reach of filters, rows `stride` apart.
struct SliceView {
  float* data = nullptr;
  std::ptrdiff_t width = 0, height = 0, stride = 0;
  float* row(std::ptrdiff_t j) const { return data + j * stride; }
};

/// A voxel in pieces: what they differ from their mean by, x fastest.
struct Pieces {
  std::ptrdiff_t i = 0, j = 0;  ///< of the voxel
  const float* difference = nullptr;
};

/// The point-spread function of a whole grid.
class PointSpread {
 public:
  PointSpread(AxisSpread x, AxisSpread y, AxisSpread z);
  int reach(int axis) const { return axis == 0 ? x_.reach() : axis == 1 ? y_.reach() : z_.reach(); }
  const AxisSpread& z() const { return z_; }

  /// Blurs the slice of voxel means within itself, in place; beyond the border the border's value.
  void blur_in_plane(const SliceView& slice) const;
  /// Adds to a slice what a voxel's pieces, in the slice `offset` further on, change in it. There must be
  /// memory for `reach` values around the voxel and 8 more behind.
  void add_pieces(const Pieces& voxel, int offset, const SliceView& slice) const;

 private:
  AxisSpread x_, y_, z_;
  int lanes_ = 8;                 ///< 2 * reach + 1 along x, rounded up to whole groups of 8
  std::vector<float> x_lanes_;    ///< [part][lane]: weight of a piece in the output `lane - reach`
  std::vector<float> y_weights_;  ///< [output][part]
};

}  // namespace ostia::phantom
