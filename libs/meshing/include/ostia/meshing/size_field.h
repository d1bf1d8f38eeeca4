#pragma once
/// \file Edge lengths anywhere in space, known at scattered points.

#include "ostia/geometry/kd_tree.h"
#include "ostia/geometry/vec.h"

#include <vector>

namespace ostia::meshing {

struct SizeField {
  std::vector<geometry::Vec3> points;
  std::vector<double> edge_mm;  ///< one a point, each positive and finite
  double gradation = 0.3;       ///< growth of the length away from all points, mm per mm; in [0.01, 2]
};
/// Throws InvalidInput: no points, another number of lengths, a length that is not positive, gradation.
void validate(const SizeField& field);

/// The length at a place: the mean of the eight nearest points' with weights 1 / distance^2 (Shepard 1968),
/// a point's own at the point. Where the nearest point is farther away than its length, it grows with the
/// distance beyond that. Queries are const and safe from many threads; the same for any of them.
class SizeLookup {
 public:
  explicit SizeLookup(const SizeField& field);
  double operator()(const geometry::Vec3& place) const;

 private:
  geometry::KdTree tree_;
  std::vector<double> edge_mm_;
  double gradation_;
};

}  // namespace ostia::meshing
