#include "io_test_support.h"

#include "ostia/io/graph_file.h"
#include "ostia/io/surface_fields.h"
#include "ostia/io/surface_file.h"

namespace ostia::io {
namespace {

TEST(VtkSurface, RoundTripsFacesAndNames) {
  const auto path = testing::temporary_folder("io") / "a.vtp";
  write_surface(path, faced_tetrahedron());
  const auto read = read_surface(path).surface;
  expect_same_mesh(read.mesh, tetrahedron_surface());
  EXPECT_EQ(read.face_ids, faced_tetrahedron().face_ids);
  ASSERT_EQ(read.faces.size(), 3u);
  EXPECT_EQ(read.faces[1].name, "inlet_a");
  EXPECT_EQ(read.faces[1].kind, geometry::FaceKind::inlet);
  EXPECT_EQ(read.faces[2].kind, geometry::FaceKind::outlet);
}

TEST(VtkSurface, SaysItsAxesAndUnit) {
  const auto path = testing::temporary_folder("io") / "a.vtp";
  write_surface(path, tetrahedron_surface());
  const std::string content = core::read_file(path);
  EXPECT_NE(content.find("\"Axes\""), std::string::npos);
  EXPECT_NE(content.find("\"Unit\""), std::string::npos);
}

TEST(VtkSurface, WritesTheSameBytesAgain) {
  const auto folder = testing::temporary_folder("io");
  write_surface(folder / "a.vtp", faced_tetrahedron());
  write_surface(folder / "b.vtp", faced_tetrahedron());
  EXPECT_EQ(core::read_file(folder / "a.vtp"), core::read_file(folder / "b.vtp"));
}

TEST(VtkSurface, KeepsFieldsOfItsPoints) {
  const auto folder = testing::temporary_folder("io");
  const PointFields fields{{"pressure_Pa", {1, {1.5, -2, 3, 1e9}}},
                           {"shear_Pa", {3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}}};
  write_vtp_with_fields(folder / "a.vtp", faced_tetrahedron(), fields);
  const PointFields read = read_surface_with_fields(folder / "a.vtp").points;
  ASSERT_EQ(read.size(), 2u);
  for (const auto& [name, field] : fields) {
    EXPECT_EQ(read.at(name).components, field.components);
    EXPECT_EQ(read.at(name).values, field.values);
  }
  const auto surface = read_surface(folder / "a.vtp").surface;
  expect_same_mesh(surface.mesh, tetrahedron_surface());
  EXPECT_EQ(surface.face_ids, faced_tetrahedron().face_ids);
  EXPECT_THROW(write_vtp_with_fields(folder / "b.vtp", faced_tetrahedron(), {{"p", {1, {1.0}}}}),
               InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(folder / "b.vtp"));
}

/// A tetrahedron as legacy polydata: strips or polygons, labels, names of faces.
std::string legacy_tetrahedron(const std::string& cells, const std::string& labels,
                               const std::string& names) {
  std::string text = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n";
  if (!names.empty()) text += "FIELD FieldData 1\nFaceNames 1 " + names;
  text += "POINTS 4 double\n0 0 0 1.25 0 0 0 1.5 0 0 0 1.75\n" + cells;
  if (!labels.empty()) text += "CELL_DATA 4\nSCALARS ModelFaceID int 1\nLOOKUP_TABLE default\n" + labels;
  return text;
}
constexpr const char* four_polygons = "POLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

TEST(VtkSurface, LegacyPolygonsAreASurfaceAndLegacyLinesAreNone) {
  const auto path = file_with("a.vtk", legacy_tetrahedron(four_polygons, "", ""));
  EXPECT_TRUE(is_surface_file(path));
  EXPECT_FALSE(is_graph_file(path));
  expect_same_mesh(read_surface(path).surface.mesh, tetrahedron_surface());
  const auto lines = file_with("b.vtk", legacy_tetrahedron("LINES 1 3\n2 0 1\n", "", ""));
  EXPECT_FALSE(is_surface_file(lines));
  EXPECT_TRUE(is_graph_file(lines));
  EXPECT_THROW(read_surface(lines), EmptySurface);
  EXPECT_FALSE(is_surface_file("no_such_file.vtk"));
  const auto lying = file_with("c.vtk", legacy_tetrahedron("POLYGONS 400000000000 16\n3 0 2 1\n", "", ""));
  expect_refusal(lying, [&] { read_surface(lying); }, {"POLYGONS"});
}

TEST(VtkSurface, StripsAreTakenApartWithTheirSides) {
  // 0 2 1 3: triangles 0 2 1 and, turned, 2 3 1 (1 2 3); joined to 3 0 by a corner that repeats.
  const auto path = file_with(
      "a.vtk",
      legacy_tetrahedron("POLYGONS 1 4\n3 0 1 3\nTRIANGLE_STRIPS 2 11\n4 0 2 1 3\n5 3 3 2 0 0\n", "", ""));
  const geometry::TriMesh mesh = read_surface(path).surface.mesh;
  const std::vector<geometry::Triangle> expected{{0, 1, 3}, {0, 2, 1}, {1, 2, 3}, {2, 3, 0}};
  EXPECT_EQ(mesh.triangles, expected);
  const auto fields = read_surface_with_fields(path);
  EXPECT_EQ(fields.mesh.triangles, expected);
  const auto thin = file_with("b.vtk", legacy_tetrahedron("TRIANGLE_STRIPS 1 3\n2 0 1\n", "", ""));
  expect_refusal(thin, [&] { read_surface(thin); }, {"strip 0", "fewer than three"});
}

TEST(VtkSurface, NamesWithoutNumbersAreThoseOfTheLabelsInTheirOrder) {
  const auto names_of = [](const std::string& labels, const std::string& names, std::size_t warnings) {
    const LoadedSurface read =
        read_surface(file_with("a.vtk", legacy_tetrahedron(four_polygons, labels, names)));
    EXPECT_EQ(read.warnings.size(), warnings);
    std::string all;
    for (const geometry::Face& face : read.surface.faces)
      all += std::to_string(face.id) + " " + face.name + ", ";
    return all;
  };
  EXPECT_EQ(names_of("7\n3\n3\n9\n", "3 string\nwall\ncap_aorta\nLAD\n", 0), "3 wall, 7 cap_aorta, 9 LAD, ");
  EXPECT_EQ(names_of("1\n1\n3\n1\n", "3 string\nwall\ncap_aorta\nLAD\n", 0), "1 wall, 3 LAD, ")
      << "labels count from 1 where there are more names";
  EXPECT_EQ(names_of("1\n1\n8\n1\n", "3 string\nwall\ncap_aorta\nLAD\n", 1), "1 wall, 8 face_8, ");
}

}  // namespace
}  // namespace ostia::io
