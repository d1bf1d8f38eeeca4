#pragma once
/// \file Poiseuille's flow in a straight tube: what OpenFOAM computes on our meshes, against theory.

#include "solver_test_support.h"

#include <Eigen/Dense>

namespace ostia::solver {

struct PoiseuilleErrors {
  double pressure_gradient = 0.0;  ///< relative
  double wall_shear_stress = 0.0;  ///< relative, of the mean
  std::size_t cells = 0;
};

/// Of a finished run in a tube along z: pressure as a straight line through the cells, and the mean wall
/// shear stress, both between a quarter and three quarters of the length.
inline PoiseuilleErrors poiseuille_errors(const std::filesystem::path& folder,
                                          const geometry::MixedMesh& mesh, double radius_mm, double length_mm,
                                          const OpenfoamCaseOptions& options, double flow_ml_s) {
  const double from = 0.25 * length_mm, to = 0.75 * length_mm;
  const auto height = [&](const auto& corners) {
    double z = 0.0;
    for (const std::int32_t p : corners) z += mesh.points[static_cast<std::size_t>(p)].z();
    return z / static_cast<double>(corners.size());
  };
  const OpenfoamField pressure = result(folder, "p", mesh);
  std::vector<std::pair<double, double>> samples;
  for (std::size_t i = 0; i < pressure.cells.size(); ++i) {
    const std::size_t n = mesh.tetrahedra.size();
    const double z = i < n ? height(mesh.tetrahedra[i]) : height(mesh.prisms[i - n]);
    if (z > from && z < to) samples.emplace_back(z, pressure.cells[i]);
  }
  Eigen::MatrixXd line(samples.size(), 2);
  Eigen::VectorXd value(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    line.row(static_cast<Eigen::Index>(i)) << 1.0, 1e-3 * samples[i].first;
    value[static_cast<Eigen::Index>(i)] = samples[i].second;
  }
  const double slope = line.colPivHouseholderQr().solve(value)[1];

  const OpenfoamField shear = result(folder, "wallShearStress", mesh);
  double force = 0.0, area = 0.0;
  std::size_t facet = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.triangle_face_ids[i] != 1) continue;
    const std::size_t own = facet++;
    const auto& t = mesh.triangles[i];
    const double z = height(t);
    if (z < from || z > to) continue;
    const auto p = [&](std::size_t c) { return mesh.points[static_cast<std::size_t>(t[c])]; };
    const double a = (p(1) - p(0)).cross(p(2) - p(0)).norm();
    force += a * shear.magnitude(shear.patches.at("wall"), own);
    area += a;
  }
  const double nu = 1e-6 * options.flow.blood.kinematic_viscosity_mm2_s(), r = 1e-3 * radius_mm,
               q = 1e-6 * flow_ml_s;
  const double true_slope = -8.0 * nu * q / (std::numbers::pi * std::pow(r, 4));
  const double true_shear = 4.0 * nu * q / (std::numbers::pi * std::pow(r, 3));
  return {slope / true_slope - 1.0, force / area / true_shear - 1.0, pressure.cells.size()};
}

}  // namespace ostia::solver
