#include "ostia/meshing/poisson_surface.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace ostia::meshing {
namespace {

using geometry::AnalyticShape;
using geometry::TriMesh;
using geometry::Vec3;

struct Samples {
  std::vector<Vec3> points, normals;
};

/// Spread evenly over a sphere about the origin (a Fibonacci spiral), with the exact normals.
Samples on_sphere(double radius, int count, const Vec3& centre = Vec3::Zero()) {
  Samples samples;
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / count, r = std::sqrt(1.0 - z * z);
    const Vec3 n(r * std::cos(turn * i), r * std::sin(turn * i), z);
    samples.points.push_back(centre + radius * n);
    samples.normals.push_back(n);
  }
  return samples;
}

/// Closed, outward and free of crossings, in so many parts.
void expect_sound(const TriMesh& mesh, std::size_t parts) {
  const geometry::SurfaceFaults faults = geometry::find_faults(mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.self_intersections, 0U);
  EXPECT_EQ(faults.components, parts);
  EXPECT_GT(geometry::volume(mesh), 0.0);
}

double rms_from_sphere(const std::vector<Vec3>& points, double radius) {
  double squares = 0.0;
  for (const Vec3& p : points) squares += std::pow(p.norm() - radius, 2);
  return std::sqrt(squares / static_cast<double>(points.size()));
}

// Few points and evenly spread ones, too: their hull is all there is of space, and nothing beyond it.
TEST(PoissonSurface, OfASphereIsThatSphere) {
  for (const int count : {500, 1000, 4000}) {
    const Samples samples = on_sphere(5.0, count);
    const TriMesh mesh = poisson_surface(samples.points, samples.normals);
    expect_sound(mesh, 1);
    const double spacing = std::sqrt(4.0 * std::numbers::pi * 25.0 / count);
    EXPECT_LT(rms_from_sphere(mesh.points, 5.0), 0.12 * spacing) << count;
    EXPECT_NEAR(geometry::volume(mesh), 4.0 / 3.0 * std::numbers::pi * 125.0, 8.0) << count;
  }
}

// A surface through the points follows their errors, this one evens them out.
TEST(PoissonSurface, IsNearerToTheTruthThanNoisyPoints) {
  Samples samples = on_sphere(5.0, 4000);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.1);
  for (std::size_t i = 0; i < samples.points.size(); ++i)
    samples.points[i] += noise(random) * samples.normals[i];
  const TriMesh mesh = poisson_surface(samples.points, samples.normals);
  expect_sound(mesh, 1);
  EXPECT_LT(rms_from_sphere(mesh.points, 5.0), 0.6 * rms_from_sphere(samples.points, 5.0));
}

TEST(PoissonSurface, OfThinBranchesKeepsThemAll) {
  const AnalyticShape shape = geometry::coronary_like_tree();
  const TriMesh given = geometry::surface_of(shape, 0.45, false);
  const TriMesh mesh = poisson_surface(given);
  expect_sound(mesh, 1);
  const geometry::TubeDistance distance(shape);
  double squares = 0.0;
  for (const Vec3& p : mesh.points) squares += std::pow(distance(p), 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(mesh.points.size())), 0.06);
  for (const Vec3& p : given.points) {  // and nothing of it is missing
    double nearest = std::numeric_limits<double>::infinity();
    if (static_cast<std::size_t>(&p - given.points.data()) % 97 != 0) continue;
    for (const Vec3& q : mesh.points) nearest = std::min(nearest, (p - q).norm());
    EXPECT_LT(nearest, 0.3);
  }
}

TEST(PoissonSurface, KeepsPartsThatAreFarApart) {
  Samples samples = on_sphere(5.0, 3000);
  const Samples small = on_sphere(0.8, 200, Vec3(40.0, 3.0, -7.0));
  samples.points.insert(samples.points.end(), small.points.begin(), small.points.end());
  samples.normals.insert(samples.normals.end(), small.normals.begin(), small.normals.end());
  const TriMesh mesh = poisson_surface(samples.points, samples.normals, {0.25, 3});
  expect_sound(mesh, 2);
}

TEST(PoissonSurface, IsTheSameEachTime) {
  const Samples samples = on_sphere(5.0, 1000);
  const TriMesh a = poisson_surface(samples.points, samples.normals);
  const TriMesh b = poisson_surface(samples.points, samples.normals);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(PoissonSurface, SmallerCellsGiveMoreTriangles) {
  const Samples samples = on_sphere(5.0, 1000);
  const auto count = [&](double cell) {
    return static_cast<double>(poisson_surface(samples.points, samples.normals, {cell, 4}).triangles.size());
  };
  EXPECT_NEAR(count(0.25) / count(0.5), 4.0, 0.3);
}

TEST(PoissonSurface, RefusesWhatBoundsNoSolid) {
  Samples samples = on_sphere(5.0, 100);
  EXPECT_THROW(poisson_surface(std::vector<Vec3>{}, std::vector<Vec3>{}), InvalidInput);
  EXPECT_THROW(poisson_surface(samples.points, std::vector<Vec3>{}), InvalidInput);
  EXPECT_THROW(poisson_surface(samples.points, samples.normals, {-1.0, 3}), InvalidInput);
  EXPECT_THROW(poisson_surface(samples.points, samples.normals, {0.5, 0}), InvalidInput);
  EXPECT_THROW(poisson_surface(samples.points, samples.normals, {1e-4, 3}), InvalidInput);
  Samples flat = samples;
  for (Vec3& p : flat.points) p.z() = 1.0;
  EXPECT_THROW(poisson_surface(flat.points, flat.normals), InvalidInput);
  Samples broken = samples;
  broken.normals[7].setZero();
  EXPECT_THROW(poisson_surface(broken.points, broken.normals), InvalidInput);
  broken = samples;
  broken.points[7].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(poisson_surface(broken.points, broken.normals), InvalidInput);
}

TEST(PoissonSurface, CanBeCancelled) {
  const Samples samples = on_sphere(5.0, 500);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(poisson_surface(samples.points, samples.normals, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
