#pragma once
/// \file One vessel's wall as it is stored: samples on it, and how they are interpolated.

#include "ostia/lumen/implicit_surface.h"
#include "ostia/lumen/surface_sample.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ostia::lumen {

/// What f is far from all centres, and how its constant part is found.
enum class FarField {
  constant,  ///< q = +offset everywhere: far away is outside; a single right-hand side
  linear,    ///< [Wels] eq. 3: a linear polynomial with side conditions, by the Schur complement of A
};

struct InterpolationOptions {
  Kernel kernel = Kernel::wendland_c2;
  double support_radius_mm = 3.0;  ///< alpha, [0.5, 50]; default_support_radius() of the start's samples
  double offset_mm = 0.25;         ///< lambda, (0, 2]: f = +-lambda at p +- lambda n
  FarField far_field = FarField::constant;
};
void validate(const InterpolationOptions& options);  ///< throws InvalidInput

/// One vessel's part of a model. Immutable once shared.
struct VesselLumen {
  std::int32_t vessel = 0;                          ///< geometry::Vessel::id
  std::shared_ptr<const geometry::AxisCurve> axis;  ///< of the whole vessel, from the root
  double own_from_mm = 0.0;  ///< where its own segments begin; before it the wall is another vessel's
  std::vector<SurfaceSample> samples;  ///< in canonical order
  InterpolationOptions interpolation;
};

/// The support radius that a vessel's samples ask for (docs/methods/lumen-model.md gives the reason).
double default_support_radius(const std::vector<SurfaceSample>& samples);

/// f of a vessel, solved afresh in canonical order: depends on the stored model alone, not on the way that
/// led there. Throws InvalidInput (no samples; alpha too small, naming the place that no centre reaches),
/// ResourceError (the factor would not fit, estimated beforehand), NumericalError (residual above tolerance).
ImplicitSurface solve(const VesselLumen& vessel);

}  // namespace ostia::lumen
