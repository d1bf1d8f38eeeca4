// The box about a volume in 3D, as something to take hold of.

#include "ostia/view/volume_box.h"

#include "ostia/core/error.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace ostia::view {
namespace {

/// An image whose first axis runs to the feet, whose second to the left and whose third to the front.
imaging::Geometry exchanged_grid() {
  imaging::Geometry grid;
  grid.size = {51, 41, 31};
  grid.spacing = {2.0, 1.0, 0.5};
  grid.direction.col(0) = -Vec3::UnitZ();
  grid.direction.col(1) = Vec3::UnitX();
  grid.direction.col(2) = -Vec3::UnitY();
  grid.origin = {-20.0, 15.0, 100.0};
  return grid;
}

TEST(VolumeBox, FacesLieWhereTheSharesSay) {
  const imaging::Geometry grid = exchanged_grid();  // x from -20 to 20, y from 0 to 15, z from 0 to 100
  VolumeCrop crop;
  crop.low = {0.25, 0.0, 0.1};
  crop.high = {1.0, 0.8, 0.5};
  const auto faces = faces_of(crop, grid);
  const double at[] = {-10.0, 20.0, 0.0, 12.0, 10.0, 50.0}, whole[] = {40.0, 15.0, 100.0};
  for (std::size_t n = 0; n < 6; ++n) {
    const auto axis = static_cast<Eigen::Index>(n / 2);
    EXPECT_EQ(faces[n].axis, n / 2);
    EXPECT_EQ(faces[n].high, n % 2 == 1);
    EXPECT_NEAR(faces[n].middle[axis], at[n], 1e-9) << n;
    EXPECT_LT((faces[n].towards - Vec3::Unit(axis)).norm(), 1e-12) << n;
    EXPECT_NEAR(faces[n].whole_mm, whole[n / 2], 1e-9) << n;
  }
  EXPECT_LT((faces[0].middle - Vec3(-10.0, 6.0, 30.0)).norm(), 1e-9) << "in the middle of its side";
}

TEST(VolumeBox, StaysInThePatientWhenTheGridIsAnother) {
  const imaging::Geometry grid = exchanged_grid();
  imaging::Geometry part = grid;  // x from -10 to 20, y from 5 to 12.5, z from 20 to 80
  part.size = {31, 31, 16};
  part.origin = {-10.0, 12.5, 80.0};
  VolumeCrop crop;
  crop.low = {0.5, 0.0, 0.1};
  crop.high = {1.0, 0.6, 0.5};
  const VolumeCrop there = carried(crop, grid, part);
  EXPECT_NEAR(there.low[0], 1.0 / 3.0, 1e-9);  // x = 0
  EXPECT_EQ(there.high[0], 1.0);               // nothing was cut off
  EXPECT_EQ(there.low[1], 0.0);
  EXPECT_NEAR(there.high[1], 4.0 / 7.5, 1e-9);  // y = 9
  EXPECT_EQ(there.low[2], 0.0);                 // z = 10 lies below the part
  EXPECT_NEAR(there.high[2], 0.5, 1e-9);        // z = 50
  const VolumeCrop back = carried(there, part, grid);
  EXPECT_NEAR(back.low[0], crop.low[0], 1e-9);
  EXPECT_NEAR(back.high[1], crop.high[1], 1e-9);
  crop.high = {1.0, 1.0, 0.15};  // below the part: nothing would be left
  EXPECT_EQ(carried(crop, grid, part).low[2], 0.0);
  EXPECT_EQ(carried(crop, grid, part).high[2], 1.0);
}

TEST(VolumeBox, HasTwelveEdgesOfItsSizes) {
  const auto edges = edges_of({}, exchanged_grid());
  ASSERT_EQ(edges.size(), 12U);
  int count[3] = {0, 0, 0};
  for (const auto& edge : edges) {
    const Vec3 along = edge[1] - edge[0];
    Eigen::Index axis = 0;
    EXPECT_NEAR(along.cwiseAbs().maxCoeff(&axis), along.norm(), 1e-9);
    ++count[axis];
    EXPECT_NEAR(along.norm(), Vec3(40.0, 15.0, 100.0)[axis], 1e-9);
  }
  EXPECT_EQ(count[0], 4);
  EXPECT_EQ(count[1], 4);
  EXPECT_EQ(count[2], 4);
}

TEST(VolumeBox, AFaceMovesByMillimetresAndStopsAtTheImageAndAtTheOtherSide) {
  imaging::Geometry grid = exchanged_grid();
  grid.direction =
      Eigen::AngleAxisd(0.3, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix() * grid.direction;
  const VolumeCrop whole;
  for (std::size_t n = 0; n < 6; ++n) {
    const BoxFace before = faces_of(whole, grid)[n];
    const double inwards = before.high ? -3.0 : 3.0;
    const VolumeCrop moved = with_face_moved(whole, before, inwards);
    const auto after = faces_of(moved, grid);
    EXPECT_NEAR((after[n].middle - before.middle).dot(before.towards), inwards, 1e-9) << n;
    EXPECT_LT((after[n ^ 1U].middle - faces_of(whole, grid)[n ^ 1U].middle).norm(), 1e-9) << n;
    EXPECT_EQ(with_face_moved(whole, before, -inwards), whole) << "no further than the image";
    const VolumeCrop least = with_face_moved(whole, before, 1000.0 * inwards);
    EXPECT_NO_THROW(validate(least));
    EXPECT_NEAR(least.high[before.axis] - least.low[before.axis], 0.01, 1e-12);
  }
}

TEST(VolumeBox, NoBoxIsRefused) {
  VolumeCrop crop;
  crop.low[1] = 0.9;
  crop.high[1] = 0.2;
  EXPECT_THROW(faces_of(crop, exchanged_grid()), InvalidInput);
  EXPECT_THROW(edges_of(crop, exchanged_grid()), InvalidInput);
  EXPECT_THROW(with_face_moved(crop, {}, 1.0), InvalidInput);
}

}  // namespace
}  // namespace ostia::view
