// A straight tube of radius 1.5 mm: what simpleFoam computes on our meshes and cases, against theory.

#include "poiseuille.h"

#include "ostia/solver/velocity_profile.h"
#include "ostia/solver/wall_surface.h"

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

/// How much more pressure the mesh's own sections need than the circle, by theory: the inlet's polygon, and
/// the circle of the mean section (volume over length).
void print_own_sections(const geometry::MixedMesh& mesh) {
  const auto inlet = std::ranges::find(mesh.faces, geometry::FaceKind::inlet, &geometry::Face::kind);
  const Section section = section_of(mesh, inlet->id);
  const double circle = std::numbers::pi * radius_mm * radius_mm;
  const double polygon =
      circle * radius_mm * radius_mm / 8.0 / (section.area_mm2 * developed_profile(section).conductance_mm2);
  double volume = 0.0;
  for (const double v : element_volumes(mesh)) volume += v;
  geometry::Box3 box;
  for (const geometry::Vec3& p : mesh.points) box.extend(p);
  const double mean_area = volume / box.sizes().z();
  std::cout << "inlet " << section.area_mm2 / circle << " of the circle's area, its polygon needs "
            << 100.0 * (polygon - 1.0) << " % more; mean section " << mean_area / circle
            << ", a circle of it needs " << 100.0 * (std::pow(circle / mean_area, 2) - 1.0) << " % more\n";
}

TEST(Poiseuille, ThreeSizesOfEdges) {
  NEEDS_OPENFOAM();
  for (const double ratio : {0.35, 0.25, 0.18}) {
    const geometry::MixedMesh mesh = vessel(geometry::straight_tube(length_mm, radius_mm), ratio, 3);
    std::cout << "edges of " << ratio << " of the radius: ";
    const PoiseuilleErrors errors = run(mesh);
    print_own_sections(mesh);
    const double bar = ratio > 0.3 ? 0.05 : 0.02;
    EXPECT_LT(std::abs(errors.pressure_gradient), bar) << ratio;
    EXPECT_LT(std::abs(errors.wall_shear_stress), bar) << ratio;
  }
}

}  // namespace
}  // namespace ostia::solver
