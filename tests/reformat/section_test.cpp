#include "ostia/reformat/section.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/isosurface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::reformat {
namespace {

constexpr double kPi = std::numbers::pi;

geometry::TriMesh sphere(double radius, double spacing) {
  const geometry::Box3 box(Vec3::Constant(-radius - 1), Vec3::Constant(radius + 1));
  return geometry::isosurface([=](const Vec3& p) { return p.norm() - radius; }, box, spacing);
}

/// Twice the signed area about the normal: positive when the line runs counter-clockwise seen against the
/// normal.
double turning(const std::vector<Vec3>& line, const Vec3& normal) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += line[i - 1].cross(line[i]).dot(normal);
  return sum;
}

TEST(Section, OfASphereIsACircleOfKnownLengthAndArea) {
  const auto lines = section(sphere(5.0, 0.2), Vec3(0, 0, 3), Vec3(0, 0, 2));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  EXPECT_NEAR(length(lines[0]), 2 * kPi * 4.0, 0.02);
  EXPECT_NEAR(enclosed_area(lines[0]), kPi * 16.0, 0.1);
  for (const Vec3& p : lines[0]) EXPECT_NEAR(p.z(), 3.0, 1e-9);
}

TEST(Section, KeepsTheInsideToTheLeftInThePicture) {
  Plane plane;
  plane.origin = {-6, -6, 0.1};
  plane.width = plane.height = 12;
  const auto lines = section(sphere(5.0, 0.5), plane);
  ASSERT_EQ(lines.size(), 1U);
  // v points down in the picture, so left-hand inside means clockwise about u x v.
  EXPECT_LT(turning(lines[0], plane.normal()), 0.0);
}

TEST(Section, AcrossBothLimbsOfATorusGivesTwoCircles) {
  const auto shape = geometry::torus(10.0, 2.0);
  const auto surface = geometry::structured_surface(shape.tubes.front(), 64, 0.25);
  const auto lines = section(surface, Vec3(0.05, 0, 0), Vec3::UnitX());
  ASSERT_EQ(lines.size(), 2U);
  for (const auto& line : lines) EXPECT_NEAR(enclosed_area(line), 4.0 * kPi, 0.05);
}

TEST(Section, ThroughTheOpenEndsGivesOpenLines) {
  const auto tube = geometry::structured_surface(geometry::straight_tube(10.0, 2.0).tubes.front(), 33, 0.5);
  const auto lines = section(tube, Vec3(0.3, 0, 0), Vec3::UnitX());
  ASSERT_EQ(lines.size(), 2U);
  for (const auto& line : lines) {
    EXPECT_NEAR(length(line), 10.0, 1e-6);
    EXPECT_NEAR(std::abs(line.front().z() - line.back().z()), 10.0, 1e-6);
  }
}

TEST(Section, VerticesInThePlaneMakeOneLineAndAPlaneThatMissesNone) {
  const auto tube = geometry::structured_surface(geometry::straight_tube(10.0, 2.0).tubes.front(), 32, 0.5);
  const auto lines = section(tube, Vec3(0, 0, 5), Vec3::UnitZ());  // a ring of vertices lies there
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(length(lines[0]), 2 * kPi * 2.0, 0.05);
  EXPECT_TRUE(section(tube, Vec3(0, 0, 50), Vec3::UnitZ()).empty());
  EXPECT_TRUE(section(geometry::TriMesh{}, Vec3::Zero(), Vec3::UnitZ()).empty());
}

TEST(Section, RefusesBadInput) {
  geometry::TriMesh mesh = sphere(2.0, 0.5);
  EXPECT_THROW(section(mesh, Vec3::Zero(), Vec3::Zero()), InvalidInput);
  EXPECT_THROW(section(mesh, Plane{}), InvalidInput);
  mesh.triangles.push_back({0, 1, static_cast<std::int32_t>(mesh.points.size())});
  EXPECT_THROW(section(mesh, Vec3::Zero(), Vec3::UnitX()), InvalidInput);
  mesh.triangles.pop_back();
  mesh.points[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(section(mesh, Vec3::Zero(), Vec3::UnitX()), InvalidInput);
}

}  // namespace
}  // namespace ostia::reformat
