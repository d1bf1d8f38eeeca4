#include "ostia/phantom/truth.h"

#include "hand_made_tree.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using geometry::Contour;
using geometry::ContourSection;
using geometry::Health;
using testing::hand_made_tree;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<AnnotatedSection> two_sections() {
  return {{"s01", 0, 10.0, 40.25, Health::healthy}, {"s02", 0, 78.0, 102.0, Health::diseased}};
}

TEST(Truth, ContoursLieOnTheBoundaryInOrder) {
  const CoronaryTree tree = hand_made_tree();
  const geometry::ContourSet all = annotate(tree, two_sections(), {}, {});
  ASSERT_THAT(all.sections, SizeIs(2 * (2 + 3)));
  const VesselField field(tree);
  for (const ContourSection& section : all.sections) {
    const auto fault = geometry::find_fault(section);
    EXPECT_FALSE(fault.has_value()) << section.section << " " << section.observer << ": " << *fault;
    const Contour& first = section.contours.front();
    EXPECT_EQ(first.points.size(), 64u);
    EXPECT_GT(geometry::contour_normal(first).x(), 0.99) << "distal";
    if (section.observer != "truth") continue;
    const Boundary boundary = section.boundary == "lumen" ? Boundary::lumen : Boundary::wall;
    for (const Contour& contour : section.contours) {
      for (std::size_t k = 0; k < contour.points.size(); ++k) {
        const Vec3& p = contour.points[k];
        EXPECT_NEAR(field.value(boundary, p, 2.0), 0.0, 1e-6);
        EXPECT_NEAR(p.x(), contour.s_mm, 1e-9);
        const double theta = 2.0 * std::numbers::pi * static_cast<double>(k) / 64.0;
        const Vec3 across = geometry::radial_direction(tree.vessels[0].axis.frames[0], theta);
        EXPECT_NEAR((p - Vec3(p.x(), 0, 0)).normalized().dot(across), 1.0, 1e-9);
      }
    }
  }
}

TEST(Truth, ContoursOfACurvedVesselLieOnTheBoundary) {
  CoronaryTree tree;
  CoronaryVessel vessel = hand_made_tree().vessels[0];
  for (std::size_t i = 0; i < vessel.axis.size(); ++i) {  // a helix of 12 mm radius
    const double u = vessel.axis.abscissa[i] / 15.0;
    vessel.axis.points[i] = Vec3(12.0 * std::cos(u), 12.0 * std::sin(u), 9.0 * u);
  }
  geometry::complete(vessel.axis);
  tree.vessels.push_back(vessel);
  const VesselField field(tree);
  for (double s = 5.03; s < 110.0; s += 3.77) {
    for (const Boundary boundary : {Boundary::lumen, Boundary::wall}) {
      for (const Vec3& p : true_contour(tree.vessels[0], boundary, s, 64).points)
        EXPECT_NEAR(field.value(boundary, p, 2.0), 0.0, 1e-6) << s;
      const Vec3 first = true_contour(tree.vessels[0], boundary, s, 64).points.front();
      EXPECT_LT((first - boundary_point(tree.vessels[0], boundary, s, 0.0)).norm(), 1e-12);
    }
  }
}

TEST(Truth, ContoursAreEquallySpacedWithBothEnds) {
  ContourOptions options;
  options.spacing_mm = 0.5;
  const geometry::ContourSet all = annotate(hand_made_tree(), two_sections(), options, {});
  const auto& contours = all.sections[0].contours;
  EXPECT_EQ(contours.front().s_mm, 10.0);
  EXPECT_NEAR(contours.back().s_mm, 40.25, 1e-12);
  EXPECT_EQ(contours.size(), 62u);
  for (std::size_t i = 1; i < contours.size(); ++i)
    EXPECT_NEAR(contours[i].s_mm - contours[i - 1].s_mm, 30.25 / 61.0, 1e-9);
  EXPECT_EQ(all.sections[2].observer, "observer1");
  EXPECT_EQ(all.sections[2].contours.size(), 32u);
}

/// Mean distance between what two observers draw, over vessels of the same health, as the radius has it.
double mean_difference(const CoronaryVessel& vessel, double from, double to, const ObserverOptions& options,
                       double* deviation = nullptr) {
  double sum = 0.0, squares = 0.0;
  int count = 0, single = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    ObserverOptions own = options;
    own.seed = seed;
    for (double s = from; s < to; s += 2.5) {
      const RadialDeviation a = radial_deviation(vessel, 1, s, own), b = radial_deviation(vessel, 2, s, own);
      for (int k = 0; k < 16; ++k) {
        const double theta = 2.0 * std::numbers::pi * k / 16.0;
        sum += std::abs(a.at(theta) - b.at(theta));
        squares += a.at(theta) * a.at(theta) + b.at(theta) * b.at(theta);
        ++count;
        single += 2;
      }
    }
  }
  if (deviation != nullptr) *deviation = std::sqrt(squares / single);
  return sum / count;
}

TEST(Truth, ObserversDeviateAsAsked) {
  const CoronaryTree tree = hand_made_tree();
  const ObserverOptions options;
  double healthy = 0.0, diseased = 0.0;
  const double apart_healthy = mean_difference(tree.vessels[0], 5.0, 45.0, options, &healthy);
  const double apart_diseased = mean_difference(tree.vessels[0], 80.0, 100.0, options, &diseased);
  EXPECT_NEAR(healthy, 0.13, 0.13 * 0.06);
  EXPECT_NEAR(diseased, 0.20, 0.20 * 0.08);
  // Normal and independent: the mean difference of two is 2 / sqrt(pi) deviations.
  EXPECT_NEAR(apart_healthy, 2.0 / std::sqrt(std::numbers::pi) * 0.13, 0.012);
  EXPECT_NEAR(apart_diseased, 2.0 / std::sqrt(std::numbers::pi) * 0.20, 0.022);
}

TEST(Truth, ObserversAreSmoothAndTellableApart) {
  const CoronaryTree tree = hand_made_tree();
  const ObserverOptions options;
  for (double s = 10.0; s < 40.0; s += 0.7) {
    const RadialDeviation here = radial_deviation(tree.vessels[0], 1, s, options);
    const RadialDeviation next = radial_deviation(tree.vessels[0], 1, s + 0.01, options);
    EXPECT_LT(std::abs(here.at(0.3) - next.at(0.3)), 0.01) << s;
    EXPECT_EQ(here.at(0.3), radial_deviation(tree.vessels[0], 1, s, options).at(0.3));
  }
  EXPECT_NE(radial_deviation(tree.vessels[0], 1, 20.0, options).at(0.0),
            radial_deviation(tree.vessels[0], 2, 20.0, options).at(0.0));
}

TEST(Truth, ObservedRadiusStaysPositive) {
  EXPECT_DOUBLE_EQ(observed_radius(1.5, 0.2), 1.7);
  EXPECT_NEAR(observed_radius(1.5, -1e-4), 1.5 - 1e-4, 1e-8);
  EXPECT_GT(observed_radius(0.3, -0.9), 0.0);
}

TEST(Truth, ReferenceLinesRunFromTheOstiumInSmallSteps) {
  const CoronaryTree tree = hand_made_tree();
  const ChallengeVessels made = challenge_vessels(tree, {});
  ASSERT_THAT(made.vessels, SizeIs(2));  // the tree has a right coronary artery alone
  EXPECT_THAT(made.warnings, SizeIs(2));
  const ChallengeVessel& rca = made.vessels[0];
  EXPECT_EQ(rca.name, "RCA");
  EXPECT_EQ(rca.number, 0);
  EXPECT_NEAR(static_cast<double>(rca.reference.points.size()), 120.0 / 0.03 + 1.0, 1.0);
  EXPECT_NEAR(rca.reference.radius.front(), tree.vessels[0].axis.radius.front(), 1e-9);
  EXPECT_LT((rca.point_s - Vec3(0, 0, 0)).norm(), 1e-9);
  EXPECT_LT((rca.point_e - Vec3(120, 0, 0)).norm(), 1e-9);
  EXPECT_NEAR(rca.point_b.x(), 30.0, 1e-6);
  EXPECT_NEAR(rca.point_a.x(), 102.0, 1e-6);
  double mean = 0.0;
  for (const double io : rca.reference.observer_spread) {
    EXPECT_GT(io, 0.0);
    mean += io / static_cast<double>(rca.reference.observer_spread.size());
  }
  EXPECT_NEAR(mean, 0.19 * std::sqrt(std::numbers::pi / 2.0), 0.08);
  ASSERT_THAT(rca.observers, SizeIs(3));
  double apart = 0.0;
  for (const Vec3& p : rca.observers[0])
    apart += geometry::closest(rca.reference.points, p).point.x() >= 0.0 ? Vec3(0, p.y(), p.z()).norm() : 0.0;
  EXPECT_NEAR(apart / static_cast<double>(rca.observers[0].size()), 0.24, 0.12);

  const ChallengeVessel& branch = made.vessels[1];
  EXPECT_EQ(branch.number, 3);
  EXPECT_EQ(branch.path, (std::vector<std::int32_t>{0, 1}));
  EXPECT_LT((branch.reference.points.front() - Vec3(0, 0, 0)).norm(), 1e-9);
  EXPECT_NEAR(geometry::length(branch.reference.points), 50.0 + std::hypot(30.0, 52.0), 0.01);
}

TEST(Truth, TheImageCutsReferenceLinesAndSaysSo) {
  imaging::Geometry image;
  image.size = {60, 60, 60};
  image.spacing = Vec3::Ones();
  image.origin = Vec3(-10, -30, -30);  // to x = 49
  const ChallengeVessels made = challenge_vessels(hand_made_tree(), {}, image);
  ASSERT_THAT(made.vessels, SizeIs(1));
  EXPECT_TRUE(made.vessels[0].cut_by_image);
  EXPECT_NEAR(made.vessels[0].point_e.x(), 48.0, 0.11);
  EXPECT_THAT(made.warnings, ::testing::Contains(HasSubstr("cut by the image")));
  EXPECT_THAT(made.warnings, ::testing::Contains(HasSubstr("vessel3 (AM) left out")));
  image.origin = Vec3(200, 0, 0);
  const ChallengeVessels none = challenge_vessels(hand_made_tree(), {}, image);
  EXPECT_THAT(none.vessels, IsEmpty());
  EXPECT_THAT(none.warnings, SizeIs(4));
}

TEST(Truth, StenosisCategories) {
  EXPECT_EQ(stenosis_category(0.0), 0);
  EXPECT_EQ(stenosis_category(0.249), 1);
  EXPECT_EQ(stenosis_category(0.25), 2);
  EXPECT_EQ(stenosis_category(0.5), 3);
  EXPECT_EQ(stenosis_category(0.7), 4);
  EXPECT_EQ(stenosis_category(1.0), 5);
}

TEST(Truth, BadOptionsAreRefused) {
  ContourOptions contours;
  contours.points = 3;
  EXPECT_THROW(annotate(hand_made_tree(), two_sections(), contours, {}), InvalidInput);
  contours = {};
  contours.spacing_mm = 0.0;
  EXPECT_THROW(annotate(hand_made_tree(), two_sections(), contours, {}), InvalidInput);
  ObserverOptions observers;
  observers.count = 40;
  EXPECT_THROW(annotate(hand_made_tree(), two_sections(), {}, observers), InvalidInput);
  observers = {};
  observers.axis_mm = std::nan("");
  EXPECT_THROW(challenge_vessels(hand_made_tree(), observers), InvalidInput);
}

}  // namespace
}  // namespace ostia::phantom
