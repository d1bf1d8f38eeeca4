#pragma once
/// \file Which samples of a wall a newly drawn line contradicts ([Wels] 2.3).

#include "ostia/lumen/surface_sample.h"

#include <memory>
#include <optional>
#include <vector>

namespace ostia::lumen {

using geometry::AxisCurve;

/// A place of a drawn line: its abscissa and its offset from the axis there, across the vessel.
struct LinePlace {
  double s_mm = 0.0;
  Vec3 offset = Vec3::UnitX();  ///< world, mm; its part along the axis does not count
};

/// The special tangent frame bundle T*(t) of an axis and a line drawn along it.
class TangentFrameBundle {
 public:
  struct Rotation {
    Vec3 r1 = Vec3::UnitX();  ///< from the axis towards the line, across the vessel
    Vec3 r2 = Vec3::UnitZ();  ///< the axis' tangent
    Vec3 r3 = Vec3::UnitY();  ///< r1 x r2
  };
  /// `line` in order of abscissas that do not fall; at least one place, none on the axis.
  TangentFrameBundle(std::shared_ptr<const AxisCurve> axis, const std::vector<LinePlace>& line);

  const AxisCurve& axis() const { return *axis_; }
  double from_mm() const { return s_.front(); }
  double to_mm() const { return s_.back(); }
  /// T* at an abscissa; before and after the line, that of its end carried along the axis' frames.
  Rotation at(double s_mm) const;

 private:
  std::shared_ptr<const AxisCurve> axis_;
  std::vector<double> s_, x_, y_;  // offsets in the axis' own frames: they turn no more than they must
};

/// What a stroke does away with.
struct StrokeReach {
  double beta_deg = 60.0;
  double margin_mm = 0.0;                   ///< beyond both ends of the line
  double own_from_mm = 0.0;                 ///< of the vessel: tells the caps of its two ends apart
  bool start_cap = false, end_cap = false;  ///< the line runs past that end
};

/// Angle between a place's offset from its foot and r1* there, degrees.
double stroke_angle_deg(const TangentFrameBundle& bundle, const Vec3& place, double s_mm);

/// Indices of the samples with a foot t_i on the line (and its margins) whose angle is at most beta.
std::vector<std::size_t> contradicted(const std::vector<SurfaceSample>& samples,
                                      const TangentFrameBundle& bundle, const StrokeReach& reach);

/// Angles as seen from the axis, from `from` counter-clockwise over `width` radians.
struct AngularRange {
  double from = 0.0, width = 0.0;
};
bool contains(const AngularRange& range, double theta);

/// Indices of the samples with |t_i - s| < eps / 2, within the range alone if there is one. Caps stay: their
/// feet are all at the end, whatever they close.
std::vector<std::size_t> contradicted(const std::vector<SurfaceSample>& samples, const AxisCurve& axis,
                                      double s_mm, double eps_mm, const std::optional<AngularRange>& range);

}  // namespace ostia::lumen
