#pragma once
/// \file Small meshes and files for the tests of `io`.

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/geometry/tri_mesh.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

namespace ostia::io {

inline geometry::TriMesh tetrahedron_surface() {
  return {{{0, 0, 0}, {1.25, 0, 0}, {0, 1.5, 0}, {0, 0, 1.75}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

inline geometry::FacedSurface faced_tetrahedron() {
  return {tetrahedron_surface(),
          {1, 1, 2, 3},
          {{1, "wall", geometry::FaceKind::wall},
           {2, "inlet_a", geometry::FaceKind::inlet},
           {3, "outlet_a", geometry::FaceKind::outlet}}};
}

inline std::filesystem::path file_with(const std::string& name, const std::string& content) {
  const std::filesystem::path path = testing::temporary_folder("io") / name;
  core::write_file(path, content);
  return path;
}

/// The call must refuse with a message that holds all of `parts` (and the file's name).
inline void expect_refusal(const std::filesystem::path& path, const std::function<void()>& call,
                           const std::vector<std::string>& parts) {
  try {
    call();
    ADD_FAILURE() << path << " was accepted";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.exit_code(), ExitCode::bad_input) << message;
    EXPECT_NE(message.find(path.filename().string()), std::string::npos) << message;
    for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

inline void expect_same_mesh(const geometry::TriMesh& a, const geometry::TriMesh& b, double tolerance = 0.0) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_LE((a.points[i] - b.points[i]).norm(), tolerance);
  EXPECT_EQ(a.triangles, b.triangles);
}

}  // namespace ostia::io
