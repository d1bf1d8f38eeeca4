#include "ostia/io/volume_fields.h"

#include "io_test_support.h"
#include "mesh_export_meshes.h"

#include "ostia/io/mesh_export.h"
#include "ostia/io/volume_mesh_file.h"

#include <cmath>

namespace ostia::io {
namespace {

using geometry::MixedMesh;

/// Numbers that tell every place and component apart.
FieldValues numbered(std::size_t places, int components, double first) {
  FieldValues field{components, {}};
  for (std::size_t i = 0; i < places * static_cast<std::size_t>(components); ++i)
    field.values.push_back(first + 0.1 * static_cast<double>(i));
  return field;
}

VolumeFields fields_on(const MixedMesh& mesh) {
  const std::size_t elements = mesh.tetrahedra.size() + mesh.prisms.size(), points = mesh.points.size();
  return {{{"pressure_Pa", numbered(elements, 1, 3.0)}, {"velocity_m_s", numbered(elements, 3, -7.0)}},
          {{"pressure_Pa", numbered(points, 1, 11.0)}, {"gradient", numbered(points, 9, 0.0)}}};
}

void expect_equal(const std::map<std::string, FieldValues>& read,
                  const std::map<std::string, FieldValues>& written) {
  ASSERT_EQ(read.size(), written.size());
  for (const auto& [name, field] : written) {
    ASSERT_TRUE(read.contains(name)) << name;
    EXPECT_EQ(read.at(name).components, field.components) << name;
    EXPECT_EQ(read.at(name).values, field.values) << name;
  }
}

TEST(VolumeFields, AreReadAsTheyWere) {
  const auto path = testing::temporary_folder("io") / "result.vtu";
  for (const MixedMesh& linear : {column_of_tetrahedra(), column_with_prisms(), ring_of_prisms()}) {
    for (const MixedMesh& mesh : {linear, quadratic(linear)}) {
      const VolumeFields fields = fields_on(mesh);
      write_vtu_with_fields(path, mesh, fields);
      const VolumeFields read = read_vtu_fields(path);
      expect_equal(read.cells, fields.cells);
      expect_equal(read.points, fields.points);
      const MixedMesh again = read_volume_mesh(path);
      EXPECT_EQ(again.points, mesh.points);
      EXPECT_EQ(again.tetrahedra, mesh.tetrahedra);
      EXPECT_EQ(again.prisms, mesh.prisms);
      EXPECT_EQ(again.triangle_face_ids, mesh.triangle_face_ids);
    }
  }
}

TEST(VolumeFields, WithoutAnyTheFileIsTheExportedMesh) {
  const auto folder = testing::temporary_folder("io");
  const MixedMesh mesh = column_with_prisms();
  write_vtu_with_fields(folder / "a.vtu", mesh, {});
  export_mesh(mesh, MeshFormat::vtu, folder / "b.vtu");
  EXPECT_EQ(core::read_file(folder / "a.vtu"), core::read_file(folder / "b.vtu"));
  EXPECT_TRUE(read_vtu_fields(folder / "b.vtu").cells.empty()) << "ids of faces are no field";
}

/// A prism, a triangle of the boundary and a tetrahedron in this order, with arrays on the cells.
std::string mixed_up(const std::string& arrays) {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
         "<Piece NumberOfPoints=\"7\" NumberOfCells=\"3\"><Points><DataArray type=\"Float32\" "
         "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1 1 0 1 0 1 1 0 0 "
         "2</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 2 "
         "1 3 5 4 0 2 1 3 4 5 6</DataArray><DataArray type=\"Int32\" Name=\"offsets\" "
         "format=\"ascii\">6 9 13</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">13 5 "
         "10</DataArray></Cells><CellData>" +
         arrays + "</CellData></Piece></UnstructuredGrid></VTKFile>";
}

TEST(VolumeFields, AreInTheOrderOfTheElementsReadWhateverTheFilesOrder) {
  const auto path = file_with(
      "a.vtu", mixed_up("<DataArray type=\"Int32\" Name=\"CellEntityIds\" format=\"ascii\">0 1 0</DataArray>"
                        "<DataArray type=\"Float32\" Name=\"p\" format=\"ascii\">5 nan 7</DataArray>"
                        "<DataArray type=\"String\" Name=\"name\" format=\"ascii\">97 0 98 0 99 0</DataArray>"
                        "<DataArray type=\"Int64\" Name=\"v\" NumberOfComponents=\"2\" "
                        "format=\"ascii\">1 2 3 4 5 6</DataArray>"));
  const VolumeFields read = read_vtu_fields(path);
  expect_equal(read.cells, {{"p", {1, {7, 5}}}, {"v", {2, {5, 6, 1, 2}}}});
  EXPECT_EQ(read_volume_mesh(path).tetrahedra.front(), (geometry::Tetrahedron{3, 4, 5, 6}));
}

TEST(VolumeFields, RefusesWhatDoesNotFit) {
  const auto path = testing::temporary_folder("io") / "result.vtu";
  const MixedMesh mesh = column_of_tetrahedra();
  const auto refused = [&](const VolumeFields& fields, const std::string& part) {
    try {
      write_vtu_with_fields(path, mesh, fields);
      ADD_FAILURE() << "was written: " << part;
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(path));
  };
  refused({{{"p", {1, {1.0, 2.0}}}}, {}}, "the field p has 2 values");
  refused({{}, {{"v", {3, std::vector<double>(mesh.points.size())}}}}, "the field v has");
  refused({{{"t", {10, std::vector<double>(10 * mesh.tetrahedra.size())}}}, {}}, "1 to 9");
  const auto other = file_with("a.vtu", "hello");
  expect_refusal(other, [&] { read_vtu_fields(other); }, {"no VTK XML"});
}

}  // namespace
}  // namespace ostia::io
