#include "ostia/geometry/hex_prisms.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mixed_mesh_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

double volume_of(const MixedMesh& mesh, const Prism& prism) {
  const auto at = [&](std::size_t k) -> const Vec3& {
    return mesh.points[static_cast<std::size_t>(prism[k])];
  };
  const auto tetrahedron = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    return (at(b) - at(a)).cross(at(c) - at(a)).dot(at(d) - at(a)) / 6.0;
  };
  return tetrahedron(0, 1, 2, 5) + tetrahedron(0, 1, 5, 4) + tetrahedron(0, 4, 5, 3);
}

double volume_of(const MixedMesh& mesh) {
  double sum = 0.0;
  for (const Prism& prism : mesh.prisms) {
    const double one = volume_of(mesh, prism);
    EXPECT_GT(one, 0.0);
    sum += one;
  }
  return sum;
}

/// Each side is another element's, or the boundary's.
void expect_conforming(const MixedMesh& mesh) {
  std::size_t free = 0;
  const std::vector<MeshSide> sides = sorted_sides(mesh);
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].key == sides[i].key) ++end;
    EXPECT_LE(end - i, 2u);
    free += end - i == 1;
  }
  EXPECT_EQ(free, mesh.triangles.size() + mesh.quads.size());
  MixedMesh again = mesh;
  take_free_sides_as_boundary(again);
  const auto keys = [](const MixedMesh& m) {
    std::vector<Quad> all = m.quads;
    for (const Triangle& t : m.triangles) all.push_back({t[0], t[1], t[2], -1});
    for (Quad& q : all) std::ranges::sort(q);
    std::ranges::sort(all);
    return all;
  };
  EXPECT_EQ(keys(mesh), keys(again));
}

/// Boxes of edge 1; `turn` says by which of its symmetries each hexahedron's corners are listed.
template <class Turn>
HexMesh boxes(const std::array<int, 3>& n, const Turn& turn) {
  HexMesh mesh;
  mesh.faces = {
      {1, "wall", FaceKind::wall}, {2, "inlet_a", FaceKind::inlet}, {3, "outlet_a", FaceKind::outlet}};
  const auto at = [&](int x, int y, int z) {
    return static_cast<std::int32_t>(x + (n[0] + 1) * (y + (n[1] + 1) * z));
  };
  for (int z = 0; z <= n[2]; ++z)
    for (int y = 0; y <= n[1]; ++y)
      for (int x = 0; x <= n[0]; ++x) mesh.points.emplace_back(x, y, z);
  constexpr std::array<std::array<std::size_t, 8>, 3> symmetries = {
      {{0, 1, 2, 3, 4, 5, 6, 7}, {0, 4, 5, 1, 3, 7, 6, 2}, {0, 3, 7, 4, 1, 2, 6, 5}}};
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) {
        const Hexahedron plain{
            at(x, y, z),     at(x + 1, y, z),     at(x + 1, y + 1, z),     at(x, y + 1, z),
            at(x, y, z + 1), at(x + 1, y, z + 1), at(x + 1, y + 1, z + 1), at(x, y + 1, z + 1)};
        Hexahedron turned{};
        const auto& symmetry = symmetries[static_cast<std::size_t>(turn(x, y, z)) % 3];
        for (std::size_t k = 0; k < 8; ++k) turned[k] = plain[symmetry[k]];
        mesh.hexahedra.push_back(turned);
        const auto add = [&](bool there, std::int32_t id, const Quad& quad) {
          if (!there) return;
          mesh.quads.push_back(quad);
          mesh.quad_face_ids.push_back(id);
        };
        add(z == 0, 2, {plain[0], plain[3], plain[2], plain[1]});
        add(z == n[2] - 1, 3, {plain[4], plain[5], plain[6], plain[7]});
        add(y == 0, 1, {plain[0], plain[1], plain[5], plain[4]});
        add(x == n[0] - 1, 1, {plain[1], plain[2], plain[6], plain[5]});
        add(y == n[1] - 1, 1, {plain[2], plain[3], plain[7], plain[6]});
        add(x == 0, 1, {plain[3], plain[0], plain[4], plain[7]});
      }
  return mesh;
}

TEST(HexPrisms, AreCutAcrossTheWayFromInletToOutletHoweverCornersAreListed) {
  for (const int turns : {1, 3}) {
    const HexMesh mesh = boxes({3, 2, 4}, [&](int x, int y, int z) { return (x + 2 * y + z) % turns; });
    for (const Hexahedron& one : mesh.hexahedra) EXPECT_NEAR(volume(mesh, one), 1.0, 1e-12);
    const MixedMesh prisms = as_prisms(mesh);
    EXPECT_EQ(prisms.prisms.size(), 48u);
    EXPECT_NEAR(volume_of(prisms), 24.0, 1e-12);
    expect_conforming(prisms);
    EXPECT_EQ(prisms.triangles.size(), 24u) << "the sections of inlet and outlet, two of each side";
    EXPECT_EQ(prisms.quads.size(), 40u) << "the wall stays whole";
    for (const std::int32_t id : prisms.triangle_face_ids) EXPECT_NE(id, 1);
    for (const std::int32_t id : prisms.quad_face_ids) EXPECT_EQ(id, 1);
    for (const Triangle& t : prisms.triangles) {
      const auto at = [&](std::size_t k) { return prisms.points[static_cast<std::size_t>(t[k])]; };
      const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0));
      EXPECT_GT(normal.z() * (at(0).z() - 2.0), 0.0) << "outward";
    }
  }
}

TEST(HexPrisms, ARingWithoutEndsIsCutToo) {
  HexMesh mesh;
  constexpr int around = 12;
  for (int i = 0; i < around; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / around;
    for (const auto& [r, z] : {std::pair{2.0, 0.0}, {3.0, 0.0}, {3.0, 1.0}, {2.0, 1.0}})
      mesh.points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  for (int i = 0; i < around; ++i) {
    Hexahedron one{};
    for (int k = 0; k < 4; ++k) {
      one[static_cast<std::size_t>(k)] = 4 * ((i + 1) % around) + k;
      one[static_cast<std::size_t>(k + 4)] = 4 * i + k;
    }
    mesh.hexahedra.push_back(one);
    ASSERT_GT(volume(mesh, one), 0.0);
  }
  MixedMesh out;
  out.points = mesh.points;
  add_as_prisms(mesh.hexahedra, out);
  EXPECT_EQ(out.prisms.size(), 24u);
  double expected = 0.0;
  for (const Hexahedron& one : mesh.hexahedra) expected += volume(mesh, one);
  EXPECT_NEAR(volume_of(out), expected, 1e-9);
  take_free_sides_as_boundary(out);
  expect_conforming(out);
  EXPECT_EQ(out.quads.size(), 48u) << "none of the outside is cut";
}

TEST(HexPrisms, RefusesCornersThatAreNoPointsAndSidesThatOthersKeepWhole) {
  MixedMesh mesh;
  mesh.points.resize(8, Vec3::Zero());
  EXPECT_THROW(add_as_prisms({{0, 1, 2, 3, 4, 5, 6, 8}}, mesh), InvalidInput);
  // Prisms on three sides of a box, of three axes: whatever is cut, one of them keeps it whole.
  const HexMesh box = boxes({1, 1, 1}, [](int, int, int) { return 0; });
  MixedMesh between;
  between.points = box.points;
  for (const Vec3& p :
       {Vec3(-1, 0, 0), Vec3(-1, 0, 1), Vec3(0, -1, 0), Vec3(0, -1, 1), Vec3(0, 0, -1), Vec3(1, 0, -1)})
    between.points.push_back(p);
  between.prisms = {{0, 2, 8, 4, 6, 9}, {0, 10, 1, 4, 11, 5}, {0, 12, 2, 1, 13, 3}};
  EXPECT_THROW(add_as_prisms(box.hexahedra, between), GeometryError);
}

}  // namespace
}  // namespace ostia::geometry
