#include "surface_checks.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

using std::numbers::pi;
using test::expect_closed_manifold;
using test::topology_of;

double largest_distance(const AnalyticShape& shape, const TriMesh& mesh) {
  const TubeDistance f(shape);
  double largest = 0.0;
  for (const Vec3& p : mesh.points) largest = std::max(largest, std::abs(f(p)));
  return largest;
}

// The least cosine between a triangle's normal and the outward direction there: below 0 it is folded over.
double least_cosine(const AnalyticShape& shape, const TriMesh& mesh) {
  const TubeDistance f(shape);
  double least = 1.0;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t c) { return mesh.points[static_cast<std::size_t>(t[c])]; };
    const Vec3 centre = (at(0) + at(1) + at(2)) / 3.0;
    const Vec3 out = (centre - f.nearest(centre).axis_point).normalized();
    least = std::min(least, (at(1) - at(0)).cross(at(2) - at(0)).normalized().dot(out));
  }
  return least;
}

struct End {
  Vec3 centre, outward;
  double radius;
};

// Each border vertex lies on the plane of one end (and on the surface when exact); loops as many as ends.
void expect_clean_ends(const AnalyticShape& shape, const TriMesh& mesh, const std::vector<End>& ends,
                       double on_surface) {
  const test::Topology t = topology_of(mesh);
  EXPECT_EQ(t.border_loops, ends.size());
  EXPECT_EQ(t.repeated_half_edges, 0u);
  EXPECT_EQ(t.pinched_vertices, 0u);
  EXPECT_EQ(t.euler, 2 - static_cast<long>(ends.size()));
  EXPECT_GT(t.smallest_area, 0.0);
  const TubeDistance f(shape);
  const auto loops = boundary_loops(mesh);
  ASSERT_EQ(loops.size(), ends.size());
  std::vector<int> met(ends.size(), 0);
  for (const auto& loop : loops) {
    const Vec3& first = mesh.points[static_cast<std::size_t>(loop.front())];
    std::size_t nearest = 0;
    for (std::size_t e = 0; e < ends.size(); ++e) {
      if ((first - ends[e].centre).norm() < (first - ends[nearest].centre).norm()) nearest = e;
    }
    const End& end = ends[nearest];
    ++met[nearest];
    double perimeter = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3& p = mesh.points[static_cast<std::size_t>(loop[i])];
      EXPECT_NEAR((p - end.centre).dot(end.outward), 0.0, 1e-10);
      EXPECT_NEAR((p - end.centre).norm(), end.radius, 0.02 + on_surface);
      EXPECT_NEAR(f(p), 0.0, on_surface);
      perimeter += (mesh.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])] - p).norm();
    }
    EXPECT_NEAR(perimeter, 2.0 * pi * end.radius, 0.06 * end.radius);  // once around, without detours
  }
  for (const int count : met) EXPECT_EQ(count, 1);
}

End start_of(const AnalyticTube& tube) {
  return {tube.axis.points.front(), -tube.axis.frames.front().tangent, tube.axis.radius.front()};
}
End end_of(const AnalyticTube& tube) {
  return {tube.axis.points.back(), tube.axis.frames.back().tangent, tube.axis.radius.back()};
}

TEST(SurfaceOf, ClosedTubeIsExactAndHasItsVolume) {
  const AnalyticShape shape = straight_tube(20.0, 1.5);
  const TriMesh mesh = surface_of(shape, 0.2, false);
  expect_closed_manifold(mesh, 2);
  EXPECT_LT(largest_distance(shape, mesh), 1e-9);
  EXPECT_GT(least_cosine(shape, mesh), 0.5);
  const double exact = pi * 2.25 * 20.0 + 4.0 / 3.0 * pi * 3.375;
  EXPECT_NEAR(test::volume_of(mesh), exact, 0.005 * exact);
}

TEST(SurfaceOf, TorusHasItsAreaVolumeAndNoEnds) {
  const AnalyticShape shape = torus(8.0, 2.0);
  const TriMesh mesh = surface_of(shape, 0.4, true);
  expect_closed_manifold(mesh, 0);
  EXPECT_LT(largest_distance(shape, mesh), 1e-9);
  EXPECT_GT(least_cosine(shape, mesh), 0.5);
  EXPECT_NEAR(test::area_of(mesh), 4.0 * pi * pi * 16.0, 0.005 * 4.0 * pi * pi * 16.0);
  EXPECT_NEAR(test::volume_of(mesh), 2.0 * pi * pi * 8.0 * 4.0, 0.01 * 2.0 * pi * pi * 32.0);
}

TEST(SurfaceOf, OpenEndsAreFlatRoundAndClean) {
  struct Case {
    const char* name;
    AnalyticShape shape;
  };
  const std::vector<Case> cases{{"tube", straight_tube(8.0, 1.5)},
                                {"taper", tapered_tube(10.0, 2.0, 1.2)},
                                {"helix", helix_tube(10.0, 15.0, 0.2, 1.2)},
                                {"stenosis", stenosed_tube(20.0, 1.5, 0.6, 10.0, 8.0)}};
  for (const Case& c : cases) {
    for (const double spacing : {0.31, 0.23}) {
      SCOPED_TRACE(c.name);
      const AnalyticTube& tube = c.shape.tubes[0];
      const TriMesh mesh = surface_of(c.shape, spacing, true);
      EXPECT_LT(largest_distance(c.shape, mesh), 1e-9);
      EXPECT_GT(least_cosine(c.shape, mesh), 0.5);
      expect_clean_ends(c.shape, mesh, {start_of(tube), end_of(tube)}, 1e-9);
      const TriMesh closed = surface_of(c.shape, spacing, false);
      EXPECT_GT(test::smallest_angle_deg(mesh), 0.6 * test::smallest_angle_deg(closed));
    }
  }
}

TEST(SurfaceOf, OpenTubeHasTheAreaOfItsSide) {
  const TriMesh mesh = surface_of(straight_tube(20.0, 1.5), 0.15, true);
  EXPECT_NEAR(test::area_of(mesh), 2.0 * pi * 1.5 * 20.0, 0.003 * 2.0 * pi * 1.5 * 20.0);
}

TEST(SurfaceOf, YJunctionHasThreeEndsAndNoneAtTheBifurcation) {
  const AnalyticShape shape = y_junction(10.0, 15.0, 1.5, 1.1, 60.0);
  const TriMesh mesh = surface_of(shape, 0.25, true);
  EXPECT_LT(largest_distance(shape, mesh), 1e-9);
  expect_clean_ends(shape, mesh, {start_of(shape.tubes[0]), end_of(shape.tubes[1]), end_of(shape.tubes[2])},
                    1e-9);
  EXPECT_EQ(find_faults(mesh, true).self_intersections, 0u);
}

TEST(SurfaceOf, CoronaryLikeTreeIsTheSizeOfARealSurface) {
  const AnalyticShape shape = coronary_like_tree();
  const TriMesh mesh = surface_of(shape, 0.25, true);
  EXPECT_GT(mesh.triangles.size(), 50000u);
  EXPECT_LT(mesh.triangles.size(), 70000u);
  EXPECT_LT(largest_distance(shape, mesh), 1e-9);
  std::vector<End> ends{start_of(shape.tubes[0])};
  for (const AnalyticTube& tube : shape.tubes) ends.push_back(end_of(tube));
  expect_clean_ends(shape, mesh, ends, 1e-9);
  const SurfaceFaults faults = find_faults(mesh, true);
  EXPECT_EQ(faults.self_intersections, 0u) << faults.summary();
  EXPECT_EQ(faults.components, 1u);
}

TEST(RawSurfaceOf, IsOffBySecondOrderAndHasNeedles) {
  const AnalyticShape shape = helix_tube(10.0, 15.0, 0.3, 1.2);
  const TubeDistance f(shape);
  const TriMesh coarse = raw_surface_of(shape, 0.4, true), fine = raw_surface_of(shape, 0.2, true);
  const auto mean = [&](const TriMesh& mesh) {
    double sum = 0.0;
    for (const Vec3& p : mesh.points) sum += std::abs(f(p));
    return sum / static_cast<double>(mesh.points.size());
  };
  EXPECT_NEAR(mean(coarse) / mean(fine), 4.0, 0.8);
  EXPECT_LT(test::smallest_angle_deg(fine), 1.0);
  const AnalyticTube& tube = shape.tubes[0];
  expect_clean_ends(shape, fine, {start_of(tube), end_of(tube)}, 0.03);
}

TEST(StructuredSurface, LiesOnTheTubeWithOpenEnds) {
  const AnalyticShape shape = stenosed_tube(30.0, 1.5, 0.6, 15.0, 8.0);
  const TriMesh mesh = structured_surface(shape.tubes[0], 24, 0.5);
  EXPECT_EQ(mesh.points.size(), 24u * 61u);
  EXPECT_EQ(mesh.triangles.size(), 2u * 24u * 60u);
  EXPECT_LT(largest_distance(shape, mesh), 1e-9);
  EXPECT_GT(least_cosine(shape, mesh), 0.9);
  const test::Topology t = topology_of(mesh);
  EXPECT_EQ(t.border_loops, 2u);
  EXPECT_EQ(t.border_half_edges, 48u);
  EXPECT_EQ(t.repeated_half_edges, 0u);
  EXPECT_EQ(t.euler, 0);
}

TEST(StructuredSurface, ClosedAxisClosesTheSurface) {
  const AnalyticShape shape = torus(8.0, 2.0);
  const TriMesh mesh = structured_surface(shape.tubes[0], 32, 0.3);
  expect_closed_manifold(mesh, 0);
  EXPECT_LT(largest_distance(shape, mesh), 1e-9);
  EXPECT_NEAR(test::volume_of(mesh), 2.0 * pi * pi * 8.0 * 4.0, 0.02 * 2.0 * pi * pi * 32.0);
}

TEST(AnalyticSurfaces, RefuseSenselessSizes) {
  const AnalyticShape shape = straight_tube(5.0, 1.0);
  EXPECT_THROW(surface_of(shape, 0.0, true), InvalidInput);
  EXPECT_THROW(raw_surface_of(shape, -0.1, true), InvalidInput);
  EXPECT_THROW(structured_surface(shape.tubes[0], 2, 0.1), InvalidInput);
  EXPECT_THROW(structured_surface(shape.tubes[0], 12, 0.0), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
