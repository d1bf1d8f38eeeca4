#pragma once
/// \file How far a registration is to be trusted.

#include "prepared.h"

namespace ostia::registration {

struct JacobianRange {
  double min = 1.0, max = 1.0;
};
/// Of the shifts alone, at the points.
JacobianRange jacobian_range(const SplineGrid& spline, const std::vector<Vec3>& points);
/// Mean of |u(p) + v(p + u(p))|.
double inconsistency_mm(const SplineGrid& there, const SplineGrid& back, const std::vector<Vec3>& points);
/// Of the values of the one image at the points, and of the other at the shifted points; 0 where one does not
/// vary.
double correlation_of(const imaging::FloatVolume& fixed, const imaging::FloatVolume& moving,
                      const SplineGrid* spline, const std::vector<Vec3>& points);
/// Fills what is left at the landmarks, the vessels' values, the verdict and its reason.
void judge(Quality& quality, const imaging::ImageVolume& fixed, const imaging::ImageVolume& moving,
           const Guidance& guidance, const Transform& transform, bool hounsfield);

}  // namespace ostia::registration
