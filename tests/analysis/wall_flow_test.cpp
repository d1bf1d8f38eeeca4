// Shear stress and pressure along a vessel, against Poiseuille's flow in tubes of known calibre.

#include "ostia/analysis/wall_flow.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace ostia::analysis {
namespace {

constexpr double viscosity_pa_s = 3.5e-3, flow_m3_s = 1.2e-6;  // 1.2 ml/s
using std::numbers::pi;

double poiseuille_shear_pa(double radius_mm) {
  return 4.0 * viscosity_pa_s * flow_m3_s / (pi * std::pow(1e-3 * radius_mm, 3));
}
double poiseuille_gradient_pa_mm(double radius_mm) {
  return 1e-3 * 8.0 * viscosity_pa_s * flow_m3_s / (pi * std::pow(1e-3 * radius_mm, 4));
}

/// The wall of a tube about an axis, of patches as uneven as those of a mesh; the pressure falls as
/// Poiseuille's does at the calibre of each place.
std::vector<WallFlowSample> tube_wall(double length_mm, const std::function<double(double)>& radius,
                                      std::int32_t vessel = 1) {
  constexpr int rings = 200, around = 16;
  std::vector<WallFlowSample> wall;
  double pressure = 9000.0, before = 0.0;
  for (int k = 0; k < rings; ++k) {
    const double s = length_mm * (k + 0.5 + 0.3 * std::sin(2.0 * k)) / rings;
    constexpr int pieces = 20;
    for (int j = 0; j < pieces; ++j)
      pressure -= (s - before) / pieces *
                  poiseuille_gradient_pa_mm(radius(before + (s - before) * (j + 0.5) / pieces));
    before = s;
    for (int i = 0; i < around; ++i)
      wall.push_back({vessel, s, (1.0 + 0.5 * (i % 3)) * 2.0 * pi * radius(s) * length_mm / rings / around,
                      poiseuille_shear_pa(radius(s)), pressure});
  }
  return wall;
}

TEST(WallFlow, OfATubeIsPoiseuilles) {
  constexpr double radius = 1.6;
  const auto wall = tube_wall(40.0, [](double) { return radius; });
  const std::vector<FlowStation> stations = flow_stations(wall, 1, 0.0, 40.0);
  ASSERT_EQ(stations.size(), 81u);
  const double tau = poiseuille_shear_pa(radius), slope = poiseuille_gradient_pa_mm(radius);
  EXPECT_NEAR(tau, 2.0 * viscosity_pa_s * 2.0 * flow_m3_s / (pi * std::pow(1.6e-3, 3)), 1e-12);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const FlowStation& one = stations[i];
    EXPECT_NEAR(one.s_mm, 0.5 * static_cast<double>(i), 1e-9);
    EXPECT_GT(one.area_mm2, 0.0);
    EXPECT_NEAR(one.mean_shear_pa, tau, 1e-9 * tau);
    EXPECT_NEAR(one.least_shear_pa, tau, 1e-9 * tau);
    EXPECT_NEAR(one.greatest_shear_pa, tau, 1e-9 * tau);
    // Straight, its ends included: the line goes through the samples.
    EXPECT_NEAR(one.pressure_pa, 9000.0 - slope * one.s_mm, 1e-6 * slope) << one.s_mm;
  }
  EXPECT_NEAR((stations[10].pressure_pa - stations[70].pressure_pa) / 30.0, slope, 1e-6 * slope);
  // The wall's force is the fall of pressure over the section: 2 pi r L tau = pi r^2 dp.
  EXPECT_NEAR(2.0 * radius * 30.0 * tau, radius * radius * 30.0 * slope, 1e-9);
}

TEST(WallFlow, FollowsANarrowing) {
  const auto radius = [](double s) {
    const double x = (s - 20.0) / 5.0;
    return std::abs(x) < 1.0 ? 1.6 * (1.0 - 0.25 * (1.0 + std::cos(pi * x))) : 1.6;
  };
  const auto wall = tube_wall(40.0, radius);
  const std::vector<FlowStation> stations = flow_stations(wall, 1, 0.0, 40.0);
  for (const FlowStation& one : stations) {
    if (one.s_mm < 1.0 || one.s_mm > 39.0) continue;
    const double tau = poiseuille_shear_pa(radius(one.s_mm));
    EXPECT_NEAR(one.mean_shear_pa, tau, 0.06 * tau) << one.s_mm;  // over 1 mm of a throat of 5
    EXPECT_LE(one.least_shear_pa, one.mean_shear_pa);
    EXPECT_GE(one.greatest_shear_pa, one.mean_shear_pa);
  }
  EXPECT_NEAR(station_at(stations, 20.0).greatest_shear_pa, poiseuille_shear_pa(0.8),
              0.02 * poiseuille_shear_pa(0.8));
  const double fall = station_at(stations, 15.0).pressure_pa - station_at(stations, 25.0).pressure_pa;
  double truth = 0.0;
  for (int i = 0; i < 1000; ++i) truth += 0.01 * poiseuille_gradient_pa_mm(radius(15.0 + 0.01 * (i + 0.5)));
  EXPECT_NEAR(fall, truth, 0.01 * truth);
}

TEST(WallFlow, CountsTheVesselsOwnWallAlone) {
  auto wall = tube_wall(20.0, [](double) { return 1.5; });
  const auto other = tube_wall(
      20.0, [](double) { return 0.5; }, 2);
  wall.insert(wall.end(), other.begin(), other.end());
  const std::vector<FlowStation> mine = flow_stations(wall, 1, 0.0, 20.0);
  EXPECT_NEAR(mine[20].greatest_shear_pa, poiseuille_shear_pa(1.5), 1e-9);
  for (const FlowStation& one : flow_stations(wall, 3, 0.0, 20.0)) {
    EXPECT_EQ(one.area_mm2, 0.0);
    EXPECT_TRUE(std::isnan(one.mean_shear_pa) && std::isnan(one.pressure_pa));
  }
  // A stretch: what lies beside it has no say.
  const std::vector<FlowStation> part = flow_stations(wall, 1, 5.0, 7.2);
  ASSERT_EQ(part.size(), 6u);
  EXPECT_EQ(part.front().s_mm, 5.0);
  EXPECT_EQ(part.back().s_mm, 7.2);
}

TEST(WallFlow, WhatIsNotKnownIsSaid) {
  auto wall = tube_wall(20.0, [](double) { return 1.5; });
  for (WallFlowSample& one : wall) {
    if (one.s_mm > 8.0 && one.s_mm < 12.0) one.shear_pa = std::nan("");
    one.pressure_pa = std::nan("");
  }
  const std::vector<FlowStation> stations = flow_stations(wall, 1, 0.0, 20.0);
  EXPECT_TRUE(std::isnan(station_at(stations, 10.0).mean_shear_pa));
  EXPECT_TRUE(std::isnan(station_at(stations, 10.0).least_shear_pa));
  EXPECT_FALSE(std::isnan(station_at(stations, 4.1).mean_shear_pa));
  EXPECT_TRUE(std::isnan(station_at(stations, 4.0).pressure_pa));
  EXPECT_TRUE(std::isnan(station_at(stations, -1.0).mean_shear_pa));
  EXPECT_TRUE(std::isnan(station_at(stations, 20.5).mean_shear_pa));
  EXPECT_TRUE(std::isnan(station_at({}, 1.0).mean_shear_pa));
}

TEST(WallFlow, RefusesBadInput) {
  auto wall = tube_wall(20.0, [](double) { return 1.5; });
  EXPECT_THROW(flow_stations(wall, 1, 5.0, 5.0), InvalidInput);
  EXPECT_THROW(flow_stations(wall, 1, std::nan(""), 5.0), InvalidInput);
  EXPECT_THROW(flow_stations(wall, 1, 0.0, 5.0, {.step_mm = 0.0}), InvalidInput);
  EXPECT_THROW(flow_stations(wall, 1, 0.0, 5.0, {.step_mm = 1.0, .window_mm = 0.5}), InvalidInput);
  wall[3].area_mm2 = -1.0;
  EXPECT_THROW(flow_stations(wall, 1, 0.0, 5.0), InvalidInput);
  wall[3] = {1, std::nan(""), 1.0, 1.0, 1.0};
  EXPECT_THROW(flow_stations(wall, 1, 0.0, 5.0), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
