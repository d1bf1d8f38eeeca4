#include "ostia/segmentation/segment.h"

#include "tube_images.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::segmentation {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using testing::Tube;

constexpr double kSegmentVoxel = 0.4;
const std::array<std::int64_t, 3> kSegmentSize{60, 60, 60};
const Vec3 kSegmentSpacing = Vec3::Constant(kSegmentVoxel);

/// A tube oblique to the grid, its ends outside of the image, seeds well inside.
Tube oblique(double radius_voxels) {
  const Vec3 a(10.6, 11.2, 0.0);
  const Vec3 b(12.3, 13.1, 23.6);
  return {a + 0.15 * (b - a), a + 0.85 * (b - a), radius_voxels * kSegmentVoxel};
}

testing::WallError segmented_wall(const imaging::ImageVolume& image, const Tube& tube,
                                  const SegmentOptions& options = {}) {
  const SegmentationResult result = segment_vessels(image, {{tube.from, std::nullopt, tube.to}}, options);
  return testing::wall_error(surface_of(result.level_set, {tube.from, tube.to}).points, tube, 2.5);
}

class SegmentTube : public ::testing::TestWithParam<double> {};

TEST_P(SegmentTube, FindsTheWallBelowAVoxel) {
  const Tube tube = oblique(GetParam());
  const auto error =
      segmented_wall(testing::tube_image({tube}, kSegmentSize, kSegmentSpacing, 0.8 * kSegmentVoxel), tube);
  ASSERT_GT(error.count, 100U);
  EXPECT_LT(std::abs(error.mean), 0.05 * kSegmentVoxel);
  EXPECT_LT(error.rms, 0.08 * kSegmentVoxel);
}

INSTANTIATE_TEST_SUITE_P(RadiiInVoxels, SegmentTube, ::testing::Values(2.5, 4.0, 8.0));

TEST(Segment, ThinVesselsKeepTheirLength) {
  // Two and three voxels across.
  for (const double radius : {1.0, 1.5}) {
    const Tube tube = oblique(radius);
    const auto image = testing::tube_image({tube}, kSegmentSize, kSegmentSpacing, 0.6 * kSegmentVoxel);
    const SegmentationResult result = segment_vessels(image, {{tube.from, std::nullopt, tube.to}});
    const geometry::TriMesh mesh = surface_of(result.level_set, {tube.from});
    const Vec3 axis = (tube.to - tube.from).normalized();
    double first = 1e9;
    double last = -1e9;
    for (const Vec3& p : mesh.points) {
      first = std::min(first, (p - tube.from).dot(axis));
      last = std::max(last, (p - tube.from).dot(axis));
    }
    const double length = (tube.to - tube.from).norm();
    // Nothing is lost; the end of so thin a vessel may run on by some voxels.
    EXPECT_LT(first, 2.0 * kSegmentVoxel) << radius;
    EXPECT_GT(first, -7.0 * kSegmentVoxel) << radius;
    EXPECT_GT(last, length - 2.0 * kSegmentVoxel) << radius;
    EXPECT_LT(last, length + 7.0 * kSegmentVoxel) << radius;
    EXPECT_LT(std::abs(testing::wall_error(mesh.points, tube, 2.5).mean), 0.3 * kSegmentVoxel) << radius;
  }
}

/// How far the surface goes on along the tube beyond its two ends, mm; negative where it falls short.
std::array<double, 2> overhang(const geometry::TriMesh& mesh, const Tube& tube) {
  const Vec3 axis = (tube.to - tube.from).normalized();
  std::array<double, 2> result{-1e9, -1e9};
  for (const Vec3& p : mesh.points) {
    result[0] = std::max(result[0], (tube.from - p).dot(axis));
    result[1] = std::max(result[1], (p - tube.to).dot(axis));
  }
  return result;
}

TEST(Segment, ThinVesselsDoNotBreakHoweverTheyLie) {
  const Vec3 centre(12.03, 11.87, 12.11);
  for (const Vec3& way : {Vec3(0, 0, 1), Vec3(1, 1, 1), Vec3(1, 0, 1), Vec3(0.2, -0.7, 1)}) {
    for (const double radius : {1.0, 1.25, 1.5}) {
      const Vec3 half = 8.0 * way.normalized();
      const Tube tube{centre - half, centre + half, radius * kSegmentVoxel};
      const auto image =
          testing::tube_image({tube}, kSegmentSize, kSegmentSpacing, 0.6 * kSegmentVoxel, 15.0);
      for (const WallFeature feature : {WallFeature::edges, WallFeature::upwind}) {
        SegmentOptions options;
        options.feature = feature;
        const SegmentationResult result =
            segment_vessels(image, {{tube.from, std::nullopt, tube.to}}, options);
        const geometry::TriMesh mesh = surface_of(result.level_set, {tube.from});
        const std::array<double, 2> ends = overhang(mesh, tube);
        EXPECT_GT(ends[0], -1.0 * kSegmentVoxel) << radius << " along " << way.transpose();
        EXPECT_GT(ends[1], -1.0 * kSegmentVoxel) << radius << " along " << way.transpose();
        const auto error = testing::wall_error(mesh.points, tube, 1.5);
        if (feature == WallFeature::edges) {
          EXPECT_LT(std::abs(error.mean), 0.35 * kSegmentVoxel) << radius << " along " << way.transpose();
        }
      }
    }
  }
}

TEST(Segment, ComesToRestInNoise) {
  const Tube tube = oblique(8.0);
  const auto image = testing::tube_image({tube}, kSegmentSize, kSegmentSpacing, 0.8 * kSegmentVoxel, 30.0);
  const SegmentationResult result = segment_vessels(image, {{tube.from, std::nullopt, tube.to}});
  EXPECT_TRUE(result.converged) << result.rms_voxels;
  EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
}

TEST(Segment, SaysHowFarTheSurfaceStillMovesWhenItIsStoppedEarly) {
  const Tube tube = oblique(4.0);
  const auto image = testing::tube_image({tube}, kSegmentSize, kSegmentSpacing, 0.8 * kSegmentVoxel);
  SegmentOptions options;
  options.level_set.iterations_max = 6;
  const SegmentationResult result = segment_vessels(image, {{tube.from, std::nullopt, tube.to}}, options);
  EXPECT_FALSE(result.converged);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_THAT(result.warnings.front(), HasSubstr("after 6 iterations while it still moved by 0."));
}

TEST(Segment, FreeEndsAreFlatAndAtTheirSeedsInNoise) {
  const Tube tube = oblique(8.0);
  const auto image = testing::tube_image({tube}, kSegmentSize, kSegmentSpacing, 0.8 * kSegmentVoxel, 40.0);
  const SegmentationResult result = segment_vessels(image, {{tube.from, std::nullopt, tube.to}});
  const geometry::TriMesh mesh = surface_of(result.level_set, {tube.from});
  for (const double end : overhang(mesh, tube)) {
    EXPECT_GT(end, -0.5 * kSegmentVoxel);
    EXPECT_LT(end, 2.0 * kSegmentVoxel);
  }
  // Across the open lumen it is a plane: nothing but the end itself lies there.
  const Vec3 axis = (tube.to - tube.from).normalized();
  double lowest = 1e9;
  for (const Vec3& p : mesh.points) {
    if (testing::distance_to_axis(tube, p) < 0.6 * tube.radius &&
        (p - tube.to).dot(axis) > -8.0 * kSegmentVoxel)
      lowest = std::min(lowest, (p - tube.to).dot(axis));
  }
  EXPECT_GT(lowest, -2.5 * kSegmentVoxel);  // dimples at most
}

TEST(Segment, TheVoxelFeaturesOfThePaperFindTheWallToo) {
  const Tube tube = oblique(5.0);
  const auto image = testing::tube_image({tube}, kSegmentSize, kSegmentSpacing, 0.8 * kSegmentVoxel);
  for (const WallFeature feature : {WallFeature::upwind, WallFeature::centred}) {
    SegmentOptions options;
    options.feature = feature;
    const auto error = segmented_wall(image, tube, options);
    EXPECT_LT(std::abs(error.mean), 0.25 * kSegmentVoxel);
    EXPECT_LT(error.rms, 0.25 * kSegmentVoxel);
  }
}

TEST(Segment, NoiseDoesNotMoveTheWallOnAverage) {
  const Tube tube = oblique(4.0);
  const auto error = segmented_wall(
      testing::tube_image({tube}, kSegmentSize, kSegmentSpacing, 0.8 * kSegmentVoxel, 25.0), tube);
  EXPECT_LT(std::abs(error.mean), 0.1 * kSegmentVoxel);
  EXPECT_LT(error.rms, 0.35 * kSegmentVoxel);
}

TEST(Segment, ThinSlicesAndThickOnes) {
  const Tube tube{{10.1, 11.2, 4.0}, {12.2, 12.9, 26.0}, 2.4};
  const auto image = testing::tube_image({tube}, {56, 56, 30}, Vec3(0.4, 0.4, 1.0), 0.5);
  const auto error = segmented_wall(image, tube);
  EXPECT_LT(std::abs(error.mean), 0.05);
  EXPECT_LT(error.rms, 0.08);
}

TEST(Segment, TheThresholdOfTheFrontsDoesNotMatter) {
  const Tube tube = oblique(4.0);
  const auto image = testing::tube_image({tube}, kSegmentSize, kSegmentSpacing, 0.8 * kSegmentVoxel);
  std::vector<double> means;
  for (const double lower : {130.0, 180.0, 230.0, 280.0}) {
    SegmentOptions options;
    options.fronts.lower_hu = lower;
    means.push_back(segmented_wall(image, tube, options).mean);
  }
  for (const double mean : means) EXPECT_NEAR(mean, means.front(), 0.02 * kSegmentVoxel);
}

TEST(Segment, BranchesThatMeetBecomeOneSurfaceWithoutASeam) {
  const Tube trunk{{12, 12, 3}, {12, 12, 12}, 1.6, true};
  const Tube left{{12, 12, 12}, {6, 12, 20}, 1.3, true};
  const Tube right{{12, 12, 12}, {18, 12, 20}, 1.3, true};
  const auto image = testing::tube_image({trunk, left, right}, kSegmentSize, kSegmentSpacing, 0.3);
  const std::vector<BranchSeeds> branches{{Vec3(12, 12, 4), std::nullopt, Vec3(12, 12, 10)},
                                          {Vec3(12, 12, 10), std::nullopt, Vec3(7, 12, 18.7)},
                                          {Vec3(12, 12, 10), std::nullopt, Vec3(17, 12, 18.7)}};
  const SegmentationResult result = segment_vessels(image, branches);
  ASSERT_EQ(result.branches.size(), 3U);
  const geometry::TriMesh mesh = surface_of(result.level_set, {Vec3(12, 12, 4)});
  const geometry::SurfaceFaults faults = geometry::find_faults(mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.components, 1U);
  EXPECT_EQ(faults.self_intersections, 0U);
  const double euler =
      static_cast<double>(mesh.points.size()) - 0.5 * static_cast<double>(mesh.triangles.size());
  EXPECT_EQ(euler, 2.0);
  geometry::Box3 box = geometry::bounds(mesh.points);
  EXPECT_LT(box.min().x(), 7.5);
  EXPECT_GT(box.max().x(), 16.5);
  EXPECT_LT(box.min().z(), 4.8);
}

TEST(Segment, BrightThingsInTheLumenAreLumenWhereAsked) {
  const Tube tube = oblique(6.0);
  auto image = testing::tube_image({tube}, kSegmentSize, kSegmentSpacing, 0.8 * kSegmentVoxel);
  const Vec3 axis = (tube.to - tube.from).normalized();
  for (std::int64_t n = 0; n < image.geometry.voxels(); ++n) {  // a ring of a stent just inside the wall
    const Vec3 p = image.geometry.world(
        Vec3(static_cast<double>(n % 60), static_cast<double>(n / 60 % 60), static_cast<double>(n / 3600)));
    const double rho = testing::distance_to_axis(tube, p);
    if (rho > 1.7 && rho < 2.2 && std::abs((p - tube.from).dot(axis) - 8.0) < 2.0)
      image.voxels[static_cast<std::size_t>(n)] = 1500;
  }
  SegmentOptions options;
  const auto without = segmented_wall(image, tube, options);
  options.bright_is_lumen = true;
  const auto with = segmented_wall(image, tube, options);
  EXPECT_LT(with.rms, 0.5 * without.rms);
  EXPECT_LT(std::abs(with.mean), 0.15 * kSegmentVoxel);
}

TEST(Segment, SaysWhichBranchIsWrongAndWhatItMet) {
  const Tube tube = oblique(4.0);
  const auto image = testing::tube_image({tube}, kSegmentSize, kSegmentSpacing, 0.8 * kSegmentVoxel);
  EXPECT_THROW(segment_vessels(image, {}), InvalidInput);
  EXPECT_THAT(
      [&] {
        segment_vessels(image,
                        {{tube.from, std::nullopt, tube.to}, {Vec3(-50, 0, 0), std::nullopt, tube.to}});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("branch 2: seed (-50.0, 0.0, 0.0) mm")));
  const SegmentationResult cut = segment_vessels(image, {{Vec3(10.6, 11.2, 0.0), std::nullopt, tube.to}});
  EXPECT_TRUE(cut.touches_border);
  ASSERT_FALSE(cut.warnings.empty());
  EXPECT_THAT(cut.warnings.front(), HasSubstr("border of the image"));
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(segment_vessels(image, {{tube.from, std::nullopt, tube.to}}, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::segmentation
