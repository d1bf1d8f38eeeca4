#include "ostia/geometry/spline.h"

#include "ostia/core/error.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace ostia::geometry {
namespace {

using std::numbers::pi;

std::vector<Vec3> circle_points(double radius, int n) {
  std::vector<Vec3> points;
  for (int i = 0; i <= n; ++i) {
    const double angle = pi * i / n;
    points.push_back(radius * Vec3(std::cos(angle), std::sin(angle), 0.0));
  }
  return points;
}

TEST(ArcLengthSpline, PassesThroughItsPointsAndEnds) {
  const std::vector<Vec3> points{Vec3(0, 0, 0), Vec3(3, 1, 0), Vec3(5, 0, 2), Vec3(9, 0, 1)};
  const ArcLengthSpline spline(points, {1.0, 2.0, 1.5, 1.0});
  EXPECT_EQ(spline.point(-1.0), points.front());
  EXPECT_EQ(spline.point(1e9), points.back());
  EXPECT_DOUBLE_EQ(spline.scalar(spline.length()), 1.0);
  for (const Vec3& p : points) {
    double nearest = 1e9;
    for (int i = 0; i <= 20000; ++i) {
      nearest = std::min(nearest, (spline.point(spline.length() * i / 20000.0) - p).norm());
    }
    EXPECT_LT(nearest, 1e-3);
  }
}

TEST(ArcLengthSpline, AbscissaIsArcLength) {
  // Uneven chords, so the chord parameter is far from arc length. Many short steps add up to the abscissa.
  const ArcLengthSpline spline({Vec3(0, 0, 0), Vec3(1, 2, 0), Vec3(6, 0, 3), Vec3(6.5, 0, 3), Vec3(9, 7, 1)});
  const int n = 20000;
  double sum = 0.0;
  Vec3 last = spline.point(0.0);
  for (int i = 1; i <= n; ++i) {
    const double s = spline.length() * i / n;
    const Vec3 next = spline.point(s);
    sum += (next - last).norm();
    last = next;
    if (i % 2000 == 0) {
      EXPECT_NEAR(sum, s, 1e-6 * spline.length());
    }
  }
}

TEST(ArcLengthSpline, StraightLineIsExact) {
  const ArcLengthSpline spline({Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, 5), Vec3(0, 0, 5), Vec3(0, 0, 12)});
  EXPECT_NEAR(spline.length(), 12.0, 1e-12);
  EXPECT_NEAR(spline.point(7.3).z(), 7.3, 1e-8);
  EXPECT_LT((spline.tangent(3.0) - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT(spline.curvature_vector(3.0).norm(), 1e-12);
}

TEST(ArcLengthSpline, CircleHasItsLengthTangentAndCurvature) {
  const ArcLengthSpline spline(circle_points(20.0, 60));
  EXPECT_NEAR(spline.length(), 20.0 * pi, 1e-3);
  for (const double part : {0.3, 0.5, 0.71}) {  // natural ends straighten the ends only
    const double angle = part * pi;
    const double s = part * spline.length();
    EXPECT_LT((spline.point(s) - 20.0 * Vec3(std::cos(angle), std::sin(angle), 0)).norm(), 1e-4);
    EXPECT_LT((spline.tangent(s) - Vec3(-std::sin(angle), std::cos(angle), 0)).norm(), 1e-4);
    const Vec3 towards_centre = -Vec3(std::cos(angle), std::sin(angle), 0) / 20.0;
    EXPECT_LT((spline.curvature_vector(s) - towards_centre).norm(), 1e-3 / 20.0);
  }
}

TEST(ArcLengthSpline, CurvatureIsContinuousAcrossKnots) {
  const ArcLengthSpline spline({Vec3(0, 0, 0), Vec3(3, 1, 0), Vec3(5, 0, 2), Vec3(9, 0, 1), Vec3(12, 4, 1)});
  const int n = 4000;
  const double step = spline.length() / n;
  for (int i = 1; i <= n; ++i) {
    const Vec3 jump = spline.curvature_vector(i * step) - spline.curvature_vector((i - 1) * step);
    ASSERT_LT(jump.norm(), 2.0 * step) << "at " << i * step << " mm";
  }
}

TEST(ArcLengthSpline, RefusesBadInput) {
  EXPECT_THROW(ArcLengthSpline({Vec3::Zero()}), InvalidInput);
  EXPECT_THROW(ArcLengthSpline({Vec3::Zero(), Vec3::Zero()}), InvalidInput);
  EXPECT_THROW(ArcLengthSpline({Vec3::Zero(), Vec3::UnitX()}, {1.0}), InvalidInput);
  EXPECT_THROW(ArcLengthSpline({Vec3::Zero(), Vec3(std::nan(""), 0, 0)}), InvalidInput);
}

// Weights, uneven parameters and noisy values for the smoothing spline.
struct Noisy {
  std::vector<double> t, y, w;
  explicit Noisy(int n) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double at = 0.0;
    for (int i = 0; i < n; ++i) {
      t.push_back(at += 0.2 + unit(random));
      y.push_back(std::sin(0.5 * at) + 0.3 * unit(random));
      w.push_back(0.2 + 2.0 * unit(random));
    }
  }
};

// The same minimiser by dense algebra: (W + lambda Q R^-1 Q') g = W y.
Eigen::VectorXd dense_fit(const Noisy& data, double lambda, double end_weight_factor) {
  const auto n = static_cast<Eigen::Index>(data.t.size());
  const auto at = [](const std::vector<double>& v, Eigen::Index i) { return v[static_cast<std::size_t>(i)]; };
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(n, n - 2), r = Eigen::MatrixXd::Zero(n - 2, n - 2);
  Eigen::VectorXd w(n), y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    w[i] = at(data.w, i);
    y[i] = at(data.y, i);
  }
  w[0] *= end_weight_factor;
  w[n - 1] *= end_weight_factor;
  for (Eigen::Index j = 0; j < n - 2; ++j) {
    const double h0 = at(data.t, j + 1) - at(data.t, j), h1 = at(data.t, j + 2) - at(data.t, j + 1);
    q(j, j) = 1.0 / h0;
    q(j + 1, j) = -1.0 / h0 - 1.0 / h1;
    q(j + 2, j) = 1.0 / h1;
    r(j, j) = (h0 + h1) / 3.0;
    if (j + 3 < n) r(j, j + 1) = r(j + 1, j) = h1 / 6.0;
  }
  const Eigen::MatrixXd system = Eigen::MatrixXd(w.asDiagonal()) + lambda * q * r.inverse() * q.transpose();
  return system.partialPivLu().solve(Eigen::VectorXd(w.asDiagonal() * y));
}

TEST(SmoothingSpline, EqualsTheDenseMinimiser) {
  for (const int n : {3, 4, 5, 40}) {
    const Noisy data(n);
    for (const double lambda : {0.01, 1.0, 100.0}) {
      const std::vector<double> fit = smoothing_spline(data.t, data.y, data.w, lambda, false);
      const Eigen::VectorXd expected = dense_fit(data, lambda, 1.0);
      for (std::size_t i = 0; i < fit.size(); ++i) {
        EXPECT_NEAR(fit[i], expected[static_cast<Eigen::Index>(i)], 1e-9)
            << n << " points, lambda " << lambda;
      }
    }
  }
}

TEST(SmoothingSpline, FixedEndsAreExactAndLikeAnEndlessWeight) {
  const Noisy data(30);
  const std::vector<double> fit = smoothing_spline(data.t, data.y, data.w, 2.0, true);
  EXPECT_EQ(fit.front(), data.y.front());
  EXPECT_EQ(fit.back(), data.y.back());
  const Eigen::VectorXd expected = dense_fit(data, 2.0, 1e8);
  for (std::size_t i = 0; i < fit.size(); ++i)
    EXPECT_NEAR(fit[i], expected[static_cast<Eigen::Index>(i)], 1e-5);
}

TEST(SmoothingSpline, NoPenaltyInterpolatesAndStraightLinesStay) {
  const Noisy data(25);
  EXPECT_EQ(smoothing_spline(data.t, data.y, data.w, 0.0, false), data.y);
  std::vector<double> line;
  for (const double t : data.t) line.push_back(3.0 - 0.5 * t);
  const std::vector<double> fit = smoothing_spline(data.t, line, data.w, 1e4, false);
  for (std::size_t i = 0; i < line.size(); ++i) EXPECT_NEAR(fit[i], line[i], 1e-9);
}

TEST(SmoothingSpline, HugePenaltyGivesTheWeightedRegressionLine) {
  const Noisy data(25);
  double sw = 0, st = 0, sy = 0, stt = 0, sty = 0;
  for (std::size_t i = 0; i < data.t.size(); ++i) {
    sw += data.w[i];
    st += data.w[i] * data.t[i];
    sy += data.w[i] * data.y[i];
    stt += data.w[i] * data.t[i] * data.t[i];
    sty += data.w[i] * data.t[i] * data.y[i];
  }
  const double slope = (sw * sty - st * sy) / (sw * stt - st * st), offset = (sy - slope * st) / sw;
  const std::vector<double> fit = smoothing_spline(data.t, data.y, data.w, 1e9, false);
  for (std::size_t i = 0; i < fit.size(); ++i) EXPECT_NEAR(fit[i], offset + slope * data.t[i], 1e-4);
}

TEST(SmoothingSpline, PointsAreFittedCoordinateByCoordinate) {
  const Noisy data(20);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < data.t.size(); ++i) points.emplace_back(data.y[i], -2.0 * data.y[i], data.t[i]);
  const std::vector<Vec3> fit = smoothing_spline(data.t, points, data.w, 3.0, true);
  const std::vector<double> expected = smoothing_spline(data.t, data.y, data.w, 3.0, true);
  for (std::size_t i = 0; i < fit.size(); ++i) {
    EXPECT_LT((fit[i] - Vec3(expected[i], -2.0 * expected[i], data.t[i])).norm(), 1e-9);
  }
}

TEST(SmoothingSpline, RefusesBadInput) {
  const std::vector<double> t{0, 1, 2}, y{1, 2, 3}, w{1, 1, 1};
  EXPECT_THROW(smoothing_spline({0}, std::vector<double>{1}, {1}, 1.0, false), InvalidInput);
  EXPECT_THROW(smoothing_spline(t, std::vector<double>{1, 2}, w, 1.0, false), InvalidInput);
  EXPECT_THROW(smoothing_spline(t, y, {1, 1}, 1.0, false), InvalidInput);
  EXPECT_THROW(smoothing_spline(t, y, {1, 0, 1}, 1.0, false), InvalidInput);
  EXPECT_THROW(smoothing_spline({0, 1, 1}, y, w, 1.0, false), InvalidInput);
  EXPECT_THROW(smoothing_spline(t, y, w, -1.0, false), InvalidInput);
  EXPECT_THROW(smoothing_spline(t, y, w, std::nan(""), false), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
