// Cases that OpenFOAM runs for longer: steps of a pulse, and two processes.

#include "solver_test_support.h"

#include "ostia/solver/flow_report.h"
#include "ostia/solver/womersley.h"

#include <complex>

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

/// Mean of the wall's shear stress along z at a time, over the middle half of a tube, Pa.
double shear_along(const fs::path& time, const geometry::MixedMesh& mesh, double length_mm) {
  const OpenfoamField shear = read_openfoam_field(
      time / "wallShearStress", mesh.tetrahedra.size() + mesh.prisms.size(), facets_of(mesh));
  const std::vector<double>& values = shear.patches.at("wall");
  double force = 0.0, area = 0.0;
  std::size_t facet = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.triangle_face_ids[i] != 1) continue;
    const std::size_t own = facet++;
    const auto p = [&](std::size_t c) { return mesh.points[static_cast<std::size_t>(mesh.triangles[i][c])]; };
    const double z = (p(0).z() + p(1).z() + p(2).z()) / 3.0;
    if (z < 0.25 * length_mm || z > 0.75 * length_mm) continue;
    const double a = (p(1) - p(0)).cross(p(2) - p(0)).norm();
    force -= 1060.0 * a * values[3 * own + 2];
    area += a;
  }
  return force / area;
}

/// Of Womersley's flow, for a harmonic of the flow, Pa s / m3: -mu du/dr at the wall.
std::complex<double> womersley_shear(double radius_mm, double omega, double viscosity_mm2_s) {
  const double alpha = womersley_number(radius_mm, omega, viscosity_mm2_s), r = 1e-3 * radius_mm;
  const std::complex<double> z = std::polar(alpha, 0.75 * std::numbers::pi),
                             ratio = scaled_bessel(1, alpha) / scaled_bessel(0, alpha);
  return -1060.0 * 1e-6 * viscosity_mm2_s * z * ratio / (1.0 - 2.0 * ratio / z) /
         (std::numbers::pi * r * r * r);
}

TEST(OpenfoamLongRun, LongStepsKeepWomersleysShearStress) {
  NEEDS_OPENFOAM();
  constexpr double radius = 1.5, length = 8.0, period = 0.8, mean = 0.6, swing = 0.8;
  const geometry::MixedMesh mesh = vessel(geometry::straight_tube(length, radius), 0.5, 3, 0.3);
  OpenfoamCaseOptions options;
  FlowWaveform wave;
  wave.period_s = period;
  for (int i = 0; i < 200; ++i) {
    wave.time_s.push_back(period * i / 200);
    wave.flow_ml_s.push_back(mean * (1.0 + swing * std::cos(2.0 * std::numbers::pi * i / 200)));
  }
  options.flow.waveform = wave;
  options.cycles = 2;
  const fs::path folder = testing::temporary_folder("womersley") / "case";
  const OpenfoamCaseResult made = write_openfoam_case(mesh, options, folder);
  const Shell done = shell(folder, "./Allrun");
  EXPECT_TRUE(done.good) << done.output << last_words(folder);
  const std::string log = core::read_file(folder / "log.pimpleFoam");
  double steps = 0.0;
  for (std::size_t at = log.find("\nTime = "); at != std::string::npos; at = log.find("\nTime = ", at + 1))
    ++steps;
  EXPECT_NEAR(steps / made.steps, 1.0, 0.5);  // as was said beforehand
  const double omega = 2.0 * std::numbers::pi / period, nu = options.flow.blood.kinematic_viscosity_mm2_s();
  const double steady = 4.0 * 3.5e-3 * 1e-6 * mean / (std::numbers::pi * std::pow(1e-3 * radius, 3));
  const std::complex<double> swinging = 1e-6 * mean * swing * womersley_shear(radius, omega, nu);
  double off = 0.0, all = 0.0;
  int times = 0;
  for (const OpenfoamTime& time : times_of(folder)) {
    if (time.time < period * 1.001) continue;
    const double truth = steady + (swinging * std::polar(1.0, omega * time.time)).real();
    const double found = shear_along(time.folder, mesh, length);
    off += (found - truth) * (found - truth);
    all += truth * truth;
    ++times;
  }
  EXPECT_EQ(times, 20);
  std::printf("%.0f steps (%.0f said), Courant number %.3g at most, shear stress off by %.2f %% (rms)\n",
              steps, made.steps, options.courant, 100.0 * std::sqrt(off / all));
  EXPECT_LT(std::sqrt(off / all), 0.08);  // what a tube of this mesh has in steady flow, too
}

TEST(OpenfoamLongRun, WindkesselsSettleBehindAFork) {
  NEEDS_OPENFOAM();
  const geometry::MixedMesh mesh = vessel(geometry::y_junction(5.0, 5.0, 1.5, 1.2, 60.0), 0.7, 0);
  OpenfoamCaseOptions options;
  options.flow.waveform = builtin_waveform("coronary-left");
  options.flow.flow_ml_s = 0.6;
  options.flow.outlets = OutletModel::resistance;
  options.flow.total_resistance_mmhg_s_ml = 5.0;
  options.total_compliance_ml_mmhg = 0.02;
  options.courant = 20.0;
  const fs::path folder = run_case(mesh, options);
  const BoundaryFlow flow = boundary_flow(mesh, options.flow);
  const double period = options.flow.waveform->period_s, end = 3.0 * period;
  for (const Outlet& outlet : flow.outlets) {
    const OpenfoamSeries q = read_openfoam_series(folder, "flow_" + outlet.name),
                         p = read_openfoam_series(folder, "pressure_" + outlet.name);
    // Steps are not of one length: the series is read between them, at equal times of the last cycle.
    const auto harmonic = [&](const OpenfoamSeries& series, int k) {
      constexpr int samples = 2000;
      std::complex<double> sum = 0.0;
      for (int i = 1; i < samples; ++i) {
        const double time = end - period + period * i / samples;
        const auto next = series.lower_bound(time), last = std::prev(next);
        const double value =
            std::lerp(last->second, next->second, (time - last->first) / (next->first - last->first));
        sum += value * std::polar(1.0, -2.0 * std::numbers::pi * k * time / period);
      }
      return (sum + series.rbegin()->second) / double(samples);
    };
    for (int k = 0; k <= 2; ++k) {
      const std::complex<double> z =
          windkessel_of(outlet, 0.02).impedance(2.0 * std::numbers::pi * k / period);
      EXPECT_LT(std::abs(1060.0 * harmonic(p, k) / harmonic(q, k) / z - 1.0), 0.01)
          << outlet.name << " " << k;
    }
  }
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
