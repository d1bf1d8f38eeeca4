#pragma once
/// \file The curve that the rows of a curved view are strung on.

#include "ostia/reformat/curved_reformation.h"

namespace ostia::reformat {

/// Straightened: the axis itself, its coordinate w the abscissa. Stretched: the axis projected along the
/// fixed direction v, w its length in the projection. Both run on straight beyond their ends, so that they
/// are C1 and without end.
struct CurvedReformation::Guide {
  struct Foot {
    double w = 0.0;
    bool nearest = false;  ///< a local minimum of the distance; else a maximum, on the far side of a bend
  };

  static std::shared_ptr<const Guide> of_axis(const geometry::AxisCurve& axis);
  static std::shared_ptr<const Guide> of_projection(const geometry::AxisCurve& axis, double theta);

  geometry::Frame frame(const geometry::AxisCurve& axis, double w) const;  ///< stretched: normal is v
  Vec3 point(const geometry::AxisCurve& axis, double w) const;             ///< stretched: its part across v
  double abscissa(double w) const;
  double coordinate(double s_mm) const;  ///< the inverse of `abscissa`
  /// Every place of the guide from which `place` lies straight across it.
  std::vector<Foot> feet(const geometry::AxisCurve& axis, const Vec3& place) const;

  bool stretched = false;
  Vec3 v = Vec3::Zero();  ///< the fixed direction of a stretched view
  double middle = 0.0;    ///< of the axis' extent along v
  std::vector<double> w, s;
  std::vector<Vec3> points, directions;

 private:
  /// Consecutive intervals: how far their directions turn from the middle's, and how far out they reach.
  /// Together they bound how far a place lies ahead of any of them.
  struct Block {
    std::size_t first, last;
    Vec3 centre, direction;
    double turn, reach;
  };
  std::vector<Block> blocks;
  void make_blocks();
  void add_feet(const geometry::AxisCurve& axis, const Vec3& at, std::size_t i,
                std::vector<Foot>& found) const;
  std::size_t interval(double at) const;
  Vec3 piece(std::size_t i, double t) const;
  Vec3 slope(std::size_t i, double t) const;
};

}  // namespace ostia::reformat
