#include "ostia/io/volume_mesh_file.h"

#include "io_test_support.h"
#include "mesh_export_meshes.h"

#include "ostia/geometry/mixed_mesh_sides.h"
#include "ostia/io/mesh_export.h"

namespace ostia::io {
namespace {

using geometry::MixedMesh;

std::vector<MixedMesh> all_kinds() {
  std::vector<MixedMesh> meshes{column_of_tetrahedra(), column_with_prisms(), ring_of_prisms()};
  for (std::size_t i = 0; i < 3; ++i) meshes.push_back(quadratic(meshes[i]));
  return meshes;
}

void expect_equal(const MixedMesh& read, const MixedMesh& mesh) {
  EXPECT_EQ(read.points, mesh.points);
  EXPECT_EQ(read.tetrahedra, mesh.tetrahedra);
  EXPECT_EQ(read.prisms, mesh.prisms);
  EXPECT_EQ(read.triangles, mesh.triangles);
  EXPECT_EQ(read.triangle_face_ids, mesh.triangle_face_ids);
  EXPECT_EQ(read.quads, mesh.quads);
  EXPECT_EQ(read.quad_face_ids, mesh.quad_face_ids);
  EXPECT_EQ(read.tetrahedron_nodes, mesh.tetrahedron_nodes);
  EXPECT_EQ(read.prism_nodes, mesh.prism_nodes);
  EXPECT_EQ(read.triangle_nodes, mesh.triangle_nodes);
  EXPECT_EQ(read.quad_nodes, mesh.quad_nodes);
}

void expect_equal_faces(const MixedMesh& read, const MixedMesh& mesh) {
  ASSERT_EQ(read.faces.size(), mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    EXPECT_EQ(read.faces[f].id, mesh.faces[f].id);
    EXPECT_EQ(read.faces[f].name, mesh.faces[f].name);
    EXPECT_EQ(read.faces[f].kind, mesh.faces[f].kind);
  }
}

TEST(VolumeMeshFile, EveryKindOfMeshIsReadAsItWas) {
  const auto path = testing::temporary_folder("io") / "mesh.vtu";
  for (const MixedMesh& mesh : all_kinds()) {
    export_mesh(mesh, MeshFormat::vtu, path);
    const MixedMesh read = read_volume_mesh(path);
    expect_equal(read, mesh);
    expect_equal_faces(read, mesh);
  }
}

TEST(VolumeMeshFile, GmshIsReadAsItWas) {
  const auto path = testing::temporary_folder("io") / "mesh.msh";
  ASSERT_TRUE(is_volume_mesh(path));
  for (const MixedMesh& mesh : all_kinds()) {
    for (const MeshFormat format : {MeshFormat::gmsh2, MeshFormat::gmsh4}) {
      export_mesh(mesh, format, path);
      const MixedMesh read = read_volume_mesh(path);
      expect_equal_faces(read, mesh);
      EXPECT_EQ(read.points, mesh.points) << "shortest texts read back as the same numbers";
      EXPECT_EQ(read.tetrahedra, mesh.tetrahedra);
      EXPECT_EQ(read.prisms, mesh.prisms);
      EXPECT_EQ(read.tetrahedron_nodes, mesh.tetrahedron_nodes);
      EXPECT_EQ(read.prism_nodes, mesh.prism_nodes);
      // Its facets stand face by face.
      const auto measured = measure(read), expected = measure(mesh);
      EXPECT_NEAR(measured.volume, expected.volume, 1e-9);
      for (const auto& [name, face] : expected.faces) {
        EXPECT_NEAR(measured.faces.at(name).area, face.area, 1e-9) << name;
        EXPECT_EQ(measured.faces.at(name).triangles, face.triangles) << name;
        EXPECT_EQ(measured.faces.at(name).quads, face.quads) << name;
      }
    }
  }
}

/// The same facets, each turned so that its least corner comes first, with what belongs to it.
template <class Corners>
std::vector<Corners> canonical(std::vector<Corners> facets) {
  for (Corners& facet : facets)
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
  std::sort(facets.begin(), facets.end());
  return facets;
}

TEST(VolumeMeshFile, TheFreeSidesAreTheBoundary) {
  for (const MixedMesh& mesh : all_kinds()) {
    MixedMesh bare = mesh;
    geometry::take_free_sides_as_boundary(bare);
    EXPECT_EQ(canonical(bare.triangles), canonical(mesh.triangles));
    EXPECT_EQ(canonical(bare.quads), canonical(mesh.quads));
    const auto measured = measure(mesh), measured_bare = measure(bare);
    EXPECT_NEAR(measured_bare.volume, measured.volume, 1e-9) << "with its second-order nodes";
    double area = 0.0;
    for (const auto& [name, face] : measured.faces) area += face.area;
    EXPECT_NEAR(measured_bare.faces.at("wall").area, area, 1e-9);
  }
}

TEST(VolumeMeshFile, RefusesGmshFilesThatAreNotSound) {
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
  const auto element = [](const std::string& text) { return "$Elements\n1\n" + text + "\n$EndElements\n"; };
  const auto refused = [](const std::string& text, const std::string& part) {
    const auto path = file_with("a.msh", text);
    expect_refusal(path, [&] { read_volume_mesh(path); }, {part});
  };
  const MixedMesh one = read_volume_mesh(file_with("a.msh", head + nodes + element("1 4 2 7 7 1 2 3 4")));
  EXPECT_EQ(one.tetrahedra.size(), 1u);
  EXPECT_EQ(one.triangles.size(), 4u) << "the free sides";
  refused("a mesh of another kind", "no Gmsh mesh");
  refused("$MeshFormat\n2.2 1 8\n", "binary");
  refused("$MeshFormat\n4.0 0 8\n", "2.2 and 4.1");
  refused(head + "$Nodes\n99999999999\n", "more than its bytes");
  refused(head + "$Nodes\n1\n1 0 x 0\n", "is no number");
  refused(head + nodes, "no tetrahedra");
  refused(head + nodes + element("1 5 2 7 7 1 2 3 4 1 2 3 4"), "type 5");
  refused(head + nodes + element("1 4 2 7 7 1 2 3 9"), "node 9");
}

TEST(VolumeMeshFile, RefusesOtherCells) {
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
