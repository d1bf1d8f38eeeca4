#include "ostia/geometry/polyline.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ostia::geometry {
namespace {

void require_two_points(const std::vector<Vec3>& points) {
  if (points.size() < 2) {
    throw InvalidInput("a polyline needs at least two points, this one has " + std::to_string(points.size()));
  }
}

PolylineLocation locate(const std::vector<Vec3>& points, const std::vector<double>& along,
                        double abscissa_mm) {
  const double s = std::clamp(abscissa_mm, 0.0, along.back());
  const auto above = std::upper_bound(along.begin() + 1, along.end() - 1, s);
  PolylineLocation place;
  place.segment = static_cast<std::size_t>(above - along.begin()) - 1;
  const double piece = along[place.segment + 1] - along[place.segment];
  place.t = piece > 0.0 ? std::clamp((s - along[place.segment]) / piece, 0.0, 1.0) : 0.0;
  place.abscissa = s;
  place.point = (1.0 - place.t) * points[place.segment] + place.t * points[place.segment + 1];
  return place;
}

}  // namespace

std::vector<double> abscissas(const std::vector<Vec3>& points) {
  std::vector<double> along(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i)
    along[i] = along[i - 1] + (points[i] - points[i - 1]).norm();
  return along;
}

double length(const std::vector<Vec3>& points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
  return sum;
}

PolylineLocation at_abscissa(const std::vector<Vec3>& points, double abscissa_mm) {
  require_two_points(points);
  if (std::isnan(abscissa_mm))
    throw InvalidInput("the abscissa on a polyline is not a number; give it in mm");
  return locate(points, abscissas(points), abscissa_mm);
}

PolylineLocation closest(const std::vector<Vec3>& points, const Vec3& query) {
  require_two_points(points);
  PolylineLocation best;
  double best_squared = std::numeric_limits<double>::infinity();
  double along = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 step = points[i + 1] - points[i];
    const double squared = step.squaredNorm();
    const double t = squared > 0.0 ? std::clamp((query - points[i]).dot(step) / squared, 0.0, 1.0) : 0.0;
    const Vec3 point = (1.0 - t) * points[i] + t * points[i + 1];
    const double distance = (query - point).squaredNorm();
    const double piece = std::sqrt(squared);
    if (distance < best_squared) {
      best_squared = distance;
      best = {i, t, along + t * piece, point};
    }
    along += piece;
  }
  return best;
}

std::vector<Vec3> resample(const std::vector<Vec3>& points, double step_mm) {
  require_two_points(points);
  if (!(step_mm > 0.0)) {
    throw InvalidInput("the step to resample a polyline is " + std::to_string(step_mm) +
                       " mm; it must be above 0");
  }
  const std::vector<double> along = abscissas(points);
  // A length that is a whole number of steps up to rounding does not get one step more.
  const auto pieces =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(along.back() / step_mm - 1e-9)));
  std::vector<Vec3> result;
  result.reserve(pieces + 1);
  result.push_back(points.front());
  for (std::size_t i = 1; i < pieces; ++i) {
    const double s = along.back() * static_cast<double>(i) / static_cast<double>(pieces);
    result.push_back(locate(points, along, s).point);
  }
  result.push_back(points.back());
  return result;
}

}  // namespace ostia::geometry
