// Surfaces with faults that real data have.

#include "support/shapes.h"

#include "ostia/centerline/extract_centerlines.h"
#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::centerline {
namespace {

using ::testing::AllOf;
using testing::axis_error;
using ::testing::HasSubstr;

geometry::AnalyticShape tube() {
  return geometry::straight_tube(12, 1.0);
}
TriMesh tube_surface() {
  return geometry::surface_of(tube(), 0.25, true);
}

template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(BadSurfaces, needles_do_not_matter) {
  // Each tenth triangle is cut in two by a point close to a corner: needles with angles under a tenth of a
  // degree.
  TriMesh mesh = tube_surface();
  const std::size_t count = mesh.triangles.size();
  for (std::size_t t = 0; t < count; t += 10) {
    const geometry::Triangle tri = mesh.triangles[t];
    const auto at = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(tri[k])]; };
    const auto extra = static_cast<std::int32_t>(mesh.points.size());
    const Vec3 inner = 0.9990 * at(0) + 0.0005 * at(1) + 0.0005 * at(2);
    mesh.points.push_back(inner);
    mesh.triangles[t] = {tri[0], tri[1], extra};
    mesh.triangles.push_back({tri[1], tri[2], extra});
    mesh.triangles.push_back({tri[2], tri[0], extra});
  }
  const CenterlineResult result = extract_centerlines(mesh, std::nullopt, {});
  EXPECT_EQ(result.diagnostics.dropped_points, 0u);
  EXPECT_LT(axis_error(result.lines, tube()).max_mm, 0.01);
}

TEST(BadSurfaces, duplicated_points_are_joined) {
  const TriMesh mesh = tube_surface();
  TriMesh soup;
  for (const geometry::Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::int32_t>(soup.points.size());
    for (const std::int32_t v : t) soup.points.push_back(mesh.points[static_cast<std::size_t>(v)]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const CenterlineResult result = extract_centerlines(soup, std::nullopt, {});
  EXPECT_EQ(result.diagnostics.welded_points, soup.points.size() - mesh.points.size());
  EXPECT_LT(axis_error(result.lines, tube()).max_mm, 0.01);
}

TEST(BadSurfaces, a_hole_in_the_wall_is_bridged_and_reported) {
  const TriMesh mesh = tube_surface();
  std::vector<bool> keep(mesh.triangles.size(), true);
  for (std::size_t t = 0; t < keep.size(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : mesh.triangles[t]) middle += mesh.points[static_cast<std::size_t>(v)] / 3.0;
    if ((middle - Vec3(1, 0, 6)).norm() < 0.3) keep[t] = false;
  }
  const CenterlineResult result = extract_centerlines(geometry::subset(mesh, keep), std::nullopt, {});
  EXPECT_EQ(result.lines.size(), 1u);
  ASSERT_EQ(result.diagnostics.warnings.size(), 1u);
  EXPECT_THAT(result.diagnostics.warnings[0], HasSubstr("hole in the wall"));
  EXPECT_LT(axis_error(result.lines, tube()).max_mm, 0.05);
}

TEST(BadSurfaces, a_target_in_another_component_is_named) {
  TriMesh other = testing::capsule(6.0, 1.0, 0.3);
  for (Vec3& p : other.points) p.x() += 10.0;
  const TriMesh both = geometry::merged(tube_surface(), other);
  const std::string message = message_of([&] {
    extract_centerlines(both, Vec3(0, 0, 0), {Vec3(0, 0, 12), Vec3(10, 0, 3)});
  });
  EXPECT_THAT(message, AllOf(HasSubstr("target 1 (9.99"), HasSubstr("cannot be reached")));
}

TEST(BadSurfaces, a_target_outside_is_named) {
  const std::string message =
      message_of([&] { extract_centerlines(tube_surface(), std::nullopt, {Vec3(0, 5, 6)}); });
  EXPECT_THAT(message, AllOf(HasSubstr("target 0 (0, 5, 6) mm"), HasSubstr("outside")));
}

TEST(BadSurfaces, nothing_to_work_on_is_refused) {
  EXPECT_THROW(extract_centerlines({}, std::nullopt, {}), GeometryError);
  EXPECT_THROW(extract_centerlines(testing::capsule(4, 1, 0.4), std::nullopt, {}), InvalidInput);
  const TriMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
  EXPECT_THROW(extract_centerlines(flat, Vec3(0, 0, 0), {Vec3(1, 1, 0)}), GeometryError);
}

TEST(BadSurfaces, triangles_much_longer_than_the_vessel_is_wide) {
  const auto shape = geometry::helix_tube(10, 20, 0.75, 1.0);
  for (const double step : {2.0, 5.0}) {
    const TriMesh mesh = geometry::structured_surface(shape.tubes[0], 32, step);
    const CenterlineResult result = extract_centerlines(mesh, std::nullopt, {});
    // Chords of this length are off the bend by up to step^2 / (8 * 11) mm.
    EXPECT_LT(axis_error(result.lines, shape).mean_mm, step * step / 88.0) << step;
  }
  TriMesh box;
  for (int i = 0; i < 8; ++i) box.points.emplace_back((i & 1) * 10.0, (i >> 1 & 1) * 2.0, (i >> 2 & 1) * 2.0);
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  const CenterlineResult result = extract_centerlines(box, Vec3(1, 1, 1), {Vec3(9, 1, 1)});
  for (const Vec3& p : result.lines[0].points) EXPECT_LT((p - Vec3(p.x(), 1, 1)).norm(), 0.3);
}

TEST(BadSurfaces, few_points_around_are_enough) {
  const auto shape = tube();
  const CenterlineResult result =
      extract_centerlines(geometry::structured_surface(shape.tubes[0], 6, 0.5), std::nullopt, {});
  for (const Vec3& p : result.lines[0].points) EXPECT_LT(p.head<2>().norm(), 0.02);
}

}  // namespace
}  // namespace ostia::centerline
