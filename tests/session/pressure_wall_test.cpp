// Pressures of the axes on the wall, and the files that go with them.

#include "ostia/session/pressure_wall.h"

#include "report_cases.h"
#include "shared_data.h"

#include "ostia/core/files.h"
#include "ostia/session/pressure_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ostia::session::testing {
namespace {

using ::testing::HasSubstr;

PressureReport report_of(const lumen::LumenModel& model, const PressureReportOptions& options = {}) {
  return make_pressure_report(pressure_tree(model, solved_surfaces(model, core::no_task())), options);
}

TEST(PressureWall, HasTheAxisPressuresAtTheirHeight) {
  const lumen::LumenModel model = narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.6);
  const PressureReport report = report_of(model);
  const PressureWall wall = pressure_wall(report, model);
  const auto& stations = report.network->network().branches[0].stations;
  ASSERT_GT(wall.wall.points.size(), 1000u);
  ASSERT_EQ(wall.at_points.ffr.size(), wall.wall.points.size());
  for (std::size_t p = 0; p < wall.wall.points.size(); ++p) {
    const double z = wall.wall.points[p].z();  // the vessel runs along z
    if (z < stations.front().s_mm || z > stations.back().s_mm) continue;
    std::size_t i = 1;
    while (i + 1 < stations.size() && stations[i].s_mm < z) ++i;
    const double t = (z - stations[i - 1].s_mm) / (stations[i].s_mm - stations[i - 1].s_mm);
    const auto& flows = report.under_hyperaemia.stations[0];
    const double pa = (1.0 - t) * flows[i - 1].pressure_pa + t * flows[i].pressure_pa;
    const double shear = (1.0 - t) * flows[i - 1].wall_shear_pa + t * flows[i].wall_shear_pa;
    ASSERT_NEAR(wall.at_points.s_mm[p], z, 1e-3);
    ASSERT_NEAR(wall.at_points.ffr[p], pa / report.under_hyperaemia.aortic_pa, 1e-6);
    ASSERT_NEAR(wall.at_points.pressure_mmhg[p], pa / hemodynamics::pa_of_mmhg, 1e-4);
    ASSERT_NEAR(wall.at_points.wall_shear_pa[p], shear, 1e-2 + 1e-3 * std::abs(shear));
    EXPECT_EQ(wall.at_points.occluded[p], 0);
  }
}

TEST(PressureWall, OfAForkEachBranchHasItsOwn) {
  const lumen::LumenModel model = narrowed_y(1, 12.0, 0.7);
  const PressureReport report = report_of(model);
  const auto& branches = report.network->network().branches;
  ASSERT_EQ(branches.size(), 3u);
  for (std::size_t b = 0; b < branches.size(); ++b) {
    // On the wall beside the middle of each branch.
    const auto& middle = branches[b].stations[branches[b].stations.size() / 2];
    const auto& axis = *report.tree.vessels.at(branches[b].vessel).axis;
    const std::vector<geometry::Vec3> points = {axis.place(middle.s_mm, 0.5, 0.5 * middle.diameter_mm()),
                                                axis.place(middle.s_mm, 3.5, 0.5 * middle.diameter_mm())};
    const WallPressures at = pressures_on(report, points);
    for (std::size_t p = 0; p < points.size(); ++p) {
      EXPECT_EQ(at.branch[p], static_cast<std::int32_t>(b)) << p;
      EXPECT_EQ(at.vessel[p], branches[b].vessel);
      EXPECT_NEAR(at.ffr[p], report.under_hyperaemia.ratio(b, branches[b].stations.size() / 2), 2e-3);
    }
  }
}

TEST(PressureWall, IsInTheFolderWithTheCasesOfSolvers) {
  const lumen::LumenModel model = narrowed_tube("LAD", 40.0, 1.6, 15.0, 0.8);
  PressureReportOptions options;
  options.exports = {hemodynamics::NetworkFormat::svzerod, hemodynamics::NetworkFormat::svoned,
                     hemodynamics::NetworkFormat::openbf};
  PressureReport report = report_of(model, options);
  report.wall = pressure_wall(report, model);
  const std::filesystem::path folder = ostia::testing::temporary_folder("pressure-wall") / "out";
  write_pressure_report(folder, report, {"ffr", {}, "{}"}, 0.0);
  EXPECT_THAT(core::read_file(folder / "wall.vtp"), HasSubstr("WallShear_Pa"));
  for (const char* name : {"svzerod.json", "svoned.in", "openbf.yaml", "openbf_inlet.dat"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  const hemodynamics::SvzerodCase back = hemodynamics::read_svzerod(core::read_file(folder / "svzerod.json"));
  const hemodynamics::Solution theirs =
      hemodynamics::solve(hemodynamics::PreparedNetwork(back.network, {}), back.boundary);
  EXPECT_NEAR(theirs.flow_ml_s.back() / report.hyperaemia.solution.flow_ml_s.back(), 1.0, 1e-6);
  EXPECT_NEAR(theirs.to_pa.back() / (10.0 * report.hyperaemia.solution.to_pa.back()), 1.0, 1e-6);
}

}  // namespace
}  // namespace ostia::session::testing
