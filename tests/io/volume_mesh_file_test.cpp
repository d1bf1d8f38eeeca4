#include "ostia/io/volume_mesh_file.h"

#include "io_test_support.h"

#include "ostia/geometry/mesh_topology.h"

namespace ostia::io {
namespace {

geometry::VolumeMesh one_tetrahedron() {
  const geometry::FacedSurface surface = faced_tetrahedron();
  return {surface.mesh.points, {{0, 1, 2, 3}}, surface.mesh.triangles, surface.face_ids, surface.faces};
}

TEST(VolumeMeshFile, RoundTrips) {
  const auto path = testing::temporary_folder("io") / "mesh.vtu";
  const geometry::VolumeMesh mesh = one_tetrahedron();
  write_volume_mesh(path, mesh);
  const geometry::VolumeMesh read = read_volume_mesh(path);
  EXPECT_EQ(read.tetrahedra, mesh.tetrahedra);
  EXPECT_EQ(read.boundary, mesh.boundary);
  EXPECT_EQ(read.boundary_face_ids, mesh.boundary_face_ids);
  ASSERT_EQ(read.faces.size(), 3u);
  EXPECT_EQ(read.faces[2].name, "outlet_a");
  EXPECT_NEAR(geometry::volume(read), 1.25 * 1.5 * 1.75 / 6.0, 1e-12);
}

TEST(VolumeMeshFile, RefusesOtherCellsAndNames) {
  const auto path = testing::temporary_folder("io") / "mesh.msh";
  EXPECT_THROW(write_volume_mesh(path, one_tetrahedron()), InvalidInput);
  const auto line = file_with("a.vtu",
                              "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                              "byte_order=\"LittleEndian\"><UnstructuredGrid><Piece NumberOfPoints=\"2\" "
                              "NumberOfCells=\"1\"><Points><DataArray type=\"Float32\" "
                              "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0</DataArray></Points>"
                              "<Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 "
                              "1</DataArray><DataArray type=\"Int32\" Name=\"offsets\" "
                              "format=\"ascii\">2</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
                              "format=\"ascii\">3</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>");
  expect_refusal(line, [&] { read_volume_mesh(line); }, {"type 3"});
}

}  // namespace
}  // namespace ostia::io
