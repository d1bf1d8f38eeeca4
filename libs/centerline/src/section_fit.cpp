#include "section_fit.h"

#include <Eigen/Dense>

#include <cmath>

namespace ostia::centerline::detail {
namespace {

using geometry::Vec2;
using Conic = Eigen::Matrix<double, 6, 1>;  // a x^2 + b xy + c y^2 + d x + e y + f

std::optional<Ellipse> ellipse_of(const Conic& k) {
  Eigen::Matrix2d form;
  form << k[0], 0.5 * k[1], 0.5 * k[1], k[2];
  if (!(form.determinant() > 0.0)) return std::nullopt;
  const Vec2 centre = form.inverse() * Vec2(-0.5 * k[3], -0.5 * k[4]);
  const double level = centre.dot(form * centre) - k[5];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(form);
  const double p = level / axes.eigenvalues()[0], q = level / axes.eigenvalues()[1];
  if (!(p > 0.0) || !(q > 0.0) || !std::isfinite(p) || !std::isfinite(q)) return std::nullopt;
  const int major = p >= q ? 0 : 1;
  return Ellipse{centre, std::sqrt(std::max(p, q)), std::sqrt(std::min(p, q)),
                 axes.eigenvectors().col(major)};
}

}  // namespace

std::optional<Circle> fit_circle(const std::vector<Vec2>& points) {
  if (points.size() < 3) return std::nullopt;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Vec2& p : points) {
    const Eigen::Vector3d row(p.x(), p.y(), 1.0);
    normal += row * row.transpose();
    right += p.squaredNorm() * row;
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(normal);
  if (!solver.isInvertible()) return std::nullopt;
  const Eigen::Vector3d s = solver.solve(right);
  const Vec2 centre = 0.5 * s.head<2>();
  const double square = s[2] + centre.squaredNorm();
  if (!(square > 0.0) || !std::isfinite(square)) return std::nullopt;
  return Circle{centre, std::sqrt(square)};
}

std::optional<Ellipse> fit_ellipse(const std::vector<Vec2>& points) {
  if (points.size() < 6) return std::nullopt;
  double scale = 0.0;
  Vec2 mean = Vec2::Zero();
  for (const Vec2& p : points) mean += p / static_cast<double>(points.size());
  for (const Vec2& p : points) scale = std::max(scale, (p - mean).norm());
  if (!(scale > 0.0)) return std::nullopt;
  Eigen::Matrix3d s1 = Eigen::Matrix3d::Zero(), s2 = s1, s3 = s1;
  for (const Vec2& p : points) {
    const Vec2 q = (p - mean) / scale;
    const Eigen::Vector3d square(q.x() * q.x(), q.x() * q.y(), q.y() * q.y()), linear(q.x(), q.y(), 1.0);
    s1 += square * square.transpose();
    s2 += square * linear.transpose();
    s3 += linear * linear.transpose();
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> inner(s3);
  if (!inner.isInvertible()) return std::nullopt;
  const Eigen::Matrix3d t = -inner.solve(s2.transpose());
  const Eigen::Matrix3d m = s1 + s2 * t;
  Eigen::Matrix3d reduced;
  reduced << 0.5 * m.row(2), -m.row(1), 0.5 * m.row(0);
  const Eigen::EigenSolver<Eigen::Matrix3d> solver(reduced);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d a = solver.eigenvectors().col(i).real();
    if (!(4.0 * a[0] * a[2] - a[1] * a[1] > 0.0)) continue;
    Conic conic;
    conic << a, t * a;
    std::optional<Ellipse> ellipse = ellipse_of(conic);
    if (!ellipse) return std::nullopt;
    ellipse->centre = mean + scale * ellipse->centre;
    ellipse->semi_major *= scale;
    ellipse->semi_minor *= scale;
    return ellipse;
  }
  return std::nullopt;
}

double relative_miss(const Ellipse& ellipse, const Vec2& point) {
  const Vec2 p = point - ellipse.centre;
  const Vec2 minor(-ellipse.major.y(), ellipse.major.x());
  const double reach =
      std::hypot(p.dot(ellipse.major) / ellipse.semi_major, p.dot(minor) / ellipse.semi_minor);
  return std::abs(reach - 1.0);
}

}  // namespace ostia::centerline::detail
