#include "ostia/geometry/along.h"

#include <gtest/gtest.h>

#include <vector>

namespace ostia::geometry {
namespace {

struct At {
  double s = 0.0, value = 0.0;
};

double value_at(const std::vector<At>& values, double s) {
  return value_along(values, s, &At::s, &At::value);
}

TEST(Along, IsLinearBetweenValues) {
  const std::vector<At> values{{1.0, 10.0}, {2.0, 20.0}, {4.0, 0.0}};
  EXPECT_DOUBLE_EQ(value_at(values, 1.5), 15.0);
  EXPECT_DOUBLE_EQ(value_at(values, 2.0), 20.0);
  EXPECT_DOUBLE_EQ(value_at(values, 3.5), 5.0);
  EXPECT_EQ(place_along(std::vector<double>{0.0, 1.0, 2.0}, 1.25).index, 1u);
  EXPECT_DOUBLE_EQ(place_along(std::vector<double>{0.0, 1.0, 2.0}, 1.25).part, 0.25);
}

TEST(Along, EndsWithItsEnds) {
  const std::vector<At> values{{1.0, 10.0}, {2.0, 20.0}, {4.0, 0.0}};
  EXPECT_EQ(value_at(values, -7.0), 10.0);
  EXPECT_EQ(value_at(values, 99.0), 0.0);
  EXPECT_EQ(value_at({{1.0, 10.0}}, 5.0), 10.0);
}

TEST(Along, TakesTwoValuesOfOnePlace) {
  // Where one branch ends and the next begins.
  const std::vector<At> values{{0.0, 1.0}, {1.0, 0.9}, {1.0, 0.8}, {2.0, 0.7}};
  EXPECT_DOUBLE_EQ(value_at(values, 0.5), 0.95);
  EXPECT_DOUBLE_EQ(value_at(values, 1.5), 0.75);
  EXPECT_EQ(value_at({{1.0, 0.9}, {1.0, 0.8}}, 1.0), 0.9);
}

}  // namespace
}  // namespace ostia::geometry
