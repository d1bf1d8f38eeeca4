#include "ostia/geometry/centerline.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::geometry {
namespace {

Centerline bent_line() {
  Centerline line;
  line.points = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(4, 0.5, 0), Vec3(5, 2.5, 0)};
  line.radius = {2.0, 1.8, 1.5, 1.0};
  return line;
}

TEST(Centerline, CompleteFillsAbscissaAndFrames) {
  Centerline line = bent_line();
  complete(line);
  ASSERT_EQ(line.abscissa.size(), 4u);
  ASSERT_EQ(line.frames.size(), 4u);
  EXPECT_EQ(line.abscissa[0], 0.0);
  EXPECT_DOUBLE_EQ(line.abscissa[1], 2.0);
  EXPECT_LT((line.frames[3].normal - Vec3::UnitZ()).norm(), 1e-12);
}

TEST(Centerline, CompleteTakesTheFirstNormalGiven) {
  Centerline line = bent_line();
  complete(line, Vec3(0, 0, -2));
  EXPECT_LT((line.frames[0].normal + Vec3::UnitZ()).norm(), 1e-12);
}

TEST(Centerline, ResampleIsLinearInRadiusAndKeepsEnds) {
  Centerline line;
  line.points = {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 10, 0)};
  line.radius = {3.0, 2.0, 0.2};
  complete(line, Vec3::UnitX());
  const Centerline fine = resample(line, 0.3);
  ASSERT_EQ(fine.size(), 35u);
  EXPECT_EQ(fine.points.back(), line.points.back());
  EXPECT_EQ(fine.radius.back(), 0.2);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const double s = fine.abscissa[i];
    EXPECT_NEAR(s, fine.points[i].y(), 1e-12);
    EXPECT_NEAR(fine.radius[i], s < 1.0 ? 3.0 - s : 2.0 - 0.2 * (s - 1.0), 1e-12);
    EXPECT_LT((fine.frames[i].normal - Vec3::UnitX()).norm(), 1e-12);  // the first normal is kept
  }
}

TEST(Centerline, RefusesBadInput) {
  Centerline line = bent_line();
  line.radius.pop_back();
  EXPECT_THROW(resample(line, 0.1), InvalidInput);
  EXPECT_THROW(resample(bent_line(), -1.0), InvalidInput);
  Centerline point;
  point.points = {Vec3::Zero()};
  EXPECT_THROW(complete(point), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
