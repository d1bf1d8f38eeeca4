#include "io_test_support.h"

#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/surface_file.h"

#include <array>
#include <clocale>
#include <cmath>
#include <cstring>

namespace ostia::io {
namespace {

std::string binary_stl(std::uint32_t declared, std::size_t facets) {
  std::string out(80, ' ');
  out.append(reinterpret_cast<const char*>(&declared), 4);
  for (std::size_t f = 0; f < facets; ++f) {
    std::array<float, 12> numbers{
        0, 0, 1, 0, 0, static_cast<float>(f), 1, 0, static_cast<float>(f), 0, 1, static_cast<float>(f)};
    out.append(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
    out.append(2, '\0');
  }
  return out;
}

constexpr const char* ascii =
    "solid a\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1.5 0 0\n   vertex 0 2.5e0 0\n  "
    "endloop\n endfacet\nendsolid a\n";

TEST(Stl, RoundTripsInSinglePrecision) {
  const auto path = testing::temporary_folder("io") / "a.stl";
  write_surface(path, tetrahedron_surface());
  const auto mesh = read_surface(path).surface.mesh;
  EXPECT_NEAR(geometry::volume(mesh), 1.25 * 1.5 * 1.75 / 6.0, 1e-6);
  EXPECT_TRUE(geometry::find_faults(mesh, true).closed_manifold());
}

TEST(Stl, ReadsAscii) {
  const auto path = file_with("a.stl", ascii);
  const auto mesh = read_surface(path).surface.mesh;
  ASSERT_EQ(mesh.points.size(), 3u);
  EXPECT_EQ(mesh.points[2], geometry::Vec3(0, 2.5, 0));
}

TEST(Stl, ReadsBinaryThatBeginsWithSolid) {
  std::string content = binary_stl(2, 2);
  std::memcpy(content.data(), "solid facet", 11);
  EXPECT_EQ(read_surface(file_with("a.stl", content)).surface.mesh.triangles.size(), 2u);
}

TEST(Stl, CountBeyondTheFile) {
  const auto huge = file_with("a.stl", binary_stl(1u << 31, 1));
  expect_refusal(huge, [&] { read_surface(huge); }, {"2147483648"});
  const auto cut = file_with("a.stl", binary_stl(3, 2));
  expect_refusal(cut, [&] { read_surface(cut); }, {"3 triangles", "cut short"});
  const auto head = file_with("a.stl", std::string(50, 'x'));
  expect_refusal(head, [&] { read_surface(head); }, {"84 bytes"});
}

TEST(Stl, AsciiCutShort) {
  const std::string text(ascii);
  for (const std::size_t length :
       {text.find("endsolid"), text.find("vertex 0 2.5"), text.find("2.5e0") + 1}) {
    const auto path = file_with("a.stl", text.substr(0, length));
    expect_refusal(path, [&] { read_surface(path); }, {});
  }
}

TEST(Stl, CoordinatesThatAreNoNumbersAreKeptAndCounted) {
  std::string content = binary_stl(2, 2);
  const float nan = std::nanf("");
  std::memcpy(content.data() + 84 + 12, &nan, 4);
  const auto mesh = read_surface(file_with("a.stl", content)).surface.mesh;
  EXPECT_EQ(geometry::find_faults(mesh, false).non_finite_points, 1u);
}

TEST(Stl, AGermanLocaleChangesNothing) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (!std::setlocale(LC_ALL, "de_DE.UTF-8")) GTEST_SKIP() << "needs the locale de_DE.UTF-8";
  const auto mesh = read_surface(file_with("a.stl", ascii)).surface.mesh;
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(mesh.points[1].x(), 1.5);
}

TEST(Stl, RefusesWordsForNumbers) {
  std::string text(ascii);
  text.replace(text.find("1.5"), 3, "1,5");
  const auto path = file_with("a.stl", text);
  expect_refusal(path, [&] { read_surface(path); }, {"1,5"});
}

}  // namespace
}  // namespace ostia::io
