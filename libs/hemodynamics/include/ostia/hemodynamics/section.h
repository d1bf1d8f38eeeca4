#pragma once
/// \file What a section of a vessel means for the flow through it (docs/methods/hemodynamics.md).

#include "ostia/geometry/vec.h"

#include <span>

namespace ostia::hemodynamics {

using geometry::Vec2;
using geometry::Vec3;

/// The section's form, without its size. Both are 1 for a circle.
struct SectionShape {
  /// Fall of pressure of the developed laminar flow over that of the circle of equal area, >= 1. With G the
  /// mean of w, -laplace(w) = 1, w = 0 on the rim: area / (8 pi G).
  double viscous = 1.0;
  /// The perimeter over that of the circle of equal area, >= 1.
  double perimeter = 1.0;
};

/// (a^2 + b^2) / (2 a b), exact for an ellipse of these half axes. Throws InvalidInput unless both are > 0.
SectionShape shape_of_ellipse(double a_mm, double b_mm);

/// Of the ellipse that has this area and perimeter; a circle where the perimeter is no longer than the
/// circle's. Throws InvalidInput unless both are > 0 and finite.
SectionShape shape_of_measures(double area_mm2, double perimeter_mm);

/// Of a contour, counter-clockwise, its last point joined to the first: Poisson's equation by harmonic
/// polynomials (Trefftz), the rim at equal angles about the centroid. Where the contour cannot be seen whole
/// from its centroid, or the rim is missed by more than 2 % of the largest w, by the polar moment of inertia
/// (Bahrami et al. 2006: 2 pi I / area^2, within 8 % for usual ducts). Throws InvalidInput for fewer than 8
/// points or no area.
SectionShape shape_of_contour(std::span<const Vec2> contour);

}  // namespace ostia::hemodynamics
