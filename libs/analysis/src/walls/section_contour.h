#pragma once
/// \file The lumen's outline on the plane across an axis.

#include "walls/contour_measures.h"

#include "ostia/geometry/axis_curve.h"
#include "ostia/lumen/scalar_field.h"

#include <vector>

namespace ostia::analysis {

using geometry::Vec3;

/// The plane across an axis: x runs along theta = 0, y along theta = 90 degrees.
struct SectionPlane {
  Vec3 origin, x, y, normal;
  SectionPlane(const geometry::AxisCurve& axis, double s_mm);
  Vec3 world(const Vec2& p) const { return origin + p.x() * x + p.y() * y; }
  Vec2 plane(const Vec3& p) const { return {(p - origin).dot(x), (p - origin).dot(y)}; }
};

struct SectionContour {
  enum class State {
    found,
    shut,  ///< no lumen within `search_mm` of the axis
    open,  ///< the wall does not close within `reach_mm` of the axis
  } state = State::shut;
  std::vector<Vec2> points;  ///< counter-clockwise
};

constexpr double reach_mm = 12.0;  ///< of a lumen from the axis
constexpr double search_mm = 3.0;  ///< for a lumen beside the axis

/// Along `around` rays from the axis, or from the lumen's centroid where the axis lies far off it; a lumen
/// that is not star-shaped, or too flat for rays, is followed along its wall. A lumen beside the axis counts
/// only where this stretch of the axis is the nearest to it.
SectionContour section_contour(const lumen::ScalarField& field, const geometry::AxisCurve& axis, double s_mm,
                               int around);

}  // namespace ostia::analysis
