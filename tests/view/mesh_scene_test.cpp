#include "ostia/view/mesh_scene.h"

#include "grid_mesh.h"
#include "shown_scene.h"

#include "ostia/core/error.h"
#include "ostia/view/forecast_scene.h"

#include <gtest/gtest.h>

namespace ostia::view {
namespace {

using testing::Pixel;
using testing::Shot;
using testing::ShownScene;

constexpr int side = 4;  // of a cube of cubes of 2 mm, 8 mm wide

struct Shown : ShownScene {
  std::shared_ptr<MeshScene> mesh =
      std::make_shared<MeshScene>(prepared(testing::grid_of_cubes(side, side, side, 2.0)));
  Shown() {
    scene.set_guest(mesh);
    scene.set_pose(pose_from(ViewFrom::anterior, {4, 4, 4}, 10.0));
    mesh->set_edges(ShownEdges::never);
  }
  /// Elements left of the middle have the first value, the others the last.
  std::shared_ptr<const std::vector<double>> halves() const {
    auto values = std::make_shared<std::vector<double>>();
    const auto shown = prepared(testing::grid_of_cubes(side, side, side, 2.0));
    for (const auto& centre : shown->centres) values->push_back(centre.x() < 4.0F ? 0.0 : 1.0);
    return values;
  }
};

TEST(MeshSceneGui, ElementsHaveTheColoursOfTheirValues) {
  Shown shown;
  const Shot plain = shown.shoot();
  shown.mesh->set_values(shown.halves(), {"quality", 0.0, 1.0});
  const Shot shot = shown.shoot();
  // Dark blue to yellow; +x is to the right of one who looks from the front.
  const Pixel low = shot.at(shown.scene.project({1, 0, 4})), high = shot.at(shown.scene.project({7, 0, 4}));
  EXPECT_GT(low.b, low.g + 20);
  EXPECT_GT(high.g, high.b + 60);
  EXPECT_GT(high.r, high.b + 60);
  EXPECT_LT(plain.at(shown.scene.project({1, 0, 4})).difference(plain.at(shown.scene.project({7, 0, 4}))),
            12);
  EXPECT_GT(shot.painted(), plain.painted() + 500) << "the bar";
}

TEST(MeshSceneGui, WhatIsCutAwayIsNotThere) {
  Shown shown;
  const Shot whole = shown.shoot();
  shown.mesh->set_cut(MeshCut{{0, 0, 4}, {0, 0, 1}});
  const Shot cut = shown.shoot();
  EXPECT_NEAR(cut.painted(), whole.painted() / 2, whole.painted() / 20);
  EXPECT_EQ(cut.at(shown.scene.project({4, 0, 6})).difference(cut.background()), 0);
  EXPECT_GT(cut.at(shown.scene.project({4, 0, 2})).difference(cut.background()), 40);
  EXPECT_EQ(shown.mesh->side_count(), 2u * (2 * 16 + 4 * 8));
  shown.mesh->set_cut({});
  EXPECT_NEAR(shown.shoot().painted(), whole.painted(), 5);
}

TEST(MeshSceneGui, TheSameCutAgainChangesNothingAndTheOutlineIsOfTheWholeMesh) {
  Shown shown;
  const std::vector<geometry::Vec3> whole = shown.mesh->outline();
  EXPECT_EQ(whole.size(), 2u * 6 * side * side);
  const MeshCut cut{{0, 0, 4}, {0, 0, 1}};
  shown.mesh->set_cut(cut);
  EXPECT_EQ(shown.mesh->outline(), whole);
  const auto drawn = shown.mesh->prop().GetMTime();
  shown.mesh->set_cut(cut);
  EXPECT_EQ(shown.mesh->prop().GetMTime(), drawn);
  shown.mesh->set_cut(MeshCut{{0, 0, 2}, {0, 0, 1}});
  EXPECT_GT(shown.mesh->prop().GetMTime(), drawn);
}

TEST(MeshSceneGui, EdgesAndAHighlightAreSeenThroughTheMesh) {
  Shown shown;
  const Shot bare = shown.shoot();
  shown.mesh->set_edges(ShownEdges::always);
  int darker = 0;
  const Shot edged = shown.shoot();
  for (std::size_t i = 0; i < bare.pixels.size(); ++i)
    darker += edged.pixels[i].brightness() < bare.pixels[i].brightness() - 150 ? 1 : 0;
  EXPECT_GT(darker, 500);
  shown.mesh->set_edges(ShownEdges::never);
  const std::size_t inside = 6 * (2 * 16 + 2 * 4 + 2);  // in the cube from (4, 4, 4) to (6, 6, 6)
  shown.mesh->set_highlight(std::span(&inside, 1));
  const Shot marked = shown.shoot();
  const geometry::Vec2 middle = shown.scene.project({5, 4, 5});
  int pink = 0;
  for (int y = -20; y <= 20; ++y)
    for (int x = -20; x <= 20; ++x) {
      const Pixel pixel = marked.at(middle + geometry::Vec2(x, y));
      pink += pixel.r > pixel.g + 80 && pixel.b > pixel.g + 80 ? 1 : 0;
    }
  EXPECT_GT(pink, 30);
  shown.mesh->set_highlight({});
  EXPECT_EQ(shown.shoot().painted(), bare.painted());
}

TEST(MeshSceneGui, EdgesAreDrawnWhereTheyAreNear) {
  Shown shown;
  shown.mesh->set_edges(ShownEdges::near);
  // Cubes of 2 mm; half of the first edges of their sides are as long.
  const auto drawn_at = [&](double edge_px) {
    shown.scene.set_pose(pose_from(ViewFrom::anterior, {4, 4, 4}, 150.0 * 2.0 / edge_px));
    EXPECT_GT(shown.shoot().painted(), 20);
    return shown.mesh->edges_drawn();
  };
  EXPECT_FALSE(drawn_at(0.6 * MeshScene::least_edge_px));
  EXPECT_TRUE(drawn_at(1.2 * MeshScene::least_edge_px));
  EXPECT_FALSE(drawn_at(3.0));
  shown.mesh->set_edges(ShownEdges::always);
  EXPECT_TRUE(drawn_at(3.0));
  shown.mesh->set_edges(ShownEdges::never);
  EXPECT_FALSE(drawn_at(30.0));
}

TEST(MeshSceneGui, RefusesWhatDoesNotBelongToTheMesh) {
  Shown shown;
  EXPECT_THROW(MeshScene{nullptr}, InvalidInput);
  EXPECT_THROW(shown.mesh->set_values(std::make_shared<std::vector<double>>(3), {}), InvalidInput);
  EXPECT_THROW(shown.mesh->set_values(nullptr, {}), InvalidInput);
  const std::size_t none = 6 * side * side * side;
  EXPECT_THROW(shown.mesh->set_highlight(std::span(&none, 1)), InvalidInput);
  EXPECT_THROW(shown.mesh->set_cut(MeshCut{{0, 0, 0}, {0, 0, 0}}), InvalidInput);
}

TEST(ForecastSceneGui, PlacesAreInTheirColourOnTheSurface) {
  const testing::Tree tree = testing::straight_tree();
  std::vector<SurfacePlace> places(1);
  places[0].point = {0, -2, 20};
  places[0].extent_mm = 2.0;
  places[0].color = {1.0, 0.0, 0.0};
  for (std::size_t t = 0; t < tree.wall->triangles.size(); ++t) {
    const double z = tree.wall->points[static_cast<std::size_t>(tree.wall->triangles[t][0])].z();
    if (std::abs(z - 20.0) < 2.0) places[0].triangles.push_back(static_cast<std::int32_t>(t));
  }
  ShownScene shown;
  const auto guest = std::make_shared<ForecastScene>(*tree.wall, places);
  shown.scene.set_guest(guest);
  shown.scene.set_pose(pose_from(ViewFrom::anterior, {0, 0, 20}, 30.0));
  const Shot shot = shown.shoot();
  const Pixel there = shot.at(shown.scene.project({0.5, 0, 20.6})),
              sound = shot.at(shown.scene.project({0.5, 0, 30}));
  EXPECT_GT(there.r, there.g + 80);
  EXPECT_LT(std::abs(sound.r - sound.g), 30);
  EXPECT_GT(sound.difference(shot.background()), 100);
  guest->choose(0);
  EXPECT_THROW(guest->choose(1), InvalidInput);
  places[0].triangles = {static_cast<std::int32_t>(tree.wall->triangles.size())};
  EXPECT_THROW(ForecastScene(*tree.wall, places), InvalidInput);
  EXPECT_THROW(ForecastScene({}, {}), InvalidInput);
}

}  // namespace
}  // namespace ostia::view
