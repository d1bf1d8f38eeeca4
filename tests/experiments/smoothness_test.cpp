#include "ostia/experiments/smoothness.h"

#include "experiment_schema.h"
#include "lumen/vtk_filters.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/experiments/smoothness_report.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/isosurface.h"
#include "ostia/geometry/mesh_topology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ostia::experiments {
namespace {

/// Two tubes that meet at a right angle at the origin, and one on its own.
std::vector<PhantomTube> three_tubes() {
  return {{"a", Vec3(-20.0, 0.0, 0.0), Vec3::Zero(), 2.0},
          {"b", Vec3::Zero(), Vec3(0.0, 20.0, 0.0), 1.5},
          {"lone", Vec3(0.0, 0.0, 10.0), Vec3(0.0, 0.0, 30.0), 1.0}};
}

geometry::TriMesh ball(double radius) {
  return geometry::isosurface([radius](const Vec3& p) { return p.norm() - radius; },
                              geometry::Box3(Vec3::Constant(-1.3 * radius), Vec3::Constant(1.3 * radius)),
                              0.2 * radius);
}

TEST(Smoothness, ATubeBendsAroundItAndNotAlongIt) {
  const geometry::TriMesh tube =
      geometry::structured_surface(geometry::straight_tube(20.0, 2.0).tubes.front(), 48, 0.3);
  const Bending bend = bending_of(tube, {});
  EXPECT_NEAR(bend.rms_kappa1, 0.0, 1e-6);
  EXPECT_NEAR(bend.rms_kappa2, 0.5, 0.005);
  EXPECT_NEAR(bend.trimmed_kappa1, 0.0, 1e-6);
  const Bending part = bending_of(tube, [&](const Vec3& p) { return p.z() > 5.0; });
  EXPECT_LT(part.vertices, bend.vertices);
  EXPECT_TRUE(std::isnan(bending_of(tube, [](const Vec3&) { return false; }).rms_kappa1));
}

// One vertex pushed in: it and its neighbours are far less than a hundredth of the area.
TEST(Smoothness, ASingleFaultIsTrimmed) {
  geometry::TriMesh tube =
      geometry::structured_surface(geometry::straight_tube(20.0, 2.0).tubes.front(), 48, 0.3);
  Vec3& point = tube.points[tube.points.size() / 2];
  point -= 0.2 * Vec3(point.x(), point.y(), 0.0).normalized();
  const Bending bend = bending_of(tube, {});
  EXPECT_GT(bend.rms_kappa1, 0.1);
  EXPECT_NEAR(bend.trimmed_kappa1, 0.0, 1e-6);
}

TEST(Smoothness, PlacesOfThePhantom) {
  const auto tubes = three_tubes();
  EXPECT_EQ(place_of(tubes, {1.0, 2.0, 0.0}, 5.0), PhantomPlace::joint);
  EXPECT_EQ(place_of(tubes, {-10.0, 2.0, 0.0}, 5.0), PhantomPlace::tube);
  EXPECT_EQ(place_of(tubes, {-18.0, 2.0, 0.0}, 5.0), PhantomPlace::end);
  EXPECT_EQ(place_of(tubes, {0.0, 0.0, 31.0}, 5.0), PhantomPlace::end);
}

TEST(Smoothness, DistanceToTheTubes) {
  const auto tubes = three_tubes();
  EXPECT_NEAR(distance_to_phantom(tubes, {-10.0, 0.0, 3.0}), 1.0, 1e-12);  // beside a
  EXPECT_NEAR(distance_to_phantom(tubes, {0.0, 10.0, 0.5}), -1.0, 1e-12);  // within b
  EXPECT_NEAR(distance_to_phantom(tubes, {0.0, 0.0, 33.0}), 3.0, 1e-12);   // before a lid
  EXPECT_NEAR(distance_to_phantom(tubes, {4.0, 0.0, 34.0}), 5.0, 1e-12);   // beyond its rim: 3, 4, 5
  EXPECT_NEAR(distance_to_phantom(tubes, {0.0, 0.0, 29.8}), -0.2, 1e-12);  // below a lid
  EXPECT_NEAR(distance_to_phantom(tubes, {3.0, -4.0, 0.0}), 3.0, 1e-12);   // a goes on as a ball of 2
}

// A Y of three lines: the node is shared, radii belong to the segments, the direction is the lines'. Radii
// that change evenly keep their values but at the ends, where the mean has one side alone.
TEST(Smoothness, ASkeletonIsANetwork) {
  centerline::SkeletonGraph skeleton;
  skeleton.nodes = {{5, Vec3::Zero()}, {7, Vec3(0, 0, -2)}, {9, Vec3(0.6, 0, 0.8)}, {11, Vec3(-0.6, 0, 0.8)}};
  skeleton.edges = {{1,
                     7,
                     5,
                     {Vec3(0, 0, -2), Vec3(0, 0, -1.5), Vec3(0, 0, -1), Vec3(0, 0, -0.5), Vec3::Zero()},
                     {2.2, 2.1, 2.0, 1.9, 1.8}},
                    {2, 5, 9, {Vec3::Zero(), Vec3(0.6, 0, 0.8)}, {1.0, 0.9}},
                    {3, 5, 11, {Vec3::Zero(), Vec3(-0.6, 0, 0.8)}, {1.2, 1.1}}};
  const geometry::VesselGraph graph = network_of(skeleton, 1.0);
  ASSERT_EQ(graph.points.size(), 5U);
  ASSERT_EQ(graph.edges.size(), 4U);
  EXPECT_EQ(graph.edges[0].from, 1);
  EXPECT_EQ(graph.edges[0].to, graph.edges[1].from);
  EXPECT_EQ(graph.edges[1].to, 0);
  EXPECT_NEAR((graph.points[4] - Vec3(0, 0, -1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(graph.edges[0].radius_to, 2.0, 1e-12);
  EXPECT_NEAR(graph.edges[1].radius_to, (1.8 + 0.5 * 1.9) / 1.5, 1e-12);
  EXPECT_EQ(graph.edges[2].from, 0);
  EXPECT_EQ(graph.edges[2].radius_from, 1.0);
  EXPECT_EQ(graph.points[static_cast<std::size_t>(graph.edges[3].to)], Vec3(-0.6, 0, 0.8));
}

TEST(VtkFilters, DecimateAndSmoothABall) {
  const geometry::TriMesh surface = ball(5.0);
  const geometry::TriMesh fewer = decimated_by_vtk(surface, 0.5);
  const double left = static_cast<double>(fewer.triangles.size());
  EXPECT_NEAR(left / static_cast<double>(surface.triangles.size()), 0.5, 0.02);
  const geometry::TriMesh smooth = smoothed_by_vtk(surface, 20, 0.1);
  EXPECT_EQ(smooth.triangles, surface.triangles);
  EXPECT_LT(geometry::volume(smooth), 0.99 * geometry::volume(surface));  // it shrinks
  EXPECT_GT(geometry::volume(smooth), 0.5 * geometry::volume(surface));
}

// One scan of the three tubes: what is reconstructed is smooth along the tubes, and near to the isosurface.
TEST(Smoothness, ReconstructedTubesAreSmootherThanTheirIsosurface) {
  SmoothnessOptions options;
  options.levels = 2;
  options.decimations = {0.5};
  options.smoothings = {20};
  const std::vector<SurfaceFigures> all =
      measure_smoothness(three_tubes(), {twelve_orientations()[6]}, options);
  ASSERT_EQ(all.size(), 8U);
  const SurfaceFigures& isosurface = all[0];
  EXPECT_EQ(isosurface.rms_mm, 0.0);
  for (const SurfaceFigures& s : {all[1], all[2]}) {
    EXPECT_EQ(s.kind, SurfaceKind::level);
    EXPECT_TRUE(s.closed);
    EXPECT_EQ(s.self_intersections, 0U);
    EXPECT_LT(s.tubes.rms_kappa1, 0.6 * isosurface.tubes.rms_kappa1);
    EXPECT_LT(s.tubes.rms_kappa1, 0.05);
    EXPECT_GT(s.rms_mm, 0.0);
    EXPECT_LT(s.rms_mm, 0.45);
    EXPECT_LT(s.true_rms_mm, 0.5);
  }
  const SurfaceFigures &circles = all[2], &areas = all[3], &ellipses = all[4];
  EXPECT_EQ(areas.kind, SurfaceKind::areas);
  EXPECT_EQ(ellipses.kind, SurfaceKind::elliptic);
  EXPECT_EQ(ellipses.parameter, 1.0);
  EXPECT_TRUE(ellipses.closed);
  EXPECT_EQ(ellipses.self_intersections, 0U);
  EXPECT_LT(ellipses.tubes_rms_mm, areas.tubes_rms_mm);
  EXPECT_LT(ellipses.tubes_rms_mm, circles.tubes_rms_mm);
  EXPECT_LT(all[5].triangles, isosurface.triangles);
  EXPECT_EQ(all[6].triangles, all[7].triangles);
  EXPECT_EQ(all[7].parameter, 20.0);
}

/// Two scans at two levels, and what VTK makes of the second.
std::vector<SurfaceFigures> made_figures() {
  std::vector<SurfaceFigures> out;
  for (const char* name : {"a", "b"})
    for (const auto& [kind, parameter] :
         std::vector<std::pair<SurfaceKind, double>>{{SurfaceKind::isosurface, 0.0},
                                                     {SurfaceKind::level, 0.0},
                                                     {SurfaceKind::level, 1.0},
                                                     {SurfaceKind::decimated, 0.7},
                                                     {SurfaceKind::smoothed, 0.0},
                                                     {SurfaceKind::smoothed, 30.0}}) {
      if (name[0] == 'a' && (kind == SurfaceKind::decimated || kind == SurfaceKind::smoothed)) continue;
      SurfaceFigures s;
      s.orientation = name;
      s.kind = kind;
      s.parameter = parameter;
      s.triangles = 1000 + out.size();
      s.tubes = s.wall = s.whole = {0.01 * static_cast<double>(out.size()), 0.5, 0.005, 0.5, 10};
      s.rms_mm = name[0] == 'a' ? 0.1 : 0.3;
      s.closed = true;
      out.push_back(s);
    }
  return out;
}

TEST(SmoothnessReport, SummarisesTheLevels) {
  const std::vector<LevelSummary> levels = summarize(made_figures());
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_EQ(levels[1].level, 1);
  EXPECT_EQ(levels[1].scans, 2U);
  EXPECT_NEAR(levels[1].mean_rms_mm, 0.2, 1e-12);
  EXPECT_EQ(levels[1].worst_rms_mm, 0.3);
  EXPECT_EQ(levels[1].worst_kappa1_tubes, 0.05);
  EXPECT_EQ(levels[1].not_closed, 0U);

  std::vector<SurfaceFigures> more = made_figures();
  more.push_back(more[2]);
  more.back().kind = SurfaceKind::elliptic;
  more.back().rms_mm = 0.05;
  const std::vector<LevelSummary> with = summarize(more);
  ASSERT_EQ(with.size(), 3U);
  EXPECT_EQ(with[1].worst_rms_mm, 0.3);
  EXPECT_EQ(with[2].kind, SurfaceKind::elliptic);
  EXPECT_EQ(with[2].worst_rms_mm, 0.05);
  EXPECT_EQ(name_of(more.back()), "L1 elliptic");
}

TEST(SmoothnessReport, WritesTablesAndPlots) {
  const auto folder = testing::temporary_folder("smoothness");
  const SmoothnessOptions options;
  write_smoothness_report(folder, made_figures(), options);
  for (const char* name : {"surfaces.csv", "report.html", "distance.png", "smoothness.png"})
    EXPECT_GT(std::filesystem::file_size(folder / name), 100U) << name;
  EXPECT_THAT(core::read_file(folder / "surfaces.csv"), ::testing::HasSubstr("b,S0 smoothed 30 times,1008,"));
  EXPECT_TRUE(fits_schema(smoothness_json(made_figures(), options, 2), "smoothness"));
  EXPECT_THAT(smoothness_text(made_figures()), ::testing::HasSubstr("S0 less 70 %"));
}

TEST(Smoothness, RefusesOptionsOutOfRangeAndCancels) {
  SmoothnessOptions options;
  options.levels = 0;
  EXPECT_THROW(measure_smoothness(three_tubes(), twelve_orientations(), options), InvalidInput);
  options = {};
  options.decimations = {1.0};
  EXPECT_THROW(validate(options), InvalidInput);
  options = {};
  options.sample_mm = 0.0;
  EXPECT_THROW(validate(options), InvalidInput);
  options = {};
  EXPECT_THROW(measure_smoothness(three_tubes(), std::vector<Orientation>{}, options), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(measure_smoothness(three_tubes(), twelve_orientations(), options, task), Cancelled);
}

}  // namespace
}  // namespace ostia::experiments
