#include "made_up_flow.h"

#include "ostia/io/mesh_export.h"
#include "ostia/solver/flow_report.h"

namespace ostia::solver {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3;

TEST(FlowResult, PoiseuillesFlowComesBackInPascals) {
  const Poiseuille truth;
  const geometry::MixedMesh mesh = tube(truth.length_mm, truth.radius_mm);
  const fs::path folder = made_up_steady(mesh, truth);
  const FlowResult read = read_flow_result(folder);
  EXPECT_EQ(read.mesh.tetrahedra, mesh.tetrahedra);
  EXPECT_EQ(read.mesh.prisms, mesh.prisms);
  ASSERT_EQ(read.wall.parts.size(), 1u);
  const std::vector<Vec3> centres = wall_centres(mesh);
  ASSERT_EQ(read.last.wall_shear_pa.size(), 3 * centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    EXPECT_NEAR(read.last.wall_shear_pa[3 * i + 2], truth.shear_pa(), 1e-9) << "with the flow, in Pa";
    EXPECT_NEAR(read.last.wall_pressure_pa[i], truth.pressure_pa(centres[i].z()), 1e-8);
  }
  const std::vector<Vec3> cells = element_centres(mesh);
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_NEAR(read.last.velocity_m_s[3 * i + 2], truth.velocity_m_s(cells[i]).z(), 1e-11);
  EXPECT_TRUE(read.run.converged);
  EXPECT_EQ(read.run.last, 120.0);
  ASSERT_EQ(read.ends.size(), 2u);
  EXPECT_EQ(read.ends[0].kind, geometry::FaceKind::inlet);
  EXPECT_NEAR(read.ends[0].flow_ml_s, 0.5, 1e-12);
  EXPECT_NEAR(read.ends[1].flow_ml_s, 0.5, 1e-12);
  EXPECT_NEAR(read.ends[0].pressure_pa, truth.pressure_pa(0.0), 1e-8);
  EXPECT_FALSE(read.mean);
  EXPECT_LT(read.mass_balance_error(), 1e-9);
}

TEST(FlowResult, TheReportWeighsWithArea) {
  const Poiseuille truth;
  const geometry::MixedMesh mesh = tube(truth.length_mm, truth.radius_mm);
  const FlowResult read = read_flow_result(made_up_steady(mesh, truth));
  const FlowReport report = flow_report(read);
  EXPECT_TRUE(report.passed());
  ASSERT_EQ(report.walls.size(), 1u);
  const WallFigures& wall = report.walls[0];
  // 4 mu Q / (pi r^3) = 0.66 Pa: neither low nor high.
  EXPECT_NEAR(truth.shear_pa(), 0.660, 5e-4);
  for (const double value : {wall.mean_pa, wall.least_pa, wall.greatest_pa, wall.p05_pa, wall.p95_pa})
    EXPECT_NEAR(value, truth.shear_pa(), 1e-9);
  EXPECT_EQ(wall.low_share, 0.0);
  EXPECT_EQ(wall.high_share, 0.0);
  geometry::Box3 box;  // the tube's ends are cut off
  for (const Vec3& p : mesh.points) box.extend(p);
  const double side = 2.0 * std::numbers::pi * truth.radius_mm * box.sizes().z();
  EXPECT_NEAR(wall.area_mm2, side, 0.03 * side);
  EXPECT_EQ(flow_report(read, {0.7, 1.0}).walls[0].low_share, 1.0);
  EXPECT_EQ(flow_report(read, {0.1, 0.6}).walls[0].high_share, 1.0);
  EXPECT_THROW(flow_report(read, {0.7, 0.7}), InvalidInput);
}

/// A neck and a sac that a person named: the stress of one is not in the figures of the other.
TEST(FlowResult, EachNamedWallHasItsOwnFigures) {
  const Poiseuille truth;
  geometry::MixedMesh mesh = tube(truth.length_mm, truth.radius_mm);
  mesh.faces.push_back({9, "wall_sac", geometry::FaceKind::wall});
  std::vector<double> area(2, 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.triangle_face_ids[i] != 1) continue;
    const auto at = [&](std::size_t k) {
      return mesh.points[static_cast<std::size_t>(mesh.triangles[i][k])];
    };
    const bool sac = (at(0) + at(1) + at(2)).z() / 3.0 > 0.6 * truth.length_mm;
    if (sac) mesh.triangle_face_ids[i] = 9;
    area[sac ? 1 : 0] += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  }
  const FlowResult read = read_flow_result(made_up_steady(mesh, truth, {{"wall_sac", 0.25}}));
  const FlowReport report = flow_report(read);
  ASSERT_EQ(report.walls.size(), 2u);
  for (const WallFigures& wall : report.walls) {
    const bool sac = wall.name == "wall_sac";
    EXPECT_EQ(wall.name, sac ? "wall_sac" : "wall");
    EXPECT_NEAR(wall.area_mm2, area[sac ? 1 : 0], 1e-6);
    for (const double value : {wall.mean_pa, wall.least_pa, wall.greatest_pa})
      EXPECT_NEAR(value, (sac ? 0.25 : 1.0) * truth.shear_pa(), 1e-9);
    EXPECT_EQ(wall.low_share, sac ? 1.0 : 0.0) << "below 0.4 Pa";
  }
  EXPECT_NE(report.walls[0].name, report.walls[1].name);
}

TEST(FlowResult, PercentilesAreOfTheArea) {
  const std::vector<double> values{3.0, 1.0, 2.0}, areas{1.0, 8.0, 1.0};
  EXPECT_EQ(weighted_percentile(values, areas, 0.05), 1.0);
  EXPECT_EQ(weighted_percentile(values, areas, 0.8), 1.0);
  EXPECT_EQ(weighted_percentile(values, areas, 0.85), 2.0);
  EXPECT_EQ(weighted_percentile(values, areas, 0.95), 3.0);
}

TEST(FlowResult, APoorRunIsSaidWithItsReason) {
  const Poiseuille truth;
  const geometry::MixedMesh mesh = tube(truth.length_mm, truth.radius_mm);
  const fs::path folder = made_up_steady(mesh, truth);
  core::write_file(folder / "log.simpleFoam", "Time = 120\n\nEnd\n");
  const FlowResult open = read_flow_result(folder);
  EXPECT_FALSE(open.run.converged);
  EXPECT_NE(flow_report(open).reasons.at(0).find("120 iterations"), std::string::npos);
  fs::remove(folder / "log.simpleFoam");
  const FlowResult unknown = read_flow_result(folder);
  const std::string reason = flow_report(unknown).reasons.at(0);
  EXPECT_NE(reason.find("not known"), std::string::npos);
  EXPECT_EQ(reason.find(folder.string()), std::string::npos) << "folders may bear a patient's name";
  FlowReport foreign = flow_report(unknown);
  foreign.reasons.emplace_back("M\xfcller");  // no UTF-8
  EXPECT_NE(report_json(unknown, foreign).find("ller"), std::string::npos);
  core::write_file(folder / "log.simpleFoam", "SIMPLE solution converged in 120 iterations\n");
  const std::string out = open.ends[1].name;
  write_series(folder, "flow_" + out, {{120, 0.98e-6 * truth.flow_ml_s}});
  const FlowReport lost = flow_report(read_flow_result(folder));
  ASSERT_EQ(lost.reasons.size(), 1u);
  EXPECT_NE(lost.reasons[0].find("differ by 2 %"), std::string::npos) << lost.reasons[0];
  write_series(folder, "flow_" + out, {{120, 0.995e-6 * truth.flow_ml_s}});
  EXPECT_TRUE(flow_report(read_flow_result(folder)).passed());
}

TEST(FlowResult, OutletsThatHaveNotSettledAtTheirResistanceAreSaid) {
  const Poiseuille truth;
  FlowResult read = read_flow_result(made_up_steady(tube(4.0, truth.radius_mm), truth));
  // Two outlets of half the flow each, at 10 and 12 kPa.
  read.ends[1].flow_ml_s = 0.25;
  read.ends.push_back(read.ends[1]);
  read.ends[1].pressure_pa = 10e3;
  read.ends[2].name = "outlet_other";
  read.ends[2].pressure_pa = 12e3;
  read.record.resistance_pa_s_m3 = {{read.ends[1].name, 4e10}, {"outlet_other", 4.8e10}};
  EXPECT_TRUE(flow_report(read).passed());
  read.ends[2].pressure_pa = 12.5e3;
  const FlowReport off = flow_report(read);
  ASSERT_EQ(off.reasons.size(), 1u);
  EXPECT_NE(off.reasons[0].find("outlet_other"), std::string::npos) << off.reasons[0];
  EXPECT_NE(off.reasons[0].find("log.outlets"), std::string::npos) << off.reasons[0];
  read.ends[2].pressure_pa = NAN;
  EXPECT_FALSE(flow_report(read).passed());
  // One outlet holds its own pressure; in a pulse the flows are given.
  read.record.resistance_pa_s_m3.erase(read.ends[1].name);
  EXPECT_TRUE(flow_report(read).passed());
}

/// A pulsatile case of three cycles of 0.8 s with made-up flows of `factor(t)`.
template <class Factor>
fs::path made_up_pulse(const geometry::MixedMesh& mesh, const Poiseuille& flow, const Factor& factor,
                       double end_s = 2.4) {
  const fs::path folder = testing::temporary_folder("made") / "pulse";
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = flow.flow_ml_s;
  options.flow.waveform = builtin_waveform("coronary-left");
  const OpenfoamCaseResult made = write_openfoam_case(mesh, options, folder);
  std::map<double, double> in, out, pressure;
  for (int i = 1; i <= std::lround(end_s / 0.01); ++i) {
    const double t = 0.01 * i;
    in[t] = -1e-6 * flow.flow_ml_s * factor(t);
    out[t] = -in[t];
    pressure[t] = factor(t) * flow.pressure_pa(0.0) / flow.density;
  }
  for (int i = 1; i <= std::lround(end_s / 0.1); ++i) {
    char name[16];
    std::snprintf(name, sizeof name, "%g", 0.1 * i);
    flow.write(folder / name, mesh, factor(0.1 * i));
  }
  write_series(folder, "flow_" + made.flow.inlets[0].name, in);
  write_series(folder, "flow_" + made.flow.outlets[0].name, out);
  write_series(folder, "pressure_" + made.flow.inlets[0].name, pressure);
  write_series(folder, "pressure_" + made.flow.outlets[0].name, {{0.0, 0.0}, {0.01, 0.0}, {end_s, 0.0}});
  core::write_file(folder / "log.pisoFoam",
                   "Courant Number mean: 0.01 max: 0.25\nCourant Number mean: 0.02 max: 0.4\n"
                   "Courant Number mean: 0.01 max: 0.3\n");
  return folder;
}

constexpr double omega = 2.0 * std::numbers::pi / 0.8;

TEST(FlowResult, ASteadyPulseHasNoOscillation) {
  const Poiseuille truth;
  const geometry::MixedMesh mesh = tube(4.0, truth.radius_mm);
  const FlowResult read = read_flow_result(made_up_pulse(mesh, truth, [](double) { return 1.0; }));
  ASSERT_TRUE(read.mean);
  EXPECT_EQ(read.times, 8u);
  const std::vector<double> index = oscillatory_shear_index(read.mean->wall_shear_pa, read.mean_shear_pa);
  const std::vector<double> residence = relative_residence_time(read.mean_shear_pa, index);
  for (std::size_t i = 0; i < index.size(); ++i) {
    EXPECT_NEAR(read.mean_shear_pa[i], truth.shear_pa(), 1e-9);
    EXPECT_NEAR(index[i], 0.0, 1e-9);
    EXPECT_NEAR(residence[i], 1.0 / truth.shear_pa(), 1e-6);
  }
  EXPECT_TRUE(read.run.converged) << read.run.not_converged;
  EXPECT_NEAR(*read.run.largest_courant, 0.4, 1e-12);
  EXPECT_NEAR(*read.run.cycle_change, 0.0, 1e-9);
  EXPECT_NEAR(read.ends[0].flow_ml_s, truth.flow_ml_s, 1e-9);
}

TEST(FlowResult, PureOscillationHasAnIndexOfAHalf) {
  const Poiseuille truth;
  const geometry::MixedMesh mesh = tube(4.0, truth.radius_mm);
  const FlowResult read =
      read_flow_result(made_up_pulse(mesh, truth, [](double t) { return std::sin(omega * t); }));
  const std::vector<double> index = oscillatory_shear_index(read.mean->wall_shear_pa, read.mean_shear_pa);
  const std::vector<double> residence = relative_residence_time(read.mean_shear_pa, index);
  // The mean of |sin| over eight even samples is (1 + sqrt 2) / 4; over the cycle 2 / pi.
  const double mean = (1.0 + std::sqrt(2.0)) / 4.0;
  for (std::size_t i = 0; i < index.size(); ++i) {
    EXPECT_NEAR(index[i], 0.5, 1e-9);
    EXPECT_NEAR(read.mean_shear_pa[i], mean * truth.shear_pa(), 1e-9);
    EXPECT_TRUE(std::isnan(residence[i]));
  }
}

TEST(FlowResult, BetweenThemTheIndexIsThatOfTheSamples) {
  // 1 + 2 sin: the mean is 1; of |1 + 2 sin| over eight samples 1 +- sqrt 2 (twice), 1 (twice), 3, |-1|.
  const Poiseuille truth;
  const geometry::MixedMesh mesh = tube(4.0, truth.radius_mm);
  const FlowResult read =
      read_flow_result(made_up_pulse(mesh, truth, [](double t) { return 1.0 + 2.0 * std::sin(omega * t); }));
  const double mean = (2.0 * (1.0 + std::sqrt(2.0)) + 2.0 * (std::sqrt(2.0) - 1.0) + 2.0 + 3.0 + 1.0) / 8.0;
  const std::vector<double> index = oscillatory_shear_index(read.mean->wall_shear_pa, read.mean_shear_pa);
  EXPECT_NEAR(read.mean_shear_pa[3], mean * truth.shear_pa(), 1e-9);
  EXPECT_NEAR(index[3], 0.5 * (1.0 - 1.0 / mean), 1e-9);
  EXPECT_NEAR(relative_residence_time(read.mean_shear_pa, index)[3], 1.0 / truth.shear_pa(), 1e-6);
}

TEST(FlowResult, APulseThatHasNotSettledIsSaid) {
  const Poiseuille truth;
  const geometry::MixedMesh mesh = tube(4.0, truth.radius_mm);
  const FlowResult drifting =
      read_flow_result(made_up_pulse(mesh, truth, [](double t) { return 1.0 + 0.1 * t; }));
  EXPECT_NEAR(*drifting.run.cycle_change, 0.08 / 1.2, 1e-6);  // means of the cycles: 1.12 and 1.20
  EXPECT_NE(drifting.run.not_converged.find("last two cycles differ by 6.7 %"), std::string::npos)
      << drifting.run.not_converged;
  const FlowResult early = read_flow_result(made_up_pulse(
      mesh, truth, [](double) { return 1.0; }, 1.0));
  EXPECT_NE(early.run.not_converged.find("1 s of its 2.4 s"), std::string::npos) << early.run.not_converged;
  EXPECT_FALSE(early.run.cycle_change);
  expect_refusal(
      [&] {
        read_flow_result(made_up_pulse(
            mesh, truth, [](double) { return 1.0; }, 0.5));
      },
      {"0.5 s of a cycle of 0.8 s"});
}

TEST(FlowResult, UnevenSamplesAreWeighed) {
  const std::vector<double> even = periodic_weights({0.2, 0.4, 0.6, 0.8}, 0.8);
  for (const double w : even) EXPECT_NEAR(w, 0.25, 1e-12);
  const std::vector<double> uneven = periodic_weights({0.1, 0.4, 0.8}, 0.8);
  EXPECT_NEAR(uneven[0], (0.4 - 0.0) / 1.6, 1e-12);
  EXPECT_NEAR(uneven[1], (0.8 - 0.1) / 1.6, 1e-12);
  EXPECT_NEAR(uneven[2], (0.9 - 0.4) / 1.6, 1e-12);
}

TEST(FlowResult, RefusesWhatIsNoFinishedCase) {
  const Poiseuille truth;
  const geometry::MixedMesh mesh = tube(4.0, truth.radius_mm);
  const fs::path empty = testing::temporary_folder("made");
  expect_refusal([&] { read_flow_result(empty / "none"); }, {"no folder", "none"});
  expect_refusal([&] { read_flow_result(empty); }, {"no case of `ostia case`"});
  const fs::path fresh = empty / "fresh";
  write_openfoam_case(mesh, {}, fresh);
  expect_refusal([&] { read_flow_result(fresh); }, {"Allrun"});
  fs::create_directories(fresh / "processor0" / "50");
  expect_refusal([&] { read_flow_result(fresh); }, {"reconstructPar"});
  const fs::path folder = made_up_steady(mesh, truth);
  const geometry::MixedMesh other = tube(6.0, truth.radius_mm);
  io::export_mesh(other, io::MeshFormat::vtu, empty / "other.vtu");
  expect_refusal([&] { read_flow_result(folder, empty / "other.vtu"); },
                 {"other.vtu is not the mesh", std::to_string(other.points.size()) + " points"});
  geometry::MixedMesh moved = mesh;
  moved.points[7].x() += 0.01;
  io::export_mesh(moved, io::MeshFormat::vtu, empty / "moved.vtu");
  expect_refusal([&] { read_flow_result(folder, empty / "moved.vtu"); }, {"point 7", "away"});
  geometry::MixedMesh mixed_up = mesh;
  std::swap(mixed_up.tetrahedra[3], mixed_up.tetrahedra[9]);
  io::export_mesh(mixed_up, io::MeshFormat::vtu, empty / "mixed.vtu");
  expect_refusal([&] { read_flow_result(folder, empty / "mixed.vtu"); }, {"tetrahedron 3", "order"});
  mixed_up = mesh;
  const auto wall =
      static_cast<std::size_t>(std::ranges::find(mesh.triangle_face_ids, 1) - mesh.triangle_face_ids.begin());
  ASSERT_EQ(mesh.triangle_face_ids[wall + 1], 1);
  std::swap(mixed_up.triangles[wall], mixed_up.triangles[wall + 1]);
  io::export_mesh(mixed_up, io::MeshFormat::vtu, empty / "mixed.vtu");
  expect_refusal([&] { read_flow_result(folder, empty / "mixed.vtu"); }, {"face wall", "order"});
  fs::rename(folder / "mesh.vtu", empty / "kept.vtu");
  expect_refusal([&] { read_flow_result(folder); }, {"mesh.vtu", "--mesh"});
  EXPECT_TRUE(read_flow_result(folder, empty / "kept.vtu").run.converged);
  fs::rename(folder / "120" / "wallShearStress", empty / "shear");
  expect_refusal([&] { read_flow_result(folder, empty / "kept.vtu"); }, {"holds no wallShearStress"});
  core::write_file(folder / "120" / "wallShearStress", "FoamFile { format binary; class volVectorField; }");
  expect_refusal([&] { read_flow_result(folder, empty / "kept.vtu"); }, {"wallShearStress", "binary"});
}

TEST(FlowResult, CanBeCancelled) {
  const Poiseuille truth;
  const fs::path folder = made_up_steady(tube(4.0, truth.radius_mm), truth);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(read_flow_result(folder, {}, task), Cancelled);
}

TEST(FlowResult, RefusesARecordThatIsNotSound) {
  const fs::path folder = testing::temporary_folder("made");
  const auto refused = [&](const std::string& text, const std::string& part) {
    core::write_file(folder / "flow-case.json", text);
    expect_refusal([&] { read_flow_result(folder); }, {"flow-case.json", part});
  };
  refused("{", "version 1");
  refused("{\"v\": 2}", "version 1");
  refused("{\"v\": 1}", "solver");
  refused(R"({"v":1,"solver":"openfoam","density_kg_m3":"thick"})", "density_kg_m3");
  refused(R"({"v":1,"solver":"openfoam","density_kg_m3":0,"viscosity_mPa_s":3.5,"rheology":"newton",)"
          R"("period_s":0,"cycles":0,"outlets":"zero"})",
          "positive");
  core::write_file(folder / "flow-case.json",
                   R"({"v":1,"solver":"svmultiphysics","density_kg_m3":1060,"viscosity_mPa_s":3.5,)"
                   R"("rheology":"newton","period_s":0,"cycles":0,"outlets":"zero"})");
  expect_refusal([&] { read_flow_result(folder); }, {"svmultiphysics", "not read"});
}

TEST(OpenfoamOutcome, ASeriesIsPutTogetherAndAveraged) {
  const fs::path folder = testing::temporary_folder("series");
  write_series(folder, "flow_a", {{1, 5.0}, {2, 6.0}, {3, 7.0}, {9, 8.0}});  // given up
  const fs::path later = folder / "postProcessing" / "flow_a" / "2";
  fs::create_directories(later);
  core::write_file(later / "surfaceFieldValue.dat", "# Time v\n3 70\n4 80\n");
  const OpenfoamSeries series = read_openfoam_series(folder, "flow_a");
  EXPECT_EQ(series, (OpenfoamSeries{{1, 5}, {2, 6}, {3, 70}, {4, 80}}));
  EXPECT_NEAR(cycle_mean(series, 4.0, 2.0), (0.5 * (6 + 70) + 0.5 * (70 + 80)) / 2.0, 1e-12);
  EXPECT_NEAR(cycle_mean(series, 3.0, 0.5), 0.5 * (38 + 70), 1e-12) << "straight between values";
  EXPECT_THROW(cycle_mean(series, 5.0, 2.0), InvalidInput);
  EXPECT_THROW(cycle_mean(series, 4.0, 5.0), InvalidInput);
  expect_refusal([&] { read_openfoam_series(folder, "flow_b"); }, {"flow_b", "controlDict"});
}

TEST(OpenfoamRun, AResultOfARealRunBalancesItsForces) {
  NEEDS_OPENFOAM();
  constexpr double radius = 1.5, length = 8.0;
  const geometry::MixedMesh mesh = vessel(geometry::straight_tube(length, radius), 0.5, 3);
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = 0.5;
  const FlowResult read = read_flow_result(run_case(mesh, options));
  const FlowReport report = flow_report(read);
  EXPECT_TRUE(report.passed()) << report.reasons.front();
  EXPECT_LT(read.run.residuals.at("p"), 1e-6);
  EXPECT_EQ(read.run.residuals.size(), 4u);
  EXPECT_LT(read.mass_balance_error(), 1e-5);
  // The blood pulls the wall along, and what the wall holds back is the drop of the pressure.
  double pull = 0.0;
  for (std::size_t i = 0; i < read.wall.areas_mm2.size(); ++i) {
    pull += read.wall.areas_mm2[i] * read.last.wall_shear_pa[3 * i + 2];
    EXPECT_GT(read.last.wall_shear_pa[3 * i + 2], 0.0) << i;
  }
  const double drop = (read.ends[0].pressure_pa - read.ends[1].pressure_pa) * read.ends[0].area_mm2;
  EXPECT_NEAR(pull, drop, 0.03 * drop);
  EXPECT_NEAR(report.walls[0].mean_pa, (Poiseuille{radius, length}.shear_pa()), 0.08);
}

}  // namespace
}  // namespace ostia::solver
