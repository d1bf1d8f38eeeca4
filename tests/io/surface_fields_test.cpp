#include "ostia/io/surface_fields.h"

#include "io_test_support.h"

namespace ostia::io {
namespace {

/// A square of two triangles' worth as one polygon, and a triangle, with what `data` says.
std::string square_and_triangle(const std::string& point_data, const std::string& cell_data) {
  return "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\"><PolyData>"
         "<Piece NumberOfPoints=\"5\" NumberOfPolys=\"2\"><Points><DataArray type=\"Float64\" "
         "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0 2 0 0</DataArray></Points>"
         "<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 1 4 2</DataArray>"
         "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4 7</DataArray></Polys><PointData>" +
         point_data + "</PointData><CellData>" + cell_data + "</CellData></Piece></PolyData></VTKFile>";
}

std::filesystem::path written(const std::string& name, const std::string& content) {
  const auto path = testing::temporary_folder("io") / name;
  core::write_file(path, content);
  return path;
}

TEST(SurfaceWithFields, ReadsPointAndCellArraysAPolygonsForEachOfItsTriangles) {
  const auto read = read_surface_with_fields(written(
      "a.vtp", square_and_triangle(
                   "<DataArray type=\"Float32\" Name=\"pressure_Pa\" format=\"ascii\">0 1 2 3 "
                   "4</DataArray><DataArray type=\"Float64\" Name=\"traction_Pa\" "
                   "NumberOfComponents=\"3\" format=\"ascii\">1 0 0 2 0 0 3 0 0 4 0 0 5 0 6</DataArray>",
                   "<DataArray type=\"Float64\" Name=\"shear_Pa\" format=\"ascii\">7 9</DataArray>"
                   "<DataArray type=\"Int32\" Name=\"CellEntityIds\" format=\"ascii\">1 1</DataArray>")));
  ASSERT_EQ(read.mesh.triangles.size(), 3u);
  ASSERT_EQ(read.points.size(), 2u);
  ASSERT_EQ(read.points.at("pressure_Pa").values.size(), 5u);
  EXPECT_EQ(read.points.at("pressure_Pa").values[3], 3.0);
  EXPECT_EQ(read.points.at("pressure_Pa").values[4], 4.0);
  EXPECT_EQ(read.points.at("traction_Pa").components, 3);
  EXPECT_EQ(read.points.at("traction_Pa").values[14], 6.0);
  ASSERT_EQ(read.triangles.size(), 1u);
  EXPECT_EQ(read.triangles.at("shear_Pa").values, (std::vector<double>{7.0, 7.0, 9.0}));
}

TEST(SurfaceWithFields, ASurfaceWithoutArraysHasNone) {
  const auto read = read_surface_with_fields(written("a.vtp", square_and_triangle("", "")));
  EXPECT_TRUE(read.points.empty());
  EXPECT_TRUE(read.triangles.empty());
}

TEST(SurfaceWithFields, OtherFilesAreRefusedByName) {
  EXPECT_THROW(read_surface_with_fields(written("a.stl", "solid\nendsolid\n")), InvalidInput);
  EXPECT_THROW(read_surface_with_fields(written("a.vtp", "no file of VTK")), InvalidInput);
  EXPECT_THROW(read_surface_with_fields("/nowhere/a.vtp"), IoError);
}

}  // namespace
}  // namespace ostia::io
