#include "ostia/phantom/patient_heart.h"

#include "patient_of_phantom.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/polyline.h"
#include "ostia/phantom/body.h"
#include "ostia/phantom/case_folder.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/phantom/truth.h"
#include "ostia/phantom/vessel_field.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using ostia::testing::patient_of_phantom;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double degrees = std::numbers::pi / 180.0;

/// Where a patient lies that is this phantom, turned by 14 degrees and elsewhere.
Vec3 moved(const Vec3& p) {
  const Eigen::AngleAxisd turn(14.0 * degrees, Vec3(0.4, -0.7, 0.59).normalized());
  return turn * p + Vec3(31.0, -120.0, 488.0);
}
Vec3 stays(const Vec3& p) {
  return p;
}

struct Own {
  HeartShape heart;
  CoronaryTree tree;
};
Own own_of(std::uint64_t seed) {
  Own own{draw_heart(seed), {}};
  CoronaryOptions options;
  options.seed = seed;
  options.disease = 0.0;
  own.tree = draw_coronaries(own.heart, options);
  return own;
}

CoronaryOptions healthy_options(std::uint64_t seed) {
  CoronaryOptions options;
  options.seed = seed;
  options.disease = 0.0;
  return options;
}

const CoronaryVessel& built_vessel(const CoronaryTree& tree, const std::string& name) {
  const auto at = std::ranges::find(tree.vessels, name, &CoronaryVessel::name);
  if (at == tree.vessels.end()) throw InvalidInput("no " + name);
  return *at;
}

TEST(PatientHeart, ThePhantomsOwnTreeComesBackToItsPlace) {
  for (const std::uint64_t seed : {1, 4, 9}) {
    const Own own = own_of(seed);
    const PatientHeart built =
        patient_heart(patient_of_phantom(own.tree, moved), own.heart, healthy_options(seed));
    double off = 0.0, radius_off = 0.0;
    std::size_t n = 0;
    for (const CoronaryVessel& vessel : own.tree.vessels) {
      const CoronaryVessel& back = built_vessel(built.tree, vessel.name);
      for (std::size_t i = 0; i < vessel.axis.size(); i += 10) {
        const Vec3 placed = built.record.rotation * moved(vessel.axis.points[i]) + built.record.shift_mm;
        const auto foot = geometry::closest(back.axis.points, placed);
        // A patient's axis is made smoother where its bends are tight, and no more.
        EXPECT_LT((foot.point - placed).norm(), 0.6) << seed << " " << vessel.name << " " << i;
        off += (placed - vessel.axis.points[i]).norm();
        radius_off += std::abs(back.axis.radius[foot.segment] - vessel.healthy_radius_mm[i]);
        ++n;
      }
    }
    EXPECT_LT(off / static_cast<double>(n), 5.0) << "it lies where it was drawn";
    EXPECT_LT(radius_off / static_cast<double>(n), 0.06);
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(built.record.size[a], 1.0, 0.08);
  }
}

TEST(PatientHeart, TheHeartIsBentUnderTheArteriesAndNeverFolds) {
  const Own own = own_of(2), other = own_of(7);
  // Another heart's tree: longer, turned.
  const PatientHeart built =
      patient_heart(patient_of_phantom(other.tree, [](const Vec3& p) { return Vec3(1.08 * moved(p)); }),
                    own.heart, healthy_options(2));
  EXPECT_GT(built.record.least_jacobian, 0.2);
  EXPECT_LT(built.record.height_left_mm, 1.0);
  EXPECT_LT(built.record.groove_left_mm, 2.0);
  EXPECT_LT(built.record.height_left_mm, built.record.height_mm);
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(40, -30, -20), Vec3(-30, 10, -10)})
    EXPECT_LT((built.warp->to_own(built.warp->to_world(p)) - p).norm(), 1e-5);
  // Away from the heart, nothing moves much.
  EXPECT_LT((built.warp->to_own({-8, 100, 0}) - Vec3(-8, 100, 0)).norm(), 6.0);
}

TEST(PatientHeart, ArteriesOpenIntoTheAortaAndRunBesideMuscleAndFat) {
  const Own own = own_of(3), other = own_of(5);
  const PatientHeart built =
      patient_heart(patient_of_phantom(other.tree, moved), own.heart, healthy_options(3));
  const Body body(own.heart, built.tree, draw_body(3), built.warp);
  for (const char* name : {"LAD", "RCA"}) {
    const geometry::Centerline& axis = built_vessel(built.tree, name).axis;
    const Vec3 before = axis.points.front() - 1.5 * axis.frames.front().tangent;
    EXPECT_EQ(body.at(before).label, Label::aorta) << name;
    EXPECT_EQ(body.at(axis.points[axis.size() / 2]).label, Label::coronary_lumen) << name;
  }
  // Beyond an artery's wall and its fat there is no chamber on the outer side.
  std::size_t chamber = 0, looked = 0;
  const geometry::Centerline& lad = built_vessel(built.tree, "LAD").axis;
  for (std::size_t i = 300; i < lad.size(); i += 20) {
    const Vec3 out =
        (lad.points[i] - (own.heart.base + 0.3 * own.heart.length_mm * own.heart.long_axis)).normalized();
    const Label label = body.at(lad.points[i] + 5.0 * out).label;
    chamber += label == Label::left_ventricle || label == Label::right_ventricle || label == Label::myocardium
                   ? 1
                   : 0;
    ++looked;
  }
  EXPECT_LT(chamber, looked / 10);
}

TEST(PatientHeart, TheTruthLiesOnTheBoundary) {
  const Own own = own_of(3), other = own_of(6);
  CoronaryOptions options = healthy_options(3);
  options.disease = 1.5;
  const CoronaryTree tree = patient_heart(patient_of_phantom(other.tree, moved), own.heart, options).tree;
  const VesselField field(tree);
  EXPECT_EQ(geometry::find_fault(vessel_tree(tree)).value_or("none"), "none");
  std::size_t stenoses = 0;
  for (const CoronaryVessel& vessel : tree.vessels) {
    stenoses += vessel.stenoses.size();
    for (const Stretch& free : free_stretches(tree, vessel.id))
      for (double s = free.from_mm; s < free.to_mm; s += 3.7)
        for (const double theta : {0.3, 1.9, 4.4})
          EXPECT_NEAR(field.value(Boundary::lumen, boundary_point(vessel, Boundary::lumen, s, theta), 1.0),
                      0.0, 1e-4)
              << vessel.name << " " << s;
  }
  EXPECT_GT(stenoses, 0U);
}

TEST(PatientHeart, WhatTheMaskLacksIsGrownAndDrawnAndTold) {
  const Own own = own_of(3);
  const auto left = [](const std::string& name) { return name == "LAD" || name == "LCX"; };
  const PatientHeart built =
      patient_heart(patient_of_phantom(own.tree, moved, left, 0.6), own.heart, healthy_options(3));
  const CoronaryVessel& lad = built_vessel(built.tree, "LAD");
  // To the apex.
  const Vec3 end = built.warp->to_own(lad.axis.points.back());
  EXPECT_GT((end - own.heart.base).dot(own.heart.long_axis), 0.85 * own.heart.length_mm);
  for (const PatientPart& part : built.record.parts)
    if (part.vessel == "LAD") {
      EXPECT_GT(part.grown_mm, 20.0);
      EXPECT_GT(part.measured_mm, 50.0);
    }
  EXPECT_EQ(built_vessel(built.tree, "RCA").parent, -1);
  EXPECT_GT(built_vessel(built.tree, "PDA").axis.abscissa.back(), 30.0);
  EXPECT_THAT(built.record.remarks, Contains(AllOf(HasSubstr("drawn"), HasSubstr("RCA"), HasSubstr("PDA"))));
  for (const CoronaryVessel& vessel : built.tree.vessels)
    for (double s = 0.0; s < vessel.axis.abscissa.back(); s += 2.0)
      EXPECT_GT(vessel.lumen.min_at(s), 0.4) << vessel.name << " " << s;
}

TEST(PatientHeart, WhatIsNoHeartIsRefusedInASentence) {
  const Own own = own_of(1);
  const auto twice = [](const Vec3& p) { return Vec3(1.8 * moved(p)); };
  EXPECT_THAT([&] { patient_heart(patient_of_phantom(own.tree, twice), own.heart, healthy_options(1)); },
              ThrowsMessage<InvalidInput>(HasSubstr("times as large")));
  const auto right = [](const std::string& name) { return name == "RCA"; };
  EXPECT_THAT(
      [&] { patient_heart(patient_of_phantom(own.tree, stays, right), own.heart, healthy_options(1)); },
      ThrowsMessage<InvalidInput>(HasSubstr("left anterior descending")));
  EXPECT_THROW(patient_heart({}, own.heart, healthy_options(1)), InvalidInput);
  PatientTree broken = patient_of_phantom(own.tree, stays);
  broken.vessels[1].radius_mm[3] = std::nan("");
  EXPECT_THAT([&] { patient_heart(broken, own.heart, healthy_options(1)); },
              ThrowsMessage<InvalidInput>(HasSubstr("vessel 2")));
  CoronaryOptions bypass = healthy_options(1);
  bypass.anatomy = Anatomy::bypass;
  EXPECT_THROW(patient_heart(patient_of_phantom(own.tree, stays), own.heart, bypass), InvalidInput);
}

TEST(PatientHeart, AMirroredHeartLiesWorse) {
  const Own own = own_of(4);
  const auto mirror = [](const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); };
  const PatientLie as_is = lie_of(patient_of_phantom(own.tree, stays), own.heart);
  const PatientLie mirrored = lie_of(patient_of_phantom(own.tree, mirror), own.heart);
  EXPECT_LT(as_is.height_mm, 2.0);
  EXPECT_GT(mirrored.height_mm + mirrored.groove_mm, 2.0 * (as_is.height_mm + as_is.groove_mm));
}

TEST(PatientHeart, ACaseIsTheSameForAnyNumberOfThreads) {
  CaseOptions options;
  options.preset = Preset::tiny;
  options.patient = std::make_shared<const PatientTree>(patient_of_phantom(own_of(8).tree, moved));
  std::string text[2];
  for (int threads = 1; threads <= 2; ++threads) {
    core::set_max_threads(threads);
    text[threads - 1] = case_json(plan_case(options), 0, false);
  }
  core::set_max_threads(0);
  EXPECT_EQ(text[0], text[1]);
  EXPECT_THAT(text[0], HasSubstr("\"least_jacobian\""));
}

}  // namespace
}  // namespace ostia::phantom
