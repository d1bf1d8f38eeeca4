#include "ostia/lumen/vessel_lumen.h"

#include "interpolation/constraints.h"
#include "interpolation/interpolation_system.h"
#include "interpolation/sparse_factor.h"

#include "ostia/core/error.h"
#include "ostia/geometry/kd_tree.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::lumen {

void validate(const InterpolationOptions& options) {
  if (!(options.support_radius_mm >= 0.5 && options.support_radius_mm <= 50.0))
    throw InvalidInput("the support radius of a wall is " + std::to_string(options.support_radius_mm) +
                       " mm; choose one from 0.5 to 50 mm");
  if (!(options.offset_mm > 0.0 && options.offset_mm <= 2.0))
    throw InvalidInput("the offset of a wall's constraints is " + std::to_string(options.offset_mm) +
                       " mm; choose one above 0 and up to 2 mm");
  if (!(options.offset_mm < options.support_radius_mm))
    throw InvalidInput("the offset of a wall's constraints, " + std::to_string(options.offset_mm) +
                       " mm, is not less than its support radius of " +
                       std::to_string(options.support_radius_mm) + " mm; reduce the offset");
}

double default_support_radius(const std::vector<SurfaceSample>& samples) {
  if (samples.size() < 2)
    throw InvalidInput("a support radius needs at least two samples on the wall; add samples");
  std::vector<Vec3> places;
  for (const SurfaceSample& sample : samples) places.push_back(sample.position);
  const geometry::KdTree tree(places);
  // The fourth neighbour of a place in a regular net is a step of the net away.
  std::vector<double> steps;
  for (const Vec3& place : places) {
    const auto neighbours = tree.nearest(place, 5);
    steps.push_back((places[static_cast<std::size_t>(neighbours.back())] - place).norm());
  }
  const auto wide = steps.begin() + static_cast<std::ptrdiff_t>(9 * (steps.size() - 1) / 10);
  std::nth_element(steps.begin(), wide, steps.end());
  return std::clamp(3.0 * *wide, 0.75, 10.0);
}

ImplicitSurface solve(const VesselLumen& vessel) {
  const ConstraintSet set(vessel);
  set.check_for_holes();
  const std::vector<Constraint> constraints = set.all();
  const SymmetricMatrix matrix = interpolation_matrix(constraints, vessel.interpolation);
  const SparseFactor factor(matrix);
  const Solution solution = solve_system(
      constraints, vessel.interpolation, [&](const Eigen::MatrixXd& b) { return factor.solve(b); },
      [&](const Eigen::MatrixXd& x) { return product(matrix, x); });
  return surface_of(constraints, vessel.interpolation, solution);
}

}  // namespace ostia::lumen
