#include "ostia/view/tree_scene.h"

#include "shown_scene.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ostia::view {
namespace {

using geometry::Vec2;
using testing::Pixel;
using testing::Shot;
using testing::ShownScene;
using testing::Tree;

/// The vessel in the middle, 0.2 mm a pixel, seen from the front.
CameraPose from_front(const Vec3& target = {0.0, 0.0, 20.0}) {
  return pose_from(ViewFrom::anterior, target, 30.0);
}

TEST(TreeSceneGui, ATubeIsWhereProjectSays) {
  const Tree tree = testing::straight_tree();
  ShownScene shown;
  shown.scene.set_wall(tree.wall, tree.model);
  shown.scene.set_pose(from_front());
  const Shot shot = shown.shoot();
  // 5 pixels a mm, z up, and +x (the patient's left) to the right of one who stands before the patient.
  const Vec2 at = shown.scene.project({1.0, 0.0, 30.0});
  EXPECT_NEAR(at.x(), 205.0, 1e-9);
  EXPECT_NEAR(at.y(), 200.0, 1e-9);
  for (const double z : {2.0, 13.0, 25.0, 38.0}) {
    for (const double side : {-1.0, 1.0}) {
      const Vec2 inside = shown.scene.project({side * 1.7, 0.0, z});
      const Vec2 outside = shown.scene.project({side * 2.4, 0.0, z});
      EXPECT_GT(shot.at(inside).difference(shot.background()), 40) << z << " " << side;
      EXPECT_LT(shot.at(outside).difference(shot.background()), 5) << z << " " << side;
    }
  }
  EXPECT_NEAR(shot.painted(), 5 * 5 * 4.0 * 43.0, 500);  // 4 mm wide, 40 mm long, rounded ends
}

TEST(TreeSceneGui, PickTellsVesselAndAbscissa) {
  const Tree tree = testing::straight_tree();
  ShownScene shown;
  shown.scene.set_wall(tree.wall, tree.model);
  shown.scene.set_pose(from_front());
  for (const double z : {3.0, 11.3, 20.0, 36.6}) {
    const auto pick = shown.scene.pick(shown.scene.project({0.8, 0.0, z}));
    ASSERT_TRUE(pick && pick->vessel);
    EXPECT_EQ(*pick->vessel, 4);
    EXPECT_NEAR(pick->s_mm, z, 0.3);
    EXPECT_FALSE(pick->measurement);
    EXPECT_NEAR((pick->point - Vec3(0.8, -std::sqrt(4.0 - 0.64), z)).norm(), 0.0, 0.05);  // the near side
  }
  EXPECT_FALSE(shown.scene.pick(shown.scene.project({3.0, 0.0, 20.0})));
}

TEST(TreeSceneGui, PickTellsBranchesApart) {
  const Tree tree = testing::y_tree();
  ShownScene shown;
  shown.scene.set_wall(tree.wall, tree.model);
  shown.scene.set_pose(from_front(Vec3::Zero()));
  for (const auto& vessel : tree.model.vessels) {
    for (double s = vessel->own_from_mm + 8.0; s < vessel->axis->length() - 2.0; s += 3.0) {
      const auto pick = shown.scene.pick(shown.scene.project(vessel->axis->point(s)));
      ASSERT_TRUE(pick && pick->vessel) << s;
      EXPECT_EQ(*pick->vessel, vessel->vessel) << s;
      EXPECT_NEAR(pick->s_mm, s, 0.3);
    }
  }
}

TEST(TreeSceneGui, AHiddenVesselShowsNothingAndIsNotPicked) {
  const Tree tree = testing::y_tree();
  ShownScene shown;
  shown.scene.set_wall(tree.wall, tree.model);
  shown.scene.set_pose(from_front(Vec3::Zero()));
  const lumen::VesselLumen& branch = *tree.model.vessels[1];
  const lumen::VesselLumen& parent = *tree.model.vessels[0];
  const Vec2 on_branch = shown.scene.project(branch.axis->point(branch.axis->length() - 8.0));
  const Vec2 on_parent = shown.scene.project(parent.axis->point(parent.axis->length() - 8.0));
  const Shot before = shown.shoot();
  VesselStyle style = shown.scene.vessel_style(branch.vessel);
  style.visible = false;
  shown.scene.set_vessel_style(branch.vessel, style);
  const Shot after = shown.shoot();
  EXPECT_GT(before.at(on_branch).difference(before.background()), 40);
  EXPECT_EQ(after.at(on_branch).difference(after.background()), 0);
  EXPECT_EQ(after.at(on_parent).difference(before.at(on_parent)), 0);
  EXPECT_FALSE(shown.scene.pick(on_branch));
  EXPECT_TRUE(shown.scene.pick(on_parent));
  style.visible = true;
  shown.scene.set_vessel_style(branch.vessel, style);
  EXPECT_EQ(shown.shoot().painted(), before.painted());
}

TEST(TreeSceneGui, ColoursFollowVesselsSelectionAndValues) {
  const Tree tree = testing::y_tree();
  ShownScene shown;
  shown.scene.set_wall(tree.wall, tree.model);
  shown.scene.set_pose(from_front(Vec3::Zero()));
  std::vector<Vec2> on;
  for (const auto& vessel : tree.model.vessels) {
    shown.scene.set_vessel_style(vessel->vessel, {true, {1.0, 0.0, 0.0}});
    on.push_back(shown.scene.project(vessel->axis->point(vessel->axis->length() - 8.0)));
  }
  const std::int32_t second = tree.model.vessels[1]->vessel;
  shown.scene.set_vessel_style(second, {true, {0.0, 0.0, 1.0}});
  const Shot by_vessel = shown.shoot();
  EXPECT_GT(by_vessel.at(on[0]).r, by_vessel.at(on[0]).b + 50);
  EXPECT_GT(by_vessel.at(on[1]).b, by_vessel.at(on[1]).r + 50);
  shown.scene.select_vessel(second);
  const Shot selected = shown.shoot();
  EXPECT_EQ(selected.at(on[1]).difference(by_vessel.at(on[1])), 0);
  EXPECT_LT(selected.at(on[0]).r, by_vessel.at(on[0]).r - 20);
  shown.scene.select_vessel({});
  std::vector<double> values(tree.wall->points.size(), 4.0);
  shown.scene.set_wall_values(values, {"diameter, mm", 1.0, 4.0, ColorScale::sequential});
  const Shot yellow = shown.shoot();
  EXPECT_GT(yellow.at(on[1]).g, yellow.at(on[1]).b + 50);
  EXPECT_GT(yellow.painted(), by_vessel.painted() + 300) << "no bar beside the picture";
  shown.scene.clear_wall_values();
  EXPECT_EQ(shown.shoot().painted(), by_vessel.painted());
  values.pop_back();
  EXPECT_THROW(shown.scene.set_wall_values(values, {}), InvalidInput);
}

TEST(TreeSceneGui, AStretchIsColouredAndTheRestStays) {
  const Tree tree = testing::straight_tree();
  ShownScene shown;
  shown.scene.set_wall(tree.wall, tree.model);
  shown.scene.set_pose(from_front());
  const Shot before = shown.shoot();
  const std::int32_t vessel = tree.model.tree.vessels[0].id;
  shown.scene.set_colored_stretches(
      {{vessel, 10.0, 20.0, {1.0, 0.0, 1.0}}, {99, 0.0, 50.0, {0.0, 1.0, 0.0}}});
  const Shot after = shown.shoot();
  const auto pixel = [&](double s_mm) {
    return shown.scene.project(lumen::vessel(tree.model, vessel).axis->point(s_mm));
  };
  EXPECT_GT(after.at(pixel(15.0)).difference(before.at(pixel(15.0))), 30);
  EXPECT_GT(after.at(pixel(15.0)).b, after.at(pixel(15.0)).g + 30);
  EXPECT_EQ(after.at(pixel(5.0)).difference(before.at(pixel(5.0))), 0);
  EXPECT_EQ(after.at(pixel(25.0)).difference(before.at(pixel(25.0))), 0);
  shown.scene.set_colored_stretches({});
  EXPECT_EQ(shown.shoot().at(pixel(15.0)).difference(before.at(pixel(15.0))), 0);
}

/// The same wall with a bump: points nearer than 3 mm to a place are moved outwards.
std::shared_ptr<const geometry::TriMesh> bumped(const geometry::TriMesh& wall, const Vec3& at) {
  auto result = std::make_shared<geometry::TriMesh>(wall);
  for (Vec3& point : result->points) {
    const double away = (point - at).norm();
    if (away < 3.0) point += 1.5 * (1.0 - away / 3.0) * Vec3(point.x(), point.y(), 0.0).normalized();
  }
  return result;
}

TEST(TreeSceneGui, AWallOfAnotherTimeIsSeenAboutThisOneAndNotPicked) {
  const Tree tree = testing::straight_tree();
  ShownScene shown;
  shown.scene.set_wall(tree.wall, tree.model);
  shown.scene.set_pose(from_front());
  const Shot alone = shown.shoot();
  geometry::TriMesh wider = *tree.wall;  // by half, about the axis
  for (Vec3& point : wider.points) point = {1.5 * point.x(), 1.5 * point.y(), point.z()};
  shown.scene.set_other_wall(std::make_shared<const geometry::TriMesh>(wider));
  const Shot both = shown.shoot();
  const Vec2 beside = shown.scene.project({2.5, 0.0, 20.0}), beyond = shown.scene.project({3.5, 0.0, 20.0});
  EXPECT_LT(alone.at(beside).difference(alone.background()), 5);
  EXPECT_GT(both.at(beside).difference(both.background()), 40);
  EXPECT_LT(both.at(beyond).difference(both.background()), 5);
  EXPECT_FALSE(shown.scene.pick(beside));
  // Half transparent: this wall shines through, and a picture that is saved has both.
  const Vec2 middle = shown.scene.project({0.0, 0.0, 20.0});
  EXPECT_GT(both.at(middle).difference(both.at(beside)), 20);
  const figure::Raster saved = shown.scene.snapshot(400, 300);
  const std::size_t at =
      4 * (static_cast<std::size_t>(299 - beside.y()) * 400 + static_cast<std::size_t>(beside.x()));
  EXPECT_NEAR(saved.rgba[at + 2], both.at(beside).b, 12);
  shown.scene.set_other_wall(nullptr);
  EXPECT_LT(shown.shoot().at(beside).difference(alone.at(beside)), 5);
  geometry::TriMesh broken = wider;
  broken.triangles.front()[0] = -1;
  EXPECT_THROW(shown.scene.set_other_wall(std::make_shared<const geometry::TriMesh>(broken)), InvalidInput);
}

TEST(TreeSceneGui, AnUpdateOfTheWallChangesItThereAlone) {
  const Tree tree = testing::straight_tree();
  ShownScene shown;
  shown.scene.set_wall(tree.wall, tree.model);
  shown.scene.set_pose(from_front());
  const Shot before = shown.shoot();
  shown.scene.set_wall(bumped(*tree.wall, {2.0, 0.0, 20.0}), tree.model);
  const Shot after = shown.shoot();
  int near = 0, far = 0;
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 400; ++x) {
      if (after.at(Vec2(x, y)).difference(before.at(Vec2(x, y))) == 0) continue;
      ++(std::abs(y - 150) <= 5 * 4 ? near : far);  // 3 mm and one ring of triangles, 5 pixels a mm
    }
  }
  EXPECT_GT(near, 80);
  EXPECT_EQ(far, 0);
  const Vec2 on_bump = shown.scene.project({2.9, 0.0, 20.0});
  EXPECT_LT(before.at(on_bump).difference(before.background()), 5);
  EXPECT_GT(after.at(on_bump).difference(after.background()), 40);
  const auto pick = shown.scene.pick(on_bump);
  ASSERT_TRUE(pick);
  EXPECT_NEAR(pick->s_mm, 20.0, 0.3);
}

TEST(TreeSceneGui, OtherTrianglesOnTheSamePointsAreDrawn) {
  const Tree tree = testing::straight_tree();
  ShownScene shown;
  shown.scene.set_wall(tree.wall, tree.model);
  shown.scene.set_pose(from_front());
  const int whole = shown.shoot().painted();
  auto half = std::make_shared<geometry::TriMesh>(*tree.wall);
  std::erase_if(half->triangles, [&](const geometry::Triangle& t) {
    return half->points[static_cast<std::size_t>(t[0])].z() > 20.0;
  });
  shown.scene.set_wall(half, tree.model);
  EXPECT_NEAR(shown.shoot().painted(), 0.5 * whole, 200.0);
}

/// While a hand pulls at one place the wall elsewhere is not drawn again; the picture is that of a scene
/// which knows nothing of the walls before.
TEST(TreeSceneGui, AWallPulledAtOnePlaceLooksAsIfDrawnWhole) {
  const Tree tree = testing::straight_tree();
  ShownScene pulled;
  pulled.scene.set_wall(tree.wall, tree.model);
  pulled.scene.set_pose(from_front());
  pulled.shoot();
  const auto others = [&](const geometry::TriMesh& wall, const auto& change) {
    ShownScene fresh;
    fresh.scene.set_wall(std::make_shared<const geometry::TriMesh>(wall), tree.model);
    fresh.scene.set_pose(from_front());
    change(fresh.scene);
    const Shot wanted = fresh.shoot(), got = pulled.shoot();
    int count = 0;
    for (std::size_t i = 0; i < wanted.pixels.size(); ++i)
      count += wanted.pixels[i].difference(got.pixels[i]) > 3 ? 1 : 0;  // rounding where two pieces meet
    return count;
  };
  const auto nothing = [](TreeScene&) {};
  struct Pull {
    Vec3 at;
    bool kept;
  };
  for (const Pull& pull :
       {Pull{{2.0, 0.0, 20.0}, false}, Pull{{2.0, 0.0, 20.6}, true}, Pull{{2.0, 0.0, 19.5}, true},
        Pull{{-2.0, 0.0, 35.0}, false}, Pull{{-2.0, 0.0, 34.5}, true}}) {
    const auto wall = bumped(*tree.wall, pull.at);
    pulled.scene.set_wall(wall, tree.model);
    EXPECT_EQ(others(*wall, nothing), 0) << pull.at.z();
    EXPECT_EQ(pulled.scene.kept_picture(), pull.kept) << pull.at.z();
  }
  EXPECT_TRUE(pulled.scene.settle());
  EXPECT_FALSE(pulled.scene.settle());
  const auto wall = bumped(*tree.wall, {-2.0, 0.0, 34.5});
  EXPECT_EQ(others(*wall, nothing), 0);
  EXPECT_FALSE(pulled.scene.kept_picture());
  const auto blue = [](TreeScene& scene) { scene.set_vessel_style(4, {true, {0.2, 0.3, 0.9}}); };
  blue(pulled.scene);
  EXPECT_EQ(others(*wall, blue), 0);
  const auto clear = [](TreeScene& scene) { scene.set_opacity(0.5); };
  pulled.scene.set_wall(bumped(*tree.wall, {2.0, 0.0, 10.0}), tree.model);
  pulled.scene.set_wall(wall, tree.model);
  blue(pulled.scene), clear(pulled.scene);
  EXPECT_EQ(others(*wall, [&](TreeScene& scene) { blue(scene), clear(scene); }), 0);
  const auto pick = pulled.scene.pick(pulled.scene.project({-2.9, 0.0, 34.5}));
  ASSERT_TRUE(pick);
  EXPECT_NEAR(pick->s_mm, 34.5, 0.3);
}

TEST(TreeSceneGui, CursorAndMeasurementsAreSeenOverTheWall) {
  const Tree tree = testing::straight_tree();
  ShownScene shown;
  shown.scene.set_wall(tree.wall, tree.model);
  shown.scene.set_pose(from_front());
  const Shot plain = shown.shoot();
  const geometry::AxisCurve& axis = *tree.model.vessels[0]->axis;
  shown.scene.set_cursor(SceneCursor{axis.point(10.0), axis.frame(10.0), 4.0, 0.0, false});
  // Behind the wall for this viewer, so that it is seen only if it is drawn over all.
  shown.scene.set_measurements({{7, {Vec3(0.0, 2.0, 25.0), Vec3(0.0, 2.0, 35.0)}, false, "", false}});
  const Shot marked = shown.shoot();
  const Vec2 ball = shown.scene.project(axis.point(10.0)), ring = shown.scene.project({4.0, 0.0, 10.0});
  const Vec2 line = shown.scene.project({0.0, 2.0, 30.0});
  EXPECT_GT(marked.at(ball).difference(plain.at(ball)), 60);
  EXPECT_GT(marked.at(line).difference(plain.at(line)), 60);
  int on_ring = 0;
  for (int dx = -3; dx <= 3; ++dx)
    on_ring += marked.at(ring + Vec2(dx, 0.0)).difference(plain.background()) > 60 ? 1 : 0;
  EXPECT_GT(on_ring, 0);
  const auto pick = shown.scene.pick(line + Vec2(3.0, 0.0));
  ASSERT_TRUE(pick && pick->measurement && pick->vessel);
  EXPECT_EQ(*pick->measurement, 7);
  EXPECT_NEAR(pick->s_mm, 30.0, 0.3);
  EXPECT_FALSE(shown.scene.pick(line + Vec2(8.0, 0.0))->measurement);
  shown.scene.set_measurements({{8, {Vec3(10.0, 0.0, 25.0), Vec3(10.0, 0.0, 35.0)}, false, "10.0 mm", true}});
  const auto beside = shown.scene.pick(shown.scene.project({10.0, 0.0, 28.0}));
  ASSERT_TRUE(beside && beside->measurement);
  EXPECT_FALSE(beside->vessel);
  EXPECT_NEAR((beside->point - Vec3(10.0, 0.0, 28.0)).norm(), 0.0, 1e-6);
  const Shot with_label = shown.shoot();
  shown.scene.set_measurements({{8, {Vec3(10.0, 0.0, 25.0), Vec3(10.0, 0.0, 35.0)}, false, "", true}});
  EXPECT_GT(with_label.painted(), shown.shoot().painted() + 60);
  shown.scene.set_cursor({});
  shown.scene.set_measurements({});
  EXPECT_EQ(shown.shoot().painted(), plain.painted());
}

/// The wall is not drawn again for a cursor that moves, and nobody sees the difference.
TEST(TreeSceneGui, ACursorThatMovesKeepsThePictureOfTheWall) {
  const Tree tree = testing::straight_tree();
  const auto cursor_at = [](double z) {
    SceneCursor cursor;
    cursor.place = {0.0, 0.0, z};
    cursor.frame = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
    cursor.radius_mm = 3.0;
    return cursor;
  };
  const auto start = [&](ShownScene& shown, double z) {
    shown.scene.set_wall(tree.wall, tree.model);
    shown.scene.set_pose(from_front());
    shown.scene.set_scale_bar_shown(true);
    shown.scene.set_cursor(cursor_at(z));
  };
  ShownScene moved, fresh;
  start(moved, 5.0);
  moved.shoot();
  EXPECT_FALSE(moved.scene.kept_picture());
  moved.scene.set_cursor(cursor_at(30.0));
  const Shot after = moved.shoot();
  EXPECT_TRUE(moved.scene.kept_picture());
  start(fresh, 30.0);
  const Shot wanted = fresh.shoot();
  EXPECT_FALSE(fresh.scene.kept_picture());
  int others = 0;
  for (std::size_t i = 0; i < wanted.pixels.size(); ++i)
    others += wanted.pixels[i].difference(after.pixels[i]) > 0 ? 1 : 0;
  EXPECT_EQ(others, 0);
  // Whatever else changes is drawn.
  const auto drawn_after = [&](const auto& change) {
    moved.shoot();
    EXPECT_TRUE(moved.scene.kept_picture());
    change();
    const Shot now = moved.shoot();
    EXPECT_FALSE(moved.scene.kept_picture());
    return now;
  };
  const Shot red = drawn_after([&] { moved.scene.set_vessel_style(4, {true, {1.0, 0.0, 0.0}}); });
  EXPECT_GT(red.at(moved.scene.project({0.8, 0.0, 10.0})).r,
            2 * red.at(moved.scene.project({0.8, 0.0, 10.0})).b);
  const Shot turned = drawn_after([&] { moved.scene.rotate_by(40.0, 90.0); });
  EXPECT_NE(turned.painted(), red.painted());
  const Shot light = drawn_after([&] { moved.scene.set_look(figure::Look::light); });
  EXPECT_GT(light.background().brightness(), 600);
  drawn_after([&] { moved.scene.clear_wall(); });
}

TEST(TreeSceneGui, APictureInSpaceHasItsPixelsInPlace) {
  ShownScene shown;
  reformat::Plane plane;
  plane.origin = {-10.0, 0.0, 10.0};
  plane.u = Vec3::UnitX();
  plane.v = -Vec3::UnitZ();
  plane.pixel_mm = 1.0;
  plane.width = plane.height = 20;
  ScenePlanePicture picture{plane, std::vector<std::uint8_t>(400, 60)};
  picture.gray[3 * 20 + 15] = 255;  // row 3, column 15
  shown.scene.set_plane(ScenePlane::coronal, picture);
  shown.scene.set_pose(from_front(Vec3::Zero()));
  const Shot shot = shown.shoot();
  const Vec2 landmark = shown.scene.project(reformat::world(plane, {15.5, 3.5}));
  EXPECT_NEAR(shot.at(landmark).r, 255, 12);
  const Vec2 elsewhere = shown.scene.project(reformat::world(plane, {3.5, 15.5}));
  EXPECT_NEAR(shot.at(elsewhere).r, 60, 4);
  shown.scene.set_plane(ScenePlane::coronal, {});
  EXPECT_EQ(shown.shoot().painted(), 0);
  picture.gray.pop_back();
  EXPECT_THROW(shown.scene.set_plane(ScenePlane::axial, picture), InvalidInput);
}

TEST(TreeSceneGui, ASnapshotShowsTheSameInAnotherSize) {
  const Tree tree = testing::straight_tree();
  ShownScene shown;
  shown.scene.set_wall(tree.wall, tree.model);
  shown.scene.set_pose(from_front());
  const Shot before = shown.shoot();
  const figure::Raster picture = shown.scene.snapshot(800, 600);
  ASSERT_EQ(picture.rgba.size(), 800U * 600U * 4U);
  EXPECT_EQ(picture.pixel(0, 0)[3], 255);
  int differ = 0;
  for (int y = 20; y < 280; y += 4) {
    for (int x = 20; x < 380; x += 4) {
      const std::uint8_t* p = picture.pixel(2 * x + 1, 599 - (2 * y + 1));
      differ += Pixel{p[0], p[1], p[2]}.difference(before.at(Vec2(x, y))) > 60 ? 1 : 0;
    }
  }
  EXPECT_LT(differ, 25);  // along the edges alone
  EXPECT_GT(shown.scene.snapshot(64, 64, figure::Look::light).pixel(2, 2)[0], 200);
  EXPECT_EQ(shown.shoot().painted(), before.painted()) << "the snapshot disturbed the window";
  EXPECT_THROW(shown.scene.snapshot(10, 600), InvalidInput);
  EXPECT_THROW(shown.scene.snapshot(100, 9000), InvalidInput);
}

TEST(TreeSceneGui, MarkerAndScaleBarAreDrawn) {
  ShownScene shown;
  shown.scene.set_pose(from_front());
  EXPECT_EQ(shown.shoot().painted(), 0);
  shown.scene.set_scale_bar_shown(true);
  const Shot bar = shown.shoot();
  int longest = 0;
  for (int y = 0; y < 40; ++y) {
    int run = 0;
    for (int x = 0; x < 399; ++x) {
      run = bar.at(Vec2(x, y)).difference(bar.background()) > 60 ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  }
  EXPECT_NEAR(longest, 100, 2);  // 20 mm at 5 pixels a mm is a quarter of the width
  shown.scene.set_scale_bar_shown(false);
  shown.scene.set_marker_shown(true);
  EXPECT_GT(shown.shoot().painted(), 800);
}

TEST(TreeSceneGui, RefusesWhatCannotBeShown) {
  const Tree tree = testing::straight_tree();
  ShownScene shown;
  EXPECT_THROW(shown.scene.set_wall(nullptr, tree.model), InvalidInput);
  auto broken = std::make_shared<geometry::TriMesh>(*tree.wall);
  broken->triangles[5][1] = static_cast<std::int32_t>(broken->points.size());
  EXPECT_THROW(shown.scene.set_wall(broken, tree.model), InvalidInput);
  broken = std::make_shared<geometry::TriMesh>(*tree.wall);
  broken->points[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(shown.scene.set_wall(broken, tree.model), InvalidInput);
  EXPECT_THROW(shown.scene.set_wall(tree.wall, lumen::LumenModel{}), InvalidInput);
  shown.scene.set_wall(tree.wall, tree.model);
  const Shot before = shown.shoot();
  EXPECT_THROW(shown.scene.select_vessel(99), InvalidInput);
  EXPECT_THROW(shown.scene.set_vessel_style(99, {}), InvalidInput);
  EXPECT_THROW(shown.scene.set_opacity(0.0), InvalidInput);
  EXPECT_THROW(shown.scene.set_measurements({{1, {}, false, "", false}}), InvalidInput);
  EXPECT_THROW(shown.scene.set_volume_window(100.0, 0.0), InvalidInput);
  EXPECT_THROW(shown.scene.set_pixel_ratio(0.0), InvalidInput);
  CameraPose skewed;
  skewed.up = skewed.towards;
  EXPECT_THROW(shown.scene.set_pose(skewed), InvalidInput);
  EXPECT_EQ(shown.shoot().painted(), before.painted());
  TreeScene alone;
  EXPECT_THROW(alone.project(Vec3::Zero()), InvalidInput);
  shown.scene.clear_wall();
  EXPECT_EQ(shown.shoot().painted(), 0);
  EXPECT_FALSE(shown.scene.pick({200.0, 150.0}));
}

}  // namespace
}  // namespace ostia::view
