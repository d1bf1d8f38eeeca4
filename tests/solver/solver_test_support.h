#pragma once
/// \file Vessels, cases made of them, and OpenFOAM's programs for the tests of `solver`.

#include "shape_tree.h"
#include "shared_data.h"
#include "test_surfaces.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/meshing/boundary_layer.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"
#include "ostia/solver/openfoam_case.h"
#include "ostia/solver/openfoam_result.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace ostia::solver {

/// A vessel meshed with edges of `edge_ratio` of the radius; with prisms on the wall where `layers` > 0.
inline geometry::MixedMesh vessel(const geometry::AnalyticShape& shape, double edge_ratio, int layers,
                                  double spacing_mm = 0.25) {
  const geometry::FacedSurface surface = meshing::capped(shape, spacing_mm, false);
  meshing::SizingOptions sizing;
  sizing.edge_ratio = edge_ratio;
  const auto sizes =
      meshing::target_edge_lengths(surface.mesh, meshing::TubeFunction(meshing::tree_of(shape)), sizing);
  const geometry::FacedSurface remeshed = meshing::remesh(surface, sizes).surface;
  if (layers == 0) return geometry::mixed(meshing::tetrahedralize(remeshed).mesh);
  meshing::BoundaryLayerOptions options;
  options.layers = layers;
  options.thickness = 1.0;
  return meshing::fill_with_layers(remeshed, options).mesh;
}

/// A disc or ellipse in the plane z = 0 (normal -z, outward of a vessel above it) as a mesh of one face:
/// `rings` rings of 6, 12, 18, ... triangles' points; the outermost ring of triangles' pairs is one of
/// quadrilaterals where `quads`.
geometry::MixedMesh disc(double a_mm, double b_mm, int rings, bool quads = false);

struct Shell {
  bool good = false;
  std::string output;
};
/// Runs a line of the shell in a folder; its whole output comes back.
inline Shell shell(const std::filesystem::path& folder, const std::string& line) {
  const std::filesystem::path log = testing::temporary_folder("shell") / "log";
  const core::ChildResult child = core::run_child(
      "/bin/sh", {"-c", "cd '" + folder.string() + "' && ( " + line + " ) > '" + log.string() + "' 2>&1"});
  return {child.ok(), std::filesystem::exists(log) ? core::read_file(log) : child.standard_error};
}

/// The log of the program that failed, for messages.
inline std::string last_words(const std::filesystem::path& folder) {
  return shell(folder, "tail -n 25 log.*").output;
}

#define NEEDS_OPENFOAM()                                                    \
  if (!shell("/", "command -v simpleFoam && command -v pimpleFoam").good) { \
    GTEST_SKIP() << "openfoam is not installed";                            \
  }

/// Writes and runs a case; its folder.
inline std::filesystem::path run_case(const geometry::MixedMesh& mesh, const OpenfoamCaseOptions& options,
                                      const std::string& command = "./Allrun") {
  const std::filesystem::path folder = testing::temporary_folder("run") / "case";
  write_openfoam_case(mesh, options, folder);
  const Shell done = shell(folder, command);
  EXPECT_TRUE(done.good) << done.output << last_words(folder);
  EXPECT_NE(core::read_file(folder / "log.checkMesh").find("Mesh OK"), std::string::npos);
  return folder;
}

inline std::map<std::string, std::size_t> facets_of(const geometry::MixedMesh& mesh) {
  std::map<std::string, std::size_t> count;
  for (const geometry::Face& face : mesh.faces) {
    const auto n =
        std::ranges::count(mesh.triangle_face_ids, face.id) + std::ranges::count(mesh.quad_face_ids, face.id);
    count[face.name] = static_cast<std::size_t>(n);
  }
  return count;
}

inline OpenfoamField result(const std::filesystem::path& folder, const std::string& field,
                            const geometry::MixedMesh& mesh) {
  return read_openfoam_field(last_time(folder) / field, mesh.tetrahedra.size() + mesh.prisms.size(),
                             facets_of(mesh));
}

/// The last value that a function object has written.
inline double last_value(const std::filesystem::path& folder, const std::string& function) {
  const Shell read = shell(
      folder, "cat postProcessing/" + function + "/*/surfaceFieldValue.dat | tail -n 1 | awk '{print $2}'");
  return std::stod(read.output);
}

/// The call must refuse, with all of `parts` in its message.
inline void expect_refusal(const std::function<void()>& call, const std::vector<std::string>& parts) {
  try {
    call();
    ADD_FAILURE() << "was accepted: " << parts.front();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.exit_code(), ExitCode::bad_input) << message;
    for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

}  // namespace ostia::solver
