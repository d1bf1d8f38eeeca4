// Small cases that OpenFOAM itself runs: that it takes every file, and that what flows in flows out.

#include "solver_test_support.h"

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
  options.flow.outlets = Outlets::split;
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
  options.flow.outlets = Outlets::resistance;
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

}  // namespace
}  // namespace ostia::solver
