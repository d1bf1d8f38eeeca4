#include "io_test_support.h"

#include "ostia/io/surface_file.h"

#include <algorithm>
#include <cstring>

namespace ostia::io {
namespace {

constexpr const char* header =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty "
    "uchar red\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
constexpr const char* body = "0 0 0 7\n1 0 0 7\n1 1 0 7\n0 1 0 7\n4 0 1 2 3\n";

TEST(Ply, RoundTripsExactly) {
  const auto path = testing::temporary_folder("io") / "a.ply";
  write_surface(path, tetrahedron_surface());
  expect_same_mesh(read_surface(path).surface.mesh, tetrahedron_surface());
}

TEST(Ply, SplitsPolygonsAndSaysSo) {
  const auto loaded = read_surface(file_with("a.ply", std::string(header) + body));
  EXPECT_EQ(loaded.surface.mesh.triangles.size(), 2u);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("1 polygons"), std::string::npos);
}

TEST(Ply, ReadsBigEndian) {
  std::string content =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty "
      "double z\n"
      "element face 1\nproperty list uchar int vertex_index\nend_header\n";
  const auto add = [&](auto value) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    std::reverse(bytes.begin(), bytes.end());
    content += bytes;
  };
  for (const double v : {0.0, 0.0, 0.0, 1.5, 0.0, 0.0, 0.0, 2.5, 0.0}) add(v);
  content += '\3';
  for (const std::int32_t i : {0, 1, 2}) add(i);
  const auto mesh = read_surface(file_with("a.ply", content)).surface.mesh;
  EXPECT_EQ(mesh.points[1], geometry::Vec3(1.5, 0, 0));
  EXPECT_EQ(mesh.triangles[0], (geometry::Triangle{0, 1, 2}));
}

TEST(Ply, RefusesWhatIsCutOrOutOfRange) {
  const std::vector<std::pair<std::string, std::string>> bad{
      {"plz\n", "\"ply\""},
      {"ply\nformat ascii 1.0\nelement vertex 3\n", "does not end"},
      {std::string(header) + "0 0 0 7\n1 0 0", "cut short"},
      {std::string(header) + "0 0 0 7\n1 0 0 7\n1 1 0 7\n0 1 0 7\n3 0 1 9\n", "point 9"},
      {std::string(header) + "0 0 0 7\n1 0 0 7\n1 1 0 7\n0 1 0 7\n3 0 1 -2\n", "out of range"},
      {std::string(header) + "0 0 0 7\n1 0 x 7\n", "\"x\""},
      {"ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nend_header\n", "count"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n",
       "no x, y or z"},
      {"ply\nelement vertex 1\nproperty float x\nend_header\n0\n", "no format"},
  };
  for (const auto& [content, part] : bad) {
    const auto path = file_with("a.ply", content);
    expect_refusal(path, [&] { read_surface(path); }, {part});
  }
}

TEST(Ply, DoesNotAllocateWhatTheFileCannotHold) {
  const auto path = file_with(
      "a.ply",
      "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\nproperty float y\n"
      "property float z\nend_header\nxxxx");
  expect_refusal(path, [&] { read_surface(path); }, {"cut short"});
}

}  // namespace
}  // namespace ostia::io
