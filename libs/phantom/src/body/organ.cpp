#include "body/organ.h"

#include "ostia/geometry/spline.h"
#include "ostia/phantom/noise.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

constexpr std::int64_t table_side = 64;
constexpr std::int64_t table_mask = table_side - 1;
constexpr double table_range = 5.8;  // of uniform numbers: brings the deviation to about 1

}  // namespace

bool Capsule::holds(const Vec3& p) const {
  const Vec3 along = to - from, d = p - from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp(d.dot(along) / length2, 0.0, 1.0) : 0.0;
  const double radius = from_radius + t * (to_radius - from_radius);
  return (d - t * along).squaredNorm() < radius * radius;
}

geometry::Box3 Capsule::box() const {
  const Vec3 reach = Vec3::Constant(std::max(from_radius, to_radius));
  return {from.cwiseMin(to) - reach, from.cwiseMax(to) + reach};
}

Distance ellipsoid(const Vec3& centre, const geometry::Mat3& to_unit) {
  const double steepest = Eigen::JacobiSVD<geometry::Mat3>(to_unit).singularValues()[0];
  return [=](const Vec3& p) { return ((to_unit * (p - centre)).norm() - 1.0) / steepest; };
}

Distance ellipsoid(const Vec3& centre, const Vec3& semi_axes) {
  return ellipsoid(centre, geometry::Mat3(semi_axes.cwiseInverse().asDiagonal()));
}

Distance column(double x, double y, double semi_x, double semi_y) {
  const double least = std::min(semi_x, semi_y);
  return [=](const Vec3& p) {
    const double u = (p.x() - x) / semi_x, v = (p.y() - y) / semi_y;
    return least * (std::sqrt(u * u + v * v) - 1.0);
  };
}

Distance half_space(const Vec3& point, const Vec3& outward) {
  const Vec3 n = outward.normalized();
  return [=](const Vec3& p) { return (p - point).dot(n); };
}

Distance both(Distance a, Distance b) {
  return [a = std::move(a), b = std::move(b)](const Vec3& p) { return std::max(a(p), b(p)); };
}

Distance either(std::vector<Distance> parts) {
  return [parts = std::move(parts)](const Vec3& p) {
    double least = parts.front()(p);
    for (std::size_t i = 1; i < parts.size(); ++i) least = std::min(least, parts[i](p));
    return least;
  };
}

Distance without(Distance a, Distance b) {
  return [a = std::move(a), b = std::move(b)](const Vec3& p) { return std::max(a(p), -b(p)); };
}

Distance grown(Distance a, double by_mm) {
  return [a = std::move(a), by_mm](const Vec3& p) { return a(p) - by_mm; };
}

Capsules tube(const std::vector<Vec3>& controls, const std::vector<double>& radii, double step_mm) {
  const geometry::ArcLengthSpline spline(controls, radii);
  const int steps = std::max(1, static_cast<int>(std::ceil(spline.length() / step_mm)));
  Capsules out;
  Vec3 last = spline.point(0.0);
  double last_radius = radii.front();
  for (int i = 1; i <= steps; ++i) {
    const double s = spline.length() * i / steps;
    const Vec3 p = spline.point(s);
    const double radius = std::max(0.1, spline.scalar(s));
    out.push_back({last, p, last_radius, radius});
    last = p;
    last_radius = radius;
  }
  return out;
}

Capsules grown(Capsules capsules, double by_mm) {
  for (Capsule& c : capsules) {
    c.from_radius += by_mm;
    c.to_radius += by_mm;
  }
  return capsules;
}

void append(Capsules& to, const Capsules& more) {
  to.insert(to.end(), more.begin(), more.end());
}

NoiseField::NoiseField(std::uint64_t seed) : value_(table_side * table_side * table_side) {
  for (std::size_t i = 0; i < value_.size(); ++i)
    value_[i] = static_cast<float>(table_range * (uniform(seed, 0x54455854ULL * 0x100000000ULL + i) - 0.5));
}

double NoiseField::at(const Vec3& u) const {
  std::size_t low[3], high[3];
  double weight[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double floor = std::floor(u[axis]);
    const double t = u[axis] - floor;
    const auto base = static_cast<std::int64_t>(floor);
    low[axis] = static_cast<std::size_t>(base & table_mask);
    high[axis] = static_cast<std::size_t>((base + 1) & table_mask);
    weight[axis] = t * t * (3.0 - 2.0 * t);
  }
  const auto row = [&](std::size_t y, std::size_t z) {
    const float* line = value_.data() + table_side * (y + table_side * z);
    return line[low[0]] + weight[0] * (line[high[0]] - line[low[0]]);
  };
  const auto plane = [&](std::size_t z) {
    const double a = row(low[1], z);
    return a + weight[1] * (row(high[1], z) - a);
  };
  const double a = plane(low[2]);
  return a + weight[2] * (plane(high[2]) - a);
}

Distance uneven(Distance a, double amplitude_mm, double grain_mm, std::shared_ptr<const NoiseField> noise) {
  // The smooth step's slope is at most 1.5, along each axis.
  const double steepest = 1.0 + amplitude_mm * 1.5 * std::sqrt(3.0) * table_range / grain_mm;
  const double most = 0.5 * table_range * amplitude_mm;
  return [=, a = std::move(a)](const Vec3& p) {
    const double d = a(p);
    if (std::abs(d) > most) return (d > 0.0 ? d - most : d + most) / steepest;
    const double moved = d + amplitude_mm * noise->at(p / grain_mm + Vec3::Constant(0.37 * grain_mm));
    return std::clamp(moved, -most, most) / steepest;
  };
}

}  // namespace ostia::phantom
