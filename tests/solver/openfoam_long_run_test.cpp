// Cases that OpenFOAM runs for longer: steps of a pulse, and two processes.

#include "solver_test_support.h"

#include "ostia/solver/flow_report.h"

namespace ostia::solver {
namespace {

namespace fs = std::filesystem;

TEST(OpenfoamLongRun, APulsatileTubeFollowsItsWaveform) {
  NEEDS_OPENFOAM();
  const geometry::MixedMesh mesh = vessel(geometry::straight_tube(6.0, 1.5), 0.7, 2, 0.3);
  OpenfoamCaseOptions options;
  options.flow.waveform = builtin_waveform("coronary-left");
  options.flow.waveform->period_s = 0.8;
  options.flow.flow_ml_s = 0.6;
  options.cycles = 1;
  options.results_per_cycle = 40;
  options.time_step_s = 0.005;
  const fs::path folder = testing::temporary_folder("pulse") / "case";
  const OpenfoamCaseResult made = write_openfoam_case(mesh, options, folder);
  EXPECT_NEAR(made.time_step_s, 0.005, 1e-12);
  // Eight steps of the cycle.
  const Shell done = shell(folder, "sed -i 's/^endTime .*/endTime 0.04;/' system/controlDict && ./Allrun");
  EXPECT_TRUE(done.good) << done.output << last_words(folder);
  const BoundaryFlow& flow = made.flow;
  EXPECT_EQ(last_time(folder).filename(), "0.04");
  EXPECT_NEAR(last_value(folder, "flow_" + flow.inlets[0].name), -1e-6 * flow.flow_ml_s(0.04), 1e-12);
  EXPECT_NEAR(last_value(folder, "flow_" + flow.outlets[0].name), 1e-6 * flow.flow_ml_s(0.04), 1e-10);
}

TEST(OpenfoamLongRun, ACycleIsReadBackWithTheMeansOfItsMeanFlow) {
  NEEDS_OPENFOAM();
  constexpr double radius = 1.5, mean_flow = 0.6;
  const geometry::MixedMesh mesh = vessel(geometry::straight_tube(8.0, radius), 0.7, 2, 0.3);
  OpenfoamCaseOptions options;
  options.flow.waveform = builtin_waveform("coronary-left");
  options.flow.flow_ml_s = mean_flow;
  options.cycles = 2;
  options.time_step_s = 0.005;
  const FlowResult read = read_flow_result(run_case(mesh, options));
  EXPECT_EQ(read.times, 20u);
  EXPECT_NEAR(read.ends[0].flow_ml_s, mean_flow, 0.002 * mean_flow);
  EXPECT_NEAR(read.ends[1].flow_ml_s, mean_flow, 0.002 * mean_flow);
  ASSERT_TRUE(read.run.cycle_change);
  // Womersley's flow is linear: the mean shear stress is Poiseuille's of the mean flow. It never turns back
  // here.
  const double truth = 4.0 * 3.5e-3 * 1e-6 * mean_flow / (std::numbers::pi * std::pow(1e-3 * radius, 3));
  EXPECT_NEAR(flow_report(read).walls[0].mean_pa, truth, 0.12 * truth);
  const std::vector<double> index = oscillatory_shear_index(read.mean->wall_shear_pa, read.mean_shear_pa);
  EXPECT_LT(weighted_percentile(index, read.wall.areas_mm2, 0.95), 0.05);
}

TEST(OpenfoamLongRun, OnTwoProcessesTheResultIsTheSame) {
  NEEDS_OPENFOAM();
  if (!shell("/", "command -v mpirun").good) GTEST_SKIP() << "mpirun is not installed";
  const geometry::MixedMesh mesh = vessel(geometry::straight_tube(6.0, 1.5), 0.7, 2, 0.3);
  OpenfoamCaseOptions options;
  options.tolerance = 1e-7;
  const fs::path one = run_case(mesh, options),
                 two = run_case(mesh, options,
                                "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
                                "OMPI_MCA_rmaps_base_oversubscribe=1 ./Allrun 2");
  ASSERT_TRUE(fs::exists(two / "processor1"));
  const OpenfoamField a = result(one, "p", mesh), b = result(two, "p", mesh);
  double largest = 0.0, difference = 0.0;
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    largest = std::max(largest, std::abs(a.cells[i]));
    difference = std::max(difference, std::abs(a.cells[i] - b.cells[i]));
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(difference, 1e-4 * largest);
}

}  // namespace
}  // namespace ostia::solver
