#include "ostia/evaluation/axis_error.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::evaluation {
namespace {

using geometry::Centerline;
using geometry::Vec3;

Centerline line(const Vec3& offset, double radius, int points = 101) {
  Centerline out;
  for (int i = 0; i < points; ++i) {
    out.points.push_back(Vec3(0, 0, 0.1 * i) + offset);
    out.radius.push_back(radius);
  }
  geometry::complete(out);
  return out;
}

TEST(AxisError, ParallelLinesAreTheirDistanceApart) {
  const AxisSummary s = summarize(compare_axes(line(Vec3::Zero(), 2.0), line(Vec3(0.3, 0.4, 0), 2.2)));
  EXPECT_EQ(s.points, 101u);
  EXPECT_NEAR(s.mean_mm, 0.5, 1e-12);
  EXPECT_NEAR(s.max_mm, 0.5, 1e-12);
  EXPECT_NEAR(s.radius_median_relative, 0.1, 1e-12);
}

TEST(AxisError, InterpolatesTheReferenceBetweenItsPoints) {
  Centerline reference = line(Vec3::Zero(), 1.0, 2);
  reference.radius[1] = 3.0;
  const auto d = compare_axes(reference, line(Vec3(0, 0, 0.05), 2.0, 2));
  EXPECT_NEAR(d[0].reference_radius_mm, 2.0, 1e-12);
  EXPECT_NEAR(d[0].reference_abscissa_mm, 0.05, 1e-12);
}

TEST(AxisError, LeavesOutWhatDoesNotCount) {
  const auto middle = [](const AxisDeviation& d) {
    return d.reference_abscissa_mm > 2.0 && d.reference_abscissa_mm < 3.0;
  };
  EXPECT_EQ(compare_axes(line(Vec3::Zero(), 2.0), line(Vec3::Zero(), 2.0), middle).size(), 9u);
  EXPECT_THROW(summarize({}), InvalidInput);
  EXPECT_THROW(compare_axes(Centerline{}, line(Vec3::Zero(), 1.0)), InvalidInput);
}

}  // namespace
}  // namespace ostia::evaluation
