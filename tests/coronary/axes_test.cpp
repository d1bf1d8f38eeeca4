#include "ostia/coronary/axes.h"

#include "artery_scene.h"
#include "calcified_tube.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/polyline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ostia::coronary {
namespace {

using testing::Scene;
using testing::Tube;

double off_axes(const Scene& scene, const Vec3& place) {
  double nearest = 1e9;
  for (const Tube& tube : scene.arteries) nearest = std::min(nearest, tube.distance(place) + tube.radius_mm);
  return nearest;
}

TEST(CentredTree, AxesLieInTheMiddleAndJoin) {
  const Scene scene;
  const imaging::ImageVolume image = scene.image();
  const GrownTree grown = grow_tree(image, Scene::aorta(), scene.ostia());
  const CentredTree found = centred_tree(image, grown, scene.ostia());
  EXPECT_EQ(geometry::find_fault(found.tree).value_or("none"), "none");
  EXPECT_EQ(geometry::roots(found.tree).size(), 1U);
  ASSERT_EQ(found.tree.vessels.size(), 2U);
  ASSERT_EQ(found.notes.size(), 2U);
  EXPECT_TRUE(found.warnings.empty());

  const geometry::Centerline trunk = geometry::vessel_axis(found.tree, found.tree.vessels[0]);
  const geometry::Centerline side = geometry::vessel_axis(found.tree, found.tree.vessels[1]);
  const Vec3 fork(0.0, 0.0, 20.0), corner(8.0, 0.0, 20.0);
  EXPECT_LT((trunk.points.front() - scene.ostium).norm(), 1.0);
  double most = 0.0;
  std::size_t looked_at = 0;
  for (const geometry::Centerline& axis : {trunk, side}) {
    for (std::size_t i = 0; i < axis.size(); ++i) {
      const Vec3& p = axis.points[i];
      if (axis.abscissa[i] < 2.0 || axis.abscissa[i] > axis.abscissa.back() - 2.0) continue;
      if ((p - fork).norm() < 5.0 || (p - corner).norm() < 4.0) continue;
      most = std::max(most, off_axes(scene, p));
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, 80U);
  EXPECT_LT(most, 0.15);  // a third of a voxel
  const Vec3 left = geometry::node(found.tree, geometry::segment(found.tree, 2).from).position;
  EXPECT_LT((left - fork).norm(), 1.0) << "where the side branch leaves";
  for (const AxisNotes& notes : found.notes) EXPECT_GT(notes.evidence, 0.7);
}

TEST(CentredTree, RadiiAreTheLumens) {
  const Scene scene;
  const imaging::ImageVolume image = scene.image();
  const CentredTree found =
      centred_tree(image, grow_tree(image, Scene::aorta(), scene.ostia()), scene.ostia());
  for (const geometry::Vessel& vessel : found.tree.vessels) {
    const geometry::Centerline axis = geometry::vessel_axis(found.tree, vessel);
    for (std::size_t i = 0; i < axis.size(); ++i) {
      const double x = axis.points[i].x(), z = axis.points[i].z();
      if (x > -8.0 && x < -3.0) {
        EXPECT_NEAR(axis.radius[i], 1.6, 0.25) << x;
      }
      if (x > 12.0 && x < 19.0 && z < 18.0) {
        EXPECT_NEAR(axis.radius[i], 1.2, 0.25) << x;
      }
      if (z > 25.0 && z < 28.5) {
        EXPECT_NEAR(axis.radius[i], 1.0, 0.25) << z;
      }
    }
  }
}

TEST(CentredTree, BesideCalciumTheAxisIsTheBoundarysMiddle) {
  using CalcifiedTube = ostia::testing::CalcifiedTube;
  GrownTree grown;
  grown.branches.resize(1);
  grown.branches[0].points = CalcifiedTube::line_through_nodule();
  std::vector<Ostium> ostia(1);
  ostia[0].place = grown.branches[0].points.front();
  ostia[0].direction = Vec3::UnitZ();
  const CentredTree found = centred_tree(CalcifiedTube::image(), grown, ostia);
  ASSERT_EQ(found.tree.vessels.size(), 1U);
  const geometry::Centerline axis = geometry::vessel_axis(found.tree, found.tree.vessels[0]);
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const double z = axis.points[i].z(), away = std::abs(z - CalcifiedTube::throat_mm);
    if (z < 4.0 || z > CalcifiedTube::length_mm - 4.0) continue;
    const double off = (axis.points[i] - CalcifiedTube::middle(z)).norm();
    EXPECT_LT(off, 0.25) << z;
    if (away > 4.0) continue;
    EXPECT_NEAR(axis.radius[i], CalcifiedTube::radius(z), 0.2) << z;
    sum += off;
    ++count;
  }
  ASSERT_GT(count, 10);
  EXPECT_LT(sum / count, 0.15);
}

TEST(CentredTree, AcrossAClosedStretchItIsStraightAndSaysSo) {
  const Scene scene = Scene::closed();
  const imaging::ImageVolume image = scene.image();
  const CentredTree found =
      centred_tree(image, grow_tree(image, Scene::aorta(), scene.ostia()), scene.ostia());
  ASSERT_EQ(found.tree.vessels.size(), 1U);
  const geometry::Centerline axis = geometry::vessel_axis(found.tree, found.tree.vessels[0]);
  EXPECT_GT(axis.points.back().x(), 20.0);
  for (const Vec3& point : axis.points)
    if (point.x() > -3.0 && point.x() < 9.0) {
      EXPECT_NEAR(point.y(), 0.0, 0.3) << point.transpose();
    }
  const std::vector<std::string>& said = found.notes[0].warnings;
  EXPECT_TRUE(std::any_of(said.begin(), said.end(),
                          [](const std::string& one) { return one.starts_with("no lumen is seen for "); }));
}

TEST(CentredTree, EachOstiumIsARoot) {
  Scene scene;
  scene.arteries = {{{-20.0, -8.0, 20.0}, {10.0, -8.0, 20.0}, 1.4},
                    {{-20.0, 8.0, 20.0}, {10.0, 8.0, 24.0}, 1.2}};
  scene.vein = {{0.0, 30.0, 0.0}, {5.0, 30.0, 0.0}, 1.0};
  scene.chamber_radius_mm = 5.0;
  std::vector<Ostium> ostia(2);
  for (std::size_t i = 0; i < 2; ++i) {
    ostia[i].place = scene.arteries[i].from;
    ostia[i].direction = Vec3::UnitX();
  }
  const imaging::ImageVolume image = scene.image(0.5);
  const GrownTree grown = grow_tree(image, Scene::aorta(), ostia);
  core::TaskContext task;
  const CentredTree found = centred_tree(image, grown, ostia, {}, task);
  EXPECT_EQ(task.progress(), 1.0);
  EXPECT_EQ(geometry::find_fault(found.tree).value_or("none"), "none");
  EXPECT_EQ(geometry::roots(found.tree).size(), 2U);
  EXPECT_EQ(found.tree.vessels.size(), 2U);
}

TEST(CentredTree, ABranchThatIsNoneIsLeftOutAndSaid) {
  const Scene scene;
  const imaging::ImageVolume image = scene.image();
  GrownTree grown = grow_tree(image, Scene::aorta(), scene.ostia());
  GrownBranch wrong = grown.branches[1];
  wrong.points = {Vec3(-10.0, 0.0, 20.0), Vec3(-5.0, 0.1, 20.0), Vec3(0.0, 0.0, 20.1)};  // within the trunk
  grown.branches.push_back(wrong);
  const CentredTree found = centred_tree(image, grown, scene.ostia());
  EXPECT_EQ(found.tree.vessels.size(), 2U);
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_NE(found.warnings[0].find("a branch of 10.0 mm was left out"), std::string::npos)
      << found.warnings[0];
}

TEST(CentredTree, TheSameForAnyNumberOfThreads) {
  const Scene scene;
  const imaging::ImageVolume image = scene.image(0.6);
  const GrownTree grown = grow_tree(image, Scene::aorta(), scene.ostia());
  core::set_max_threads(1);
  const CentredTree alone = centred_tree(image, grown, scene.ostia());
  core::set_max_threads(3);
  const CentredTree together = centred_tree(image, grown, scene.ostia());
  core::set_max_threads(0);
  ASSERT_EQ(alone.tree.segments.size(), together.tree.segments.size());
  for (std::size_t i = 0; i < alone.tree.segments.size(); ++i) {
    EXPECT_EQ(alone.tree.segments[i].axis.points, together.tree.segments[i].axis.points);
    EXPECT_EQ(alone.tree.segments[i].axis.radius, together.tree.segments[i].axis.radius);
  }
}

TEST(CentredTree, RefusesWhatItCannotUseAndStopsWhenTold) {
  const Scene scene;
  const imaging::ImageVolume image = scene.image(1.0);
  GrownTree grown;
  EXPECT_THROW(centred_tree(image, grown, scene.ostia()), InvalidInput);
  grown.branches.resize(1);
  grown.branches[0].points = {scene.ostium, Vec3(8.0, 0.0, 20.0)};
  AxesOptions options;
  options.step_mm = 0.0;
  EXPECT_THROW(centred_tree(image, grown, scene.ostia(), options), InvalidInput);
  EXPECT_THROW(centred_tree(image, grown, {}), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(centred_tree(image, grown, scene.ostia(), {}, task), Cancelled);
  grown.branches[0].parent = 0;
  EXPECT_THROW(centred_tree(image, grown, scene.ostia()), InvalidInput);
  // Nothing but what cannot be followed.
  grown.branches[0].parent = -1;
  grown.branches[0].points = {scene.ostium, Vec3(900.0, 0.0, 20.0)};
  EXPECT_THROW(centred_tree(image, grown, scene.ostia()), GeometryError);
}

}  // namespace
}  // namespace ostia::coronary
