#include "ostia/meshing/size_field.h"

#include "ostia/core/error.h"

#include <cmath>
#include <string>

namespace ostia::meshing {

namespace {

const SizeField& valid(const SizeField& field) {
  validate(field);
  return field;
}

}  // namespace

void validate(const SizeField& field) {
  if (field.points.empty() || field.edge_mm.size() != field.points.size())
    throw InvalidInput("size field: " + std::to_string(field.edge_mm.size()) + " lengths for " +
                       std::to_string(field.points.size()) + " points; it needs points and one a point");
  for (std::size_t i = 0; i < field.edge_mm.size(); ++i)
    if (!(field.edge_mm[i] > 0.0) || !std::isfinite(field.edge_mm[i]))
      throw InvalidInput("size field: the length at point " + std::to_string(i) + " is " +
                         std::to_string(field.edge_mm[i]) + " mm; it must be positive and finite");
  if (!(field.gradation >= 0.01 && field.gradation <= 2.0))
    throw InvalidInput("size field: gradation " + std::to_string(field.gradation) +
                       " mm per mm must lie in [0.01, 2]");
}

SizeLookup::SizeLookup(const SizeField& field)
    : tree_(valid(field).points), edge_mm_(field.edge_mm), gradation_(field.gradation) {}

double SizeLookup::operator()(const geometry::Vec3& place) const {
  constexpr std::size_t near_points = 8;
  double sum = 0.0, weights = 0.0, beyond_mm = -1.0;
  for (const std::int32_t i : tree_.nearest(place, near_points)) {
    const double edge = edge_mm_[static_cast<std::size_t>(i)];
    const double squared = (tree_.points()[static_cast<std::size_t>(i)] - place).squaredNorm();
    if (weights == 0.0) {  // the nearest
      if (squared <= 1e-18 * edge * edge) return edge;
      beyond_mm = std::sqrt(squared) - edge;
    }
    sum += edge / squared;
    weights += 1.0 / squared;
  }
  return sum / weights + (beyond_mm > 0.0 ? gradation_ * beyond_mm : 0.0);
}

}  // namespace ostia::meshing
