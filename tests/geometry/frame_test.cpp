#include "ostia/geometry/frame.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

using std::numbers::pi;

// A helix of radius a and rise b per radian, with its Frenet frame. Its torsion is b / (a^2 + b^2)
// everywhere.
struct Helix {
  double a = 8.0, b = 3.0;
  Vec3 point(double t) const { return {a * std::cos(t), a * std::sin(t), b * t}; }
  Vec3 tangent(double t) const { return Vec3(-a * std::sin(t), a * std::cos(t), b) / std::hypot(a, b); }
  Vec3 normal(double t) const { return {-std::cos(t), -std::sin(t), 0.0}; }
};

void expect_orthonormal(const std::vector<Frame>& frames) {
  for (const Frame& f : frames) {
    ASSERT_NEAR(f.tangent.norm(), 1.0, 1e-12);
    ASSERT_NEAR(f.normal.norm(), 1.0, 1e-12);
    ASSERT_NEAR(f.normal.dot(f.tangent), 0.0, 1e-12);
    ASSERT_LT((f.tangent.cross(f.normal) - f.binormal).norm(), 1e-12);
  }
}

// How far the last frame is from the closed form: against Frenet it has turned by minus the integral of the
// torsion.
double helix_error(int pieces) {
  const Helix helix;
  const double turns = 1.5 * 2.0 * pi;
  std::vector<Vec3> points, tangent;
  for (int i = 0; i <= pieces; ++i) {
    points.push_back(helix.point(turns * i / pieces));
    tangent.push_back(helix.tangent(turns * i / pieces));
  }
  const std::vector<Frame> frames = rotation_minimising_frames(points, tangent, helix.normal(0.0));
  expect_orthonormal(frames);
  const double arc = turns * std::hypot(helix.a, helix.b);
  const double torsion = helix.b / (helix.a * helix.a + helix.b * helix.b);
  const Vec3 t = helix.tangent(turns), n = helix.normal(turns);
  const Vec3 expected = Eigen::AngleAxisd(-torsion * arc, t) * n;
  const Vec3 got = frames.back().normal;
  return std::atan2(expected.cross(got).dot(t), expected.dot(got));
}

TEST(Frame, HelixTurnsAgainstFrenetByTheTorsionToFourthOrder) {
  const double coarse = std::abs(helix_error(50)), fine = std::abs(helix_error(100)),
               finer = std::abs(helix_error(200));
  EXPECT_LT(coarse, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.15);
  EXPECT_NEAR(std::log2(fine / finer), 4.0, 0.15);
}

TEST(Frame, PlanarCurveWithInflectionKeepsItsBinormal) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 200; ++i) points.emplace_back(0.2 * i, 5.0 * std::sin(0.05 * pi * i), 0.0);
  const std::vector<Frame> frames = rotation_minimising_frames(points);
  expect_orthonormal(frames);
  // The root's normal is +z, and nothing in the plane turns it.
  for (const Frame& f : frames) EXPECT_LT((f.normal - Vec3::UnitZ()).norm(), 1e-12);
}

TEST(Frame, InPlaneNormalDoesNotFlipAtAnInflection) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 400; ++i) points.emplace_back(0.1 * i, 5.0 * std::sin(0.025 * pi * i), 0.0);
  const std::vector<Vec3> t = tangents(points);
  const std::vector<Frame> frames = rotation_minimising_frames(points, t, Vec3::UnitY());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Vec3 left = Vec3::UnitZ().cross(t[i]);
    EXPECT_GT(frames[i].normal.dot(left), 1.0 - 1e-12) << "at " << i;
  }
}

TEST(Frame, StraightLineKeepsItsFrame) {
  std::vector<Vec3> points;
  for (int i = 0; i < 20; ++i) points.push_back(0.3 * i * Vec3(1, 2, -2) / 3.0);
  const std::vector<Frame> frames = rotation_minimising_frames(points);
  for (const Frame& f : frames) EXPECT_LT((f.normal - frames.front().normal).norm(), 1e-12);
}

TEST(Frame, InitialNormalIsZProjectedOrXAlongZ) {
  EXPECT_LT((initial_normal(Vec3::UnitX()) - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((initial_normal(-Vec3::UnitZ()) - Vec3::UnitX()).norm(), 1e-15);
  const Vec3 oblique = initial_normal(Vec3(1, 0, 1));
  EXPECT_LT((oblique - Vec3(-1, 0, 1).normalized()).norm(), 1e-15);
}

TEST(Frame, TangentsOfACircleAreSecondOrder) {
  const auto error = [](int n) {
    std::vector<Vec3> points;
    for (int i = 0; i <= n; ++i) {
      const double angle = pi * i / n;
      points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    }
    const std::vector<Vec3> t = tangents(points);
    double worst = 0.0;
    for (int i = 0; i <= n; ++i) {
      const double angle = pi * i / n;
      worst = std::max(worst,
                       (t[static_cast<std::size_t>(i)] - Vec3(-std::sin(angle), std::cos(angle), 0)).norm());
    }
    return worst;
  };
  EXPECT_LT(error(100), 1e-3);
  EXPECT_GT(error(50) / error(100), 3.5);
}

TEST(Frame, TangentsOfUnevenStepsAreSecondOrder) {
  // Steps that alternate 1:2 along a circle: a plain central difference would be first order only.
  const auto error = [](double h) {
    std::vector<Vec3> points;
    std::vector<double> angles;
    double angle = 0.0;
    for (int i = 0; angle < 2.0; ++i) {
      angles.push_back(angle);
      points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
      angle += i % 2 == 0 ? h : 2.0 * h;
    }
    const std::vector<Vec3> t = tangents(points);
    double worst = 0.0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      worst = std::max(worst, (t[i] - Vec3(-std::sin(angles[i]), std::cos(angles[i]), 0)).norm());
    }
    return worst;
  };
  EXPECT_GT(error(0.02) / error(0.01), 3.5);
}

TEST(Frame, RefusesBadInput) {
  const std::vector<Vec3> twice{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitX()};
  EXPECT_THROW(tangents({Vec3::Zero()}), InvalidInput);
  EXPECT_THROW(tangents(twice), InvalidInput);
  EXPECT_THROW(rotation_minimising_frames(twice), InvalidInput);
  EXPECT_THROW(rotation_minimising_frames(twice, {3, Vec3::UnitX()}, Vec3::UnitY()), InvalidInput);
  const std::vector<Vec3> line{Vec3::Zero(), Vec3::UnitX()};
  EXPECT_THROW(rotation_minimising_frames(line, {Vec3::UnitX()}, Vec3::UnitY()), InvalidInput);
  EXPECT_THROW(rotation_minimising_frames(line, {2, Vec3::UnitX()}, Vec3::UnitX()), InvalidInput);
}

// Seen by one who looks along +z with +x to his right, up is -y: counter-clockwise leads from +x to -y.
TEST(Frame, TheAngleAcrossAVesselGrowsCounterClockwiseLookingDistally) {
  const Frame frame{Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  EXPECT_LT((radial_direction(frame, 0.0) - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LT((radial_direction(frame, pi / 2.0) + Vec3::UnitY()).norm(), 1e-15);
  for (const double theta : {-3.0, -1.2, 0.0, 0.7, 2.9})
    EXPECT_NEAR(angle_of(frame, 2.5 * radial_direction(frame, theta) + 7.0 * Vec3::UnitZ()), theta, 1e-14);
  EXPECT_EQ(angle_of(frame, Vec3::UnitZ()), 0.0);
}

TEST(Frame, AFrameBetweenTwoOthersIsOrthonormalAndTurnsEvenly) {
  const Frame a{Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  const Vec3 t = Vec3(0.1, 0.2, 1.0).normalized();
  const Vec3 n = (Vec3(0.98, 0.1, 0.0) - t * t.dot(Vec3(0.98, 0.1, 0.0))).normalized();
  const Frame b{t, n, t.cross(n)};
  expect_orthonormal({interpolated(a, b, 0.0), interpolated(a, b, 0.3), interpolated(a, b, 1.0)});
  EXPECT_LT((interpolated(a, b, 0.0).normal - a.normal).norm(), 1e-12);
  EXPECT_LT((interpolated(a, b, 1.0).normal - b.normal).norm(), 1e-12);
}

}  // namespace
}  // namespace ostia::geometry
