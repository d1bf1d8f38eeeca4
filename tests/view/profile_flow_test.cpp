// A solver's result along the vessels and in the profile: Poiseuille's flow on the walls of a Y.

#include "ostia/view/profile_flow.h"

#include "bench_case.h"

#include "ostia/core/error.h"
#include "ostia/view/profile_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::view {
namespace {

using lumen::testing::YTree;
using std::numbers::pi;

constexpr double blood_pa_s = 3.5e-3;

double tau_pa(double flow_ml_s, double radius_mm) {
  return 4.0 * blood_pa_s * 1e-6 * flow_ml_s / (pi * std::pow(1e-3 * radius_mm, 3));
}
double fall_pa_mm(double flow_ml_s, double radius_mm) {
  return 1e-3 * 8.0 * blood_pa_s * 1e-6 * flow_ml_s / (pi * std::pow(1e-3 * radius_mm, 4));
}

/// The walls of both, each where it is its own, with what flows at their points.
struct FlowInY {
  YTree y;
  double main_ml_s = 1.2, side_ml_s = 0.3;
  geometry::TriMesh wall;
  std::vector<double> shear, pressure;

  FlowInY() {
    const Vec3 z = Vec3::UnitZ(), joint = y.joint_mm * z;
    add(Vec3::Zero(), z, y.main_radius_mm, 0.0, y.main_length_mm, main_ml_s, 500.0);
    const double ostium = y.main_radius_mm * std::numbers::sqrt2;
    add(joint, Vec3(1, 0, 1).normalized(), y.side_radius_mm, ostium + 1.5, y.side_length_mm, side_ml_s,
        500.0 - y.joint_mm * fall_pa_mm(main_ml_s, y.main_radius_mm));
  }
  void add(const Vec3& from, const Vec3& way, double radius, double s0, double s1, double flow, double p0) {
    constexpr int around = 24;
    const int along = static_cast<int>(std::lround((s1 - s0) / 0.3));
    const Vec3 u = way.unitOrthogonal(), v = way.cross(u);
    const auto first = static_cast<std::int32_t>(wall.points.size());
    for (int k = 0; k <= along; ++k)
      for (int i = 0; i < around; ++i) {
        const double s = s0 + (s1 - s0) * k / along, angle = 2.0 * pi * i / around;
        wall.points.push_back(from + s * way + radius * (std::cos(angle) * u + std::sin(angle) * v));
        shear.push_back(tau_pa(flow, radius));
        pressure.push_back(p0 - s * fall_pa_mm(flow, radius));
      }
    for (int k = 0; k < along; ++k)
      for (int i = 0; i < around; ++i) {
        const std::int32_t a = first + around * k + i, b = first + around * k + (i + 1) % around;
        wall.triangles.push_back({a, b, b + around});
        wall.triangles.push_back({a, b + around, a + around});
      }
  }
  FlowStations stations() const {
    return flow_along_vessels(lumen::model_of_tubes(y.tree()), wall, {shear, FieldAt::points},
                              {pressure, FieldAt::points});
  }
};

TEST(ProfileFlow, EachVesselHasWhatFlowsInItself) {
  const FlowInY flow;
  const FlowStations stations = flow.stations();
  const auto& main = stations.at(flow.y.main_id);
  const auto& side = stations.at(flow.y.side_id);
  EXPECT_EQ(main.front().s_mm, 0.0);
  EXPECT_NEAR(side.front().s_mm, flow.y.joint_mm, 1e-6);
  const auto check = [](const std::vector<analysis::FlowStation>& of, double from, double to, double ml_s,
                        double radius) {
    for (double s = from; s < to; s += 1.3) {
      const analysis::FlowStation here = station_at(of, s), next = station_at(of, s + 1.0);
      EXPECT_NEAR(here.mean_shear_pa, tau_pa(ml_s, radius), 1e-6) << s;
      EXPECT_NEAR(here.greatest_shear_pa, tau_pa(ml_s, radius), 1e-6) << s;
      EXPECT_NEAR(here.pressure_pa - next.pressure_pa, fall_pa_mm(ml_s, radius),
                  0.01 * fall_pa_mm(ml_s, radius))
          << s;
    }
  };
  check(main, 1.0, 17.0, flow.main_ml_s, flow.y.main_radius_mm);
  check(main, 30.0, 47.0, flow.main_ml_s, flow.y.main_radius_mm);
  check(side, flow.y.joint_mm + 8.0, flow.y.joint_mm + 26.0, flow.side_ml_s, flow.y.side_radius_mm);
}

TEST(ProfileFlow, TheWayOfABranchGoesOnFromItsParents) {
  const FlowInY flow;
  const auto model = lumen::model_of_tubes(flow.y.tree());
  const auto along = stations_along(flow.stations(), analysis::ostial_way(model, flow.y.side_id));
  ASSERT_FALSE(along.empty());
  EXPECT_EQ(along.front().s_mm, 0.0);
  EXPECT_NEAR(station_at(along, 10.0).mean_shear_pa, tau_pa(flow.main_ml_s, flow.y.main_radius_mm), 1e-6);
  EXPECT_NEAR(station_at(along, 40.0).mean_shear_pa, tau_pa(flow.side_ml_s, flow.y.side_radius_mm), 1e-6);
  for (std::size_t i = 0; i + 1 < along.size(); ++i) EXPECT_LE(along[i].s_mm, along[i + 1].s_mm);
  EXPECT_TRUE(stations_along({}, analysis::ostial_way(model, flow.y.side_id)).empty());
}

TEST(ProfileFlow, ValuesOfTrianglesDoAsWellAndAnotherHeartHasNone) {
  FlowInY flow;
  const std::vector<double> shear(flow.wall.triangles.size(), 2.5);
  const auto model = lumen::model_of_tubes(flow.y.tree());
  const FlowStations there = flow_along_vessels(model, flow.wall, {shear, FieldAt::triangles}, {});
  EXPECT_NEAR(station_at(there.at(flow.y.main_id), 10.0).mean_shear_pa, 2.5, 1e-9);
  EXPECT_TRUE(std::isnan(station_at(there.at(flow.y.main_id), 10.0).pressure_pa));
  for (Vec3& point : flow.wall.points) point.x() += 60.0;
  const FlowStations none = flow_along_vessels(model, flow.wall, {shear, FieldAt::triangles}, {});
  EXPECT_TRUE(stations_along(none, analysis::ostial_way(model, flow.y.main_id)).empty());
  const std::vector<double> few(3, 1.0);
  EXPECT_THROW(flow_along_vessels(model, flow.wall, {few, FieldAt::points}, {}), InvalidInput);
}

TEST(ProfileFlow, HasAxesUnitAndLegendOfItsOwn) {
  const FlowInY flow;
  testing::TubeCase tube(flow.y.tree());
  tube.bench.vessel.set(flow.y.side_id);
  tube.bench.cursor_mm.set(10.0);
  ProfileView profile(tube.bench);
  profile.set_size(700, 220, 1.0);
  const auto lines = [&](Role role) {
    const auto& all = profile.overlay().lines;
    return std::count_if(all.begin(), all.end(), [&](const OverlayLine& line) { return line.role == role; });
  };
  const auto text = [&](Role role, const std::string& part) {
    const auto& all = profile.overlay().texts;
    return std::count_if(all.begin(), all.end(), [&](const OverlayText& one) {
      return one.role == role && one.text.find(part) != std::string::npos;
    });
  };
  EXPECT_EQ(lines(Role::shear), 0);
  EXPECT_EQ(text(Role::area, "area"), 1);
  const double before = profile.x_of(50.0);
  profile.set_flow(
      std::make_shared<const ProfileFlow>(ProfileFlow{flow.stations(), "shear, Pa", "pressure, Pa"}));
  EXPECT_GT(lines(Role::shear), 0);
  EXPECT_GT(lines(Role::pressure), 1);  // its axis is one
  EXPECT_EQ(text(Role::area, ""), 0);
  EXPECT_EQ(text(Role::shear, "shear, Pa: " + std::string("0.668")), 1);
  EXPECT_GE(text(Role::shear, ""), 3);  // legend and numbers
  EXPECT_EQ(text(Role::pressure, "pressure, Pa: 49"), 1);
  EXPECT_GE(text(Role::pressure, ""), 3);
  EXPECT_LT(profile.x_of(50.0), before) << "the axes have room";
  const auto& bands = profile.overlay().bands;
  EXPECT_TRUE(
      std::any_of(bands.begin(), bands.end(), [](const OverlayBand& b) { return b.role == Role::shear; }));
  for (const OverlayLine& line : profile.overlay().lines)
    if (line.role == Role::shear || line.role == Role::pressure)
      for (const Vec2& px : line.px) {
        EXPECT_GE(px.x(), 0.0);
        EXPECT_LE(px.x(), 700.0);
        EXPECT_GE(px.y(), 0.0);
        EXPECT_LE(px.y(), 220.0);
      }
  // What was gathered of a vessel does not stay for another one.
  tube.bench.vessel.set(flow.y.main_id);
  EXPECT_EQ(text(Role::shear, "shear, Pa: " + std::string("0.668")), 1) << "at 10 mm they run together";
  tube.bench.cursor_mm.set(40.0);
  const auto main = station_at(flow.stations().at(flow.y.main_id), 40.0);
  EXPECT_EQ(text(Role::shear, "shear, Pa: " + three_digits(main.mean_shear_pa)), 1);
  tube.bench.vessel.set(flow.y.side_id);
  tube.bench.cursor_mm.set(40.0);
  const auto side = station_at(flow.stations().at(flow.y.side_id), 40.0);
  EXPECT_EQ(text(Role::shear, "shear, Pa: " + three_digits(side.mean_shear_pa)), 1);
  profile.set_flow(nullptr);
  EXPECT_EQ(lines(Role::shear), 0);
  EXPECT_EQ(profile.x_of(50.0), before);
}

}  // namespace
}  // namespace ostia::view
