#include "ostia/io/surface_file.h"

#include "io_test_support.h"

namespace ostia::io {
namespace {

TEST(SurfaceFile, RoundTripsEveryFormat) {
  const auto folder = testing::temporary_folder("io");
  for (const std::string name : {"a.vtp", "a.ply", "a.stl", "A.STL"}) {
    write_surface(folder / name, tetrahedron_surface());
    const auto read = read_surface(folder / name).surface.mesh;
    ASSERT_EQ(read.triangles.size(), 4u) << name;
    ASSERT_EQ(read.points.size(), 4u) << name;
  }
}

TEST(SurfaceFile, RefusesToLoseFaceNames) {
  const auto folder = testing::temporary_folder("io");
  expect_refusal(folder / "a.stl", [&] { write_surface(folder / "a.stl", faced_tetrahedron()); },
                 {"named faces", ".vtp"});
  EXPECT_FALSE(std::filesystem::exists(folder / "a.stl"));
}

TEST(SurfaceFile, RefusesToWriteATriangleOfAPointThatIsNot) {
  geometry::TriMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const std::int32_t corner : {3, -1}) {
    mesh.triangles = {{0, 1, corner}};
    for (const char* name : {"a.stl", "a.ply", "a.vtp"}) {
      const auto file = testing::temporary_folder("io") / name;
      EXPECT_THROW(write_surface(file, mesh), InvalidInput) << name;
      EXPECT_FALSE(std::filesystem::exists(file)) << name;
    }
  }
}

TEST(SurfaceFile, EmptyFile) {
  for (const std::string name : {"a.stl", "a.ply", "a.obj", "a.vtp"}) {
    const auto path = file_with(name, "");
    expect_refusal(path, [&] { read_surface(path); }, {"empty"});
  }
}

TEST(SurfaceFile, NamesWhatItCannotRead) {
  const auto path = file_with("a.xyz", "1 2 3");
  expect_refusal(path, [&] { read_surface(path); }, {".stl"});
  expect_refusal("nowhere.stl", [&] { read_surface("nowhere.stl"); }, {"no such file"});
  expect_refusal("a.xyz", [&] { write_surface(path, tetrahedron_surface()); }, {".vtp"});
}

TEST(SurfaceFile, LongPathsWithSpacesAndUtf8) {
  const auto folder = testing::temporary_folder("io") / "Gef\xc3\xa4\xc3\x9f e";
  std::filesystem::create_directory(folder);
  for (const std::string end : {".vtp", ".ply", ".stl"}) {
    const auto path = folder / (std::string(245, 'n') + end);
    write_surface(path, tetrahedron_surface());
    EXPECT_EQ(read_surface(path).surface.mesh.triangles.size(), 4u);
  }
}

TEST(SurfaceFile, ReadOnlyFolderKeepsTheOldFile) {
  const auto file = testing::temporary_folder("io") / "file";
  core::write_file(file, "mine");
  EXPECT_THROW(write_surface(file / "a.vtp", tetrahedron_surface()), IoError);
  EXPECT_EQ(core::read_file(file), "mine");
}

TEST(SurfaceFile, KnowsItsExtensions) {
  EXPECT_TRUE(is_surface_file("a.STL"));
  EXPECT_TRUE(is_surface_file("a.vtp"));
  EXPECT_FALSE(is_surface_file("a.nii.gz"));
}

}  // namespace
}  // namespace ostia::io
