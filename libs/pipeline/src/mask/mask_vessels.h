#pragma once
/// \file A mask's vessels while their walls are made: areas and shapes on rings along each axis.

#include "ostia/core/task_context.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/imaging/volume.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

namespace ostia::pipeline {

using MaskAxis = std::shared_ptr<const geometry::AxisCurve>;

inline constexpr int mask_rays = 24;          // of a ring
inline constexpr double mask_ring_mm = 0.25;  // about, between rings
inline constexpr double mask_reach_mm = 7.0;  // of a voxel from the axis it belongs to
using MaskRing = std::array<double, mask_rays>;

/// One vessel, on rings from where it is its own vessel to its end.
struct MaskVessel {
  MaskAxis axis;
  double own_mm = 0.0;   // where its way leaves its parent's
  double free_mm = 0.0;  // where it has left its parent's lumen
  double step_mm = mask_ring_mm;
  std::vector<double> area_mm2;    // one a ring
  std::vector<MaskRing> shape;     // radius over the mean one; mean square 1
  std::vector<MaskRing> given_up;  // mm, of the radius, where another vessel is too near
  std::vector<bool> at_fork;       // a branch leaves here: voxels do not tell whose they are
  geometry::Box3 box;

  std::size_t rings() const { return area_mm2.size(); }
  double s(std::size_t ring) const { return own_mm + step_mm * static_cast<double>(ring); }
  double mean_radius(double s_mm) const;
  double radius(double s_mm, double theta) const;
  /// Rings between two abscissas, as far as there are any: [first, last).
  std::size_t ring_from(double s_mm) const;
};

/// In the tree's order; areas are those of the axes' radii.
std::vector<MaskVessel> mask_vessels(const geometry::VesselTree& tree);

/// Where a place is as seen from the vessel whose wall is nearest.
struct Belonging {
  std::int32_t vessel = -1;
  geometry::AxisFoot foot;
  double beyond_mm = 1e9;  // the wall; negative inside
};

/// The least distance from the axis of a wall that gives way to another.
double least_wall(const MaskVessel& vessel, double s_mm);
/// Distance beyond a vessel's wall, or of the circle of its section's area; behind an end that of the ball
/// there.
double beyond_wall(const MaskVessel& vessel, const geometry::AxisFoot& foot, bool round);
Belonging belonging_of(const std::vector<MaskVessel>& vessels, const geometry::Vec3& place, bool round);
std::vector<Belonging> all_belongings(const std::vector<MaskVessel>& vessels, const imaging::Geometry& grid,
                                      const std::vector<std::int64_t>& voxels, bool round,
                                      const core::TaskContext& task);
geometry::Vec3 centre_of_voxel(const imaging::Geometry& grid, std::int64_t n);

/// A mean over neighbours along the vessel, weighed by a Gaussian, within the rings from `first` on.
template <class Value>
std::vector<Value> evened_along(const std::vector<Value>& values, std::size_t first, double sigma_rings,
                                const std::function<void(Value&, const Value&, double)>& add, Value zero) {
  if (sigma_rings < 1e-3) return values;
  std::vector<Value> result = values;
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3.0 * sigma_rings));
  const auto count = static_cast<std::ptrdiff_t>(values.size());
  for (auto i = static_cast<std::ptrdiff_t>(first); i < count; ++i) {
    Value sum = zero;
    double weights = 0.0;
    for (std::ptrdiff_t j = std::max(static_cast<std::ptrdiff_t>(first), i - reach);
         j <= std::min(count - 1, i + reach); ++j) {
      const double d = static_cast<double>(j - i) / sigma_rings, w = std::exp(-0.5 * d * d);
      add(sum, values[static_cast<std::size_t>(j)], w);
      weights += w;
    }
    Value mean = zero;
    add(mean, sum, 1.0 / weights);
    result[static_cast<std::size_t>(i)] = mean;
  }
  return result;
}
void add_ring(MaskRing& sum, const MaskRing& value, double weight);

/// Walls that are nearer to each other than `apart_mm` though their vessels are far apart along the tree give
/// way, half each, and so does a wall that would fold on the inner side of a bend. Deterministic.
void part_walls(std::vector<MaskVessel>& vessels, const geometry::VesselTree& tree, double apart_mm,
                const core::TaskContext& task);

}  // namespace ostia::pipeline
