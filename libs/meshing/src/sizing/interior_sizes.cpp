#include "sizing/interior_sizes.h"

#include <algorithm>

namespace ostia::meshing {

InteriorSizes::InteriorSizes(const MesherJob& job)
    : job_(job), surface_(job.points), field_({job.field_points, job.field_sizes, job.field_gradation}) {}

double InteriorSizes::operator()(const geometry::Vec3& place) const {
  constexpr double reach = 1.5;  // of the surface's sizes: where a tetrahedron on a triangle has its apex
  const auto nearest = static_cast<std::size_t>(surface_.nearest(place));
  const double wall = job_.sizes[nearest], far = (job_.points[nearest] - place).norm();
  const double least = wall - job_.field_gradation * std::max(0.0, far - reach * wall),
               most = wall + job_.field_gradation * far;
  return std::clamp(field_(place), std::min(least, most), most);
}

}  // namespace ostia::meshing
