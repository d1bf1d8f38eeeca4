// The only file that sees CGAL's Poisson reconstruction (GPL-3).
#include "poisson/poisson_function.h"

#include "ostia/core/error.h"
#include "ostia/geometry/kd_tree.h"

#define CGAL_EIGEN3_ENABLED 1

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Poisson_reconstruction_function.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <string>
#include <utility>

namespace ostia::meshing {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Sample = std::pair<Point, Kernel::Vector_3>;
using Samples = std::vector<Sample>;
using PointMap = CGAL::First_of_pair_property_map<Sample>;
using NormalMap = CGAL::Second_of_pair_property_map<Sample>;

constexpr std::size_t level_points = 12;  // about a vertex and its neighbours

Point point_of(const geometry::Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

/// The corners of a box that is three times as large as the points' own. Where the points' hull is all there
/// is to tetrahedralise (a ball, evenly sampled), nothing would tell what is outside.
std::vector<geometry::Vec3> far_corners(const std::vector<geometry::Vec3>& points) {
  geometry::Box3 box;
  for (const geometry::Vec3& p : points) box.extend(p);
  const geometry::Vec3 reach = geometry::Vec3::Constant(1.5 * box.sizes().maxCoeff());
  const geometry::Box3 around(box.center() - reach, box.center() + reach);
  std::vector<geometry::Vec3> corners;
  for (int c = 0; c < 8; ++c) corners.push_back(around.corner(static_cast<geometry::Box3::CornerType>(c)));
  return corners;
}

Samples samples_of(const std::vector<geometry::Vec3>& points, const std::vector<geometry::Vec3>& normals) {
  Samples samples;
  samples.reserve(points.size() + 8);
  for (const geometry::Vec3& corner : far_corners(points))
    samples.emplace_back(point_of(corner), Kernel::Vector_3(0.0, 0.0, 0.0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const geometry::Vec3 n = normals[i].normalized();
    samples.emplace_back(point_of(points[i]), Kernel::Vector_3(n.x(), n.y(), n.z()));
  }
  return samples;
}

}  // namespace

struct PoissonFunction::Impl {
  Impl(const Samples& samples, const std::vector<geometry::Vec3>& points)
      : spacing(CGAL::compute_average_spacing<CGAL::Sequential_tag>(samples, 6,
                                                                    CGAL::parameters::point_map(PointMap()))),
        tree(points),
        function(samples.begin(), samples.end(), PointMap(), NormalMap()) {}
  double value(const geometry::Vec3& point) const { return function(point_of(point)); }
  /// Of the function on the surface near `point`: the mean of the nearest samples' values.
  double level(const geometry::Vec3& point) const {
    double sum = 0.0, weights = 0.0;
    for (const std::int32_t i : tree.nearest(point, level_points)) {
      const auto k = static_cast<std::size_t>(i);
      const double weight = 1.0 / ((tree.points()[k] - point).squaredNorm() + 0.25 * spacing * spacing);
      sum += weight * values[k];
      weights += weight;
    }
    return sum / weights;
  }
  double spacing;
  double sign = 1.0;
  geometry::KdTree tree;
  std::vector<double> values;  ///< at the points
  CGAL::Poisson_reconstruction_function<Kernel> function;
};

PoissonFunction::PoissonFunction(const std::vector<geometry::Vec3>& points,
                                 const std::vector<geometry::Vec3>& normals)
    : impl_(std::make_unique<Impl>(samples_of(points, normals), points)) {
  if (!impl_->function.compute_implicit_function())
    throw NumericalError("Poisson's equation of " + std::to_string(points.size()) +
                         " points could not be solved; take the isosurface instead");
  impl_->values.reserve(points.size());
  for (const geometry::Vec3& p : points) impl_->values.push_back(impl_->value(p));
  double outside = 0.0;
  for (const geometry::Vec3& corner : far_corners(points))
    outside += impl_->value(corner) - impl_->level(corner);
  impl_->sign = outside < 0.0 ? -1.0 : 1.0;
}

PoissonFunction::~PoissonFunction() = default;

double PoissonFunction::operator()(const geometry::Vec3& point) const {
  return impl_->sign * (impl_->value(point) - impl_->level(point));
}

double PoissonFunction::mean_spacing_mm() const {
  return impl_->spacing;
}

}  // namespace ostia::meshing
