#include "ostia/view/scene_pointer.h"

#include "bench_case.h"
#include "pictures/section_places.h"
#include "shown_scene.h"

#include "ostia/core/error.h"
#include "ostia/view/scene_measurements.h"
#include "ostia/view/words.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::view {
namespace {

using analysis::MeasureKind;
using geometry::Vec2;
using session::Tool;
using testing::ShownScene;

/// A tree in the window, 0.1 mm a pixel, seen from the front: +x to the right, z up, the near wall at -y.
struct SceneHand {
  std::filesystem::path folder;
  session::Workbench bench;
  ShownScene shown;
  ScenePointer hand{shown.scene, bench};
  std::vector<std::string> notes;
  session::Subscription noted =
      bench.noted.observe([this](const std::string& text) { notes.push_back(text); });

  explicit SceneHand(const geometry::VesselTree& tree, const Vec3& target = {0.0, 0.0, 15.0}) {
    std::string name = (std::filesystem::temp_directory_path() / "ostia-scene-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    folder = name;
    bench.set_image(testing::tube_image());
    bench.set_session(session::Session(session::CaseFile::create(
        folder / "case.ostia", lumen::model_of_tubes(tree), bench.image().reference)));
    shown.scene.set_wall(std::make_shared<const geometry::TriMesh>(bench.session().live().wall(0.25)),
                         *bench.model());
    shown.scene.set_pose(pose_from(ViewFrom::anterior, target, 15.0));
  }
  ~SceneHand() {
    bench.close_case();
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  Vec2 px(const Vec3& place) const { return shown.scene.project(place); }
  void click_px(const Vec2& at) {
    const PointerEvent event{at, Button::left};
    hand.move({at});
    EXPECT_FALSE(hand.press(event)) << "the click took hold of something";
    hand.release(event);
    show();
  }
  void click(const Vec3& place) { click_px(px(place)); }
  /// Takes hold at the first place and lets go at the last.
  bool drag(const std::vector<Vec2>& way) {
    const bool held = hand.press({way.front(), Button::left});
    for (const Vec2& at : way) hand.move({at});
    hand.release({way.back(), Button::left});
    show();
    return held;
  }
  void show() { shown.scene.set_measurements(scene_measurements(bench)); }
  std::vector<analysis::Measurement> made() const {
    return bench.session().file().annotations()->measurements;
  }
  double first_value(std::size_t which) const { return bench.measured(made()[which]).front().value; }
};

geometry::VesselTree tube() {
  return lumen::testing::straight_vessel(testing::tube_length_mm, testing::tube_radius_mm);
}

/// On the tube's near wall.
Vec3 near_wall(double x, double z) {
  return {x, -std::sqrt(testing::tube_radius_mm * testing::tube_radius_mm - x * x), z};
}

struct OnTube : ::testing::Test, SceneHand {
  OnTube() : SceneHand(tube()) {}
};

TEST_F(OnTube, TwoClicksAreTheStraightDistanceBetweenPlacesOfTheNearWall) {
  bench.tool.set(Tool::distance);
  const Vec3 a = near_wall(0.7, 10.0), b = near_wall(-1.1, 18.0);
  click(a);
  EXPECT_TRUE(hand.busy());
  EXPECT_TRUE(made().empty());
  click(b);
  EXPECT_FALSE(hand.busy());
  ASSERT_EQ(made().size(), 1U);
  EXPECT_EQ(made()[0].kind, MeasureKind::distance);
  EXPECT_NEAR((made()[0].points[0] - a).norm(), 0.0, 0.05);
  EXPECT_NEAR((made()[0].points[1] - b).norm(), 0.0, 0.05);
  EXPECT_NEAR(first_value(0), (b - a).norm(), 0.05);
  EXPECT_EQ(bench.selected_measurement.get(), made()[0].id);
  ASSERT_TRUE(bench.undo());
  EXPECT_TRUE(made().empty());
}

TEST_F(OnTube, ThreeClicksAreAnAngleWithItsVertexSecond) {
  bench.tool.set(Tool::angle);
  for (const Vec3& place : {near_wall(0.0, 10.0), near_wall(0.0, 15.0), near_wall(1.0, 15.0)}) click(place);
  ASSERT_EQ(made().size(), 1U);
  const Vec3 up(0.0, 0.0, -5.0), across = near_wall(1.0, 15.0) - near_wall(0.0, 15.0);
  EXPECT_NEAR(first_value(0), std::acos(up.dot(across) / up.norm() / across.norm()) * 180.0 / M_PI, 1.0);
}

TEST_F(OnTube, OneClickIsTheDiameterAcrossTheViewAsTheProfileHasIt) {
  bench.tool.set(Tool::diameter);
  click(near_wall(0.9, 12.0));
  ASSERT_EQ(made().size(), 1U);
  const analysis::Measurement one = made()[0];
  EXPECT_EQ(one.vessel, bench.vessel.get());
  EXPECT_NEAR(first_value(0), 2.0 * testing::tube_radius_mm, 0.03);
  EXPECT_NEAR(first_value(0), bench.section(one.vessel, 12.0)->diameter_mm, 0.02);
  for (const Vec3& end : one.points) {
    EXPECT_NEAR(std::hypot(end.x(), end.y()), testing::tube_radius_mm, 0.05);
    EXPECT_NEAR(end.z(), 12.0, 0.15);
    EXPECT_LT(std::abs(end.y()), 0.2) << "not across the line of sight";
  }
  EXPECT_EQ(handles_of(bench, one), one.points);
  const auto shown_now = scene_measurements(bench);
  ASSERT_EQ(shown_now.size(), 1U);
  EXPECT_TRUE(shown_now[0].curves.empty());
}

TEST_F(OnTube, OneClickIsTheOutlineAndItsArea) {
  bench.tool.set(Tool::area);
  click(near_wall(-0.5, 20.0));
  ASSERT_EQ(made().size(), 1U);
  const double exact = bench.section(bench.vessel.get(), 20.0)->area_mm2;
  EXPECT_NEAR(exact, M_PI * testing::tube_radius_mm * testing::tube_radius_mm, 0.15);
  EXPECT_NEAR(first_value(0), exact, 0.001 * exact);
}

TEST_F(OnTube, OneClickIsARingOfCtNumbers) {
  bench.tool.set(Tool::ring_hu);
  click(near_wall(0.0, 9.0));
  ASSERT_EQ(made().size(), 1U);
  EXPECT_NEAR(made()[0].from_mm, 9.0, 0.1);
  const double mean = first_value(0);  // beyond the soft edge there is fat
  EXPECT_GT(mean, testing::fat_hu - 1.0);
  EXPECT_LT(mean, 0.5 * (testing::fat_hu + testing::tube_hu));
}

TEST_F(OnTube, TwoPlacesInEitherOrderAreAStretchOfTheVessel) {
  bench.tool.set(Tool::volume);
  click(near_wall(0.3, 22.0));
  click(near_wall(-0.3, 8.0));
  ASSERT_EQ(made().size(), 1U);
  EXPECT_NEAR(made()[0].from_mm, 8.0, 0.1);
  EXPECT_NEAR(made()[0].to_mm, 22.0, 0.1);
  const double length = made()[0].to_mm - made()[0].from_mm;
  EXPECT_NEAR(first_value(0), M_PI * testing::tube_radius_mm * testing::tube_radius_mm * length,
              0.02 * first_value(0));
}

TEST_F(OnTube, BesideTheWallNothingIsPlacedAndThePersonIsTold) {
  for (const Tool tool : {Tool::distance, Tool::diameter, Tool::stenosis}) {
    bench.tool.set(tool);
    notes.clear();
    click(Vec3(5.0, 0.0, 15.0));
    EXPECT_EQ(notes, std::vector{words().off_wall});
    EXPECT_FALSE(hand.busy());
  }
  bench.tool.set(Tool::distance);
  click(near_wall(0.0, 10.0));
  click(Vec3(5.0, 0.0, 15.0));
  EXPECT_TRUE(hand.busy()) << "the first place is lost";
  click(near_wall(0.0, 20.0));
  ASSERT_EQ(made().size(), 1U);
  EXPECT_NEAR(first_value(0), 10.0, 0.1);
}

TEST_F(OnTube, ADragTurnsTheCameraAndADoubleClickPlacesOnce) {
  bench.tool.set(Tool::distance);
  EXPECT_FALSE(drag({px(near_wall(0.0, 10.0)), px(near_wall(0.0, 14.0))}));
  EXPECT_FALSE(hand.busy());
  click(near_wall(0.0, 10.0));
  click_px(px(near_wall(0.0, 10.0)) + Vec2(1.0, 1.0));
  EXPECT_TRUE(made().empty());
  EXPECT_TRUE(hand.busy());
}

TEST_F(OnTube, EscapeAndAnotherToolDropWhatIsBegun) {
  const auto plain = shown.shoot();
  bench.tool.set(Tool::angle);
  click(near_wall(0.0, 10.0));
  click(near_wall(0.0, 14.0));
  EXPECT_GT(shown.shoot().at(px({0.0, 0.0, 12.0})).difference(plain.at(px({0.0, 0.0, 12.0}))), 60)
      << "what is begun is not shown";
  hand.cancel();
  EXPECT_FALSE(hand.busy());
  EXPECT_EQ(shown.shoot().painted(), plain.painted());
  click(near_wall(0.0, 10.0));
  bench.tool.set(Tool::distance);
  EXPECT_FALSE(hand.busy());
  EXPECT_TRUE(made().empty());
  EXPECT_EQ(bench.session().file().journal().size(), 1U);  // the case's begin
}

TEST_F(OnTube, ALineFollowsTheMouseOverTheWallWithItsLength) {
  bench.tool.set(Tool::distance);
  const auto plain = shown.shoot();
  int asked = 0;
  const auto again = hand.stale.observe([&] { ++asked; });
  click(near_wall(0.0, 8.0));
  hand.move({px(near_wall(0.0, 20.0))});
  EXPECT_GE(asked, 2);
  EXPECT_EQ(hand.shape(), CursorShape::cross);
  const Vec2 between = px({0.0, 0.0, 14.0});
  EXPECT_GT(shown.shoot().at(between).difference(plain.at(between)), 60);
  hand.move({px({6.0, 0.0, 20.0})});  // off the wall
  EXPECT_EQ(hand.shape(), CursorShape::arrow);
  EXPECT_LT(shown.shoot().at(between).difference(plain.at(between)), 10);
  EXPECT_TRUE(made().empty());
}

TEST_F(OnTube, AHandleOfTheSelectedMeasurementIsDraggedOverTheWallAsOneStep) {
  bench.tool.set(Tool::distance);
  click(near_wall(0.0, 8.0));
  click(near_wall(0.0, 20.0));
  bench.tool.set(Tool::browse);
  const Vec2 end = px(near_wall(0.0, 20.0));
  hand.move({end});
  EXPECT_EQ(hand.shape(), CursorShape::grab);
  EXPECT_TRUE(drag({end, px(near_wall(0.2, 22.0)), px(near_wall(0.6, 24.0)), px({7.0, 0.0, 24.0})}));
  EXPECT_NEAR((made()[0].points[1] - near_wall(0.6, 24.0)).norm(), 0.0, 0.05) << "the last place on the wall";
  ASSERT_TRUE(bench.undo());
  EXPECT_NEAR(first_value(0), 12.0, 0.1);
  ASSERT_TRUE(bench.undo());
  EXPECT_TRUE(made().empty());
  ASSERT_TRUE(bench.redo());
  bench.selected_measurement.set(0);
  EXPECT_FALSE(drag({end, end + Vec2(0.0, 40.0)})) << "a measurement that is not selected was moved";
}

TEST_F(OnTube, EscapeBringsAHandleBackAndAButtonThatWentUpUnseenLeavesIt) {
  bench.tool.set(Tool::distance);
  click(near_wall(0.0, 8.0));
  click(near_wall(0.0, 20.0));
  const Vec2 end = px(near_wall(0.0, 20.0)), there = px(near_wall(0.0, 24.0));
  const auto pull = [&] {
    ASSERT_TRUE(hand.press({end, Button::left}));
    hand.move({px(near_wall(0.0, 22.0))});
    hand.move({there});
    ASSERT_NEAR(first_value(0), 16.0, 0.1);
  };
  pull();
  hand.cancel();
  EXPECT_NEAR(first_value(0), 12.0, 0.1);
  hand.move({px(near_wall(0.0, 26.0))});
  hand.release({px(near_wall(0.0, 26.0)), Button::left});
  EXPECT_NEAR(first_value(0), 12.0, 0.1);
  pull();
  hand.let_go();
  hand.move({px(near_wall(0.0, 26.0))});
  EXPECT_NEAR(first_value(0), 16.0, 0.1);
  EXPECT_EQ(made().size(), 1U);
  EXPECT_FALSE(hand.busy());
}

TEST_F(OnTube, AnEndOfAStretchGoesAlongTheVesselAndNotPastTheOther) {
  bench.tool.set(Tool::volume);
  click(near_wall(0.0, 8.0));
  click(near_wall(0.0, 20.0));
  const auto at_axis = [&](double z) { return px({0.0, 0.0, z}); };
  EXPECT_TRUE(drag({at_axis(20.0), at_axis(18.0), at_axis(16.0)}));
  EXPECT_NEAR(made()[0].to_mm, 16.0, 0.1);
  EXPECT_TRUE(drag({at_axis(16.0), at_axis(12.0), at_axis(5.0)}));
  EXPECT_NEAR(made()[0].from_mm, 8.0, 0.1);
  EXPECT_NEAR(made()[0].to_mm, 12.0, 0.1);
}

TEST_F(OnTube, DeleteTakesWhatIsUnderTheMouseOrSelected) {
  bench.tool.set(Tool::distance);
  for (const double z : {5.0, 15.0}) {
    click(near_wall(-0.5, z));
    click(near_wall(0.5, z + 4.0));
  }
  ASSERT_EQ(made().size(), 2U);
  EXPECT_EQ(bench.selected_measurement.get(), made()[1].id);
  EXPECT_TRUE(hand.erase({px(0.5 * (near_wall(-0.5, 5.0) + near_wall(0.5, 9.0)))}));
  ASSERT_EQ(made().size(), 1U);
  EXPECT_NEAR(made()[0].points[0].z(), 15.0, 0.05);
  show();
  EXPECT_TRUE(hand.erase({px({8.0, 0.0, 25.0})}));
  EXPECT_TRUE(made().empty());
  show();
  EXPECT_FALSE(hand.erase({px({8.0, 0.0, 25.0})}));
  EXPECT_TRUE(bench.undo());
  EXPECT_EQ(made().size(), 1U);
}

TEST_F(OnTube, WithoutAMeasuringToolAClickChoosesPlaceAndMeasurement) {
  bench.tool.set(Tool::distance);
  click(near_wall(-0.5, 5.0));
  click(near_wall(0.5, 9.0));
  bench.tool.set(Tool::browse);
  bench.selected_measurement.set(0);
  click(0.5 * (near_wall(-0.5, 5.0) + near_wall(0.5, 9.0)));
  EXPECT_NEAR(bench.cursor_mm.get(), 7.0, 0.2);
  EXPECT_EQ(bench.selected_measurement.get(), made()[0].id);
}

TEST_F(OnTube, LabelsSayNameAndValueAndStretchesHaveOutlines) {
  bench.tool.set(Tool::stenosis);
  click(near_wall(0.0, 8.0));
  click(near_wall(0.0, 22.0));
  const auto all = scene_measurements(bench);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].label.substr(0, all[0].label.find(' ')), "Stenosis");
  EXPECT_EQ(all[0].label.back(), '%');
  ASSERT_EQ(all[0].curves.size(), 4U);  // the axis, two ends, the throat
  for (std::size_t i = 1; i < 4; ++i)
    for (const Vec3& point : all[0].curves[i].points)
      EXPECT_NEAR(std::hypot(point.x(), point.y()), testing::tube_radius_mm, 0.05);
  bench.marks_shown.set(false);
  EXPECT_TRUE(scene_measurements(bench).empty());
}

/// A parent along +z that ends at the origin (with the first child: vessel A), and two children.
struct OnY : ::testing::Test, SceneHand {
  OnY() : SceneHand(lumen::testing::tree_of(geometry::y_junction(20.0, 30.0, 2.0, 1.5, 80.0)), Vec3::Zero()) {
    shown.scene.set_pose(pose_from(ViewFrom::anterior, Vec3::Zero(), 40.0));
  }
  const lumen::VesselLumen& vessel(std::size_t which) const { return *bench.model()->vessels[which]; }
  Vec3 on_axis(std::size_t which, double s_mm) const { return vessel(which).axis->point(s_mm); }
};

TEST_F(OnY, AStenosisOfTwoVesselsIsRefusedAndTheFirstPlaceStays) {
  bench.tool.set(Tool::stenosis);
  click(on_axis(0, 38.0));
  click(on_axis(1, 38.0));
  EXPECT_TRUE(made().empty());
  EXPECT_EQ(notes, std::vector{words().other_vessel});
  EXPECT_TRUE(hand.busy());
  click(on_axis(0, 26.0));
  ASSERT_EQ(made().size(), 1U);
  EXPECT_EQ(made()[0].vessel, vessel(0).vessel);
  EXPECT_NEAR(made()[0].from_mm, 26.0, 0.3);
  EXPECT_NEAR(made()[0].to_mm, 38.0, 0.3);
}

TEST_F(OnY, ABranchsWayLeadsThroughItsParent) {
  bench.tool.set(Tool::volume);
  click(on_axis(0, 10.0));  // the wall of the first vessel, which both share
  click(on_axis(1, 40.0));
  ASSERT_EQ(made().size(), 1U);
  EXPECT_EQ(made()[0].vessel, vessel(1).vessel);
  EXPECT_NEAR(made()[0].from_mm, 10.0, 0.3);
  EXPECT_NEAR(made()[0].to_mm, 40.0, 0.3);
}

TEST_F(OnY, WhatLostItsVesselIsNotShownAndAGestureOnItEnds) {
  bench.tool.set(Tool::volume);
  click(on_axis(1, 30.0));
  click(on_axis(1, 40.0));
  ASSERT_EQ(made().size(), 1U);
  click(on_axis(1, 45.0));
  ASSERT_TRUE(hand.busy());
  bench.edit(lumen::BranchDelete{vessel(1).vessel});
  EXPECT_FALSE(hand.busy());
  EXPECT_TRUE(scene_measurements(bench).empty());
  EXPECT_EQ(made().size(), 1U);
}

TEST(SectionPlaces, ADiameterOfAnEllipseIsThatOfTheCircleOfItsArea) {
  analysis::MeasuredSection section;
  section.measures.centroid = {1.0, 2.0, 3.0};
  section.measures.normal = Vec3::UnitZ();
  const double a = 2.0, b = 1.2;
  section.measures.diameter_mm = 2.0 * std::sqrt(a * b);
  for (int i = 0; i < 128; ++i) {
    const double t = 2.0 * M_PI * i / 128;
    section.contour.push_back(section.measures.centroid + Vec3(a * std::cos(t), b * std::sin(t), 0.0));
  }
  for (const Vec3& sight : {Vec3(1.0, 0.3, 0.0), Vec3(0.2, -1.0, 0.5)}) {
    const auto ends = diameter_ends(section, sight.normalized());
    ASSERT_TRUE(ends);
    EXPECT_NEAR((ends->first - ends->second).norm(), section.measures.diameter_mm, 0.006);
    for (const Vec3& end : {ends->first, ends->second}) {
      const Vec3 off = end - section.measures.centroid;
      EXPECT_NEAR(off.x() * off.x() / (a * a) + off.y() * off.y() / (b * b), 1.0, 2e-3) << "not on the wall";
    }
    // Of the two lines of this length the one more across the line of sight.
    const Vec3 along = (ends->first - ends->second).normalized();
    const Vec3 mirrored(along.x(), -along.y(), along.z());
    EXPECT_LE(std::abs(along.dot(sight)), std::abs(mirrored.dot(sight)) + 1e-6);
  }
  section.measures.centroid.x() += 10.0;
  EXPECT_FALSE(diameter_ends(section, Vec3::UnitX()));
}

TEST(SceneLabels, KeepApartAndWithinThePicture) {
  ShownScene shown;
  shown.scene.set_pose(pose_from(ViewFrom::anterior, Vec3::Zero(), 15.0));
  const auto painted = [&](const std::vector<Vec3>& places, const std::string& text) {
    std::vector<SceneMeasurement> all;
    for (const Vec3& place : places) all.push_back({1, {place}, false, text, false});
    shown.scene.set_measurements(all);
    return shown.shoot().painted();
  };
  const int letters = painted({Vec3::Zero()}, "12.3 mm") - painted({Vec3::Zero()}, "");
  ASSERT_GT(letters, 60);
  EXPECT_NEAR(painted({Vec3::Zero(), Vec3::Zero()}, "12.3 mm") - painted({Vec3::Zero(), Vec3::Zero()}, ""),
              2 * letters, 0.1 * letters)
      << "one label hides the other";
  const Vec3 at_edge(19.0, 0.0, 14.0);  // 10 pixels from the corner
  EXPECT_NEAR(painted({at_edge}, "12.3 mm") - painted({at_edge}, ""), letters, 0.15 * letters)
      << "the label is cut off";
  const Vec3 outside(30.0, 0.0, 0.0);
  EXPECT_EQ(painted({outside}, "12.3 mm"), 0);
}

TEST(SceneLabels, ADraftIsSeenAndNotPicked) {
  ShownScene shown;
  shown.scene.set_pose(pose_from(ViewFrom::anterior, Vec3::Zero(), 15.0));
  const SceneMeasurement line{5, {Vec3(-5.0, 0.0, 0.0), Vec3(5.0, 0.0, 0.0)}, false, "", false};
  shown.scene.set_draft(line);
  EXPECT_GT(shown.shoot().painted(), 100);
  EXPECT_FALSE(shown.scene.pick(shown.scene.project(Vec3::Zero())));
  shown.scene.set_draft({});
  EXPECT_EQ(shown.shoot().painted(), 0);
  shown.scene.set_measurements({line});
  EXPECT_TRUE(shown.scene.pick(shown.scene.project(Vec3::Zero())));
  SceneMeasurement broken = line;
  broken.curves.push_back({{Vec3(NAN, 0.0, 0.0)}, false});
  EXPECT_THROW(shown.scene.set_draft(broken), InvalidInput);
}

TEST(ScenePointer, WithoutACaseNothingHappens) {
  session::Workbench bench;
  ShownScene shown;
  ScenePointer hand(shown.scene, bench);
  bench.tool.set(Tool::distance);
  const PointerEvent at{Vec2(200.0, 150.0), Button::left};
  hand.move(at);
  EXPECT_FALSE(hand.press(at));
  hand.release(at);
  EXPECT_FALSE(hand.erase(at));
  EXPECT_FALSE(hand.busy());
}

}  // namespace
}  // namespace ostia::view
