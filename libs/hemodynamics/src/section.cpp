#include "ostia/hemodynamics/section.h"

#include "circle.h"

#include "ostia/core/error.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace ostia::hemodynamics {
namespace {

constexpr int rim_points = 128;  // at equal angles
constexpr int harmonics = 16;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Ramanujan's second formula, off by less than 1e-5 down to an axis ratio of 1 : 10.
double ellipse_perimeter(double a, double b) {
  const double h = (a - b) * (a - b) / ((a + b) * (a + b));
  return pi * (a + b) * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));
}

struct Moments {
  double area = 0.0, perimeter = 0.0, polar = 0.0;  // polar moment about the centroid
  Vec2 centroid = Vec2::Zero();
};

Moments moments_of(std::span<const Vec2> contour) {
  Moments m;
  const Vec2 origin = contour.front();
  double about_origin = 0.0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec2 a = contour[i] - origin, b = contour[(i + 1) % contour.size()] - origin;
    const double twice = cross(a, b);
    m.area += 0.5 * twice;
    m.centroid += twice / 6.0 * (a + b);
    about_origin += twice / 12.0 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
    m.perimeter += (b - a).norm();
  }
  if (!(m.area > 0.0)) throw InvalidInput("a section's contour encloses no area, or runs clockwise");
  m.centroid /= m.area;
  m.polar = about_origin - m.area * m.centroid.squaredNorm();
  m.centroid += origin;
  return m;
}

/// Distances of the rim at equal angles about the centroid: cubic between the contour's points. None where
/// the contour turns back.
std::optional<std::vector<double>> radii_about(const Vec2& centre, std::span<const Vec2> contour) {
  const std::size_t n = contour.size();
  std::vector<double> angle, radius;
  for (const Vec2& p : contour) {
    const Vec2 d = p - centre;
    double theta = std::atan2(d.y(), d.x());
    if (!angle.empty()) theta = angle.back() + std::remainder(theta - angle.back(), 2.0 * pi);
    if (!angle.empty() && !(theta > angle.back())) return std::nullopt;
    angle.push_back(theta);
    radius.push_back(d.norm());
  }
  if (!(std::abs(angle.back() + std::remainder(angle.front() - angle.back(), 2.0 * pi) - angle.front() -
                 2.0 * pi) < 1e-9))
    return std::nullopt;
  const auto at = [&](long i, double& theta) {
    const long turns = i >= 0 ? i / static_cast<long>(n) : -1 - (-i - 1) / static_cast<long>(n);
    const auto k = static_cast<std::size_t>(i - turns * static_cast<long>(n));
    theta = angle[k] + 2.0 * pi * static_cast<double>(turns);
    return radius[k];
  };
  std::vector<double> out;
  std::size_t interval = 0;
  for (int k = 0; k < rim_points; ++k) {
    const double theta = angle.front() + 2.0 * pi * k / rim_points;
    while (interval + 1 < n && angle[interval + 1] <= theta) ++interval;
    std::array<double, 4> x{}, y{};
    for (long j = 0; j < 4; ++j)
      y[static_cast<std::size_t>(j)] =
          at(static_cast<long>(interval) + j - 1, x[static_cast<std::size_t>(j)]);
    double value = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      double weight = 1.0;
      for (std::size_t j = 0; j < 4; ++j)
        if (i != j) weight *= (theta - x[j]) / (x[i] - x[j]);
      value += weight * y[i];
    }
    out.push_back(value);
  }
  return out;
}

/// area / (8 pi G), G the mean of w = sum of harmonics - r^2 / 4, w = 0 on the rim in the least squares'
/// sense. None where the rim is missed.
std::optional<double> by_harmonics(const std::vector<double>& radii) {
  double mean = 0.0, area = 0.0;
  for (const double r : radii) mean += r / rim_points;
  const int unknowns = 2 * harmonics + 1;
  Eigen::MatrixXd rim(rim_points, unknowns);
  Eigen::VectorXd target(rim_points);
  for (int k = 0; k < rim_points; ++k) {
    const double theta = 2.0 * pi * k / rim_points, rho = radii[static_cast<std::size_t>(k)] / mean;
    rim(k, 0) = 1.0;
    double power = 1.0;
    for (int n = 1; n <= harmonics; ++n) {
      power *= rho;
      rim(k, 2 * n - 1) = power * std::cos(n * theta);
      rim(k, 2 * n) = power * std::sin(n * theta);
    }
    target[k] = rho * rho / 4.0;
    area += pi / rim_points * rho * rho;
  }
  // Normal equations: the columns are of like size, since rho is about 1.
  const Eigen::VectorXd a = (rim.transpose() * rim + 1e-12 * Eigen::MatrixXd::Identity(unknowns, unknowns))
                                .ldlt()
                                .solve(rim.transpose() * target);
  if (!a.allFinite() || !((rim * a - target).cwiseAbs().maxCoeff() < 0.02 * a[0])) return std::nullopt;
  double integral = 0.0;
  for (int k = 0; k < rim_points; ++k) {
    const double theta = 2.0 * pi * k / rim_points, rho = radii[static_cast<std::size_t>(k)] / mean;
    double power = rho * rho, sum = a[0] * power / 2.0 - power * power / 16.0;
    for (int n = 1; n <= harmonics; ++n) {
      power *= rho;
      sum += power / (n + 2) * (a[2 * n - 1] * std::cos(n * theta) + a[2 * n] * std::sin(n * theta));
    }
    integral += 2.0 * pi / rim_points * sum;
  }
  return area * area / (8.0 * pi * integral);
}

}  // namespace

SectionShape shape_of_ellipse(double a_mm, double b_mm) {
  if (!(a_mm > 0.0 && b_mm > 0.0)) throw InvalidInput("an ellipse has half axes above 0");
  return {(a_mm * a_mm + b_mm * b_mm) / (2.0 * a_mm * b_mm),
          std::max(1.0, ellipse_perimeter(a_mm, b_mm) / (2.0 * pi * std::sqrt(a_mm * b_mm)))};
}

SectionShape shape_of_measures(double area_mm2, double perimeter_mm) {
  if (!(area_mm2 > 0.0 && std::isfinite(area_mm2) && perimeter_mm > 0.0 && std::isfinite(perimeter_mm)))
    throw InvalidInput("a section's area and perimeter are numbers above 0");
  const double wanted = perimeter_mm / (2.0 * std::sqrt(pi * area_mm2));
  if (!(wanted > 1.0)) return {};
  // Of axes e^x and e^-x: the perimeter rises with x.
  double low = 0.0, high = 2.0;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (shape_of_ellipse(std::exp(x), std::exp(-x)).perimeter < wanted ? low : high) = x;
  }
  SectionShape shape = shape_of_ellipse(std::exp(low), std::exp(-low));
  shape.perimeter = wanted;
  return shape;
}

SectionShape shape_of_contour(std::span<const Vec2> contour) {
  if (contour.size() < 8) throw InvalidInput("a section's contour has fewer than 8 points");
  const Moments m = moments_of(contour);
  SectionShape shape;
  shape.perimeter = std::max(1.0, m.perimeter / (2.0 * std::sqrt(pi * m.area)));
  std::optional<double> viscous;
  if (const auto radii = radii_about(m.centroid, contour)) viscous = by_harmonics(*radii);
  shape.viscous = std::max(1.0, viscous.value_or(2.0 * pi * m.polar / (m.area * m.area)));
  return shape;
}

}  // namespace ostia::hemodynamics
