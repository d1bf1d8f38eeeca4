#include "io_test_support.h"

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

}  // namespace
}  // namespace ostia::io
