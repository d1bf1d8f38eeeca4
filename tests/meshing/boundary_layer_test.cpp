#include "ostia/meshing/boundary_layer.h"

#include "boundary_layer/march.h"
#include "boundary_layer_shapes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

PrismCorners right_prism(double height) {
  const double h = 0.5 * std::numbers::sqrt3;
  return {Vec3(0, 0, 0),      Vec3(1, 0, 0),      Vec3(0.5, h, 0),
          Vec3(0, 0, height), Vec3(1, 0, height), Vec3(0.5, h, height)};
}

TEST(BoundaryLayerPrism, OfKnownShape) {
  for (const double height : {1.0, 1e-6}) {
    EXPECT_NEAR(prism_scaled_jacobian(right_prism(height)), 1.0, 1e-12);
    EXPECT_NEAR(prism_volume(right_prism(height)), std::numbers::sqrt3 / 4.0 * height, 1e-15);
  }
  PrismCorners sheared = right_prism(1.0);  // leaning by 45 degrees
  for (std::size_t i = 3; i < 6; ++i) sheared[i].x() += 1.0;
  EXPECT_NEAR(prism_scaled_jacobian(sheared), std::sqrt(0.5), 1e-12);
  PrismCorners flipped = right_prism(1.0);
  for (std::size_t i = 3; i < 6; ++i) flipped[i].z() = -1.0;
  EXPECT_NEAR(prism_scaled_jacobian(flipped), -1.0, 1e-12);
}

/// The upper triangle turned by 170 degrees about the axis: the determinant is positive at all corners,
/// since both triangles face upward, but the triangle half-way is turned inside out.
TEST(BoundaryLayerPrism, TheCoefficientsSeeAnInsideThatTheCornersDoNot) {
  PrismCorners twisted = right_prism(1.0);
  const Vec3 centre(0.5, 0.5 / std::numbers::sqrt3, 0.0);
  const Eigen::AngleAxisd turn(170.0 / 180.0 * std::numbers::pi, Vec3::UnitZ());
  for (std::size_t i = 3; i < 6; ++i) twisted[i] = centre + turn * (twisted[i] - centre);
  EXPECT_GT(prism_scaled_jacobian(twisted), 0.0);
  const auto c = prism_jacobian_coefficients(twisted);
  EXPECT_LT(*std::min_element(c.begin(), c.end()), 0.0);
}

/// On a regular tube everything is known: the edges, so the thickness, so where the points are.
TEST(BoundaryLayer, OfAStraightTubeIsExact) {
  constexpr int around = 20;
  constexpr double radius = 1.5, step = 0.4;
  const geometry::FacedSurface surface = structured_tube(around, radius, step, 24);
  BoundaryLayerOptions options;
  options.layers = 3;
  options.thickness = 0.8;
  const BoundaryLayer layer = boundary_layer(surface, options);
  const double chord = 2.0 * radius * std::sin(std::numbers::pi / around);
  const double edge = (chord + step + std::hypot(chord, step)) / 3.0;  // two of each at a point
  const std::size_t n = layer.wall.points.size();
  ASSERT_EQ(layer.points.size(), 4 * n);
  EXPECT_NEAR(layer.report.full_share, 1.0, 1e-9);
  EXPECT_TRUE(layer.report.warnings.empty());
  const double first = 0.8 * edge / (1.0 + 1.2 + 1.44);
  std::size_t checked = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& p = layer.points[i];
    if (p.z() < 3.1 * step || p.z() > (24 - 3.1) * step) continue;  // rings have fewer edges at a point
    const double expected[] = {0.0, first, 2.2 * first, 3.64 * first};
    for (std::size_t k = 1; k <= 3; ++k) {
      EXPECT_NEAR((layer.points[k * n + i] - p).norm(), expected[k], 1e-12);
      EXPECT_NEAR(layer.points[k * n + i].head<2>().norm(), radius - expected[k], 2e-3 * radius);
    }
    ++checked;
  }
  EXPECT_GT(checked, 300u);
  // Ring points stay in their cap's plane to round-off.
  for (const geometry::Quad& quad : layer.quads)
    for (const std::int32_t v : quad) {
      const double z = layer.points[static_cast<std::size_t>(v)].z();
      EXPECT_LT(std::min(std::abs(z), std::abs(z - 24 * step)), 1e-12);
    }
  EXPECT_EQ(layer.quads.size(), 2u * 3u * around);
}

TEST(BoundaryLayer, KeepsTheWallBitForBitAndDoesNotDependOnThreads) {
  const geometry::FacedSurface surface = remeshed(geometry::y_junction(8.0, 8.0, 2.0, 1.5, 70.0), 0.35);
  BoundaryLayerOptions options;
  options.layers = 4;
  options.thickness = 0.5;
  const BoundaryLayer layer = boundary_layer(surface, options);
  EXPECT_TRUE(std::equal(layer.wall.points.begin(), layer.wall.points.end(), layer.points.begin()));
  EXPECT_TRUE(std::equal(layer.wall.points.begin(), layer.wall.points.end(), surface.mesh.points.begin()));
  const int threads = core::max_threads();
  core::set_max_threads(1);
  const BoundaryLayer alone = boundary_layer(surface, options);
  core::set_max_threads(threads);
  EXPECT_EQ(alone.points, layer.points);
  EXPECT_EQ(alone.inner.mesh.triangles, layer.inner.mesh.triangles);
}

void expect_valid(const BoundaryLayer& layer) {
  EXPECT_EQ(layer.report.inverted, 0u);
  EXPECT_GE(layer.report.min_scaled_jacobian, 0.1);
  const SurfaceQuality inner = surface_quality(layer.inner.mesh);
  EXPECT_EQ(inner.self_intersections + inner.open_edges + inner.non_manifold_edges, 0u);
  double prisms = 0.0;
  for (const geometry::Prism& prism : layer.prisms) {
    PrismCorners p;
    for (std::size_t i = 0; i < 6; ++i) p[i] = layer.points[static_cast<std::size_t>(prism[i])];
    prisms += prism_volume(p);
  }
  geometry::TriMesh outer = layer.wall;  // closed over its rings by the inner caps and the layers' sides
  outer.points = layer.points;
  const auto n = static_cast<std::int32_t>(layer.wall.points.size());
  const auto total = static_cast<std::int32_t>(layer.points.size());
  outer.points.insert(outer.points.end(), layer.inner.mesh.points.begin() + n, layer.inner.mesh.points.end());
  for (std::size_t i = layer.wall.triangles.size(); i < layer.inner.mesh.triangles.size(); ++i) {
    geometry::Triangle t = layer.inner.mesh.triangles[i];
    for (std::int32_t& v : t) v = v < n ? total - n + v : total + v - n;
    outer.triangles.push_back(t);
  }
  for (const geometry::Quad& q : layer.quads) {
    outer.triangles.push_back({q[0], q[1], q[2]});
    outer.triangles.push_back({q[0], q[2], q[3]});
  }
  const double whole = geometry::volume(outer);
  EXPECT_NEAR(prisms + geometry::volume(layer.inner.mesh), whole, 1e-9 * whole);
}

struct Setting {
  int layers;
  double thickness;
};
constexpr Setting settings[] = {{2, 0.25}, {4, 0.5}, {3, 1.0}, {5, 0.6}};

void expect_all_settings_valid(const geometry::FacedSurface& surface) {
  for (const Setting& s : settings) {
    SCOPED_TRACE(std::to_string(s.layers) + " x " + std::to_string(s.thickness));
    BoundaryLayerOptions options;
    options.layers = s.layers;
    options.thickness = s.thickness;
    const BoundaryLayer layer = boundary_layer(surface, options);
    expect_valid(layer);
    if (s.thickness == 0.25) {
      EXPECT_GE(layer.report.full_share, 0.95);
    }
  }
}

TEST(BoundaryLayer, IsValidInAnAortaLikeFork) {
  expect_all_settings_valid(remeshed(geometry::y_junction(40.0, 40.0, 10.0, 7.0, 50.0), 1.0));
}

TEST(BoundaryLayer, IsValidInAForkOfNarrowAngle) {
  expect_all_settings_valid(remeshed(geometry::y_junction(8.0, 14.0, 2.0, 1.4, 25.0), 0.3));
}

/// What the surfaces here demand: points at the thickness asked for along the wall's normals do not do.
TEST(BoundaryLayer, EqualThicknessAlongNormalsInvertsPrismsThere) {
  const geometry::FacedSurface surface = remeshed(geometry::y_junction(8.0, 14.0, 2.0, 1.4, 25.0), 0.3);
  BoundaryLayerOptions options;
  options.layers = 1;
  options.thickness = 1.0;
  const BoundaryLayer layer = boundary_layer(surface, options);
  const std::vector<Vec3> normals = geometry::vertex_normals(layer.wall);
  std::size_t below = 0;
  for (const geometry::Triangle& t : layer.wall.triangles) {
    PrismCorners p;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto v = static_cast<std::size_t>(t[i]);
      p[i] = layer.wall.points[v] - layer.report.wanted_mm[v] * normals[v];
      p[i + 3] = layer.wall.points[v];
    }
    below += prism_scaled_jacobian(p) < 0.1 ? 1 : 0;
  }
  EXPECT_GT(below, 0u);
}

/// A thorn of the wall: too sharp for the bound at any thickness, so that the prisms there are as good as
/// they can be, and told; or overhanging, so that no direction sees all of its sides.
TEST(BoundaryLayer, TellsWhereTheWallIsTooSharp) {
  geometry::FacedSurface thorny = structured_tube(20, 1.5, 0.4, 24);
  thorny.mesh.points[20 * 12].x() = -0.5;
  const BoundaryLayer layer = boundary_layer(thorny);
  EXPECT_EQ(layer.report.inverted, 0u);
  EXPECT_LT(layer.report.min_scaled_jacobian, 0.1);
  EXPECT_GT(layer.report.min_scaled_jacobian, 0.0);
  ASSERT_FALSE(layer.report.warnings.empty());
  EXPECT_NE(layer.report.warnings.back().find("folds so sharply, or has such a needle, near ("),
            std::string::npos);
}

TEST(BoundaryLayer, NamesAPlaceThatNoDirectionSees) {
  const LayerWall wall = layer_wall(structured_tube(12, 1.5, 0.7, 8));
  std::vector<SightCone> cones = sight_cones(wall);
  EXPECT_EQ(march_directions(wall, cones).size(), wall.mesh.points.size());
  cones[12 * 4] = {Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY()};  // two triangles back to back
  try {
    march_directions(wall, cones);
    ADD_FAILURE() << "no error";
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("near (1.50, 0.00, 2.80) mm"), std::string::npos)
        << error.what();
  }
}

TEST(BoundaryLayer, IsValidInATightStenosis) {
  expect_all_settings_valid(remeshed(geometry::stenosed_tube(20.0, 1.6, 0.85, 10.0, 5.0), 0.15));
}

TEST(BoundaryLayer, IsValidInACoronaryTree) {
  expect_all_settings_valid(remeshed(geometry::coronary_like_tree(), 0.3));
}

TEST(BoundaryLayer, ThickerThanTheVesselIsThinnedAndTold) {
  BoundaryLayerOptions options;
  options.layers = 6;
  options.thickness = 3.0;  // edges of 0.4 radii: 1.2 radii
  const BoundaryLayer layer = boundary_layer(remeshed(geometry::straight_tube(12.0, 1.5), 0.3), options);
  expect_valid(layer);
  EXPECT_LT(layer.report.full_share, 0.1);
  ASSERT_FALSE(layer.report.warnings.empty());
  EXPECT_NE(layer.report.warnings[0].find("thinner than asked"), std::string::npos);
  EXPECT_NE(layer.report.warnings[0].find("near ("), std::string::npos);
  ASSERT_FALSE(layer.report.thin_places.empty());
  for (const ThinPlace& place : layer.report.thin_places) EXPECT_LT(place.thickness_mm, place.wanted_mm);
  for (const double t : layer.report.thickness_mm) {
    EXPECT_GT(t, 0.0);
    EXPECT_LT(t, 0.6 * 1.5);  // half of the radius and what facets add
  }
}

TEST(BoundaryLayer, RefusesBadInputAndObeysCancel) {
  const geometry::FacedSurface surface = structured_tube(12, 1.5, 0.7, 8);
  for (const int layers : {0, 21}) {
    BoundaryLayerOptions bad;
    bad.layers = layers;
    EXPECT_THROW(boundary_layer(surface, bad), InvalidInput);
  }
  for (const double thickness : {0.0, -1.0, 3.1, std::nan("")}) {
    BoundaryLayerOptions bad;
    bad.thickness = thickness;
    EXPECT_THROW(boundary_layer(surface, bad), InvalidInput);
  }
  EXPECT_THROW(boundary_layer({}), InvalidInput);
  auto open = surface;
  open.mesh.triangles.pop_back();
  EXPECT_THROW(boundary_layer(open), InvalidInput);  // ids no longer match
  open.face_ids.pop_back();
  EXPECT_THROW(boundary_layer(open), GeometryError);
  auto inward = surface;
  for (auto& t : inward.mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_THROW(boundary_layer(inward), GeometryError);
  auto crossing = surface;
  crossing.mesh.points[12 * 4] = Vec3(-2.0, 0.0, 2.8);  // through the wall across
  EXPECT_THROW(boundary_layer(crossing), GeometryError);
  auto capless = surface;
  capless.face_ids.assign(capless.face_ids.size(), 1);
  EXPECT_THROW(boundary_layer(capless), InvalidInput);
  auto bulging = surface;
  bulging.mesh.points[3].z() -= 0.8;  // of a ring
  EXPECT_THROW(boundary_layer(bulging), GeometryError);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(boundary_layer(surface, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
