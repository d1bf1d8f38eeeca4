// Images of a heart that cannot be used as they are: what is said of them, and that no tree is made up.

#include "coarse_scan.h"
#include "kept_scan.h"

#include "ostia/core/error.h"
#include "ostia/coronary/extract.h"
#include "ostia/geometry/polyline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace ostia::coronary {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// A whole heart in cubes of 1.2 mm.
struct CoarseHeart {
  phantom::CasePlan plan;
  imaging::ImageVolume image;
};
const CoarseHeart& heart() {
  static const CoarseHeart made = [] {
    constexpr double voxel_mm = 1.2;
    phantom::CaseOptions options;
    options.preset = phantom::Preset::small;
    CoarseHeart result{phantom::plan_case(options), {}};
    ostia::testing::make_coarse(result.plan.options.scan, voxel_mm);
    result.image = ostia::testing::kept_scan(result.plan).image;
    return result;
  }();
  return made;
}

struct Outcome {
  std::string refusal;
  Extraction found;
};
Outcome outcome_of(const imaging::ImageVolume& image) {
  Outcome outcome;
  try {
    outcome.found = extract(image);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::bad_input) << error.what();
    outcome.refusal = error.what();
  }
  return outcome;
}

/// Voxel (i, j, k) of the result is voxel `of` of the image; the header stays as it is, and so is wrong.
template <class Of>
imaging::ImageVolume rearranged(const imaging::ImageVolume& image, std::array<std::int64_t, 3> size,
                                const Of& of) {
  imaging::ImageVolume result;
  result.geometry = image.geometry;
  result.geometry.size = size;
  result.voxels.resize(image.voxels.size());
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const std::array<std::int64_t, 3> at = of(i, j, k);
        result(i, j, k) = image(at[0], at[1], at[2]);
      }
  return result;
}

imaging::ImageVolume part(std::array<double, 3> from, std::array<double, 3> to) {
  const imaging::ImageVolume& image = heart().image;
  imaging::Region region;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto size = static_cast<double>(image.geometry.size[a]);
    region.lower[a] = static_cast<std::int64_t>(from[a] * size);
    region.upper[a] = static_cast<std::int64_t>(to[a] * size);
  }
  return imaging::cropped(image, region);
}

/// Share of the found axes farther than 2 mm from every true one.
double invented(const Extraction& found) {
  const geometry::VesselTree truth = phantom::vessel_tree(heart().plan.tree);
  double points = 0.0, off = 0.0;
  for (const geometry::TreeSegment& segment : found.vessels.tree.segments)
    for (const Vec3& point : segment.axis.points) {
      double nearest = 1e9;
      for (const geometry::TreeSegment& one : truth.segments)
        nearest = std::min(nearest, (geometry::closest(one.axis.points, point).point - point).norm());
      points += 1.0;
      off += nearest > 2.0 ? 1.0 : 0.0;
    }
  return points > 0.0 ? off / points : 0.0;
}

TEST(BadImages, TheHeartAsItIsGivesATree) {
  const Outcome outcome = outcome_of(heart().image);
  EXPECT_EQ(outcome.refusal, "");
  EXPECT_LT(invented(outcome.found), 0.05);
  EXPECT_THAT(outcome.found.warnings, Contains(HasSubstr("voxels of 1.2 mm are wide")));
  EXPECT_THAT(outcome.found.warnings, ::testing::Not(Contains(HasSubstr("mirrored or turned"))));
}

TEST(BadImages, OneThatStandsOnItsHeadIsRefused) {
  const auto [x, y, z] = heart().image.geometry.size;
  const Outcome outcome = outcome_of(
      rearranged(heart().image, {x, y, z},
                 [top = z](std::int64_t i, std::int64_t j, std::int64_t k) -> std::array<std::int64_t, 3> {
                   return {i, j, top - 1 - k};
                 }));
  EXPECT_THAT(outcome.refusal, HasSubstr("stands on its head"));
}

TEST(BadImages, AMirroredOneIsToldAndGetsNoNames) {
  const auto [x, y, z] = heart().image.geometry.size;
  const Outcome outcome = outcome_of(
      rearranged(heart().image, {x, y, z},
                 [width = x](std::int64_t i, std::int64_t j, std::int64_t k) -> std::array<std::int64_t, 3> {
                   return {width - 1 - i, j, k};
                 }));
  ASSERT_EQ(outcome.refusal, "");
  EXPECT_THAT(outcome.found.warnings, Contains(HasSubstr("mirrored or turned")));
  for (const geometry::Vessel& vessel : outcome.found.vessels.tree.vessels)
    EXPECT_THAT(vessel.name, ::testing::StartsWith("V"));
}

TEST(BadImages, OneOfExchangedAxesIsToldAndGetsNoNames) {
  const auto [x, y, z] = heart().image.geometry.size;
  const Outcome outcome = outcome_of(
      rearranged(heart().image, {y, x, z},
                 [](std::int64_t i, std::int64_t j, std::int64_t k) -> std::array<std::int64_t, 3> {
                   return {j, i, k};
                 }));
  if (!outcome.refusal.empty()) {
    EXPECT_THAT(outcome.refusal, HasSubstr("x and y may be exchanged"));
    return;
  }
  EXPECT_THAT(outcome.found.warnings, Contains(HasSubstr("x and y may be exchanged")));
  for (const geometry::Vessel& vessel : outcome.found.vessels.tree.vessels)
    EXPECT_THAT(vessel.name, ::testing::StartsWith("V"));
}

TEST(BadImages, OnesThatLieOnTheirSideAreRefused) {
  const auto [x, y, z] = heart().image.geometry.size;
  const Outcome about_x = outcome_of(
      rearranged(heart().image, {x, z, y},
                 [](std::int64_t i, std::int64_t j, std::int64_t k) -> std::array<std::int64_t, 3> {
                   return {i, k, j};
                 }));
  EXPECT_NE(about_x.refusal, "");
  EXPECT_THAT(about_x.refusal, HasSubstr("draw a first vessel by its two ends"));
  const Outcome about_y = outcome_of(
      rearranged(heart().image, {z, y, x},
                 [](std::int64_t i, std::int64_t j, std::int64_t k) -> std::array<std::int64_t, 3> {
                   return {k, j, i};
                 }));
  EXPECT_NE(about_y.refusal, "");
}

TEST(BadImages, WithoutContrastNothingIsFound) {
  imaging::ImageVolume native = heart().image;
  for (std::int16_t& voxel : native.voxels)
    if (voxel > 110) voxel = static_cast<std::int16_t>(60 + (voxel - 60) / 30);
  EXPECT_THAT(outcome_of(native).refusal, HasSubstr("as blood without contrast agent"));
}

TEST(BadImages, CutBelowTheRootOrAboveItNothingIsFound) {
  EXPECT_THAT(outcome_of(part({0, 0, 0}, {1, 1, 0.5})).refusal, HasSubstr("first vessel by its two ends"));
  EXPECT_THAT(outcome_of(part({0, 0, 0.72}, {1, 1, 1})).refusal, HasSubstr("first vessel by its two ends"));
}

TEST(BadImages, WithoutTheLeftHalfWhatIsFoundIsTrueAndTheRestIsTold) {
  const Outcome outcome = outcome_of(part({0, 0, 0}, {0.5, 1, 1}));
  if (outcome.refusal.empty()) {
    EXPECT_LT(invented(outcome.found), 0.05);
    EXPECT_THAT(outcome.found.warnings, Contains(HasSubstr("one coronary artery alone was found")));
  } else {
    EXPECT_THAT(outcome.refusal, HasSubstr("draw a first vessel by its two ends"));
  }
}

TEST(BadImages, AWireOfMetalIsToldAndNotFollowed) {
  imaging::ImageVolume wired = heart().image;
  const imaging::Geometry& grid = wired.geometry;
  const Vec3 from = heart().plan.heart.root.annulus + Vec3(-35.0, 8.0, 50.0);
  const Vec3 to = heart().plan.heart.base + 70.0 * heart().plan.heart.long_axis;
  for (double t = 0.0; t <= 1.0; t += 0.002) {
    const Vec3 at = grid.index(from + t * (to - from));
    for (int n = 0; n < 8; ++n) {
      const auto i = static_cast<std::int64_t>(at.x()) + n % 2,
                 j = static_cast<std::int64_t>(at.y()) + n / 2 % 2,
                 k = static_cast<std::int64_t>(at.z()) + n / 4;
      if (i >= 0 && j >= 0 && k >= 0 && i < grid.size[0] && j < grid.size[1] && k < grid.size[2])
        wired(i, j, k) = 3071;
    }
  }
  const Outcome outcome = outcome_of(wired);
  ASSERT_EQ(outcome.refusal, "");
  EXPECT_THAT(outcome.found.warnings, Contains(HasSubstr("ml of metal")));
  EXPECT_LT(invented(outcome.found), 0.05);
}

}  // namespace
}  // namespace ostia::coronary
