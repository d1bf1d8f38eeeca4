#include "cage_system.h"

#include "moved_tree.h"
#include "registration_parts.h"

#include <gtest/gtest.h>

#include <random>

namespace ostia::motion {
namespace {

using geometry::Vec3;

struct Sample {
  geometry::TriMesh source = geometry::surface_of(geometry::coronary_like_tree(), 1.2, false);
  geometry::TriMesh target = testing::moved(source, 0.3);
  geometry::CageGrid grid = geometry::cage_around(source.points, 2);
  std::vector<Vec3> points = rest_points(grid);
  std::vector<SurfacePair> pairs;

  Sample() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-0.5, 0.5);
    for (Vec3& p : points) p += Vec3(unit(random), unit(random), unit(random));
    const auto places = cage_points(grid, source.points);
    pairs = vertex_pairs(carried_mesh(source, places, grid, points), places, PairingVertices(target), 60.0);
  }
};

// Distances alone, along normals mostly, with the energy and without.
TEST(CageSystem, ItsGradientIsThatOfItsEnergy) {
  const Sample s;
  for (const CageCost& cost :
       {CageCost{{}, true, 2.0, 1.0}, CageCost{{}, true, 2.0, 0.05}, CageCost{{}, false, 2.0, 1.0}}) {
    const CageSystem system(s.grid, s.source, cost);
    const std::vector<Vec3> gradient = system.gradient(s.points, s.pairs);
    double largest = 0.0;
    for (const Vec3& g : gradient) largest = std::max(largest, g.norm());
    for (std::size_t p = 0; p < s.points.size(); p += 7)
      for (int axis = 0; axis < 3; ++axis) {
        constexpr double step = 1e-4;
        std::vector<Vec3> more = s.points, less = s.points;
        more[p][axis] += step;
        less[p][axis] -= step;
        const double difference =
            (system.energy(more, s.pairs) - system.energy(less, s.pairs)) / (2.0 * step);
        EXPECT_NEAR(gradient[p][axis], difference, 1e-5 * largest);
      }
  }
}

// Of a quadratic function: twice what a step along any direction adds, by the step's square.
TEST(CageSystem, NoDirectionIsCurvedMoreThanItsBound) {
  const Sample s;
  const CageSystem system(s.grid, s.source, {{}, false, 2.0, 1.0});
  const double bound = system.greatest_curvature(s.pairs);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const double before = system.energy(s.points, s.pairs);
  double closest = 0.0;
  for (int k = 0; k < 20; ++k) {
    std::vector<Vec3> direction(s.points.size()), moved = s.points;
    double squared = 0.0, slope = 0.0;
    const std::vector<Vec3> gradient = system.gradient(s.points, s.pairs);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      direction[i] = k == 0 ? gradient[i] : Vec3(normal(random), normal(random), normal(random));
      squared += direction[i].squaredNorm();
      slope += gradient[i].dot(direction[i]);
      moved[i] += direction[i];
    }
    const double curvature = 2.0 * (system.energy(moved, s.pairs) - before - slope) / squared;
    EXPECT_LE(curvature, bound);
    closest = std::max(closest, curvature / bound);
  }
  EXPECT_GT(closest, 0.05);
}

TEST(VertexPairs, AreTheClosestVerticesWhoseNormalsAgree) {
  const geometry::AnalyticShape tube = geometry::straight_tube(20.0, 2.0);
  const geometry::TriMesh source = geometry::structured_surface(tube.tubes[0], 24, 0.5);
  geometry::TriMesh target = source;
  for (Vec3& p : target.points) p += Vec3(0.0, 0.0, 0.1);
  const geometry::CageGrid grid = geometry::cage_around(source.points, 1);
  const auto places = cage_points(grid, source.points);
  for (const SurfacePair& pair : vertex_pairs(source, places, PairingVertices(target), 30.0)) {
    EXPECT_EQ(pair.weight, 1.0);
    EXPECT_NEAR(pair.distance, 0.1, 1e-9);
  }
  for (geometry::Triangle& t : target.triangles) std::swap(t[0], t[1]);
  for (const SurfacePair& pair : vertex_pairs(source, places, PairingVertices(target), 30.0))
    EXPECT_EQ(pair.weight, 0.0);
}

}  // namespace
}  // namespace ostia::motion
