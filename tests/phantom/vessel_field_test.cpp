#include "ostia/phantom/vessel_field.h"

#include "hand_made_tree.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/phantom/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ostia::phantom {
namespace {

using std::numbers::pi;

CoronaryTree one_tube(const std::function<double(double, double)>& radius) {
  CoronaryTree tree;
  tree.vessels.push_back(testing::tube(0, "RCA", {1, 2, 3}, {1, 2, 33}, radius));
  return tree;
}

int euler(const geometry::TriMesh& mesh) {
  return static_cast<int>(mesh.points.size()) - static_cast<int>(mesh.triangles.size()) / 2;
}

TEST(VesselField, AroundTubeIsDistanceMinusRadius) {
  const VesselField field(one_tube([](double, double) { return 1.5; }));
  for (std::uint64_t i = 0; i < 400; ++i) {
    const double rho = 4.0 * uniform(1, 3 * i), angle = 2.0 * pi * uniform(1, 3 * i + 1);
    const double z = 4.0 + 28.0 * uniform(1, 3 * i + 2);
    const Vec3 p(1.0 + rho * std::cos(angle), 2.0 + rho * std::sin(angle), z);
    const double ends = std::max(3.0 - z, z - 33.0);
    EXPECT_NEAR(field.value(Boundary::lumen, p, 10.0), std::max(rho - 1.5, ends), 1e-9);
    EXPECT_NEAR(field.value(Boundary::wall, p, 10.0), std::max(rho - 2.1, ends), 1e-9);
  }
  EXPECT_DOUBLE_EQ(field.value(Boundary::lumen, {40, 2, 10}, 0.7), 0.7);
  EXPECT_NEAR(field.value(Boundary::lumen, {1, 2, 1}, 10.0), 2.0, 1e-9);  // beyond the flat end
}

TEST(VesselField, PlaceGivesCoordinatesBack) {
  const CoronaryTree tree =
      one_tube([](double s, double theta) { return 1.5 + 0.01 * s + 0.1 * std::cos(2.0 * theta); });
  const VesselField field(tree);
  const CoronaryVessel& vessel = tree.vessels[0];
  std::vector<VesselField::Place> places;
  for (double theta = -3.0; theta < 3.1; theta += 0.3) {
    const Vec3 p = vessel.axis.points[123] + 1.2 * geometry::radial_direction(vessel.axis.frames[123], theta);
    field.places(p, 0.5, places);
    ASSERT_EQ(places.size(), 1U);
    EXPECT_NEAR(places[0].s_mm, 12.3, 1e-9);
    EXPECT_NEAR(places[0].theta, theta, 1e-9);
    EXPECT_NEAR(places[0].rho_mm, 1.2, 1e-9);
    EXPECT_DOUBLE_EQ(places[0].lumen_mm, vessel.lumen.at(places[0].s_mm, places[0].theta));
    EXPECT_DOUBLE_EQ(places[0].wall_mm, vessel.wall.at(places[0].s_mm, places[0].theta));
  }
}

TEST(VesselField, UnionIsTheLeastOfItsVesselsAndNearIsNeverWrong) {
  const CoronaryTree tree = testing::hand_made_tree();
  const VesselField field(tree);
  std::vector<VesselField::Place> places;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Vec3 p(60.0 + 70.0 * (2.0 * uniform(5, 3 * i) - 1.0), 60.0 * uniform(5, 3 * i + 1) - 4.0,
                 8.0 * uniform(5, 3 * i + 2) - 4.0);
    const double value = field.value(Boundary::wall, p, 1.0);
    field.places(p, 1.0, places);
    double least = 1.0;
    for (const auto& place : places) {
      const double length = tree.vessels[static_cast<std::size_t>(place.vessel)].axis.abscissa.back();
      least = std::min(least, std::max({place.rho_mm - place.wall_mm, -place.s_mm, place.s_mm - length}));
    }
    EXPECT_NEAR(value, least, 1e-12);
    const geometry::Box3 box(p - Vec3::Constant(0.1), p + Vec3::Constant(0.1));
    if (value < 0.5) {
      EXPECT_TRUE(field.near(box, 0.5));
    }
  }
  EXPECT_FALSE(field.near(geometry::Box3(Vec3(0, 40, 0), Vec3(10, 50, 10)), 2.0));
}

TEST(VesselField, MaterialsLieInLayers) {
  CoronaryTree tree = one_tube([](double, double) { return 1.5; });
  Plaque plaque;
  plaque.kind = PlaqueKind::calcified;
  plaque.s_centre_mm = 10.0;
  plaque.length_mm = 6.0;
  plaque.theta_extent = pi / 2.0;
  plaque.hu = 900.0f;
  tree.vessels[0].plaques.push_back(plaque);
  const VesselField field(tree);
  const geometry::Frame& frame = tree.vessels[0].axis.frames[100];
  const auto at = [&](double rho, double theta) {
    return field.material(tree.vessels[0].axis.points[100] + rho * geometry::radial_direction(frame, theta));
  };
  EXPECT_EQ(at(1.4, 0.0)->label, Label::coronary_lumen);
  EXPECT_EQ(at(1.8, 0.1)->label, Label::calcified_plaque);
  EXPECT_EQ(at(1.8, 0.1)->hu, 900.0f);
  EXPECT_EQ(at(1.8, 1.0)->label, Label::vessel_wall);  // beside the plaque
  EXPECT_FALSE(at(2.2, 0.0).has_value());
}

TEST(TreeSurface, TubeHasItsVolumeAndIsClosed) {
  const auto radius = [](double s, double theta) {
    return 1.6 - 0.01 * s + 0.15 * std::cos(2.0 * theta) - 0.7 * std::exp(-std::pow((s - 15.0) / 4.0, 2.0));
  };
  const CoronaryTree tree = one_tube(radius);
  const VesselField field(tree);
  const geometry::TriMesh mesh = tree_surface(field, Boundary::lumen, 0.09);
  const auto faults = geometry::find_faults(mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.self_intersections, 0U);
  EXPECT_EQ(faults.components, 1U);
  EXPECT_EQ(euler(mesh), 2);
  double volume = 0.0;
  constexpr int pieces = 3000;
  for (int i = 0; i < pieces; ++i)
    volume += 30.0 / pieces * tree.vessels[0].lumen.area_at((i + 0.5) * 30.0 / pieces);
  EXPECT_NEAR(geometry::volume(mesh), volume, 1e-3 * volume);
  for (const Vec3& p : mesh.points) ASSERT_NEAR(field.value(Boundary::lumen, p, 1.0), 0.0, 1e-6);
  // Inside triangles, away from the rims of the caps.
  for (const geometry::Triangle& t : mesh.triangles) {
    const Vec3 p =
        (mesh.points[static_cast<std::size_t>(t[0])] + mesh.points[static_cast<std::size_t>(t[1])] +
         mesh.points[static_cast<std::size_t>(t[2])]) /
        3.0;
    if (p.z() > 3.3 && p.z() < 32.7) {
      ASSERT_NEAR(field.value(Boundary::lumen, p, 1.0), 0.0, 0.01);
    }
  }
}

TEST(TreeSurface, FinerSurfaceComesNearerToTheVolume) {
  const VesselField field(one_tube([](double, double) { return 1.2; }));
  const double exact = pi * 1.2 * 1.2 * 30.0;
  const double coarse = std::abs(geometry::volume(tree_surface(field, Boundary::lumen, 0.3)) - exact) / exact;
  const double fine = std::abs(geometry::volume(tree_surface(field, Boundary::lumen, 0.1)) - exact) / exact;
  EXPECT_LT(fine, 1e-3 + 0.5 * coarse);
  EXPECT_LT(fine, 2e-3);
}

TEST(TreeSurface, SameForAnyNumberOfThreads) {
  const VesselField field(testing::hand_made_tree());
  core::set_max_threads(1);
  const geometry::TriMesh mesh = tree_surface(field, Boundary::wall, 0.3);
  core::set_max_threads(3);
  const geometry::TriMesh again = tree_surface(field, Boundary::wall, 0.3);
  core::set_max_threads(0);
  EXPECT_EQ(mesh.points, again.points);
  EXPECT_EQ(mesh.triangles, again.triangles);
  EXPECT_EQ(euler(mesh), 2);  // a branch opens no handle
}

TEST(TreeSurface, DrawnTreeIsTwoSpheres) {
  const VesselField field(draw_coronaries(draw_heart(3), {3, 0.0}));
  const geometry::TriMesh mesh = tree_surface(field, Boundary::lumen, 0.3);
  const auto faults = geometry::find_faults(mesh, false);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.components, 2U);
  EXPECT_EQ(euler(mesh), 4);
}

TEST(TreeSurface, BadSpacingAndCancellation) {
  const VesselField field(one_tube([](double, double) { return 1.2; }));
  EXPECT_THROW(tree_surface(field, Boundary::lumen, 0.0), InvalidInput);
  EXPECT_THROW(tree_surface(field, Boundary::lumen, std::numeric_limits<double>::quiet_NaN()), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(tree_surface(field, Boundary::lumen, 0.3, task), Cancelled);
}

}  // namespace
}  // namespace ostia::phantom
