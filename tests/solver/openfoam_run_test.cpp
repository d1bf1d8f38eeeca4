// Small cases that OpenFOAM itself runs: that it takes every file, and that what flows in flows out.

#include "solver_test_support.h"

#include "ostia/solver/flow_result.h"
#include "ostia/solver/openfoam_continue.h"

namespace ostia::solver {
namespace {

namespace fs = std::filesystem;

TEST(OpenfoamRun, ASteadyForkBalancesWithZeroPressure) {
  NEEDS_OPENFOAM();
  const geometry::MixedMesh mesh = vessel(geometry::y_junction(5.0, 5.0, 1.5, 1.2, 60.0), 0.7, 2);
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = 0.5;
  const fs::path folder = run_case(mesh, options);
  const BoundaryFlow flow = boundary_flow(mesh, options.flow);
  double out = 0.0;
  for (const Outlet& outlet : flow.outlets) out += last_value(folder, "flow_" + outlet.name);
  EXPECT_NEAR(last_value(folder, "flow_" + flow.inlets[0].name), -0.5e-6, 1e-15);
  EXPECT_NEAR(out, 0.5e-6, 1e-10);
  EXPECT_GT(last_value(folder, "pressure_" + flow.inlets[0].name), 0.0);
  // Shear at the wall, and the pressure in Pa.
  const OpenfoamField shear = result(folder, "wallShearStress", mesh), p = result(folder, "p", mesh),
                      pascal = result(folder, "pressureInPascal", mesh);
  EXPECT_GT(shear.magnitude(shear.patches.at("wall"), 10), 0.0);
  EXPECT_NEAR(pascal.cells[5], 1060.0 * p.cells[5], 1e-5 * std::abs(pascal.cells[5]));
}

TEST(OpenfoamRun, OutletsTakeTheirShareOfTheFlow) {
  NEEDS_OPENFOAM();
  const geometry::MixedMesh mesh = vessel(geometry::y_junction(5.0, 5.0, 1.5, 1.2, 60.0), 0.7, 0);
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = 0.5;
  options.flow.outlets = OutletModel::split;
  options.flow.blood.rheology = Rheology::carreau;
  BoundaryFlow flow = boundary_flow(mesh, options.flow);
  const fs::path folder = run_case(mesh, options);
  for (const Outlet& outlet : flow.outlets)
    EXPECT_NEAR(last_value(folder, "flow_" + outlet.name), outlet.share * 0.5e-6, 1e-10) << outlet.name;
}

TEST(OpenfoamRun, OutletsResist) {
  NEEDS_OPENFOAM();
  const geometry::MixedMesh mesh = vessel(geometry::y_junction(5.0, 5.0, 1.5, 1.2, 60.0), 0.7, 0);
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = 0.5;
  options.flow.outlets = OutletModel::resistance;
  const fs::path folder = run_case(mesh, options);
  const BoundaryFlow flow = boundary_flow(mesh, options.flow);
  for (const Outlet& outlet : flow.outlets) {
    const double ml_s = 1e6 * last_value(folder, "flow_" + outlet.name),
                 pressure = 1060.0 * last_value(folder, "pressure_" + outlet.name);
    EXPECT_NEAR(ml_s, outlet.share * 0.5, 1e-4);
    // 90 mmHg: exactly at the largest; at the others but for what the fork itself takes.
    const double most = &outlet == &flow.outlets[0] ? 1e-4 : 1e-2;
    EXPECT_NEAR(pressure / (outlet.resistance_pa_s_m3 * 1e-6 * ml_s), 1.0, most);
    EXPECT_NEAR(pressure / (90.0 * 133.322), 1.0, 1e-2);
  }
}

TEST(OpenfoamRun, OneThatDidNotConvergeGoesOnFromWhereItWas) {
  NEEDS_OPENFOAM();
  const geometry::MixedMesh mesh = vessel(geometry::straight_tube(6.0, 1.5), 0.7, 2);
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = 0.5;
  options.iterations = 20;
  const fs::path folder = run_case(mesh, options);
  EXPECT_FALSE(read_flow_result(folder).run.converged);
  const CaseLength length = continue_openfoam_case(folder, 1000, std::nullopt);
  EXPECT_DOUBLE_EQ(length.now, 20.0);
  const Shell done = shell(folder, "./Allrun");
  EXPECT_TRUE(done.good) << done.output << last_words(folder);
  const FlowResult read = read_flow_result(folder);
  EXPECT_TRUE(read.run.converged);
  EXPECT_GT(read.run.last, 20.0);
  const std::string log = core::read_file(folder / "log.simpleFoam");
  EXPECT_NE(log.find("\nTime = 21\n"), std::string::npos);
  EXPECT_EQ(log.find("\nTime = 20\n"), std::string::npos);
  // As one that was never stopped.
  options.iterations = 1000;
  const FlowResult whole = read_flow_result(run_case(mesh, options));
  EXPECT_NEAR(read.ends[0].pressure_pa, whole.ends[0].pressure_pa, 1e-4 * whole.ends[0].pressure_pa);
}

/// Narrows the branch of a fork on the side of +x to half its radius over 3 mm, about a place of its axis.
void narrow(geometry::MixedMesh& mesh, double angle_deg) {
  const double half = angle_deg / 2.0 * std::numbers::pi / 180.0;
  const geometry::Vec3 along(std::sin(half), 0.0, std::cos(half));
  // The end of the branch lies on its axis.
  geometry::Vec3 end = geometry::Vec3::Zero();
  for (const geometry::Face& face : mesh.faces) {
    if (face.kind != geometry::FaceKind::outlet) continue;
    const Section section = section_of(mesh, face.id);
    geometry::Vec3 centre = geometry::Vec3::Zero();
    for (const geometry::Vec3& p : section.centres) centre += p / static_cast<double>(section.centres.size());
    if (centre.x() > end.x()) end = centre;
  }
  const geometry::Vec3 throat = end - 2.5 * along;
  for (geometry::Vec3& p : mesh.points) {
    const double s = (p - throat).dot(along);
    const geometry::Vec3 away = p - throat - s * along;
    if (std::abs(s) < 1.5 && away.norm() < 2.0)
      p -= 0.25 * (1.0 + std::cos(std::numbers::pi * s / 1.5)) * away;
  }
}

TEST(OpenfoamRun, OutletsResistTogetherWithTheModel) {
  NEEDS_OPENFOAM();
  geometry::MixedMesh mesh = vessel(geometry::y_junction(5.0, 9.0, 1.5, 1.2, 60.0), 0.6, 0);
  narrow(mesh, 60.0);
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = 0.5;
  options.flow.outlets = OutletModel::resistance;
  options.flow.total_resistance_mmhg_s_ml = 0.5;  // about what the throat resists
  const fs::path folder = run_case(mesh, options);
  const BoundaryFlow flow = boundary_flow(mesh, options.flow);
  double sum = 0.0, least = 1.0;
  for (const Outlet& outlet : flow.outlets) {
    const double m3_s = last_value(folder, "flow_" + outlet.name),
                 pressure = 1060.0 * last_value(folder, "pressure_" + outlet.name);
    EXPECT_NEAR(pressure / (outlet.resistance_pa_s_m3 * m3_s), 1.0, 3e-3) << outlet.name;
    sum += m3_s;
    least = std::min(least, m3_s / (outlet.share * 0.5e-6));
  }
  EXPECT_NEAR(sum, 0.5e-6, 1e-10);
  EXPECT_LT(least, 0.95) << "the throat sends blood to the other branch";
  EXPECT_NE(core::read_file(folder / "log.simpleFoam").find("solution converged"), std::string::npos);
  EXPECT_EQ(times_of(folder).size(), 1u);
}

}  // namespace
}  // namespace ostia::solver
