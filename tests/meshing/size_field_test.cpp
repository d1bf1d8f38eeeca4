#include "ostia/meshing/size_field.h"

#include "boundary_layer_shapes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mixed_mesh_sides.h"
#include "ostia/meshing/boundary_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

TEST(SizeLookup, IsExactAtThePointsAndGrowsAwayFromThem) {
  SizeField field;
  for (int i = 0; i < 20; ++i) {
    field.points.emplace_back(0.1 * i, 0.0, 0.0);
    field.edge_mm.push_back(0.2 + 0.01 * i);
  }
  field.gradation = 0.5;
  const SizeLookup lookup(field);
  for (std::size_t i = 0; i < field.points.size(); ++i) EXPECT_EQ(lookup(field.points[i]), field.edge_mm[i]);
  EXPECT_NEAR(lookup(Vec3(1.05, 0, 0)), 0.305, 0.005);
  EXPECT_NEAR(lookup(Vec3(0, 10.2, 0)), 0.5 * 10.0 + 0.22, 0.05);
  field.edge_mm[3] = 0.0;
  EXPECT_THROW(validate(field), InvalidInput);
  field.edge_mm.pop_back();
  EXPECT_THROW(validate(field), InvalidInput);
}

/// Short edges about the middle of a tube of 12 mm, 0.5 mm far from it.
double wanted_mm(const Vec3& p) {
  return std::min(0.5, 0.12 + 0.25 * (p - Vec3(0.0, 0.0, 6.0)).norm());
}

std::shared_ptr<const SizeField> focus() {
  auto field = std::make_shared<SizeField>();
  for (double z = -0.5; z < 12.6; z += 0.2)
    for (double y = -1.7; y < 1.8; y += 0.2)
      for (double x = -1.7; x < 1.8; x += 0.2) {
        field->points.emplace_back(x, y, z);
        field->edge_mm.push_back(wanted_mm(field->points.back()));
      }
  return field;
}

geometry::FacedSurface surface_with(const std::shared_ptr<const SizeField>& field) {
  const auto shape = geometry::straight_tube(12.0, 1.5);
  const geometry::FacedSurface input = capped(shape, 0.3, false);
  SizingOptions sizing;
  sizing.field = field;
  return remesh(input, target_edge_lengths(input.mesh, TubeFunction(tree_of(shape)), sizing)).surface;
}

/// Mean edge of the tetrahedra within `reach` of a place, over what was wanted there.
double edge_share(const std::vector<Vec3>& points, const std::vector<geometry::Tetrahedron>& tetrahedra,
                  const Vec3& place, double reach) {
  double sum = 0.0, count = 0.0;
  for (const geometry::Tetrahedron& t : tetrahedra)
    for (const auto& [a, b] : geometry::tetrahedron_edges) {
      const Vec3 &p = points[static_cast<std::size_t>(t[a])], &q = points[static_cast<std::size_t>(t[b])];
      const Vec3 middle = 0.5 * (p + q);
      if ((middle - place).norm() > reach) continue;
      sum += (p - q).norm() / wanted_mm(middle);
      count += 1.0;
    }
  return count > 0.0 ? sum / count : 0.0;
}

TEST(SizeFieldInside, BothMeshersFollowIt) {
  const auto surface = surface_with(focus());
  for (const Mesher mesher : {Mesher::tetgen, Mesher::mesh3}) {
    TetrahedralizeOptions options;
    options.mesher = mesher;
    options.field = focus();
    const auto made = tetrahedralize(surface, options);
    EXPECT_EQ(made.report.made_by, mesher);
    // Mesh_3 asks for the length at one place of a tetrahedron, TetGen's at all four corners: its are longer.
    const double longest = mesher == Mesher::mesh3 ? 1.4 : 1.2;
    for (const Vec3& place : {Vec3(0, 0, 6), Vec3(0.5, 0.0, 5.5), Vec3(0, 0, 3), Vec3(0, 0, 9)}) {
      const double share = edge_share(made.mesh.points, made.mesh.tetrahedra, place, 0.5);
      EXPECT_GT(share, 0.8) << place.transpose() << " by " << static_cast<int>(mesher);
      EXPECT_LT(share, longest) << place.transpose() << " by " << static_cast<int>(mesher);
    }
    EXPECT_EQ(made.report.quality.inverted, 0U);
    EXPECT_GT(made.report.quality.min_dihedral_deg, 10.0);
  }
}

TEST(SizeFieldInside, TetGenKeepsTheSurfaceAndMakesTheSameMeshAgain) {
  const auto surface = surface_with(focus());
  TetrahedralizeOptions options;
  options.field = focus();
  const auto one = tetrahedralize(surface, options), two = tetrahedralize(surface, options);
  EXPECT_EQ(one.mesh.boundary, surface.mesh.triangles);
  EXPECT_EQ(one.mesh.points, two.mesh.points);
  EXPECT_EQ(one.mesh.tetrahedra, two.mesh.tetrahedra);
}

TEST(SizeFieldInside, LayersStayAndTheirThicknessFollowsTheWallsEdge) {
  const auto field =
      std::make_shared<SizeField>(SizeField{{Vec3(0, 0, 1.0), Vec3(0, 0, 11.0)}, {0.45, 0.45}, 0.3});
  auto fine = std::make_shared<SizeField>(*field);
  for (double z = 5.0; z < 7.1; z += 0.1)
    fine->points.emplace_back(1.5, 0.0, z), fine->edge_mm.push_back(0.15);
  const auto made = [&](const std::shared_ptr<const SizeField>& sizes) {
    TetrahedralizeOptions inside;
    inside.field = sizes;
    return fill_with_layers(surface_with(sizes), {}, inside);
  };
  const FilledWithLayers refined = made(fine), even = made(field);
  EXPECT_EQ(refined.layers.inverted, 0U);
  const auto thickness_at = [](const FilledWithLayers& filled, const Vec3& place) {
    std::size_t best = 0;  // wall points come first
    for (std::size_t i = 0; i < filled.layers.thickness_mm.size(); ++i)
      if ((filled.mesh.points[i] - place).norm() < (filled.mesh.points[best] - place).norm()) best = i;
    return filled.layers.thickness_mm[best];
  };
  const Vec3 place(1.5, 0.0, 6.0), other(1.5, 0.0, 2.5);
  EXPECT_NEAR(thickness_at(refined, place), 0.25 * 0.15, 0.3 * 0.25 * 0.15);
  EXPECT_LT(thickness_at(refined, place), 0.5 * thickness_at(even, place));
  EXPECT_NEAR(thickness_at(refined, other), thickness_at(even, other), 0.25 * thickness_at(even, other));
}

TEST(SizeFieldInside, ABadFieldIsRefusedBeforeAnythingIsMade) {
  TetrahedralizeOptions options;
  auto field = std::make_shared<SizeField>();
  options.field = field;
  EXPECT_THROW(validate(options), InvalidInput);
  field->points.emplace_back(0, 0, 0);
  field->edge_mm.push_back(-1.0);
  EXPECT_THROW(validate(options), InvalidInput);
  SizingOptions sizing;
  sizing.field = field;
  EXPECT_THROW(validate(sizing), InvalidInput);
}

}  // namespace
}  // namespace ostia::meshing
