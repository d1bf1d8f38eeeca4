// A surface with known values in the scene: where which colour is, what the mouse finds, and the wall again.

#include "ostia/view/surface_field_scene.h"

#include "shown_scene.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace ostia::view {
namespace {

using testing::Pixel;
using testing::Shot;
using testing::ShownScene;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// 20 mm wide (x) and 40 mm high (z) in the plane y = 0, facing the front, in squares of 1 mm.
geometry::TriMesh sheet() {
  geometry::TriMesh mesh;
  for (int k = 0; k <= 40; ++k)
    for (int i = 0; i <= 20; ++i) mesh.points.push_back({i - 10.0, 0.0, double(k)});
  for (int k = 0; k < 40; ++k)
    for (int i = 0; i < 20; ++i) {
      const int a = 21 * k + i;
      mesh.triangles.push_back({a, a + 1, a + 22});
      mesh.triangles.push_back({a, a + 22, a + 21});
    }
  return mesh;
}

/// At the points 0.1 z.
std::vector<double> rising(const geometry::TriMesh& mesh) {
  std::vector<double> values;
  for (const Vec3& point : mesh.points) values.push_back(0.1 * point.z());
  return values;
}

struct SurfaceFieldGui : ::testing::Test {
  ShownScene shown;
  std::shared_ptr<const FieldSurface> surface = std::make_shared<const FieldSurface>(sheet());
  std::shared_ptr<SurfaceFieldScene> field = std::make_shared<SurfaceFieldScene>(surface);
  SurfaceFieldGui() { shown.scene.set_pose(pose_from(ViewFrom::anterior, {0.0, 0.0, 20.0}, 30.0)); }
  std::optional<double> value_at(const Vec3& place) {
    return field->value_at(shown.scene.ray(shown.scene.project(place)));
  }
};

/// Which of the scale's colours a pixel comes nearest to, whatever the light: by the components' shares.
double nearest_share(const Pixel& pixel) {
  const auto hue = [](double r, double g, double b) { return Vec3(r, g, b).normalized().eval(); };
  const Vec3 seen = hue(pixel.r, pixel.g, pixel.b);
  double best = 0.0, least = 1e9;
  for (double t = 0.0; t <= 1.0; t += 0.005) {
    const figure::Color color = scale_color(ColorScale::sequential, t);
    const double away = (hue(color.r, color.g, color.b) - seen).norm();
    if (away < least) std::tie(least, best) = std::pair(away, t);
  }
  return best;
}

TEST_F(SurfaceFieldGui, ColoursAndValuesAreThoseOfThePlace) {
  field->set_values(rising(surface->mesh()), FieldAt::points, {"rise, Pa", 0.5, 3.5});
  shown.scene.set_guest(field);
  const Shot shot = shown.shoot();
  for (const double z : {8.0, 12.5, 20.0, 27.3, 32.0}) {
    const Vec3 place(-3.2, 0.0, z);
    const auto value = value_at(place);
    ASSERT_TRUE(value) << z;
    EXPECT_NEAR(*value, 0.1 * z, 1e-9) << z;
    EXPECT_NEAR(nearest_share(shot.at(shown.scene.project(place))), (0.1 * z - 0.5) / 3.0, 0.06) << z;
  }
  EXPECT_FALSE(value_at({12.0, 0.0, 20.0}));
}

TEST_F(SurfaceFieldGui, ValuesOfTrianglesHaveEdges) {
  const geometry::TriMesh& mesh = surface->mesh();
  std::vector<double> values(mesh.triangles.size());
  for (std::size_t t = 0; t < values.size(); ++t) values[t] = t < values.size() / 2 ? 1.0 : 2.0;
  field->set_values(values, FieldAt::triangles, {"step", 0.0, 3.0});
  shown.scene.set_guest(field);
  const Shot shot = shown.shoot();
  EXPECT_EQ(value_at({0.3, 0.0, 19.9}), 1.0);
  EXPECT_EQ(value_at({0.3, 0.0, 20.1}), 2.0);
  EXPECT_NEAR(nearest_share(shot.at(shown.scene.project({0.3, 0.0, 19.5}))), 1.0 / 3.0, 0.05);
  EXPECT_NEAR(nearest_share(shot.at(shown.scene.project({0.3, 0.0, 20.5}))), 2.0 / 3.0, 0.05);
}

TEST_F(SurfaceFieldGui, WhatIsNotKnownIsGreyAndNotANumber) {
  std::vector<double> values = rising(surface->mesh());
  for (std::size_t i = 0; i < 10 * 21; ++i) values[i] = not_a_number;
  field->set_values(values, FieldAt::points, {"rise", 0.0, 4.0});
  shown.scene.set_guest(field);
  const Shot shot = shown.shoot();
  const Pixel grey = shot.at(shown.scene.project({0.0, 0.0, 5.0}));
  EXPECT_LT(std::abs(grey.r - grey.b) + std::abs(grey.r - grey.g), 12);
  ASSERT_TRUE(value_at({0.0, 0.0, 5.0}));
  EXPECT_TRUE(std::isnan(*value_at({0.0, 0.0, 5.0})));
}

TEST_F(SurfaceFieldGui, ItStandsInTheWallsPlaceAndTheWallComesBack) {
  const testing::Tree tree = testing::straight_tree();
  shown.scene.set_wall(tree.wall, tree.model);
  const Shot wall = shown.shoot();
  const Vec3 beside(8.0, 0.0, 20.0), on_wall(0.0, 0.0, 20.0);
  EXPECT_LT(wall.at(shown.scene.project(beside)).difference(wall.background()), 5);
  field->set_values(rising(surface->mesh()), FieldAt::points, {"rise", 0.0, 4.0});
  shown.scene.set_guest(field);
  const Shot guest = shown.shoot();
  EXPECT_GT(guest.at(shown.scene.project(beside)).difference(guest.background()), 40);
  EXPECT_NEAR(nearest_share(guest.at(shown.scene.project({0.0, 0.0, 12.0}))), 0.3, 0.06);
  EXPECT_FALSE(shown.scene.pick(shown.scene.project(on_wall))) << "a wall that is not shown was picked";
  // An edit meanwhile does not bring the wall up.
  shown.scene.set_wall(std::make_shared<const geometry::TriMesh>(*tree.wall), tree.model);
  EXPECT_NEAR(nearest_share(shown.shoot().at(shown.scene.project({0.0, 0.0, 12.0}))), 0.3, 0.06);
  // Other values of the same guest are seen at once.
  std::vector<double> half = rising(surface->mesh());
  for (double& value : half) value *= 2.0;
  field->set_values(half, FieldAt::points, {"rise", 0.0, 4.0});
  EXPECT_NEAR(nearest_share(shown.shoot().at(shown.scene.project({0.0, 0.0, 12.0}))), 0.6, 0.06);
  shown.scene.set_guest(nullptr);
  const Shot again = shown.shoot();
  EXPECT_LT(again.at(shown.scene.project(beside)).difference(again.background()), 5);
  EXPECT_EQ(again.at(shown.scene.project(on_wall)).difference(wall.at(shown.scene.project(on_wall))), 0);
  EXPECT_TRUE(shown.scene.pick(shown.scene.project(on_wall)));
}

TEST_F(SurfaceFieldGui, ASnapshotShowsItWithItsBar) {
  field->set_values(rising(surface->mesh()), FieldAt::points, {"rise, Pa", 0.0, 4.0});
  shown.scene.set_guest(field);
  const figure::Raster picture = shown.scene.snapshot(400, 300);
  const auto at = [&](int x, int y) {
    const std::uint8_t* p = picture.pixel(x, y);
    return Pixel{p[0], p[1], p[2]};
  };
  EXPECT_NEAR(nearest_share(at(200, 110)), 0.7, 0.06);  // z = 28 mm
  // The bar, from 90 to 210 pixels: its first colour below, its last above.
  EXPECT_NEAR(nearest_share(at(344, 206)), 0.03, 0.05);
  EXPECT_NEAR(nearest_share(at(344, 94)), 0.97, 0.05);
}

TEST_F(SurfaceFieldGui, AFittedViewShowsAllOfIt) {
  field->set_values(rising(surface->mesh()), FieldAt::points, {"rise", 0.0, 4.0});
  shown.scene.set_guest(field);
  const CameraPose pose = shown.scene.pose_fitted();
  EXPECT_NEAR(pose.target.z(), 20.0, 1e-9);
  EXPECT_NEAR(pose.half_height_mm, 20.0 * 1.08, 0.8);
}

TEST_F(SurfaceFieldGui, WhatDoesNotFitIsRefused) {
  EXPECT_THROW(SurfaceFieldScene(nullptr), InvalidInput);
  EXPECT_THROW(field->set_values({1.0, 2.0}, FieldAt::points, {"", 0.0, 1.0}), InvalidInput);
  EXPECT_THROW(field->set_values(rising(surface->mesh()), FieldAt::triangles, {"", 0.0, 1.0}), InvalidInput);
  EXPECT_THROW(field->set_values(rising(surface->mesh()), FieldAt::points, {"", 1.0, 1.0}), InvalidInput);
  EXPECT_THROW(FieldSurface(geometry::TriMesh{}), InvalidInput);
  EXPECT_THROW(FieldSurface(geometry::TriMesh{{Vec3::Zero()}, {{0, 1, 2}}}), InvalidInput);
  EXPECT_FALSE(field->value_at({})) << "there are no values yet";
}

TEST(AutomaticRange, IsFromThe2ndToThe98thPercentile) {
  std::vector<double> values(100);
  std::iota(values.begin(), values.end(), 1.0);
  EXPECT_EQ(automatic_range(values), std::pair(2.0, 98.0));
  values[99] = 1e9;  // a spike
  values.insert(values.begin(), not_a_number);
  EXPECT_EQ(automatic_range(values), std::pair(2.0, 98.0));
}

TEST(AutomaticRange, IsNeverEmpty) {
  EXPECT_EQ(automatic_range({}), std::pair(0.0, 1.0));
  for (const double same : {0.0, 5.0, -5.0, 1e-12, not_a_number}) {
    const auto [low, high] = automatic_range(std::vector<double>(7, same));
    EXPECT_LT(low, high) << same;
    if (!std::isnan(same)) {
      EXPECT_LT(low, same);
      EXPECT_GT(high, same);
    }
  }
}

}  // namespace
}  // namespace ostia::view
