// Curvatures of shapes that have closed forms.

#include "ostia/evaluation/surface_shape.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace ostia::evaluation {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

using std::numbers::pi;

/// A grid of m x n points on a torus, outward.
TriMesh torus(double ring, double radius, int m, int n) {
  TriMesh mesh;
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < n; ++j) {
      const double a = 2.0 * pi * i / m, b = 2.0 * pi * j / n;
      const double rho = ring + radius * std::cos(b);
      mesh.points.emplace_back(rho * std::cos(a), rho * std::sin(a), radius * std::sin(b));
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::int32_t>((i % m) * n + j % n); };
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < n; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// An open cylinder along z, outward.
TriMesh cylinder(double radius, double length, int around, int along) {
  TriMesh mesh;
  for (int k = 0; k <= along; ++k)
    for (int i = 0; i < around; ++i)
      mesh.points.emplace_back(radius * std::cos(2.0 * pi * i / around),
                               radius * std::sin(2.0 * pi * i / around), length * k / along);
  const auto at = [&](int i, int k) { return static_cast<std::int32_t>(k * around + i % around); };
  for (int k = 0; k < along; ++k) {
    for (int i = 0; i < around; ++i) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return mesh;
}

/// An octahedron, each triangle cut in four and its points put on the sphere, `times` times.
TriMesh sphere(double radius, int times) {
  TriMesh mesh{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
               {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < times; ++level) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [place, fresh] =
          middles.emplace(std::minmax(a, b), static_cast<std::int32_t>(mesh.points.size()));
      if (fresh)
        mesh.points.push_back(
            (mesh.points[static_cast<std::size_t>(a)] + mesh.points[static_cast<std::size_t>(b)])
                .normalized());
      return place->second;
    };
    std::vector<geometry::Triangle> finer;
    for (const auto& t : mesh.triangles) {
      const std::int32_t a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
    }
    mesh.triangles = finer;
  }
  for (Vec3& p : mesh.points) p *= radius;
  return mesh;
}

TEST(SurfaceShape, ASphereIsEverywhereAsRound) {
  const SurfaceShape shape = shape_of(sphere(2.5, 6));
  EXPECT_TRUE(shape.closed);
  EXPECT_NEAR(shape.rms_kappa1, 0.4, 0.4e-3);
  EXPECT_NEAR(shape.rms_kappa2, 0.4, 0.4e-3);
  EXPECT_NEAR(shape.rms_curvature, 0.4 * std::sqrt(2.0), 0.4e-3);
  EXPECT_NEAR(shape.area_mm2, 4.0 * pi * 2.5 * 2.5, 1e-3 * shape.area_mm2);
  EXPECT_NEAR(shape.volume_mm3, 4.0 / 3.0 * pi * std::pow(2.5, 3), 1e-3 * shape.volume_mm3);
  EXPECT_EQ(shape.vertices_left_out, 0u);
}

TEST(SurfaceShape, ACylinderBendsOneWay) {
  const TriMesh mesh = cylinder(1.5, 10.0, 160, 170);
  const SurfaceShape shape = shape_of(mesh);
  EXPECT_FALSE(shape.closed);
  EXPECT_TRUE(std::isnan(shape.volume_mm3));
  EXPECT_EQ(shape.vertices_left_out, 320u) << "both borders";
  EXPECT_NEAR(shape.rms_kappa1, 1.0 / 1.5, 1e-3 / 1.5);
  EXPECT_NEAR(shape.rms_kappa2, 0.0, 1e-3 / 1.5);
}

TEST(SurfaceShape, ATorusBulgesOutsideAndIsASaddleInside) {
  constexpr double ring = 5.0, radius = 2.0;
  const TriMesh mesh = torus(ring, radius, 400, 160);
  const std::vector<PrincipalCurvatures> all = curvatures(mesh);
  EXPECT_NEAR(all[0].kappa1, 1.0 / radius, 1e-3);
  EXPECT_NEAR(all[0].kappa2, 1.0 / (ring + radius), 1e-3);
  EXPECT_NEAR(all[80].kappa2, -1.0 / (ring - radius), 1e-3) << "the inner equator";
  // Mean square of cos b / (R + r cos b), weighted by (R + r cos b):
  // the integral of cos^2 b / (R + r cos b) over b, by the residue of its antiderivative.
  const double integral =
      2.0 * pi * ring / (radius * radius) * (ring / std::sqrt(ring * ring - radius * radius) - 1.0);
  const double exact = std::sqrt(integral / (2.0 * pi * ring));
  const SurfaceShape shape = shape_of(mesh);
  EXPECT_NEAR(shape.rms_kappa1, 1.0 / radius, 1e-3 / radius);
  EXPECT_NEAR(shape.rms_kappa2, exact, 1e-3 * exact);
}

TEST(SurfaceShape, TurnedInsideOutTheSignsTurn) {
  TriMesh mesh = sphere(2.0, 4);
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  for (const PrincipalCurvatures& c : curvatures(mesh)) EXPECT_NEAR(c.kappa2, -0.5, 0.01);
}

TEST(SurfaceShape, RefusesWhatIsNoSurface) {
  EXPECT_THROW(shape_of({}), InvalidInput);
  TriMesh bad = sphere(1.0, 1);
  bad.points[3].x() = std::nan("");
  EXPECT_THROW(shape_of(bad), InvalidInput);
  const SurfaceShape one = shape_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  EXPECT_EQ(one.vertices_left_out, 3u);
  EXPECT_TRUE(std::isnan(one.rms_curvature));
}

TEST(SurfaceShape, CanBeCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(shape_of(sphere(1.0, 3), task), Cancelled);
}

}  // namespace
}  // namespace ostia::evaluation
