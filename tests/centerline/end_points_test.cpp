#include "ostia/centerline/end_points.h"

#include "support/shapes.h"

#include "ostia/centerline/lumen_surface.h"
#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::centerline {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;

struct Tube {
  LumenSurface surface =
      prepare_lumen(geometry::surface_of(geometry::tapered_tube(10, 1.5, 1.0), 0.25, true));
  InnerVoronoi diagram = inner_voronoi(surface.sampled, surface.on_border, surface.only_in_caps);
};

const Tube& end_points_tube() {
  static const Tube t;
  return t;
}

template <class Call>
std::string end_points_message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(EndPoints, takes_the_wider_end_as_source) {
  const EndPoints ends =
      choose_ends(end_points_tube().diagram, end_points_tube().surface.openings, std::nullopt, {});
  EXPECT_NEAR(ends.source.position.z(), 0.0, 1e-6);
  ASSERT_EQ(ends.targets.size(), 1u);
  EXPECT_NEAR(ends.targets[0].position.z(), 10.0, 1e-6);
  EXPECT_TRUE(ends.targets[0].at_opening);
}

TEST(EndPoints, a_given_source_at_the_narrow_end_leaves_the_wide_one_as_target) {
  const EndPoints ends =
      choose_ends(end_points_tube().diagram, end_points_tube().surface.openings, Vec3(0.1, 0.1, 9.9), {});
  EXPECT_NEAR(ends.source.position.z(), 10.0, 1e-6);
  ASSERT_EQ(ends.targets.size(), 1u);
  EXPECT_NEAR(ends.targets[0].position.z(), 0.0, 1e-6);
}

TEST(EndPoints, moves_a_point_on_the_wall_to_the_axis) {
  const EndPoints ends = choose_ends(end_points_tube().diagram, end_points_tube().surface.openings,
                                     std::nullopt, {Vec3(1.2, 0.0, 6.0)});
  EXPECT_FALSE(ends.targets[0].at_opening);
  EXPECT_LT(ends.targets[0].position.head<2>().norm(), 0.15);
  EXPECT_NEAR(ends.targets[0].position.z(), 6.0, 0.6);
}

TEST(EndPoints, names_a_point_outside) {
  const std::string message = end_points_message_of([] {
    choose_ends(end_points_tube().diagram, end_points_tube().surface.openings, std::nullopt,
                {Vec3(0, 0, 5), Vec3(7.5, 0, 5)});
  });
  EXPECT_THAT(message, HasSubstr("target 1 (7.5, 0, 5) mm lies outside"));
}

TEST(EndPoints, refuses_source_and_target_in_one_place) {
  EXPECT_THROW(choose_ends(end_points_tube().diagram, end_points_tube().surface.openings, Vec3(0, 0, 0),
                           {Vec3(0.1, 0, 0)}),
               GeometryError);
}

TEST(EndPoints, asks_for_points_where_nothing_is_open) {
  const InnerVoronoi diagram = inner_voronoi(testing::capsule(6.0, 1.0, 0.3));
  EXPECT_THROW(choose_ends(diagram, {}, std::nullopt, {}), InvalidInput);
  EXPECT_THROW(choose_ends(diagram, {}, Vec3(0, 0, 0), {}), InvalidInput);
  EXPECT_EQ(choose_ends(diagram, {}, Vec3(0, 0, 0), {Vec3(0, 0, 6)}).targets.size(), 1u);
}

TEST(EndPoints, a_hole_in_the_wall_is_no_end) {
  std::vector<Opening> openings = end_points_tube().surface.openings;
  openings.push_back({Vec3(1.25, 0.0, 5.0), 0.3});
  const EndPoints ends = choose_ends(end_points_tube().diagram, openings, std::nullopt, {});
  EXPECT_EQ(ends.targets.size(), 1u);
  ASSERT_EQ(ends.warnings.size(), 1u);
  EXPECT_THAT(ends.warnings[0], HasSubstr("(1.25, 0, 5) mm"));
}

}  // namespace
}  // namespace ostia::centerline
