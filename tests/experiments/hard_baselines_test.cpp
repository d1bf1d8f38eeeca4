#include "hard/baseline_growing.h"
#include "hard/baseline_path.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace ostia::experiments {
namespace {

using geometry::Vec3;

/// An image whose value at a place is a function of it.
imaging::ImageVolume sampled_image(const imaging::Geometry& grid,
                                   const std::function<double(const Vec3&)>& value) {
  imaging::ImageVolume image{grid, std::vector<std::int16_t>(static_cast<std::size_t>(grid.voxels()))};
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i)
        image(i, j, k) =
            static_cast<std::int16_t>(std::lround(value(grid.world(Vec3(double(i), double(j), double(k))))));
  return image;
}

imaging::Geometry cube(std::int64_t size, double spacing_mm) {
  imaging::Geometry grid;
  grid.size = {size, size, size};
  grid.spacing = Vec3::Constant(spacing_mm);
  grid.origin = Vec3::Constant(-0.5 * spacing_mm * static_cast<double>(size - 1));
  return grid;
}

/// Smooth bright things about the origin, so wide that differences of voxels are derivatives.
double at_middle(const std::function<double(const Vec3&)>& squared) {
  constexpr double width2 = 2.0 * 1.5 * 1.5;
  const imaging::Geometry grid = cube(41, 0.4);
  const imaging::ImageVolume image =
      sampled_image(grid, [&](const Vec3& p) { return 20000.0 * std::exp(-squared(p) / width2); });
  return frangi_vesselness(image, {.sigmas_mm = {1.5}})(20, 20, 20);
}

TEST(FrangiVesselness, IsThePapersFormulaInATubeABlobAndAPlate) {
  const double of_one = 1.0 - std::exp(-2.0);  // 1 - exp(-1 / 2 0.5^2)
  // In the middle the Hessian's norm is the image's largest, so c is half of it.
  EXPECT_NEAR(at_middle([](const Vec3& p) { return p.x() * p.x() + p.y() * p.y(); }), of_one * of_one, 0.005);
  EXPECT_NEAR(at_middle([](const Vec3& p) { return p.squaredNorm(); }), of_one * std::exp(-2.0) * of_one,
              0.005);
  EXPECT_NEAR(at_middle([](const Vec3& p) { return p.x() * p.x(); }), 0.0, 0.005);
}

TEST(FrangiVesselness, IsNothingInDarkTubesAndFlatImages) {
  const imaging::Geometry grid = cube(21, 0.5);
  const auto dark = sampled_image(
      grid, [](const Vec3& p) { return 1000.0 - 900.0 * std::exp(-(p.x() * p.x() + p.y() * p.y()) / 2.0); });
  EXPECT_EQ(frangi_vesselness(dark)(10, 10, 10), 0.0F);
  const auto flat = frangi_vesselness(sampled_image(grid, [](const Vec3&) { return 100.0; }));
  EXPECT_EQ(*std::ranges::max_element(flat.voxels), 0.0F);
}

TEST(CheapestWay, IsStraightWhereAllCostsTheSameAndGoesThroughTheGapInAWall) {
  imaging::FloatVolume cost{cube(11, 1.0), std::vector<float>(11 * 11 * 11, 1.0F)};
  const Vec3 from(-5.0, 0.0, 0.0), to(5.0, 0.0, 0.0);
  const std::vector<Vec3> straight = cheapest_ways(cost, from, {to}).front();
  EXPECT_EQ(straight.size(), 11U);
  EXPECT_DOUBLE_EQ(geometry::length(straight), 10.0);
  for (std::int64_t j = 0; j < 11; ++j)
    for (std::int64_t k = 0; k < 11; ++k)
      if (j != 9 || k != 5) cost(5, j, k) = 1000.0F;  // x = 0, but for y = 4
  const std::vector<Vec3> about = cheapest_ways(cost, from, {to}).front();
  EXPECT_TRUE(std::ranges::any_of(about, [](const Vec3& p) { return p == Vec3(0.0, 4.0, 0.0); }));
  EXPECT_EQ(about.front(), from);
  EXPECT_EQ(about.back(), to);
  EXPECT_EQ(cheapest_ways(cost, from, {from}).front().size(), 1U);
  const Vec3 aside(-5.0, 5.0, 0.0);
  const auto both = cheapest_ways(cost, from, {aside, to, from});
  ASSERT_EQ(both.size(), 3U);
  EXPECT_EQ(both[0], cheapest_ways(cost, from, {aside}).front());
  EXPECT_EQ(both[1], about) << "whatever else is asked for";
  EXPECT_EQ(both[2].size(), 1U);
}

/// A half circle of 15 mm about the origin in the plane z = 0, 1.5 mm in radius.
double off_arc(const Vec3& p) {
  const double along = std::atan2(p.y(), p.x());
  const double ends = std::min((p - Vec3(15, 0, 0)).norm(), (p - Vec3(-15, 0, 0)).norm());
  return along < 0.0 ? ends : std::hypot(std::hypot(p.x(), p.y()) - 15.0, p.z());
}

TEST(CheapestWay, FollowsABentTubeAndNotTheStraightWay) {
  imaging::Geometry grid = cube(81, 0.5);
  grid.size[2] = 25;
  grid.origin.z() = -6.0;
  const imaging::ImageVolume image = sampled_image(
      grid, [](const Vec3& p) { return 400.0 / (1.0 + std::exp((off_arc(p) - 1.5) / 0.3)) - 80.0; });
  const std::vector<Vec3> way = cheapest_ways(cost_per_mm(image), {15, 0, 0}, {{-15, 0, 0}}).front();
  for (const Vec3& point : way) EXPECT_LT(off_arc(point), 1.0) << point.transpose();
  EXPECT_GT(geometry::length(way), 0.98 * 15.0 * std::numbers::pi);
  EXPECT_LT(geometry::length(way), 1.2 * 15.0 * std::numbers::pi);  // voxel by voxel
}

/// An aorta along z and a vessel that leaves it along x and forks at x = 25 into two along +-y.
double off_fork(const Vec3& p) {
  const auto off = [&](const Vec3& a, const Vec3& b) {
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - t * (b - a)).norm();
  };
  return std::min({off({8, 0, 0}, {25, 0, 0}), off({25, 0, 0}, {32, 12, 0}), off({25, 0, 0}, {32, -12, 0})});
}

double fork_hu(const Vec3& p) {
  const double aorta = std::hypot(p.x(), p.y()) - 10.0, vessel = off_fork(p) - 1.6;
  return std::min(aorta, vessel) < 0.0 ? 400.0 : 20.0;
}

imaging::Geometry fork_grid() {
  imaging::Geometry grid;
  grid.size = {100, 60, 40};
  grid.spacing = Vec3::Constant(0.5);
  grid.origin = Vec3(-12.0, -15.0, -10.0);
  return grid;
}

TEST(RegionGrowing, FindsTheVesselsOfAForkAndNotTheAorta) {
  const GrownRegion grown = grow_region(sampled_image(fork_grid(), fork_hu), {{9.8, 0, 0}});
  EXPECT_NEAR(grown.blood_hu, 400.0, 1.0);
  EXPECT_NEAR(grown.parts.at(0).threshold_hu, 225.0, 1.0);
  EXPECT_FALSE(grown.parts.at(0).leaked);
  EXPECT_NEAR(grown.parts.at(0).volume_ml, 0.001 * std::numbers::pi * 1.6 * 1.6 * 42.0, 0.06);
  ASSERT_EQ(grown.tree.vessels.size(), 2U);
  for (const geometry::Vessel& vessel : grown.tree.vessels) {
    const geometry::Centerline axis = geometry::vessel_axis(grown.tree, vessel);
    EXPECT_GT(axis.abscissa.back(), 24.0);
    for (const Vec3& point : axis.points) EXPECT_LT(off_fork(point), 0.8) << point.transpose();
  }
}

TEST(RegionGrowing, RaisesTheThresholdWhereItLeaksAndSaysWhereThatDoesNotHelp) {
  // A sheet that is too thin for a chamber touches the vessel; it holds some 3 ml.
  const auto with_sheet = [](double sheet_hu) {
    return sampled_image(fork_grid(), [&](const Vec3& p) {
      const bool sheet = std::abs(p.x() - 20.0) < 2.0;
      return std::max(fork_hu(p), sheet ? sheet_hu : 20.0);
    });
  };
  const RegionGrowingOptions small{.most_ml = 1.0};
  const GrownRegion raised = grow_region(with_sheet(260.0), {{9.8, 0, 0}}, small);
  EXPECT_FALSE(raised.parts.at(0).leaked);
  EXPECT_GT(raised.parts.at(0).threshold_hu, 260.0);
  EXPECT_LE(raised.parts.at(0).threshold_hu, 270.0);
  EXPECT_EQ(raised.tree.vessels.size(), 2U);
  const GrownRegion lost = grow_region(with_sheet(400.0), {{9.8, 0, 0}}, small);
  EXPECT_TRUE(lost.parts.at(0).leaked);
  EXPECT_TRUE(lost.tree.vessels.empty());
}

TEST(RegionGrowing, RefusesWhatMakesNoSense) {
  const imaging::ImageVolume image = sampled_image(fork_grid(), fork_hu);
  EXPECT_THROW(grow_region(image, {}), InvalidInput);
  EXPECT_THROW(grow_region(image, {{500, 0, 0}}), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(grow_region(image, {{9.8, 0, 0}}, {}, task), Cancelled);
  EXPECT_THROW(frangi_vesselness(image, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::experiments
