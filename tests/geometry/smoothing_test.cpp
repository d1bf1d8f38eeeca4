#include "ostia/geometry/smoothing.h"

#include "test_meshes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::geometry {
namespace {

using std::numbers::pi;

TriMesh noisy_sphere(double noise) {
  TriMesh mesh = test::icosphere(5);
  const auto moves = test::random_points(mesh.points.size(), noise, 1);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) mesh.points[p] *= 1.0 + moves[p].x();
  return mesh;
}

double roughness(const TriMesh& mesh) {
  double sum = 0.0, squares = 0.0;
  for (const Vec3& p : mesh.points) {
    sum += p.norm();
    squares += p.squaredNorm();
  }
  const auto n = static_cast<double>(mesh.points.size());
  return std::sqrt(std::max(0.0, squares / n - (sum / n) * (sum / n)));
}

TEST(Taubin, NoiseFallsAndTheSphereKeepsItsVolume) {
  const TriMesh noisy = noisy_sphere(0.02);
  const TriMesh smooth = taubin_smoothed(noisy);
  EXPECT_LT(roughness(smooth), 0.4 * roughness(noisy));
  EXPECT_NEAR(volume(smooth), 4.0 / 3.0 * pi, 0.01 * 4.0 / 3.0 * pi);
  EXPECT_EQ(smooth.triangles, noisy.triangles);
}

TEST(Taubin, GainOfAWaveOnARingIsTheTransferFunction) {
  // Points of a tube's inner rings see the neighbours of a regular lattice; a wave along the tube, with
  // k = 1 - mean over the neighbours of the phase's cosine, must shrink by ((1 - lambda k)(1 - mu k))^n.
  const int around = 64, rings = 201;
  TriMesh mesh = test::tube(around, rings, 1.0, 20.0);
  const double phase = pi / 5;
  const auto ring_of = [&](std::size_t p) { return static_cast<double>(p / around); };
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    mesh.points[p].z() += 1e-3 * std::sin(phase * ring_of(p));
  TaubinOptions options;
  options.iterations = 5;
  const TriMesh smooth = taubin_smoothed(mesh, options);
  // Of six neighbours two lie on the same ring, two on each ring beside it.
  const double k = 1.0 - (2.0 + 4.0 * std::cos(phase)) / 6.0;
  const double mu = 1.0 / (options.pass_band - 1.0 / options.lambda);
  const double gain = std::pow((1.0 - options.lambda * k) * (1.0 - mu * k), options.iterations);
  for (std::size_t p = 60 * around; p < 140 * around; p += 37) {
    const double height = 20.0 * ring_of(p) / (rings - 1);
    ASSERT_NEAR(smooth.points[p].z() - height, gain * 1e-3 * std::sin(phase * ring_of(p)), 1e-9);
  }
}

TEST(Taubin, BorderStays) {
  TriMesh mesh = test::tube(20, 10);
  const auto moves = test::random_points(mesh.points.size(), 0.05, 2);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) mesh.points[p] += moves[p];
  mesh.points.emplace_back(9, 9, 9);
  const TriMesh smooth = taubin_smoothed(mesh);
  for (std::size_t p = 0; p < 20; ++p) {
    EXPECT_EQ(smooth.points[p], mesh.points[p]);
    EXPECT_EQ(smooth.points[180 + p], mesh.points[180 + p]);
    EXPECT_NE(smooth.points[80 + p], mesh.points[80 + p]);
  }
  EXPECT_EQ(smooth.points.back(), Vec3(9, 9, 9));
}

TEST(Taubin, NoIterationsChangeNothingAndThreadsDoNotMatter) {
  const TriMesh noisy = noisy_sphere(0.02);
  TaubinOptions none;
  none.iterations = 0;
  EXPECT_EQ(taubin_smoothed(noisy, none).points, noisy.points);
  core::set_max_threads(1);
  const TriMesh one = taubin_smoothed(noisy);
  core::set_max_threads(0);
  EXPECT_EQ(taubin_smoothed(noisy).points, one.points);
}

TEST(Taubin, ReportsProgressAndObeysCancel) {
  const core::TaskContext task;
  taubin_smoothed(noisy_sphere(0.01), {}, task);
  EXPECT_EQ(task.progress(), 1.0);
  task.cancel();
  EXPECT_THROW(taubin_smoothed(noisy_sphere(0.01), {}, task), Cancelled);
}

TEST(Taubin, RefusesBadOptionsAndPoints) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(validate(TaubinOptions{}));
  EXPECT_NO_THROW(validate(TaubinOptions{10, 0.1, 0.6307}));
  EXPECT_THROW(validate(TaubinOptions{-1, 0.1, 0.33}), InvalidInput);
  EXPECT_THROW(validate(TaubinOptions{1, 0.0, 0.33}), InvalidInput);
  EXPECT_THROW(validate(TaubinOptions{1, 2.0, 0.33}), InvalidInput);
  EXPECT_THROW(validate(TaubinOptions{1, nan, 0.33}), InvalidInput);
  EXPECT_THROW(validate(TaubinOptions{1, 0.1, 0.0}), InvalidInput);
  EXPECT_THROW(validate(TaubinOptions{1, 0.1, 1.0}), InvalidInput);
  EXPECT_THROW(validate(TaubinOptions{1, 0.1, 0.95}), InvalidInput);  // the roughest ripple would grow
  EXPECT_THROW(validate(TaubinOptions{1, 1.9, 0.6}), InvalidInput);   // no inflating step exists
  TriMesh mesh = test::icosphere(1);
  mesh.points[3].x() = nan;
  EXPECT_THROW(taubin_smoothed(mesh), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
