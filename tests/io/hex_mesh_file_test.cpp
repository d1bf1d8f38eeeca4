#include "ostia/io/hex_mesh_file.h"

#include "io_test_support.h"
#include "openfoam_case.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/volume_mesh_file.h"

#include <gmock/gmock.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cstdlib>

namespace ostia::io {
namespace {

namespace fs = std::filesystem;
using geometry::HexMesh;
using ::testing::HasSubstr;

fs::path target(const std::string& name) {
  return testing::temporary_folder("hexahedra") / name;
}

/// A column of 2 x 1 x 3 boxes of 1/3 mm: inlet below, outlet above.
HexMesh column() {
  HexMesh mesh;
  mesh.faces = {{1, "wall", geometry::FaceKind::wall},
                {2, "inlet_0", geometry::FaceKind::inlet},
                {3, "outlet_0", geometry::FaceKind::outlet}};
  const auto at = [](int x, int y, int z) { return static_cast<std::int32_t>(x + 3 * (y + 2 * z)); };
  for (int z = 0; z <= 3; ++z)
    for (int y = 0; y <= 1; ++y)
      for (int x = 0; x <= 2; ++x) mesh.points.push_back(geometry::Vec3(x, y, z) / 3.0);
  const auto add = [&](std::int32_t face, std::array<std::int32_t, 4> quad) {
    mesh.quads.push_back(quad);
    mesh.quad_face_ids.push_back(face);
  };
  for (int z = 0; z < 3; ++z)
    for (int x = 0; x < 2; ++x) {
      mesh.hexahedra.push_back({at(x, 0, z), at(x + 1, 0, z), at(x + 1, 1, z), at(x, 1, z), at(x, 0, z + 1),
                                at(x + 1, 0, z + 1), at(x + 1, 1, z + 1), at(x, 1, z + 1)});
      add(1, {at(x, 0, z), at(x + 1, 0, z), at(x + 1, 0, z + 1), at(x, 0, z + 1)});
      add(1, {at(x + 1, 1, z), at(x, 1, z), at(x, 1, z + 1), at(x + 1, 1, z + 1)});
    }
  for (int z = 0; z < 3; ++z) {
    add(1, {at(0, 1, z), at(0, 0, z), at(0, 0, z + 1), at(0, 1, z + 1)});
    add(1, {at(2, 0, z), at(2, 1, z), at(2, 1, z + 1), at(2, 0, z + 1)});
  }
  for (int x = 0; x < 2; ++x) {
    add(2, {at(x, 0, 0), at(x, 1, 0), at(x + 1, 1, 0), at(x + 1, 0, 0)});
    add(3, {at(x, 0, 3), at(x + 1, 0, 3), at(x + 1, 1, 3), at(x, 1, 3)});
  }
  return mesh;
}

TEST(HexMeshFile, VtkReadsTheVtu) {
  const HexMesh mesh = column();
  const fs::path path = target("a.vtu");
  write_hex_mesh(path, mesh);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  ASSERT_EQ(grid.GetNumberOfPoints(), static_cast<vtkIdType>(mesh.points.size()));
  for (vtkIdType p = 0; p < grid.GetNumberOfPoints(); ++p)
    for (int i = 0; i < 3; ++i) EXPECT_EQ(grid.GetPoint(p)[i], mesh.points[static_cast<std::size_t>(p)][i]);
  ASSERT_EQ(grid.GetNumberOfCells(), static_cast<vtkIdType>(mesh.hexahedra.size() + mesh.quads.size()));
  vtkDataArray* ids = grid.GetCellData()->GetArray("CellEntityIds");
  ASSERT_NE(ids, nullptr);
  for (std::size_t c = 0; c < mesh.hexahedra.size() + mesh.quads.size(); ++c) {
    const auto cell = static_cast<vtkIdType>(c);
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    grid.GetCellPoints(cell, count, corners);
    const bool volume = c < mesh.hexahedra.size();
    const std::size_t q = volume ? 0 : c - mesh.hexahedra.size();
    EXPECT_EQ(grid.GetCellType(cell), volume ? VTK_HEXAHEDRON : VTK_QUAD);
    ASSERT_EQ(count, volume ? 8 : 4);
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
      EXPECT_EQ(corners[k], volume ? mesh.hexahedra[c][k] : mesh.quads[q][k]);
    EXPECT_EQ(ids->GetTuple1(cell), volume ? 0 : mesh.quad_face_ids[q]);
  }
}

TEST(HexMeshFile, ThePolyMeshHasEachSideOnce) {
  const fs::path path = target("case");
  write_hex_mesh(path, column());
  write_hex_mesh(path, column());  // its own is replaced
  const fs::path folder = path / "constant" / "polyMesh";
  // 7 sides between boxes, 22 around them: 18 of the wall, 2 at each end.
  EXPECT_THAT(core::read_file(folder / "owner"),
              HasSubstr("nPoints:24  nCells:6  nFaces:29  nInternalFaces:7"));
  EXPECT_THAT(core::read_file(folder / "neighbour"), HasSubstr("\n7\n(\n1\n2\n3\n3\n4\n5\n5\n)"));
  const std::string boundary = core::read_file(folder / "boundary");
  for (const char* patch :
       {"wall\n    {\n        type            wall;\n        nFaces          18;\n        startFace       7;",
        "inlet_0\n    {\n        type            patch;\n        nFaces          2;\n        startFace       "
        "25;",
        "outlet_0\n    {\n        type            patch;\n        nFaces          2;\n        startFace      "
        " 27;"})
    EXPECT_THAT(boundary, HasSubstr(patch));
}

TEST(HexMeshFile, CheckMeshAcceptsThePolyMesh) {
  if (std::system("command -v checkMesh > /dev/null") != 0) GTEST_SKIP() << "openfoam is not installed";
  const fs::path path = target("case");
  write_hex_mesh(path, column());
  testing::add_control(path);
  const std::string line = "WM_PROJECT_DIR=/usr/share/openfoam checkMesh -allTopology -case '" +
                           path.string() + "' > '" + (path / "log").string() + "' 2>&1";
  ASSERT_EQ(std::system(line.c_str()), 0);
  const std::string told = core::read_file(path / "log");
  EXPECT_THAT(told, HasSubstr("hexahedra:     6"));
  EXPECT_THAT(told, HasSubstr("Mesh OK."));
}

TEST(HexMeshFile, WhatIsNoMeshIsRefused) {
  const auto refused = [](const HexMesh& mesh, const char* why, const char* name = "a.vtu") {
    const fs::path path = target(name);
    try {
      write_hex_mesh(path, mesh);
      ADD_FAILURE() << "written, though: " << why;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
    EXPECT_FALSE(fs::exists(path));
  };
  refused(column(), ".vtu", "a.msh");
  HexMesh none = column();
  none.hexahedra.clear();
  refused(none, "no hexahedra");
  HexMesh open = column();
  open.quads.pop_back();
  open.quad_face_ids.pop_back();
  refused(open, "free sides");
  HexMesh turned = column();
  std::swap(turned.quads[0][1], turned.quads[0][3]);
  refused(turned, "inside out");
  HexMesh unnamed = column();
  unnamed.quad_face_ids[3] = 9;
  refused(unnamed, "no face has the id 9");
}

TEST(HexMeshFile, WhatItCannotReplaceStays) {
  const fs::path path = target("case");
  fs::create_directories(path / "system");
  core::write_file(path / "system" / "controlDict", "mine");
  EXPECT_THROW(write_hex_mesh(path, column()), InvalidInput);
  EXPECT_EQ(core::read_file(path / "system" / "controlDict"), "mine");
  EXPECT_THROW(write_hex_mesh("/proc/nowhere/at/all.vtu", column()), IoError);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(write_hex_mesh(target("b.vtu"), column(), task), Cancelled);
}

TEST(HexMeshFile, IsReadAsTwoPrismsEachFromBothFormats) {
  for (const char* name : {"column.vtu", "column"}) {
    SCOPED_TRACE(name);
    const fs::path path = target(name);
    write_hex_mesh(path, column());
    const LayeredMesh read = read_layered_mesh(path);
    EXPECT_EQ(read.hexahedra, 6u);
    EXPECT_EQ(read.mesh.prisms.size(), 12u);
    EXPECT_TRUE(read.mesh.tetrahedra.empty());
    EXPECT_EQ(read.mesh.triangles.size(), 8u) << "two sides at the inlet and two at the outlet, cut";
    EXPECT_EQ(read.mesh.quads.size(), 18u);
    double volume = 0.0;
    for (const geometry::Prism& p : read.mesh.prisms) {
      const auto at = [&](std::size_t k) { return read.mesh.points[static_cast<std::size_t>(p[k])]; };
      volume += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0));
    }
    EXPECT_NEAR(volume, 6.0 / 27.0, 1e-9) << "mm3, each prism upright and positive";
    ASSERT_EQ(read.mesh.faces.size(), 3u);
    EXPECT_EQ(read.mesh.faces[1].name, "inlet_0");
    EXPECT_EQ(read.mesh.faces[1].kind, geometry::FaceKind::inlet);
    // What was read can be written in every format that holds prisms.
    EXPECT_NO_THROW(export_mesh(read.mesh, MeshFormat::gmsh4, target("column.msh")));
  }
}

}  // namespace
}  // namespace ostia::io
