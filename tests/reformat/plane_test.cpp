#include "ostia/reformat/plane.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ostia::reformat {
namespace {

imaging::Geometry sheared_grid() {
  imaging::Geometry grid;
  grid.size = {40, 30, 20};
  grid.spacing = {0.5, 0.6, 1.5};
  grid.origin = {-12.0, 7.0, 100.0};
  grid.direction = Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return grid;
}

TEST(Plane, WorldAndProjectionAreInverse) {
  const Plane plane = axial_plane(sheared_grid(), {1.0, 2.0, 110.0});
  const Vec2 pixel(12.25, 3.5);
  const PlanePoint back = project(plane, world(plane, pixel) + 2.5 * plane.normal());
  EXPECT_NEAR(back.picture_px.x(), pixel.x(), 1e-9);
  EXPECT_NEAR(back.picture_px.y(), pixel.y(), 1e-9);
  EXPECT_NEAR(back.distance_mm, 2.5, 1e-9);
}

TEST(Plane, StandardPlanesPassThroughThePointAndHangAsRadiologistsExpect) {
  const Vec3 position(1.0, 2.0, 110.0);
  const Plane axial = axial_plane(sheared_grid(), position);
  const Plane coronal = coronal_plane(sheared_grid(), position);
  const Plane sagittal = sagittal_plane(sheared_grid(), position);
  for (const Plane& plane : {axial, coronal, sagittal}) {
    EXPECT_NEAR(project(plane, position).distance_mm, 0.0, 1e-9);
    EXPECT_DOUBLE_EQ(plane.pixel_mm, 0.5);
  }
  EXPECT_EQ(patient_letters(axial.u) + patient_letters(axial.v), "LP");
  EXPECT_EQ(patient_letters(coronal.u) + patient_letters(coronal.v), "LI");
  EXPECT_EQ(patient_letters(sagittal.u) + patient_letters(sagittal.v), "PI");
  EXPECT_EQ(patient_letters(axial.normal()), "S");
}

TEST(Plane, StandardPlanesCoverTheWholeImageAndNoMore) {
  imaging::Geometry grid;
  grid.size = {10, 20, 30};
  grid.spacing = {1.0, 2.0, 3.0};
  const Plane axial = axial_plane(grid, {0, 0, 15});
  EXPECT_EQ(axial.width, 10);
  EXPECT_EQ(axial.height, 40);
  EXPECT_TRUE(axial.origin.isApprox(Vec3(-0.5, -1.0, 15.0)));
  const Plane coronal = coronal_plane(grid, {0, 4, 15}, 1.5);
  EXPECT_EQ(coronal.width, 7);    // 10 mm
  EXPECT_EQ(coronal.height, 60);  // 90 mm
  EXPECT_TRUE(coronal.origin.isApprox(Vec3(-0.5, 4.0, 88.5)));
}

TEST(Plane, CrossSectionIsCentredOnTheAxisAndNormalToIt) {
  const geometry::Centerline axis = geometry::torus(20.0, 2.0, 0.05).tubes.front().axis;
  for (const double s : {0.0, 7.123, 50.0, 100.0}) {
    const Plane plane = cross_section_plane(axis, s, 12.0, 0.1);
    const Vec3 middle = centre(plane);
    EXPECT_NEAR(middle.head<2>().norm(), 20.0, 1e-4);
    const Vec3 tangent = Vec3::UnitZ().cross(middle).normalized();
    EXPECT_NEAR(std::abs(plane.normal().dot(tangent)), 1.0, 1e-5);
    EXPECT_EQ(plane.width, 120);
  }
}

TEST(Plane, CrossSectionLooksDistally) {
  const geometry::Centerline axis = geometry::straight_tube(10.0, 2.0).tubes.front().axis;
  const Plane plane = cross_section_plane(axis, 4.0, 8.0, 0.2);
  EXPECT_TRUE(plane.normal().isApprox(Vec3::UnitZ(), 1e-9));
  EXPECT_TRUE(centre(plane).isApprox(Vec3(0, 0, 4), 1e-9));
  EXPECT_TRUE(centre(cross_section_plane(axis, 99.0, 8.0, 0.2)).isApprox(Vec3(0, 0, 10), 1e-9));
}

TEST(Plane, LettersNameObliqueDirectionsLargestFirst) {
  EXPECT_EQ(patient_letters({-1, 0, 0}), "R");
  EXPECT_EQ(patient_letters({0.1, -1, 0}), "A");
  EXPECT_EQ(patient_letters({0.6, -0.8, 0}), "AL");
  EXPECT_EQ(patient_letters({0, 0, 0}), "");
}

TEST(Plane, RefusesWhatCannotBePictured) {
  Plane plane;
  EXPECT_THROW(validate(plane), InvalidInput);  // no pixels
  plane.width = plane.height = 8;
  EXPECT_NO_THROW(validate(plane));
  plane.pixel_mm = 0.0;
  EXPECT_THROW(validate(plane), InvalidInput);
  plane.pixel_mm = 1.0;
  plane.v = Vec3(0.1, 1, 0);
  EXPECT_THROW(validate(plane), InvalidInput);
  plane.v = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(validate(plane), InvalidInput);
  EXPECT_THROW(axial_plane(imaging::Geometry{}, Vec3::Zero()), InvalidInput);
  EXPECT_THROW(axial_plane(sheared_grid(), Vec3::Zero(), 1e-7), InvalidInput);
  EXPECT_THROW(axial_plane(sheared_grid(), Vec3::Constant(INFINITY)), InvalidInput);
  EXPECT_THROW(cross_section_plane(geometry::Centerline{}, 0, 10, 0.1), InvalidInput);
}

}  // namespace
}  // namespace ostia::reformat
