#pragma once
/// \file Fields whose zero sets are known curves on a view, for tests.

#include "ostia/lumen/contour_lines.h"

#include <cmath>
#include <functional>
#include <limits>

namespace ostia::lumen::testing {

/// A field from a function; gradients by central differences.
class FunctionField final : public ScalarField {
 public:
  explicit FunctionField(std::function<double(const Vec3&)> f, double slope = 1.0)
      : f_(std::move(f)), slope_(slope) {}
  double value(const Vec3& place) const override { return f_(place); }
  Vec3 gradient(const Vec3& place) const override {
    Vec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = 1e-5 * Vec3::Unit(axis);
      slope[axis] = (f_(place + step) - f_(place - step)) / 2e-5;
    }
    return slope;
  }
  void values(std::span<const Vec3> places, std::span<double> out) const override {
    for (std::size_t i = 0; i < places.size(); ++i) out[i] = f_(places[i]);
  }
  Box3 box() const override {
    constexpr double far = 1e6;
    return {Vec3::Constant(-far), Vec3::Constant(far)};
  }
  double wall_slope() const override { return slope_; }

 private:
  std::function<double(const Vec3&)> f_;
  double slope_;
};

inline std::function<double(const Vec3&)> ball(const Vec3& centre, double radius) {
  return [=](const Vec3& p) { return (p - centre).norm() - radius; };
}

/// Around the z axis.
inline std::function<double(const Vec3&)> torus(double large, double small) {
  return [=](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - large, p.z()) - small; };
}

/// A view of the plane z = 0, with the world's origin in the middle of the picture.
inline ViewSurface flat_view(int width, int height, double pixel_mm) {
  ViewSurface view{width, height, pixel_mm, {}, {}};
  view.world = [=](const Vec2& px) {
    return Vec3((px.x() - 0.5 * width) * pixel_mm, (px.y() - 0.5 * height) * pixel_mm, 0.0);
  };
  return view;
}

/// Twice the area on the left of a closed line as seen in the picture (y down): positive where it runs
/// counter-clockwise as seen.
inline double area_on_the_left(const ContourLine& line) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < line.picture_px.size(); ++i) {
    const Vec2 &p = line.picture_px[i], &q = line.picture_px[i + 1];
    sum -= p.x() * q.y() - q.x() * p.y();
  }
  return sum;
}

inline double longest_step(const ContourLine& line) {
  double longest = 0.0;
  for (std::size_t i = 0; i + 1 < line.picture_px.size(); ++i)
    longest = std::max(longest, (line.picture_px[i + 1] - line.picture_px[i]).norm());
  return longest;
}

}  // namespace ostia::lumen::testing
