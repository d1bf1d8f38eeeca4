// Vessels that a person adds by clicks: their walls are the search's, their ways keep out of what is wide.

#include "ostia/session/new_vessel.h"

#include "ostia/analysis/lumen_profile.h"
#include "ostia/core/error.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/pipeline/image_walls.h"
#include "ostia/session/case_report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace ostia::session {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;

constexpr double length_mm = 36.0, beside_mm = 16.0;

double blurred(double outside_mm) {
  return 0.5 * std::erfc(outside_mm / (0.3 * std::numbers::sqrt2));
}

/// Two straight arteries along z in fat, 1.7 and 1.3 mm wide; with `chamber`, a ball of 12 mm about the
/// middle of the second.
imaging::ImageVolume two_arteries(bool chamber = false) {
  imaging::ImageVolume image;
  image.geometry.size = {90, 60, 100};
  image.geometry.spacing = {0.4, 0.4, 0.4};
  image.geometry.origin = {-10.0, -12.0, -2.0};
  for (int k = 0; k < 100; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 90; ++i) {
        const Vec3 p = image.geometry.world({double(i), double(j), double(k)});
        double blood = std::max(blurred(std::hypot(p.x(), p.y()) - 1.7),
                                blurred(std::hypot(p.x() - beside_mm, p.y()) - 1.3));
        if (p.z() < 0.0 || p.z() > length_mm) blood = 0.0;
        if (chamber) blood = std::max(blood, blurred((p - Vec3(beside_mm, 0.0, 18.0)).norm() - 12.0));
        image.voxels.push_back(static_cast<std::int16_t>(std::lround(-90.0 + 490.0 * blood)));
      }
  return image;
}

geometry::VesselTree tree_of_both() {
  geometry::VesselTree tree;
  for (int v = 0; v < 2; ++v) {
    geometry::Centerline axis;
    for (int i = 0; i <= 68; ++i) {
      axis.points.emplace_back(v * beside_mm, 0.0, 1.0 + 0.5 * i);
      axis.radius.push_back(v == 0 ? 1.7 : 1.3);
    }
    geometry::complete(axis);
    const std::int32_t first = 10 * v;
    tree.nodes.push_back({first + 1, axis.points.front()});
    tree.nodes.push_back({first + 2, axis.points.back()});
    tree.segments.push_back({first + 3, first + 1, first + 2, std::move(axis)});
    tree.vessels.push_back({first + 4, v == 0 ? "LAD" : "RCA", {first + 3}});
  }
  return tree;
}

double diameter_at(const lumen::LumenModel& model, std::int32_t vessel, double z_mm) {
  const analysis::SurfaceOfVessel surfaces = solved_surfaces(model);
  const auto foot = lumen::vessel(model, vessel).axis->nearest_foot({beside_mm, 0.0, z_mm});
  return analysis::measured_section(model, surfaces, vessel, foot.s_mm).measures.diameter_mm;
}

TEST(NewVessel, AnArteryThatWasDeletedComesBackByTwoClicksAsItWas) {
  const imaging::ImageVolume image = two_arteries();
  const geometry::VesselTree tree = tree_of_both();
  const lumen::LumenModel before =
      lumen::model_of_walls(tree, pipeline::walls_from_image(tree, image, core::no_task()));
  const lumen::LumenModel without = lumen::apply(before, lumen::BranchDelete{14}).model;
  const segmentation::MinimalPath way =
      segmentation::path_between(image, {beside_mm + 0.4, 0.0, 1.5}, {beside_mm, -0.5, 34.0});
  EXPECT_FALSE(require_artery(way, image));
  const lumen::Edit edit = with_wall_and_name(artery_of(way, unused_name(&without)), without, image);
  ASSERT_FALSE(std::get<lumen::VesselAdd>(edit).wall.empty());
  const lumen::LumenModel after = lumen::apply(without, edit).model;
  ASSERT_EQ(after.tree.vessels.size(), 2U);
  const std::int32_t made = after.tree.vessels.back().id;
  for (const double z : {6.0, 12.0, 18.0, 24.0, 29.0})
    EXPECT_NEAR(diameter_at(after, made, z), diameter_at(before, 14, z), 0.05) << z;
}

TEST(NewVessel, OfAWayThroughAChamberIsRefusedOrWarnedOf) {
  const imaging::ImageVolume image = two_arteries(true);
  segmentation::MinimalPath way;
  way.lumen_hu = 400.0, way.background_hu = -90.0;
  for (int i = 0; i <= 68; ++i) way.points.emplace_back(beside_mm, 0.0, 1.0 + 0.5 * i);
  EXPECT_NEAR(wide_stretch_mm(way, image), 21.0, 1.5);  // a chord of the ball 5 mm from its border
  try {
    static_cast<void>(require_artery(way, image));
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_THAT(error.what(), HasSubstr("wider than a coronary artery"));
    EXPECT_THAT(error.what(), HasSubstr("click"));
  }
  way.points.resize(22);  // ends 3 or 4 mm within it
  const auto warning = require_artery(way, image);
  ASSERT_TRUE(warning);
  EXPECT_THAT(*warning, HasSubstr("an aorta or a chamber"));
  EXPECT_FALSE(require_artery(way, image, 11.0));
}

TEST(NewVessel, OtherEditsStayAsTheyAre) {
  const imaging::ImageVolume image = two_arteries();
  const geometry::VesselTree tree = tree_of_both();
  const lumen::LumenModel model = lumen::model_of_tubes(tree);
  const lumen::Edit same = with_wall_and_name(lumen::VesselRename{4, "LM"}, model, image);
  EXPECT_EQ(std::get<lumen::VesselRename>(same).name, "LM");
  segmentation::MinimalPath way;
  way.points = {{0, 0, 0}, {0, 0, 1}};
  EXPECT_THROW(artery_of(way, "V1"), InvalidInput);
}

}  // namespace
}  // namespace ostia::session
