// Volume meshes and surfaces that were cut short at 200 places: refused, or nothing of them is lost.

#include "io_test_support.h"
#include "mesh_export_meshes.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

namespace ostia::io {
namespace {

namespace fs = std::filesystem;

/// 190 places all over, and each of the last ten.
std::set<std::size_t> places(std::size_t size) {
  constexpr std::size_t spread = 190, last = 10;
  std::set<std::size_t> at;
  for (std::size_t k = 0; k < spread; ++k) at.insert(size * k / spread);
  for (std::size_t k = 1; k <= std::min(last, size); ++k) at.insert(size - k);
  return at;
}

/// `same`: reads a file and compares it with the whole one.
void expect_none_lost(const fs::path& whole, const std::function<bool(const fs::path&)>& same) {
  const std::string bytes = core::read_file(whole);
  const fs::path cut = whole.parent_path() / ("cut" + whole.extension().string());
  ASSERT_TRUE(same(whole));
  for (const std::size_t at : places(bytes.size())) {
    core::write_file(cut, std::string_view(bytes).substr(0, at));
    try {
      EXPECT_TRUE(same(cut)) << whole.filename() << " cut after " << at << " of " << bytes.size() << " bytes";
    } catch (const Error& refusal) {
      EXPECT_NE(refusal.exit_code(), ExitCode::internal) << refusal.what();
    }
  }
}

struct MeshKind {
  MeshFormat format;
  const char* name;
};

class CutMesh : public ::testing::TestWithParam<MeshKind> {};

TEST_P(CutMesh, IsRefusedOrWhole) {
  const geometry::MixedMesh mesh = column_of_tetrahedra();
  const fs::path file = testing::temporary_folder("cut") / GetParam().name;
  export_mesh(mesh, GetParam().format, file);
  const geometry::MixedMesh all = read_volume_mesh(file);
  expect_none_lost(file, [&](const fs::path& path) {
    const geometry::MixedMesh read = read_volume_mesh(path);
    return read.points == all.points && read.tetrahedra == all.tetrahedra &&
           read.triangles == all.triangles && read.triangle_face_ids == all.triangle_face_ids;
  });
}

INSTANTIATE_TEST_SUITE_P(
    , CutMesh,
    ::testing::Values(MeshKind{MeshFormat::vtu, "a.vtu"}, MeshKind{MeshFormat::gmsh2, "b.msh"},
                      MeshKind{MeshFormat::gmsh4, "c.msh"}, MeshKind{MeshFormat::fluent, "d.msh"},
                      MeshKind{MeshFormat::abaqus, "e.inp"}, MeshKind{MeshFormat::exodus, "f.exo"},
                      MeshKind{MeshFormat::cgns, "g.cgns"}),
    [](const auto& test) { return "Of" + std::string(1, test.param.name[0]); });

TEST(CutSurface, IsRefusedOrWhole) {
  const geometry::MixedMesh column = column_of_tetrahedra();
  geometry::TriMesh mesh;
  mesh.points = column.points;
  mesh.triangles = column.triangles;
  for (const char* name : {"a.vtp", "b.stl", "c.ply"}) {
    const fs::path file = testing::temporary_folder("cut") / name;
    write_surface(file, mesh);
    const geometry::TriMesh all = read_surface(file).surface.mesh;
    expect_none_lost(file, [&](const fs::path& path) {
      const geometry::TriMesh read = read_surface(path).surface.mesh;
      return read.points == all.points && read.triangles == all.triangles;
    });
  }
}

}  // namespace
}  // namespace ostia::io
