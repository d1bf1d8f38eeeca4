#pragma once
/// \file A slice in coarse squares, projected onto a turning detector and back: for errors that are made in
/// the projections.

#include "scan/point_spread.h"

#include "ostia/geometry/vec.h"

#include <functional>
#include <vector>

namespace ostia::phantom {

constexpr double water_per_mm = 0.0195;  ///< attenuation of water at 70 keV

/// A slice in squares of whole voxels, about `cell_mm` wide; values are means over the squares.
struct CoarseSlice {
  /// `value`: of a voxel's CT number.
  CoarseSlice(const SliceView& slice, const geometry::Vec3& spacing_mm, double cell_mm,
              const std::function<double(float)>& value);
  /// Adds `scale` times the values to a slice, linearly between the squares' centres.
  void add_to(const SliceView& slice, double scale) const;

  std::ptrdiff_t width = 0, height = 0, step_x = 1, step_y = 1;
  double cell_mm_x = 1.0, cell_mm_y = 1.0;
  std::vector<double> values;
};

/// The detector of parallel rays that holds a coarse slice, at one angle after another.
class SliceDetector {
 public:
  explicit SliceDetector(const CoarseSlice& slice);
  void turn_to(double angle);
  /// Line integrals (values times mm), bin by bin.
  std::vector<double> projection(const CoarseSlice& slice) const;
  /// The filter of back-projection in space (Ramachandran and Lakshminarayanan 1971).
  std::vector<double> ramp_filtered(const std::vector<double>& projection) const;
  /// Adds the view to every square that it crosses, as one of so many over half a turn.
  void back_project(const std::vector<double>& view, int views, CoarseSlice& slice) const;

 private:
  double bin(const CoarseSlice& slice, std::ptrdiff_t i, std::ptrdiff_t j) const;
  double cos_ = 1.0, sin_ = 0.0, bin_mm_ = 1.0, middle_ = 0.0;
  std::size_t bins_ = 0;
};

}  // namespace ostia::phantom
