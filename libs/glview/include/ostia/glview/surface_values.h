#pragma once
/// \file What a beating wall can be coloured by. See docs/reference/live.md.

#include "ostia/figure/color.h"
#include "ostia/glview/shown_surface.h"
#include "ostia/motion/moving_cage.h"

#include <array>
#include <string>
#include <vector>

namespace ostia::glview {

enum class SurfaceValue {
  none,
  displacement,  ///< from its place in the template, mm
  velocity,      ///< speed, mm/s
  stretch,       ///< along the vessel against the template, %
  bending,       ///< the wall's curvature along the vessel less the template's, 1/cm
};
inline constexpr std::array all_values{SurfaceValue::none, SurfaceValue::displacement, SurfaceValue::velocity,
                                       SurfaceValue::stretch, SurfaceValue::bending};

const char* title(SurfaceValue value);  ///< with its unit: "displacement, mm"
bool is_signed(SurfaceValue value);     ///< its range lies evenly about zero
/// The colour at `t` in [0, 1] of the range: viridis, or blue to vermilion where values have signs.
figure::Color color(SurfaceValue value, double t);

/// A value's range over the whole cycle.
struct ValueRange {
  double low = 0.0, high = 1.0;
};

/// Curvatures along the vessel at even phases less those of the template, 1/mm: `phases` blocks of one value
/// a vertex.
struct BendingTable {
  int phases = 0;
  std::vector<float> values;
};
/// At each vertex how fast normals turn along the vessel, by least squares over the vertices within
/// `reach_mm` on the same side of it: 1/(R + r) on the outer side of a tube of radius r about an axis of
/// radius R, where the wall is convex, and -1/(R - r) on the inner one. Throws InvalidInput for fewer than
/// two phases, or a surface without directions (ShownSurface::along); Cancelled.
BendingTable bending_table(const ShownSurface& surface, const motion::MovingCage& cage, int phases = 20,
                           double reach_mm = 3.0, const core::TaskContext& task = core::no_task());

/// One a vertex, as the shader computes them, in the units of SurfaceValue; `bending` only with a table.
/// Velocities are those of a cycle of `interval_s`. For legends and tests. Throws InvalidInput for bending
/// without its table, and for stretch where the surface has no directions.
std::vector<double> values_at(const ShownSurface& surface, const motion::MovingCage& cage, double phase,
                              SurfaceValue value, double interval_s = 1.0,
                              const BendingTable* bending = nullptr);
/// Round bounds that hold 99 % of the values at each of 20 phases; velocities for a cycle of a second.
/// Throws as `values_at`; Cancelled.
ValueRange value_range(const ShownSurface& surface, const motion::MovingCage& cage, SurfaceValue value,
                       const BendingTable* bending = nullptr,
                       const core::TaskContext& task = core::no_task());

}  // namespace ostia::glview
