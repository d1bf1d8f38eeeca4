#include "ostia/io/quad_surface_file.h"

#include "io_test_support.h"

#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkXMLPolyDataReader.h>

namespace ostia::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A box: bottom and top are ends, the four sides are the wall of two branches. No coordinate is a float.
QuadSurface box() {
  const double a = 0.1, b = 1.0 / 3.0;
  QuadSurface s;
  s.points = {{a, a, a}, {b, a, a}, {b, b, a}, {a, b, a}, {a, a, 2}, {b, a, 2}, {b, b, 2}, {a, b, 2}};
  s.quads = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  s.branch_ids = {0, 1, 0, 0, 1, 1};
  s.face_ids = {2, 3, 1, 1, 1, 1};
  s.faces = {{1, "wall", geometry::FaceKind::wall},
             {2, "inlet_1", geometry::FaceKind::inlet},
             {3, "outlet_1", geometry::FaceKind::outlet}};
  return s;
}

/// What VTK's own reader finds: quadrilaterals, their corners, and both arrays.
void expect_box(vtkPolyData& data) {
  const QuadSurface s = box();
  ASSERT_EQ(data.GetNumberOfPoints(), 8);
  ASSERT_EQ(data.GetNumberOfCells(), 6);
  for (vtkIdType p = 0; p < 8; ++p)
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(data.GetPoint(p)[i], s.points[static_cast<std::size_t>(p)][i]) << p << " " << i;
  vtkDataArray* branches = data.GetCellData()->GetArray("BranchIds");
  vtkDataArray* faces = data.GetCellData()->GetArray("CellEntityIds");
  ASSERT_TRUE(branches && faces);
  for (vtkIdType c = 0; c < 6; ++c) {
    const auto q = static_cast<std::size_t>(c);
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    data.GetCellPoints(c, count, ids);
    ASSERT_EQ(count, 4);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(ids[i], s.quads[q][i]);
    EXPECT_EQ(branches->GetTuple1(c), s.branch_ids[q]);
    EXPECT_EQ(faces->GetTuple1(c), s.face_ids[q]);
  }
}

TEST(QuadSurfaceFile, VtpHoldsQuadrilateralsAndIds) {
  const auto path = testing::temporary_folder("io") / "a.vtp";
  EXPECT_TRUE(write_quad_surface(path, box()).empty());
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  expect_box(*reader->GetOutput());
  EXPECT_THAT(core::read_file(path), HasSubstr("\"Axes\""));
}

TEST(QuadSurfaceFile, LegacyVtkHoldsThemToo) {
  const auto path = testing::temporary_folder("io") / "a.VTK";
  EXPECT_TRUE(write_quad_surface(path, box()).empty());
  vtkNew<vtkPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  expect_box(*reader->GetOutput());
  EXPECT_THAT(core::read_file(path), HasSubstr("LPS"));
}

/// Our own reader splits quadrilaterals from the first corner.
void expect_split_box(const geometry::TriMesh& mesh) {
  const QuadSurface s = box();
  ASSERT_EQ(mesh.points.size(), 8u);
  for (std::size_t p = 0; p < 8; ++p) EXPECT_EQ(mesh.points[p], s.points[p]);
  ASSERT_EQ(mesh.triangles.size(), 12u);
  for (std::size_t q = 0; q < 6; ++q) {
    EXPECT_THAT(mesh.triangles[2 * q], ElementsAre(s.quads[q][0], s.quads[q][1], s.quads[q][2]));
    EXPECT_THAT(mesh.triangles[2 * q + 1], ElementsAre(s.quads[q][0], s.quads[q][2], s.quads[q][3]));
  }
}

TEST(QuadSurfaceFile, ReadsBackAsTriangles) {
  const auto folder = testing::temporary_folder("io");
  for (const char* name : {"a.vtp", "a.ply", "a.obj"}) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(write_quad_surface(folder / name, box()).empty());
    const LoadedSurface read = read_surface(folder / name);
    expect_split_box(read.surface.mesh);
    ASSERT_EQ(read.warnings.size(), 1u);
    EXPECT_THAT(read.warnings[0], HasSubstr("6 polygons"));
  }
  const auto faces = read_surface(folder / "a.vtp").surface;
  EXPECT_THAT(faces.face_ids, ElementsAre(2, 2, 3, 3, 1, 1, 1, 1, 1, 1, 1, 1));
  ASSERT_EQ(faces.faces.size(), 3u);
  EXPECT_EQ(faces.faces[1].name, "inlet_1");
}

TEST(QuadSurfaceFile, PlyAndObjTellBranchesAndFaces) {
  const auto folder = testing::temporary_folder("io");
  write_quad_surface(folder / "a.ply", box());
  const std::string ply = core::read_file(folder / "a.ply");
  EXPECT_THAT(ply, HasSubstr("comment face 2 inlet_1\n"));
  EXPECT_THAT(ply, HasSubstr("property int branch\nproperty int face\nend_header\n"));
  EXPECT_EQ(ply.size(), ply.find("end_header\n") + 11 + 8 * 24 + 6 * (1 + 4 * 4 + 8));
  write_quad_surface(folder / "a.obj", box());
  EXPECT_THAT(core::read_file(folder / "a.obj"),
              HasSubstr("g inlet_1 branch_0\nf 1 4 3 2\ng outlet_1 branch_1\nf 5 6 7 8\ng wall branch_0\n"
                        "f 1 2 6 5\nf 2 3 7 6\ng wall branch_1\nf 3 4 8 7\nf 4 1 5 8\n"));
}

TEST(QuadSurfaceFile, StlTellsWhatItCannotHold) {
  const auto path = testing::temporary_folder("io") / "a.stl";
  const std::vector<std::string> lost = write_quad_surface(path, box());
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_THAT(lost[0], HasSubstr("triangles"));
  EXPECT_EQ(read_surface(path).surface.mesh.triangles.size(), 12u);
}

TEST(QuadSurfaceFile, RefusesAndLeavesNothing) {
  const auto folder = testing::temporary_folder("io");
  QuadSurface beyond = box();
  beyond.quads[3][2] = 8;
  expect_refusal(folder / "a.vtp", [&] { write_quad_surface(folder / "a.vtp", beyond); },
                 {"quadrilateral 3", "point 8"});
  QuadSurface few = box();
  few.branch_ids.pop_back();
  expect_refusal(folder / "a.ply", [&] { write_quad_surface(folder / "a.ply", few); }, {"5 branch ids"});
  expect_refusal(folder / "a.xyz", [&] { write_quad_surface(folder / "a.xyz", box()); }, {".obj"});
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(write_quad_surface(folder / "a.obj", box(), task), Cancelled);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace ostia::io
