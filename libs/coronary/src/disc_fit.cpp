#include "disc_fit.h"

#include "ostia/imaging/sampling.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace ostia::coronary {
namespace {

using geometry::Vec2;

struct Inside {
  double mean = 0.0, sd = 0.0;
};

/// Rings of places within `radius_mm`.
Inside inside(const imaging::ImageVolume& image, const SectionPlane& plane, double radius_mm) {
  constexpr int rings = 4, around = 12;
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (int ring = 0; ring <= rings; ++ring)
    for (int k = 0; k < (ring == 0 ? 1 : around); ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + 0.5 * (ring % 2)) / around;
      const double r = radius_mm * ring / rings;
      const double value =
          imaging::sample(image, plane.centre + r * (std::cos(angle) * plane.u + std::sin(angle) * plane.v));
      sum += value;
      squares += value * value;
      ++count;
    }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

/// Where the intensity falls first below `level` and stays there for a millimetre, on each ray, in the
/// plane's coordinates; rays without such a place have none.
std::vector<Vec2> edges(const imaging::ImageVolume& image, const SectionPlane& plane, double level,
                        const DiscFitOptions& options) {
  constexpr double step_mm = 0.75;
  const double farthest = 1.4 * options.largest_radius_mm;
  std::vector<Vec2> found;
  for (int k = 0; k < options.rays; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / options.rays;
    const Vec2 direction(std::cos(angle), std::sin(angle));
    const Vec3 along = direction.x() * plane.u + direction.y() * plane.v;
    double before = 0.0;
    for (double r = 0.0; r <= farthest; r += step_mm) {
      const Vec3 at = plane.centre + r * along;
      if (!image.geometry.contains(at)) break;
      const double value = imaging::sample(image, at);
      if (value < level && r > 0.0) {
        if (imaging::sample(image, at + 0.5 * step_mm * along) < level) {
          const double share = before > value ? (before - level) / (before - value) : 0.0;
          found.push_back((r - step_mm + step_mm * std::clamp(share, 0.0, 1.0)) * direction);
          break;
        }
      }
      before = value;
    }
  }
  return found;
}

struct Circle {
  Vec2 centre = Vec2::Zero();
  double radius = 0.0;
};

/// Least squares of x^2 + y^2 + a x + b y + c (I. Kasa, IEEE Trans. Instrum. Meas. 25:8-14, 1976).
Circle circle_through(const std::vector<Vec2>& points) {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Vec3 b = Vec3::Zero();
  for (const Vec2& p : points) {
    const Vec3 row(p.x(), p.y(), 1.0);
    a += row * row.transpose();
    b -= p.squaredNorm() * row;
  }
  const Vec3 x = a.ldlt().solve(b);
  Circle circle;
  circle.centre = -0.5 * x.head<2>();
  circle.radius = std::sqrt(std::max(0.0, circle.centre.squaredNorm() - x.z()));
  return circle;
}

struct Fitted {
  Circle circle;
  std::vector<Vec2> on_it;
};

/// Leaves out what is far from the circle, less and less tolerantly.
std::optional<Fitted> robust_circle(const std::vector<Vec2>& points, const DiscFitOptions& options) {
  // The first guess: about the middle, as wide as the median edge is far away.
  std::vector<double> away;
  for (const Vec2& p : points) away.push_back(p.norm());
  std::nth_element(away.begin(), away.begin() + static_cast<std::ptrdiff_t>(away.size() / 2), away.end());
  Fitted fit{{Vec2::Zero(), away[away.size() / 2]}, {}};
  for (const double tolerance : {4.0, 2.5, 1.5, 1.0, 1.0}) {
    fit.on_it.clear();
    for (const Vec2& p : points)
      if (std::abs((p - fit.circle.centre).norm() - fit.circle.radius) <
          tolerance * options.tolerance * fit.circle.radius)
        fit.on_it.push_back(p);
    if (2 * fit.on_it.size() < static_cast<std::size_t>(options.rays)) return std::nullopt;
    fit.circle = circle_through(fit.on_it);
    if (!(fit.circle.radius < 2.0 * options.largest_radius_mm)) return std::nullopt;
  }
  return fit;
}

}  // namespace

std::optional<DiscFit> fit_disc(const imaging::ImageVolume& image, const SectionPlane& plane,
                                const DiscFitOptions& options) {
  SectionPlane at = plane;
  std::optional<Fitted> fit;
  double radius = 0.5 * options.smallest_radius_mm;
  Inside middle;
  for (int pass = 0; pass < 3; ++pass) {
    if (!image.geometry.contains(at.centre)) return std::nullopt;
    middle = inside(image, at, 0.7 * radius);
    if (middle.mean < options.least_hu) return std::nullopt;
    const double level = middle.mean - options.fall * (middle.mean - options.wall_hu);
    const std::vector<Vec2> found = edges(image, at, level, options);
    if (2 * found.size() < static_cast<std::size_t>(options.rays)) return std::nullopt;
    fit = robust_circle(found, options);
    if (!fit) return std::nullopt;
    radius = fit->circle.radius;
    if (radius < 0.8 * options.smallest_radius_mm || radius > 1.2 * options.largest_radius_mm)
      return std::nullopt;
    if (pass < 2) at.centre += fit->circle.centre.x() * at.u + fit->circle.centre.y() * at.v;
  }
  if (radius < options.smallest_radius_mm || radius > options.largest_radius_mm) return std::nullopt;
  double squares = 0.0;
  for (const Vec2& p : fit->on_it) squares += std::pow((p - fit->circle.centre).norm() - radius, 2);
  DiscFit disc;
  disc.centre = at.centre + fit->circle.centre.x() * at.u + fit->circle.centre.y() * at.v;
  disc.radius_mm = radius;
  disc.hu = middle.mean;
  disc.sd_hu = middle.sd;
  disc.round = static_cast<double>(fit->on_it.size()) / options.rays;
  disc.residual = std::sqrt(squares / static_cast<double>(fit->on_it.size())) / radius;
  return disc;
}

}  // namespace ostia::coronary
