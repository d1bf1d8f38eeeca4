// A straight tube of radius 1.5 mm: what simpleFoam computes on our meshes and cases, against theory.

#include "poiseuille.h"

#include <iostream>

namespace ostia::solver {
namespace {

namespace fs = std::filesystem;

constexpr double radius_mm = 1.5, length_mm = 20.0, flow_ml_s = 0.5;

PoiseuilleErrors run(const geometry::MixedMesh& mesh) {
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = flow_ml_s;
  const fs::path folder = run_case(mesh, options);
  EXPECT_NE(core::read_file(folder / "log.simpleFoam").find("solution converged"), std::string::npos);
  const PoiseuilleErrors errors = poiseuille_errors(folder, mesh, radius_mm, length_mm, options, flow_ml_s);
  std::cout << errors.cells << " cells, pressure gradient " << 100 * errors.pressure_gradient
            << " %, wall shear stress " << 100 * errors.wall_shear_stress << " %\n";
  return errors;
}

TEST(Poiseuille, WithLayersThePressureDropIsWithinTwoPercent) {
  NEEDS_OPENFOAM();
  const geometry::MixedMesh mesh = vessel(geometry::straight_tube(length_mm, radius_mm), 0.25, 3);
  const PoiseuilleErrors errors = run(mesh);
  EXPECT_LT(std::abs(errors.pressure_gradient), 0.02);
  EXPECT_LT(std::abs(errors.wall_shear_stress), 0.02);
}

TEST(Poiseuille, WithoutLayersItComesNear) {
  NEEDS_OPENFOAM();
  const geometry::MixedMesh mesh = vessel(geometry::straight_tube(length_mm, radius_mm), 0.25, 0);
  const PoiseuilleErrors errors = run(mesh);
  EXPECT_LT(std::abs(errors.pressure_gradient), 0.03);
}

}  // namespace
}  // namespace ostia::solver
