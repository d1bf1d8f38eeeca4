// A tree carried onto an image of the same tubes, turned and shifted, by a map that is off by a known amount.

#include "ostia/session/carry.h"

#include "report_cases.h"
#include "schema_rules.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"
#include "ostia/geometry/rigid_fit.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <numbers>

namespace ostia::session {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr double lumen_hu = 400.0, fat_hu = -80.0, branch_radius_mm = 1.5;

lumen::LumenModel carried_y() {
  geometry::VesselTree tree =
      lumen::testing::tree_of(geometry::y_junction(15.0, 25.0, 2.0, branch_radius_mm, 70.0));
  tree.vessels[0].name = "LAD";
  tree.vessels[1].name = "LCX";
  return lumen::model_of_tubes(tree);
}

geometry::RigidFit turned_patient() {
  geometry::RigidFit motion;
  motion.rotation =
      Eigen::AngleAxisd(std::numbers::pi / 12.0, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  motion.shift = Vec3(12.0, -10.0, 12.0);
  return motion;
}

/// What the later scan shows: the former tree's tubes where `motion` takes them, but for what `hidden` says.
imaging::ImageVolume later_scan(const geometry::VesselTree& tree, const geometry::RigidFit& motion,
                                const std::function<bool(std::int32_t segment, const Vec3& former)>& hidden) {
  constexpr double voxel_mm = 0.5, blur_mm = 0.3;
  constexpr double plane_mm = 4.0;  // beside which there is no vessel
  imaging::ImageVolume image;
  image.geometry.size = {84, 60, 108};
  image.geometry.spacing.setConstant(voxel_mm);
  image.geometry.origin = motion(Vec3(0.0, 0.0, 4.0)) - 0.5 * voxel_mm * Vec3(83.0, 59.0, 107.0);
  for (std::int64_t k = 0; k < image.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < image.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < image.geometry.size[0]; ++i) {
        const Vec3 there = image.geometry.world(
            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        const Vec3 former = motion.rotation.transpose() * (there - motion.shift);
        double share = 0.0;
        if (std::abs(former.y()) > plane_mm) {
          image.voxels.push_back(static_cast<std::int16_t>(fat_hu));
          continue;
        }
        for (const geometry::TreeSegment& segment : tree.segments) {
          const geometry::PolylineLocation foot = geometry::closest(segment.axis.points, former);
          if (hidden(segment.id, foot.point)) continue;
          const double rho = (foot.point - former).norm() - segment.axis.radius[foot.segment];
          share = std::max(share, 0.5 * std::erfc(rho / (blur_mm * std::sqrt(2.0))));
        }
        image.voxels.push_back(static_cast<std::int16_t>(std::lround(fat_hu + share * (lumen_hu - fat_hu))));
      }
  return image;
}

/// Behind the ostium, which is not pulled.
double mean_off_mm(const geometry::Centerline& axis, const geometry::Centerline& former) {
  constexpr double behind_ostium_mm = 5.0;
  std::vector<Vec3> truth;
  for (const Vec3& point : former.points) truth.push_back(turned_patient()(point));
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (axis.abscissa[i] < behind_ostium_mm) continue;
    sum += (geometry::closest(truth, axis.points[i]).point - axis.points[i]).norm();
    ++count;
  }
  return sum / count;
}

struct CarryTest : ::testing::Test {
  const lumen::LumenModel before = carried_y();
  const std::int32_t lad = before.tree.vessels[0].id, lcx = before.tree.vessels[1].id;
  const std::int32_t lcx_segment = before.tree.vessels[1].segments.back();
  static constexpr double map_error_mm = 1.2;

  /// Off by more than half a radius, across all three vessels.
  static Vec3 map(const Vec3& place) {
    const Vec3 across = turned_patient().rotation * Vec3::UnitY();
    return turned_patient()(place) + map_error_mm * across;
  }
  CarriedModel carried(const imaging::ImageVolume& image, const Annotations& annotations = {},
                       const core::TaskContext& task = core::no_task()) const {
    return carry_model(before, annotations, image, map, {}, task);
  }
  static const imaging::ImageVolume& whole_scan() {
    static const imaging::ImageVolume image =
        later_scan(carried_y().tree, turned_patient(), [](std::int32_t, const Vec3&) { return false; });
    return image;
  }
  static geometry::Centerline axis_of(const lumen::LumenModel& model, std::size_t vessel) {
    return geometry::vessel_axis(model.tree, model.tree.vessels[vessel]);
  }
};

TEST_F(CarryTest, AxesAndWallsAreThoseOfTheLaterScan) {
  const CarriedModel made = carried(whole_scan());
  ASSERT_EQ(made.model.tree.vessels.size(), 2u);
  EXPECT_GT(made.followed_share, 0.95);
  EXPECT_FALSE(lumen::find_fault(made.model));
  for (const std::size_t v : {0u, 1u}) {
    EXPECT_EQ(made.model.tree.vessels[v].id, before.tree.vessels[v].id);
    EXPECT_EQ(made.model.tree.vessels[v].name, before.tree.vessels[v].name);
    EXPECT_EQ(made.vessels[v].how, CarriedHow::followed);
    EXPECT_GT(made.vessels[v].largest_shift_mm, 0.8);
    EXPECT_LT(mean_off_mm(axis_of(made.model, v), axis_of(before, v)), 0.15);
  }
  for (const geometry::TreeNode& node : made.model.tree.nodes)
    EXPECT_LT((node.position - turned_patient()(geometry::node(before.tree, node.id).position)).norm(),
              map_error_mm + 0.1);
  const lumen::VesselLumen& branch = lumen::vessel(made.model, lcx);
  for (const lumen::SurfaceSample& sample : branch.samples) {
    const geometry::AxisFoot foot = branch.axis->nearest_foot(sample.position);
    if (foot.s_mm > branch.own_from_mm + 6.0 && foot.s_mm < branch.axis->length() - 3.0) {
      EXPECT_NEAR(foot.rho_mm, branch_radius_mm, 0.25) << foot.s_mm;
    }
  }
}

TEST_F(CarryTest, AVesselThatIsNotSeenIsLeftOutAndTold) {
  Annotations annotations;
  annotations.marks.push_back({lcx, true, true, std::nullopt, "a word"});
  const CarriedModel made =
      carried(later_scan(before.tree, turned_patient(),
                         [&](std::int32_t segment, const Vec3&) { return segment == lcx_segment; }),
              annotations);
  ASSERT_EQ(made.model.tree.vessels.size(), 1u);
  EXPECT_EQ(made.model.tree.vessels[0].id, lad);
  EXPECT_EQ(made.vessels[1].how, CarriedHow::left_out);
  EXPECT_THAT(made.vessels[1].notes, ::testing::Contains(HasSubstr("no lumen")));
  EXPECT_THAT(made.not_carried, ::testing::Contains(HasSubstr("LCX")));
}

TEST_F(CarryTest, AcrossAClosedStretchTheFormerVesselIsKept) {
  // 8 mm of the LAD behind the fork show no lumen; beyond them it goes on.
  const auto closed = [&](std::int32_t segment, const Vec3& former) {
    return segment == before.tree.vessels[0].segments.back() && former.norm() > 9.0 && former.norm() < 17.0;
  };
  const CarriedModel made = carried(later_scan(before.tree, turned_patient(), closed));
  ASSERT_EQ(made.vessels[0].how, CarriedHow::followed);
  EXPECT_NEAR(made.vessels[0].unseen_mm, 7.0, 2.0);
  EXPECT_LT(mean_off_mm(axis_of(made.model, 0), axis_of(before, 0)), 0.3);
  EXPECT_GT(made.vessels[0].wall_kept_share, 0.1);
  const lumen::VesselLumen& vessel = lumen::vessel(made.model, lad);
  double sum = 0.0;
  int count = 0;
  for (const lumen::SurfaceSample& sample : vessel.samples) {
    const geometry::AxisFoot foot = vessel.axis->nearest_foot(sample.position);
    if (std::abs(foot.s_mm - 28.0) > 1.5) continue;
    sum += foot.rho_mm;
    ++count;
  }
  ASSERT_GT(count, 4);
  EXPECT_NEAR(sum / count, branch_radius_mm, 0.15) << "the former radius, in the middle of what is not seen";
}

TEST_F(CarryTest, AnEndThatIsNotSeenIsCut) {
  const CarriedModel made =
      carried(later_scan(before.tree, turned_patient(), [](std::int32_t, const Vec3& former) {
        return former.norm() > 15.0 && former.z() > 0.0;
      }));
  for (const CarriedVessel& one : made.vessels) {
    EXPECT_NEAR(one.cut_mm, 9.0, 3.0);
    EXPECT_THAT(one.notes, ::testing::Contains(HasSubstr("not seen")));
  }
  EXPECT_FALSE(lumen::find_fault(made.model));
}

TEST_F(CarryTest, WhatWasNotedGoesAlongAndNothingIsChecked) {
  Annotations annotations;
  VesselMark mark{lad, false, true, std::array<double, 3>{0.1, 0.2, 0.3}, "look here"};
  mark.lesions.push_back({20.0, 26.0, LesionState::accepted, "soft"});
  annotations.marks.push_back(mark);
  analysis::Measurement note;
  note.id = 7;
  note.kind = analysis::MeasureKind::note;
  note.name = "a place";
  note.points = {Vec3(0.0, 0.0, -5.0)};
  annotations.measurements.push_back(note);
  annotations.next_measurement_id = 8;
  const imaging::ImageVolume& image = whole_scan();
  const CarriedModel made = carried(image, annotations);
  const VesselMark* carried_one = find_mark(made.annotations, lad);
  ASSERT_NE(carried_one, nullptr);
  EXPECT_FALSE(carried_one->visible);
  EXPECT_FALSE(carried_one->checked);
  EXPECT_EQ(carried_one->color, mark.color);
  EXPECT_THAT(carried_one->note, HasSubstr("look here; carried from the former scan, not checked"));
  ASSERT_EQ(carried_one->lesions.size(), 1u);
  EXPECT_NEAR(carried_one->lesions[0].from_mm, 20.0, 0.7);
  EXPECT_NEAR(carried_one->lesions[0].to_mm, 26.0, 0.7);
  EXPECT_EQ(carried_one->lesions[0].state, LesionState::open);
  EXPECT_EQ(carried_one->lesions[0].comment, "accepted in the former scan: soft");
  ASSERT_EQ(made.annotations.measurements.size(), 1u);
  EXPECT_LT((made.annotations.measurements[0].points[0] - turned_patient()(note.points[0])).norm(), 0.7);
  EXPECT_NE(find_mark(made.annotations, lcx), nullptr) << "each vessel says that it was carried";

  const testing::TempFolder folder;
  const ImageReference reference{std::string(64, 'a'), "image-1a2b3c4d"};
  create_case(folder / "new.ostia", made, reference);
  const CaseFile opened = CaseFile::open(folder / "new.ostia");
  EXPECT_EQ(lumen::digest(*opened.model()), lumen::digest(made.model));
  EXPECT_EQ(lumen::digest(*opened.starting_model()), lumen::digest(made.model));
  EXPECT_EQ(opened.image()->sha256, reference.sha256);
  EXPECT_EQ(opened.annotations()->marks.size(), 2u);
  EXPECT_EQ(carried(image).vessels[0].shift_mm, made.vessels[0].shift_mm);
  EXPECT_EQ(lumen::digest(carried(image).model), lumen::digest(made.model));
}

TEST_F(CarryTest, ItsJsonIsThatOfTheSchema) {
  CarriedCase made;
  made.carried = carried(whole_scan());
  made.came.push_back({"D1", Vec3(1.0, 2.0, 3.0), 12.0, 0.9});
  const Json json = Json::parse(carried_json(made));
  EXPECT_EQ(testing::names_in(testing::Schema("carried-case.schema.json")["properties"]),
            testing::names_in(json));
  EXPECT_EQ(json["vessels"][1]["name"], "LCX");
  EXPECT_EQ(json["came"][0]["probability"], 0.9);
  EXPECT_TRUE(json["one_patient"].get<bool>());
}

TEST_F(CarryTest, WhatCannotBeCarriedIsRefused) {
  const imaging::ImageVolume& image = whole_scan();
  const auto refused = [&](const imaging::ImageVolume& after, const analysis::PointMap& by,
                           const CarryOptions& options, const std::string& why) {
    try {
      carry_model(before, {}, after, by, options);
      ADD_FAILURE() << why;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  };
  refused(image, map, {.reach_mm = 20.0}, "reach_mm");
  refused(
      image, [](const Vec3&) { return Vec3(Vec3::Constant(std::nan(""))); }, {}, "no place");
  refused(
      image, [](const Vec3& place) { return Vec3(place + Vec3(500.0, 0.0, 0.0)); }, {}, "outside");
  imaging::ImageVolume plain = image;
  for (std::int16_t& value : plain.voxels) value = std::min<std::int16_t>(value, 40);
  refused(plain, map, {}, "without contrast");
  core::TaskContext cancelled;
  cancelled.cancel();
  EXPECT_THROW(carried(image, {}, cancelled), Cancelled);
}

}  // namespace
}  // namespace ostia::session
