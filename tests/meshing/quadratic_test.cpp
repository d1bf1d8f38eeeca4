// Elements of second order against truth: linear Jacobians, samples, cylinders, and volumes.
#include "ostia/meshing/quadratic.h"

#include "../io/mesh_export_meshes.h"
#include "mixed_shapes.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/mesh_export.h"
#include "ostia/meshing/mixed_quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>

namespace ostia::meshing {
namespace {

using geometry::MixedMesh;
using geometry::Vec3;

using std::numbers::pi;

TetrahedronNodes tilted_tetrahedron() {
  return straight(std::array<Vec3, 4>{Vec3(0.1, 0.2, 0.3), Vec3(1.3, 0.1, 0.2), Vec3(0.2, 1.1, 0.5),
                                      Vec3(0.4, 0.3, 1.7)});
}
PrismNodes tilted_prism() {
  return straight(std::array<Vec3, 6>{Vec3(0, 0, 0), Vec3(1.2, 0.1, 0.1), Vec3(0.2, 0.9, -0.1),
                                      Vec3(0.1, 0.1, 0.5), Vec3(1.1, 0.3, 0.7), Vec3(0.1, 1.2, 0.6)});
}
/// Nodes of the second order moved by up to `size`.
template <std::size_t N>
std::array<Vec3, N> bent(std::array<Vec3, N> nodes, std::size_t corners, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-size, size);
  for (std::size_t i = corners; i < N; ++i) nodes[i] += Vec3(move(random), move(random), move(random));
  return nodes;
}

/// Points within the reference tetrahedron, or prism.
std::vector<Vec3> samples(bool prism, std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Vec3> points;
  while (points.size() < count) {
    const Vec3 p(unit(random), unit(random), unit(random));
    if (prism ? p.x() + p.y() <= 1.0 : p.sum() <= 1.0) points.push_back(p);
  }
  return points;
}

TEST(QuadraticJacobian, OfAStraightTetrahedronIsTheLinearOne) {
  const TetrahedronNodes p = tilted_tetrahedron();
  const double det = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
  for (const double c : jacobian_coefficients(p)) EXPECT_NEAR(c, det, 1e-14);
  const JacobianBounds b = jacobian_bounds(p);
  EXPECT_NEAR(b.lower, det, 1e-14);
  EXPECT_NEAR(b.upper, det, 1e-14);
  EXPECT_NEAR(volume(p), det / 6.0, 1e-15);
}

TEST(QuadraticJacobian, OfAStraightPrismIsTheLinearOne) {
  const PrismNodes p = tilted_prism();
  const PrismCorners corners{p[0], p[1], p[2], p[3], p[4], p[5]};
  EXPECT_NEAR(volume(p), prism_volume(corners), 1e-14);
  const auto nine = prism_jacobian_coefficients(corners);
  // Corners have the same values; between them it is of degree 1 and 2.
  EXPECT_NEAR(jacobian(p, {0, 0, 0}), nine[0], 1e-14);
  EXPECT_NEAR(jacobian(p, {0, 1, 1}), nine[8], 1e-14);
  EXPECT_NEAR(jacobian(p, {1, 0, 0.5}), 0.25 * nine[1] + 0.5 * nine[4] + 0.25 * nine[7], 1e-14);
  const JacobianBounds b = jacobian_bounds(p);
  EXPECT_GE(b.lower, *std::min_element(nine.begin(), nine.end()) - 1e-14);
  EXPECT_LE(b.upper, *std::max_element(nine.begin(), nine.end()) + 1e-14);
}

/// The derivative of the position, by differences.
template <class Nodes>
double differenced_jacobian(const Nodes& nodes, const Vec3& uvw) {
  constexpr double step = 1e-5;
  Eigen::Matrix3d derivative;
  for (int k = 0; k < 3; ++k) {
    const Vec3 to = step * Vec3::Unit(k);
    derivative.col(k) = (position(nodes, uvw + to) - position(nodes, uvw - to)) / (2.0 * step);
  }
  return derivative.determinant();
}

TEST(QuadraticJacobian, PositionPassesThroughTheNodes) {
  const TetrahedronNodes t = bent(tilted_tetrahedron(), 4, 0.2, 1);
  const std::array<Vec3, 4> corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const TetrahedronNodes places = straight(corners);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_LE((position(t, places[i]) - t[i]).norm(), 1e-14) << i;
  const PrismNodes p = bent(tilted_prism(), 6, 0.2, 2);
  const PrismNodes at = straight(std::array<Vec3, 6>{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0),
                                                     Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1)});
  for (std::size_t i = 0; i < 18; ++i) EXPECT_LE((position(p, at[i]) - p[i]).norm(), 1e-14) << i;
  for (const Vec3& x : samples(false, 20)) EXPECT_NEAR(jacobian(t, x), differenced_jacobian(t, x), 1e-8);
  for (const Vec3& x : samples(true, 20)) EXPECT_NEAR(jacobian(p, x), differenced_jacobian(p, x), 1e-8);
}

template <class Nodes>
void expect_bounded(const Nodes& nodes, bool prism, std::size_t count) {
  const auto c = jacobian_coefficients(nodes);
  const auto [low, high] = std::minmax_element(c.begin(), c.end());
  const JacobianBounds b = jacobian_bounds(nodes);
  double least = 1e300, greatest = -1e300, mean = 0.0;
  for (const Vec3& x : samples(prism, count)) {
    const double j = jacobian(nodes, x);
    least = std::min(least, j);
    greatest = std::max(greatest, j);
    mean += j / static_cast<double>(count);
  }
  EXPECT_LE(*low, b.lower + 1e-12);
  EXPECT_LE(b.lower, least);
  EXPECT_GE(b.upper, greatest);
  EXPECT_GE(*high, b.upper - 1e-12);
  // The bounds are as near as promised, the mean is the volume's.
  double magnitude = 0.0;
  for (const double value : c) magnitude += std::abs(value) / static_cast<double>(c.size());
  EXPECT_LE(b.least - b.lower, 1e-3 * magnitude);
  EXPECT_LE(b.upper - b.greatest, 1e-3 * magnitude);
  EXPECT_LE(jacobian_lower_bound(nodes), b.least);
  EXPECT_NEAR(mean, volume(nodes) * (prism ? 2.0 : 6.0), 0.03 * magnitude);
}

TEST(QuadraticJacobian, CoefficientsBoundTenThousandSamples) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    expect_bounded(bent(tilted_tetrahedron(), 4, 0.05 + 0.05 * seed, seed), false, 10000);
    expect_bounded(bent(tilted_prism(), 6, 0.02 + 0.04 * seed, seed), true, 10000);
  }
}

/// Positive at all ten nodes, yet negative between them.
TetrahedronNodes deceiving_tetrahedron() {
  TetrahedronNodes nodes =
      straight(std::array<Vec3, 4>{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
  const std::array<Vec3, 6> moved{Vec3(-0.3, 0.1, 0.1),  Vec3(-0.1, 0.0, 0.4), Vec3(0.0, 0.1, -0.3),
                                  Vec3(0.1, -0.4, -0.5), Vec3(0.2, 0.1, 0.2),  Vec3(-0.2, 0.2, 0.0)};
  for (std::size_t i = 0; i < 6; ++i) nodes[4 + i] += moved[i];
  return nodes;
}

TEST(QuadraticJacobian, FindsWhatIsNegativeBetweenPositiveNodes) {
  const TetrahedronNodes nodes = deceiving_tetrahedron();
  const TetrahedronNodes places =
      straight(std::array<Vec3, 4>{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
  for (const Vec3& node : places) EXPECT_GE(jacobian(nodes, node), 0.19);
  const JacobianBounds b = jacobian_bounds(nodes);
  EXPECT_LT(b.least, -0.5);  // a value that it takes
  MixedMesh mesh;
  mesh.points.assign(nodes.begin(), nodes.end());
  mesh.tetrahedra = {{0, 1, 2, 3}};
  mesh.tetrahedron_nodes = {{4, 5, 6, 7, 8, 9}};
  EXPECT_EQ(mixed_quality(mesh).tetrahedra.inverted, 1u);
}

/// Coefficients that are negative though the Jacobian is not: only subdivision shows it.
TEST(QuadraticJacobian, SubdivisionShowsWhatCoefficientsDoNot) {
  int shown = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    const TetrahedronNodes nodes = bent(tilted_tetrahedron(), 4, 0.22, 1000 + seed);
    const auto c = jacobian_coefficients(nodes);
    const JacobianBounds b = jacobian_bounds(nodes);
    if (*std::min_element(c.begin(), c.end()) < 0.0 && b.lower > 0.0) ++shown;
  }
  EXPECT_GT(shown, 5);
}

/// Largest distance of the wall's points and nodes from the cylinder of radius 1.5.
double farthest_from_cylinder(const MixedMesh& mesh) {
  double farthest = 0.0;
  const auto look = [&](const auto& nodes) {
    for (const std::int32_t v : nodes) {
      const Vec3& p = mesh.points[static_cast<std::size_t>(v)];
      farthest = std::max(farthest, std::abs(std::hypot(p.x(), p.y()) - 1.5));
    }
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (mesh.triangle_face_ids[i] == 1) look(mesh.triangles[i]), look(mesh.triangle_nodes[i]);
  return farthest;
}

TEST(Quadratic, NodesOfATubesWallLieOnTheCylinder) {
  const geometry::TriMesh reference = cylinder_reference(1.5, 3.0);
  for (const int layers : {0, 3}) {
    SCOPED_TRACE(layers);
    const MixedMesh linear = filled_tube(16, layers, 0.5);
    const QuadraticMesh q = make_quadratic(linear, reference);
    EXPECT_LE(farthest_from_cylinder(q.mesh), 1.5e-9);
    EXPECT_EQ(q.report.on_reference, q.report.wall_nodes);
    EXPECT_EQ(q.report.moved_back + q.report.not_projected + q.report.inverted, 0u);
    EXPECT_GE(q.report.min_jacobian_ratio, 0.2);
    EXPECT_TRUE(q.report.warnings.empty());
    // Corners stay, caps stay flat.
    EXPECT_TRUE(std::equal(linear.points.begin(), linear.points.end(), q.mesh.points.begin()));
    for (std::size_t i = 0; i < q.mesh.triangles.size(); ++i)
      for (const std::int32_t node : q.mesh.triangle_nodes[i])
        if (q.mesh.triangle_face_ids[i] != 1) {
          const double z = q.mesh.points[static_cast<std::size_t>(node)].z();
          EXPECT_LE(std::min(std::abs(z), std::abs(z - 3.0)), 1e-12);
        }
    for (const auto& nodes : q.mesh.quad_nodes)
      for (const std::int32_t node : nodes) {
        const double z = q.mesh.points[static_cast<std::size_t>(node)].z();
        EXPECT_LE(std::min(std::abs(z), std::abs(z - 3.0)), 1e-12);
      }
    const MixedQuality quality = mixed_quality(q.mesh);
    EXPECT_EQ(quality.boundary_mismatches, 0u);
    EXPECT_EQ(quality.inverted(), 0u);
    EXPECT_NEAR(quality.volume_mm3(), q.report.volume_mm3, 1e-10);
    EXPECT_TRUE(check(quality).ok()) << check(quality).summary();
  }
}

TEST(Quadratic, TheVolumesErrorFallsWithTheFourthPowerOfTheEdge) {
  const geometry::TriMesh reference = cylinder_reference(1.5, 3.0);
  const double truth = pi * 1.5 * 1.5 * 3.0;
  std::vector<double> straight_errors, bent_errors;
  for (const std::int32_t around : {12, 24}) {
    const QuadraticMesh q = make_quadratic(filled_tube(around, 2, 0.4), reference);
    straight_errors.push_back(truth - q.report.straight_volume_mm3);
    bent_errors.push_back(std::abs(truth - q.report.volume_mm3));
  }
  // A polygon of n edges loses 2 pi^2 / (3 n^2) of the circle.
  EXPECT_NEAR(straight_errors[0], truth * 2.0 * pi * pi / (3.0 * 144.0), 0.03 * straight_errors[0]);
  EXPECT_NEAR(straight_errors[0] / straight_errors[1], 4.0, 0.1);
  EXPECT_GT(bent_errors[0] / bent_errors[1], 12.0);
  EXPECT_LT(bent_errors[0], 0.02 * straight_errors[0]);
}

/// Layers carry the curvature: in the middle of an edge a layer is as thick as at its ends, to a share.
TEST(Quadratic, LayersFollowTheWall) {
  const MixedMesh linear = filled_tube(10, 4, 0.12);  // all layers are thinner than the wall's bulge
  const QuadraticMesh q = make_quadratic(linear, cylinder_reference(1.5, 3.0));
  EXPECT_EQ(q.report.inverted, 0u);
  EXPECT_EQ(q.report.moved_back, 0u);
  double least = 1e300, most = 0.0;
  for (std::size_t i = 0; i < q.mesh.prisms.size(); ++i) {
    const PrismNodes nodes = prism_nodes(q.mesh, i);
    for (std::size_t e = 0; e < 3; ++e) {
      const double at_ends =
          0.5 * ((nodes[e + 3] - nodes[e]).norm() + (nodes[(e + 1) % 3 + 3] - nodes[(e + 1) % 3]).norm());
      const double in_the_middle = (nodes[9 + e] - nodes[6 + e]).norm();
      least = std::min(least, in_the_middle / at_ends);
      most = std::max(most, in_the_middle / at_ends);
    }
  }
  EXPECT_GE(least, 0.95);
  EXPECT_LE(most, 1.3);  // the displacement decays over four times itself
}

TEST(Quadratic, LayersOfAForkAreValid) {
  const geometry::AnalyticShape shape = geometry::y_junction(8.0, 14.0, 2.0, 1.4, 25.0);
  const geometry::FacedSurface surface = remeshed(shape, 0.35);
  BoundaryLayerOptions options;
  options.layers = 4;
  options.thickness = 0.5;
  const MixedMesh linear = fill_with_layers(surface, options).mesh;
  const geometry::TriMesh reference = geometry::surface_of(shape, 0.2, true);
  const QuadraticMesh q = make_quadratic(linear, reference);
  EXPECT_EQ(q.report.inverted, 0u);
  EXPECT_GE(q.report.min_jacobian_ratio, 0.2);
  EXPECT_GE(q.report.on_reference, 0.97 * static_cast<double>(q.report.wall_nodes));
  const MixedQuality quality = mixed_quality(q.mesh);
  EXPECT_EQ(quality.inverted(), 0u);
  EXPECT_GE(quality.prisms.min_scaled_jacobian, 0.05);
  EXPECT_GE(quality.tetrahedra.min_scaled_jacobian, 0.05);
  const WallDeviation before = wall_deviation(linear, reference), after = wall_deviation(q.mesh, reference);
  EXPECT_LT(after.mean_mm, 0.5 * before.mean_mm);
}

/// A reference that asks for the impossible: the nodes are moved back until all elements are valid.
TEST(Quadratic, MovesBackWhereProjectionInverts) {
  const MixedMesh linear = filled_tube(16, 0, 0.0);
  const double edge = 2.0 * pi * 1.5 / 16.0;
  const geometry::TriMesh inside = cylinder_reference(1.5 - 0.45 * edge, 3.0, 2000);
  QuadraticOptions options;
  options.max_displacement = 0.6;
  const QuadraticMesh q = make_quadratic(linear, inside, options);
  EXPECT_EQ(q.report.inverted, 0u);
  EXPECT_GE(q.report.min_jacobian_ratio, options.min_jacobian_ratio);
  EXPECT_GT(q.report.moved_back, 0u);
  EXPECT_GT(q.report.rounds, 0);
  ASSERT_FALSE(q.report.places.empty());
  EXPECT_LE(q.report.places.size(), 20u);
  EXPECT_EQ(q.report.places[0].distance_mm, q.report.max_distance_mm);
  EXPECT_LT(q.report.places[0].share, 1.0);
  ASSERT_FALSE(q.report.warnings.empty());
  EXPECT_THAT(q.report.warnings[0], ::testing::HasSubstr("were moved back towards the straight edge"));
  EXPECT_EQ(mixed_quality(q.mesh).inverted(), 0u);
}

TEST(Quadratic, StaysStraightWhereTheReferenceIsFar) {
  const MixedMesh linear = filled_tube(12, 0, 0.0);
  const QuadraticMesh q = make_quadratic(linear, cylinder_reference(6.0, 3.0, 500));
  EXPECT_EQ(q.report.not_projected, q.report.wall_nodes);
  EXPECT_EQ(q.report.inverted, 0u);
  EXPECT_NEAR(q.report.volume_mm3, q.report.straight_volume_mm3, 1e-12);
  EXPECT_THAT(q.report.warnings.at(0), ::testing::HasSubstr("no reference surface near them"));
}

TEST(Quadratic, LeavesInvertedElementsAsTheyAreAndTells) {
  MixedMesh linear = filled_tube(12, 0, 0.0);
  std::swap(linear.tetrahedra[0][0], linear.tetrahedra[0][1]);
  const QuadraticMesh q = make_quadratic(linear, cylinder_reference(1.5, 3.0, 2000));
  EXPECT_EQ(q.report.inverted, 1u);
  EXPECT_THAT(q.report.warnings.at(0),
              ::testing::HasSubstr("1 elements are inverted, as they are in the linear mesh"));
}

TEST(Quadratic, IsTheSameForAnyNumberOfThreads) {
  const MixedMesh linear = filled_tube(16, 2, 0.25);
  const geometry::TriMesh reference = cylinder_reference(1.5, 3.0, 2000);
  std::vector<MixedMesh> all;
  for (const int threads : {1, 3}) {
    core::set_max_threads(threads);
    all.push_back(make_quadratic(linear, reference).mesh);
  }
  core::set_max_threads(0);
  EXPECT_EQ(all[0].points, all[1].points);
  EXPECT_EQ(all[0].prism_nodes, all[1].prism_nodes);
}

TEST(Quadratic, ExportsToAFormatOfSecondOrderAndRefusesTheOthers) {
  const QuadraticMesh q = make_quadratic(filled_tube(12, 2, 0.3), cylinder_reference(1.5, 3.0, 4000));
  const auto folder = testing::temporary_folder("quadratic");
  io::export_mesh(q.mesh, io::MeshFormat::gmsh2, folder / "m.msh");  // checks nodes and orientation itself
  std::ifstream in(folder / "m.msh");
  std::string line;
  while (std::getline(in, line) && line != "$Nodes") {
  }
  std::size_t nodes = 0;
  in >> nodes;
  ASSERT_EQ(nodes, q.mesh.points.size());
  for (std::size_t i = 0, number = 0; i < nodes; ++i) {
    Vec3 p;
    in >> number >> p.x() >> p.y() >> p.z();
    ASSERT_EQ(number, i + 1);
    ASSERT_EQ(p, q.mesh.points[i]);
  }
  std::map<int, std::size_t> types;
  while (std::getline(in, line) && line != "$Elements") {
  }
  std::size_t elements = 0;
  in >> elements;
  for (std::size_t i = 0; i < elements; ++i) {
    int number = 0, type = 0;
    in >> number >> type;
    ++types[type];
    std::getline(in, line);
  }
  EXPECT_EQ(types[11], q.mesh.tetrahedra.size());  // 10 nodes
  EXPECT_EQ(types[13], q.mesh.prisms.size());      // 18 nodes
  EXPECT_EQ(types[9], q.mesh.triangles.size());    // 6 nodes
  EXPECT_EQ(types[10], q.mesh.quads.size());       // 9 nodes
  EXPECT_THROW(io::export_mesh(q.mesh, io::MeshFormat::openfoam, folder / "case"), InvalidInput);
}

TEST(Quadratic, RefusesBadInput) {
  const MixedMesh linear = io::column_with_prisms();
  const geometry::TriMesh reference = cylinder_reference(3.0, 8.0, 100);
  EXPECT_THROW(make_quadratic(io::quadratic(linear), reference), InvalidInput);
  EXPECT_THROW(make_quadratic(linear, geometry::TriMesh{}), InvalidInput);
  MixedMesh strange = linear;
  strange.triangles[0] = {0, 20, 40};
  EXPECT_THROW(make_quadratic(strange, reference), InvalidInput);
  strange = linear;
  strange.tetrahedra[0][0] = -1;
  EXPECT_THROW(make_quadratic(strange, reference), InvalidInput);
  QuadraticOptions options;
  options.min_jacobian_ratio = 0.0;
  EXPECT_THROW(make_quadratic(linear, reference, options), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(make_quadratic(linear, reference, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
