#pragma once
/// \file Solids whose distance is known by formula, as branches of a tree, for tests.

#include "ostia/lumen/scalar_field.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

namespace ostia::lumen::test {

/// A field from formulas, which counts the places that it was asked.
class Formula : public ScalarField {
 public:
  using Value = std::function<double(const Vec3&)>;
  using Gradient = std::function<Vec3(const Vec3&)>;
  Formula(Value value, Gradient gradient, const Box3& box)
      : value_(std::move(value)), gradient_(std::move(gradient)), box_(box) {}
  double value(const Vec3& place) const override {
    ++asked;
    return value_(place);
  }
  Vec3 gradient(const Vec3& place) const override { return gradient_(place); }
  void values(std::span<const Vec3> places, std::span<double> out) const override {
    for (std::size_t i = 0; i < places.size(); ++i) out[i] = value(places[i]);
  }
  Box3 box() const override { return box_; }
  mutable std::atomic<std::size_t> asked{0};

 private:
  Value value_;
  Gradient gradient_;
  Box3 box_;
};
using Field = std::shared_ptr<const Formula>;

inline Box3 box_around(const Vec3& a, const Vec3& b, double reach) {
  return {a.cwiseMin(b) - Vec3::Constant(reach), a.cwiseMax(b) + Vec3::Constant(reach)};
}

/// All places within `radius` of a segment: distance, negative inside.
inline Field capsule(const Vec3& a, const Vec3& b, double radius) {
  const auto from_axis = [a, b](const Vec3& p) -> Vec3 {
    const Vec3 along = b - a;
    const double length = along.squaredNorm();
    const double t = length > 0.0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0.0;
    return p - a - t * along;
  };
  return std::make_shared<Formula>([=](const Vec3& p) { return from_axis(p).norm() - radius; },
                                   [=](const Vec3& p) { return from_axis(p).normalized(); },
                                   box_around(a, b, radius + 2.0));
}
inline Field ball(const Vec3& centre, double radius) {
  return capsule(centre, centre, radius);
}

/// Around the z axis.
inline Field torus(const Vec3& centre, double ring, double radius) {
  const auto from_ring = [=](const Vec3& p) -> Vec3 {
    const Vec3 q = p - centre;
    const double across = std::max(std::hypot(q.x(), q.y()), 1e-12);
    return {q.x() * (1.0 - ring / across), q.y() * (1.0 - ring / across), q.z()};
  };
  return std::make_shared<Formula>([=](const Vec3& p) { return from_ring(p).norm() - radius; },
                                   [=](const Vec3& p) { return from_ring(p).normalized(); },
                                   box_around(centre, centre, ring + radius + 2.0));
}

}  // namespace ostia::lumen::test
