#include "shared_data.h"
#include "support/read_files.h"

#include "ostia/centerline/extract_centerlines.h"
#include "ostia/geometry/polyline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::centerline {
namespace {

struct Agreement {
  double mean_mm = 0.0;
  double mean_radius = 0.0;  // relative
};

Agreement compare(const std::vector<Centerline>& lines, const std::vector<Vec3>& points,
                  const std::vector<double>& radii) {
  Agreement result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double best = 1e9, radius = 0.0;
    for (const Centerline& line : lines) {
      const auto place = geometry::closest(line.points, points[i]);
      const double distance = (place.point - points[i]).norm();
      if (distance >= best) continue;
      best = distance;
      radius = line.radius[place.segment];
    }
    result.mean_mm += best / static_cast<double>(points.size());
    if (!radii.empty())
      result.mean_radius += std::abs(radius / radii[i] - 1.0) / static_cast<double>(points.size());
  }
  return result;
}

TEST(RealCenterlines, of_a_carotid_agree_with_the_given_ones) {
  OSTIA_REQUIRE_SHARED(surface, "vessels/carotid-jackyko/lumen.stl");
  OSTIA_REQUIRE_SHARED(reference, "vessels/carotid-jackyko/centerline.vtp");
  const CenterlineResult result = extract_centerlines(testing::read_stl(surface), std::nullopt, {});
  const Centerline given = testing::read_compressed_vtp_points(reference);
  ASSERT_EQ(given.size(), 478u);
  const Agreement agreement = compare(result.lines, given.points, given.radius);
  EXPECT_EQ(result.lines.size(), 2u);
  EXPECT_LT(agreement.mean_mm, 0.2);
  EXPECT_LT(agreement.mean_radius, 0.03);
  EXPECT_FALSE(geometry::find_fault(result.tree).has_value());
}

TEST(RealCenterlines, of_the_capped_non_manifold_carotid_between_given_points) {
  OSTIA_REQUIRE_SHARED(open, "vessels/carotid-jackyko/lumen.stl");
  OSTIA_REQUIRE_SHARED(capped, "vessels/carotid-jackyko/leftlumen_capped.stl");
  const CenterlineResult by_ends = extract_centerlines(testing::read_stl(open), std::nullopt, {});
  // The capped surface is cut elsewhere: points three millimetres inside the ends lie in both.
  std::vector<Vec3> targets;
  for (const Centerline& line : by_ends.lines)
    targets.push_back(geometry::at_abscissa(line.points, line.abscissa.back() - 3.0).point);
  const Vec3 source = geometry::at_abscissa(by_ends.lines[0].points, 3.0).point;
  const CenterlineResult result = extract_centerlines(testing::read_stl(capped), source, targets);
  // The three millimetres left out at each end count with up to 3 mm each.
  EXPECT_LT(compare(result.lines, by_ends.lines[0].points, {}).mean_mm, 0.5);
}

TEST(RealCenterlines, of_a_vessel_with_an_aneurysm) {
  OSTIA_REQUIRE_SHARED(surface, "vessels/aneurysm-v4a/aneurysm_vascular_model.stl");
  const CenterlineResult result = extract_centerlines(testing::read_stl(surface), std::nullopt, {});
  EXPECT_FALSE(geometry::find_fault(result.tree).has_value());
  EXPECT_EQ(result.diagnostics.dropped_points, 0u);
  for (const double radius : result.end_radii) EXPECT_GT(radius, 0.5);
}

TEST(RealCenterlines, of_a_coronary_phantom_follow_the_given_ones) {
  OSTIA_REQUIRE_SHARED(surface, "coronary/xra-phantom/phantom-tri3-coarse.stl");
  OSTIA_REQUIRE_SHARED(reference, "coronary/xra-phantom/centerlines.vtk");
  const CenterlineResult result = extract_centerlines(testing::read_stl(surface), std::nullopt, {});
  EXPECT_EQ(result.lines.size(), 6u);
  EXPECT_LT(compare(result.lines, testing::read_ascii_vtk_points(reference), {}).mean_mm, 0.5);
}

}  // namespace
}  // namespace ostia::centerline
