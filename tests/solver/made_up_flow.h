#pragma once
/// \file OpenFOAM's results made up by hand, of which the truth is known.

#include "solver_test_support.h"

#include "ostia/solver/flow_result.h"

#include <map>
#include <string>

namespace ostia::solver {

inline std::string list_of(const std::vector<geometry::Vec3>& vectors) {
  std::string text = "nonuniform List<vector> " + std::to_string(vectors.size()) + "\n(\n";
  char line[120];
  for (const geometry::Vec3& v : vectors) {
    std::snprintf(line, sizeof line, "(%.12g %.12g %.12g)\n", v.x(), v.y(), v.z());
    text += line;
  }
  return text + ");\n";
}

inline std::string list_of(const std::vector<double>& values) {
  std::string text = "nonuniform List<scalar> " + std::to_string(values.size()) + "\n(\n";
  char line[40];
  for (const double v : values) {
    std::snprintf(line, sizeof line, "%.12g\n", v);
    text += line;
  }
  return text + ");\n";
}

/// A field with values at the walls, by their names; other patches have none.
template <class Values>
void write_field(const std::filesystem::path& file, const Values& cells,
                 const std::map<std::string, Values>& walls) {
  const bool vectors = std::is_same_v<Values, std::vector<geometry::Vec3>>;
  std::filesystem::create_directories(file.parent_path());
  std::string text =
      std::string("FoamFile\n{\n format ascii;\n class ") + (vectors ? "volVectorField" : "volScalarField") +
      ";\n}\ndimensions [0 0 0 0 0 0 0];\ninternalField " + list_of(cells) + "boundaryField\n{\n";
  for (const auto& [name, values] : walls)
    text += " " + name + "\n {\n type calculated;\n value " + list_of(values) + " }\n";
  core::write_file(file, text + "}\n");
}

/// What a function object has written: value by time.
inline void write_series(const std::filesystem::path& case_folder, const std::string& function,
                         const std::map<double, double>& values) {
  const std::filesystem::path folder = case_folder / "postProcessing" / function / "0";
  std::filesystem::create_directories(folder);
  std::string text = "# Region type : patch\n# Time\tvalue\n";
  char line[80];
  for (const auto& [time, value] : values) {
    std::snprintf(line, sizeof line, "%.12g\t%.12e\n", time, value);
    text += line;
  }
  core::write_file(folder / "surfaceFieldValue.dat", text);
}

/// A tube along z of `vessel`, with prisms on its wall.
inline geometry::MixedMesh tube(double length_mm, double radius_mm) {
  return vessel(geometry::straight_tube(length_mm, radius_mm), 0.7, 1);
}

inline std::vector<geometry::Vec3> element_centres(const geometry::MixedMesh& mesh) {
  std::vector<geometry::Vec3> centres;
  const auto add = [&](const auto& corners) {
    geometry::Vec3 sum = geometry::Vec3::Zero();
    for (const std::int32_t p : corners) sum += mesh.points[static_cast<std::size_t>(p)];
    centres.push_back(sum / static_cast<double>(corners.size()));
  };
  for (const auto& t : mesh.tetrahedra) add(t);
  for (const auto& p : mesh.prisms) add(p);
  return centres;
}

/// Centres of a wall's facets in the order of its patch (a wall of triangles alone).
inline std::vector<geometry::Vec3> wall_centres(const geometry::MixedMesh& mesh, std::int32_t face = 1) {
  std::vector<geometry::Vec3> centres;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.triangle_face_ids[i] != face) continue;
    geometry::Vec3 sum = geometry::Vec3::Zero();
    for (const std::int32_t p : mesh.triangles[i]) sum += mesh.points[static_cast<std::size_t>(p)];
    centres.push_back(sum / 3.0);
  }
  return centres;
}

/// Poiseuille's flow along +z in SI, as OpenFOAM would write it.
struct Poiseuille {
  double radius_mm = 1.5, length_mm = 8.0, flow_ml_s = 0.5, density = 1060.0, viscosity = 3.5e-3;
  double shear_pa() const {
    return 4.0 * viscosity * 1e-6 * flow_ml_s / (std::numbers::pi * std::pow(1e-3 * radius_mm, 3));
  }
  double gradient_pa_m() const { return 2.0 * shear_pa() / (1e-3 * radius_mm); }
  double pressure_pa(double z_mm) const { return gradient_pa_m() * 1e-3 * (length_mm - z_mm); }
  geometry::Vec3 velocity_m_s(const geometry::Vec3& p) const {
    const double s = std::hypot(p.x(), p.y()) / radius_mm;
    const double mean = 1e-6 * flow_ml_s / (std::numbers::pi * std::pow(1e-3 * radius_mm, 2));
    return {0.0, 0.0, 2.0 * mean * (1.0 - s * s)};
  }
  /// `factor` times this flow at a time, its stress at each wall times what `at_wall` says for the wall's
  /// name. OpenFOAM's stress at the wall is kinematic and against the flow.
  void write(const std::filesystem::path& time, const geometry::MixedMesh& mesh, double factor,
             const std::map<std::string, double>& at_wall = {}) const {
    std::vector<geometry::Vec3> velocity;
    std::vector<double> pressure;
    for (const geometry::Vec3& p : element_centres(mesh)) {
      velocity.emplace_back(factor * velocity_m_s(p));
      pressure.push_back(factor * pressure_pa(p.z()));
    }
    std::map<std::string, std::vector<double>> wall_pressure;
    std::map<std::string, std::vector<geometry::Vec3>> shear, none;
    for (const geometry::Face& face : mesh.faces) {
      if (face.kind != geometry::FaceKind::wall) continue;
      const auto times = at_wall.find(face.name);
      const double stress_pa = factor * shear_pa() * (times == at_wall.end() ? 1.0 : times->second);
      for (const geometry::Vec3& p : wall_centres(mesh, face.id)) {
        wall_pressure[face.name].push_back(factor * pressure_pa(p.z()));
        shear[face.name].emplace_back(0.0, 0.0, -stress_pa / density);
      }
      none[face.name].assign(shear[face.name].size(), geometry::Vec3::Zero());
    }
    write_field(time / "U", velocity, none);
    write_field(time / "pressureInPascal", pressure, wall_pressure);
    write_field(time / "wallShearStress",
                std::vector<geometry::Vec3>(velocity.size(), geometry::Vec3::Zero()), shear);
  }
};

/// A steady case that "has been run": 120 iterations.
inline std::filesystem::path made_up_steady(const geometry::MixedMesh& mesh, const Poiseuille& flow,
                                            const std::map<std::string, double>& at_wall = {}) {
  const std::filesystem::path folder = testing::temporary_folder("made") / "flow";
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = flow.flow_ml_s;
  const OpenfoamCaseResult made = write_openfoam_case(mesh, options, folder);
  flow.write(folder / "120", mesh, 1.0, at_wall);
  core::write_file(folder / "log.simpleFoam", "Time = 120\n\nSIMPLE solution converged in 120 iterations\n");
  const std::string in = made.flow.inlets[0].name, out = made.flow.outlets[0].name;
  write_series(folder, "flow_" + in, {{119, 9.0}, {120, -1e-6 * flow.flow_ml_s}});
  write_series(folder, "flow_" + out, {{119, 9.0}, {120, 1e-6 * flow.flow_ml_s}});
  write_series(folder, "pressure_" + in, {{120, flow.pressure_pa(0.0) / flow.density}});
  write_series(folder, "pressure_" + out, {{120, 0.0}});
  return folder;
}

}  // namespace ostia::solver
