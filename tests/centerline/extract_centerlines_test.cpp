#include "ostia/centerline/extract_centerlines.h"

#include "support/shapes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

namespace ostia::centerline {
namespace {

using testing::axis_error;
using testing::AxisError;
using ::testing::HasSubstr;

const geometry::AnalyticShape& coronary() {
  static const geometry::AnalyticShape shape = geometry::coronary_like_tree();
  return shape;
}

const TriMesh& coronary_surface() {
  static const TriMesh mesh = geometry::surface_of(coronary(), 0.25, true);
  return mesh;
}

const CenterlineResult& coronary_lines() {
  static const CenterlineResult result = extract_centerlines(coronary_surface(), std::nullopt, {});
  return result;
}

TEST(ExtractCenterlines, are_the_true_axes_of_a_coronary_like_tree) {
  const CenterlineResult& result = coronary_lines();
  ASSERT_EQ(result.lines.size(), 4u);
  const AxisError error = axis_error(result.lines, coronary());
  EXPECT_GT(error.points, 800u);
  EXPECT_LT(error.mean_mm, 0.003);
  EXPECT_LT(error.max_mm, 0.02);
  EXPECT_LT(error.max_radius, 0.005);
  EXPECT_LT(error.mean_turn_deg, 2.0);
}

TEST(ExtractCenterlines, make_a_sound_tree) {
  const CenterlineResult& result = coronary_lines();
  EXPECT_FALSE(geometry::find_fault(result.tree).has_value()) << *geometry::find_fault(result.tree);
  EXPECT_EQ(geometry::roots(result.tree).size(), 1u);
  EXPECT_EQ(geometry::ends(result.tree).size(), 4u);
  EXPECT_EQ(result.tree.segments.size(), 7u);
  EXPECT_EQ(result.tree.vessels[0].name, "vessel_1");
  EXPECT_EQ(result.diagnostics.dropped_points, 0u);
  EXPECT_GT(result.diagnostics.inner_cells, 10000u);
  EXPECT_GT(result.diagnostics.polygons, 10000u);
  EXPECT_TRUE(result.diagnostics.warnings.empty());
}

TEST(ExtractCenterlines, reach_the_barycentres_of_the_ends) {
  const CenterlineResult& result = coronary_lines();
  EXPECT_LT(result.source.norm(), 1e-2);
  EXPECT_NEAR(result.source_radius, 2.0, 0.05);
  for (const geometry::AnalyticTube& tube : coronary().tubes) {
    double nearest = 1e9;
    for (const Vec3& end : result.ends) nearest = std::min(nearest, (end - tube.axis.points.back()).norm());
    EXPECT_LT(nearest, 1e-2) << tube.name;
  }
  for (const double radius : result.end_radii) EXPECT_NEAR(radius, 0.8, 0.03);
}

TEST(ExtractCenterlines, share_their_points_upstream_of_a_bifurcation) {
  const auto& lines = coronary_lines().lines;
  for (std::size_t a = 0; a < lines.size(); ++a)
    for (std::size_t b = a + 1; b < lines.size(); ++b) {
      std::size_t same = 0;
      while (lines[a].points[same] == lines[b].points[same]) ++same;
      EXPECT_GT(lines[a].abscissa[same - 1], 9.0);
      // Once apart they do not meet again.
      EXPECT_GT((lines[a].points.back() - lines[b].points.back()).norm(), 3.0);
    }
}

TEST(ExtractCenterlines, are_smooth_at_bifurcations) {
  for (const Centerline& line : coronary_lines().lines)
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      const Vec3 a = (line.points[i] - line.points[i - 1]).normalized();
      const Vec3 b = (line.points[i + 1] - line.points[i]).normalized();
      EXPECT_LT(std::acos(std::min(1.0, a.dot(b))) * 180.0 / M_PI, 15.0);
    }
}

TEST(ExtractCenterlines, do_not_depend_on_threads_or_earlier_calls) {
  const TriMesh mesh = geometry::surface_of(geometry::y_junction(10, 10, 1.5, 1.1, 70), 0.3, true);
  core::set_max_threads(1);
  const CenterlineResult one = extract_centerlines(mesh, std::nullopt, {});
  core::set_max_threads(4);
  const CenterlineResult four = extract_centerlines(mesh, std::nullopt, {});
  core::set_max_threads(0);
  EXPECT_TRUE(testing::identical(one, four));
}

TEST(ExtractCenterlines, of_a_raw_marching_cubes_surface) {
  const auto shape = geometry::helix_tube(8, 15, 0.75, 1.2);
  const CenterlineResult result =
      extract_centerlines(geometry::raw_surface_of(shape, 0.25, true), std::nullopt, {});
  const AxisError error = axis_error(result.lines, shape);
  EXPECT_GT(error.points, 200u);
  EXPECT_LT(error.mean_mm, 0.003);
  EXPECT_LT(error.mean_radius, 0.01);
  EXPECT_LT(error.mean_turn_deg, 2.0);
}

TEST(ExtractCenterlines, pass_a_stenosis) {
  const auto shape = geometry::stenosed_tube(20, 1.5, 0.7, 10, 6);
  const CenterlineResult result =
      extract_centerlines(geometry::surface_of(shape, 0.2, true), std::nullopt, {});
  const AxisError error = axis_error(result.lines, shape);
  EXPECT_LT(error.max_mm, 0.02);
  double narrowest = 1e9;
  for (const double r : result.lines[0].radius) narrowest = std::min(narrowest, r);
  EXPECT_NEAR(narrowest, 0.45, 0.01);
}

TEST(ExtractCenterlines, of_a_closed_tube_between_its_poles) {
  const TriMesh mesh = testing::capsule(12.0, 1.0, 0.25);
  const CenterlineResult result = extract_centerlines(mesh, Vec3(0, 0, -1), {Vec3(0, 0, 13)});
  const Centerline& line = result.lines[0];
  EXPECT_LT((line.points.front() - Vec3(0, 0, 0)).norm(), 0.5);
  EXPECT_LT((line.points.back() - Vec3(0, 0, 12)).norm(), 0.5);
  for (std::size_t i = 15; i + 15 < line.size(); ++i) EXPECT_LT(line.points[i].head<2>().norm(), 0.01);
}

TEST(ExtractCenterlines, of_a_torus_go_the_short_way) {
  const TriMesh mesh = geometry::surface_of(geometry::torus(6.0, 1.0), 0.25, false);
  const CenterlineResult result = extract_centerlines(mesh, Vec3(6, 0, 0), {Vec3(0, 6, 0), Vec3(0, -6, 0)});
  for (const Centerline& line : result.lines) {
    EXPECT_NEAR(line.abscissa.back(), 0.5 * M_PI * 6.0, 0.3);
    for (std::size_t i = 15; i + 15 < line.size(); ++i)
      EXPECT_NEAR(line.points[i].head<2>().norm(), 6.0, 0.02);
  }
  EXPECT_EQ(geometry::roots(result.tree).size(), 1u);
}

TEST(ExtractCenterlines, of_a_structured_surface_with_cospherical_rings) {
  const auto shape = geometry::straight_tube(12, 1.0);
  const CenterlineResult result =
      extract_centerlines(geometry::structured_surface(shape.tubes[0], 24, 0.25), std::nullopt, {});
  const AxisError error = axis_error(result.lines, shape);
  EXPECT_EQ(result.diagnostics.dropped_points, 0u);
  EXPECT_GT(error.points, 50u);
  EXPECT_LT(error.max_mm, 0.003);
  EXPECT_LT(error.max_radius, 0.005);
}

TEST(ExtractCenterlines, a_target_on_the_way_to_another_has_a_line_but_no_vessel) {
  const TriMesh mesh = geometry::surface_of(geometry::straight_tube(12, 1.0), 0.3, true);
  const CenterlineResult result = extract_centerlines(mesh, Vec3(0, 0, 0), {Vec3(0, 0, 5), Vec3(0, 0, 12)});
  EXPECT_FALSE(geometry::find_fault(result.tree).has_value()) << *geometry::find_fault(result.tree);
  ASSERT_EQ(result.lines.size(), 2u);
  EXPECT_NEAR(result.lines[0].points.back().z(), 5.0, 0.3);
  EXPECT_NEAR(result.lines[1].points.back().z(), 12.0, 1e-6);
  ASSERT_EQ(result.tree.vessels.size(), 1u);
  EXPECT_EQ(result.tree.vessels[0].name, "vessel_2");
  ASSERT_EQ(result.diagnostics.warnings.size(), 1u);
  EXPECT_THAT(result.diagnostics.warnings[0], HasSubstr("target 0"));
}

TEST(ExtractCenterlines, names_and_voronoi_as_asked) {
  CenterlineOptions options;
  options.vessel_names = {"RCA"};
  options.keep_voronoi = true;
  options.step_mm = 0.5;
  const TriMesh mesh = geometry::surface_of(geometry::straight_tube(10, 1.0), 0.3, true);
  const CenterlineResult result = extract_centerlines(mesh, std::nullopt, {}, options);
  EXPECT_EQ(result.tree.vessels[0].name, "RCA");
  EXPECT_NEAR(static_cast<double>(result.lines[0].size()), 21.0, 1.0);
  EXPECT_EQ(result.voronoi.points.size(), result.diagnostics.inner_cells);
  EXPECT_EQ(result.voronoi.polygon_first.size(), result.diagnostics.polygons + 1);
  EXPECT_EQ(result.voronoi.arrival.size(), result.voronoi.points.size());
  options.vessel_names = {"RCA", "LAD"};
  EXPECT_THROW(extract_centerlines(mesh, std::nullopt, {}, options), InvalidInput);
}

TEST(ExtractCenterlines, refuse_bad_options) {
  const auto refused = [](auto change) {
    CenterlineOptions options;
    change(options);
    EXPECT_THROW(validate(options), InvalidInput);
  };
  refused([](CenterlineOptions& o) { o.step_mm = 0.0; });
  refused([](CenterlineOptions& o) { o.step_mm = NAN; });
  refused([](CenterlineOptions& o) { o.smoothing_radii = -1.0; });
  refused([](CenterlineOptions& o) { o.merge_fraction = 1.0; });
  EXPECT_NO_THROW(validate(CenterlineOptions{}));
}

TEST(ExtractCenterlines, are_cancelled_midway) {
  core::TaskContext task;
  std::jthread canceller([task] {
    while (task.progress() < 0.2) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    task.cancel();
  });
  EXPECT_THROW(extract_centerlines(coronary_surface(), std::nullopt, {}, {}, task), Cancelled);
  EXPECT_GE(task.progress(), 0.2);
}

}  // namespace
}  // namespace ostia::centerline
