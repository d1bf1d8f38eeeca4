#include "ray_scene.h"
#include "seen_pixels.h"
#include "test_shapes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/figure/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace ostia::figure {
namespace {

constexpr double kPi = std::numbers::pi;

RenderOptions small_picture() {
  RenderOptions options;
  options.width_px = 240;
  options.height_px = 200;
  return options;
}

double covered_pixels(const Raster& raster) {
  double sum = 0.0;
  for (std::size_t i = 3; i < raster.rgba.size(); i += 4) sum += raster.rgba[i] / 255.0;
  return sum;
}

TEST(Render, ABallsSilhouetteHasItsArea) {
  Scene scene;
  scene.meshes.push_back({.mesh = ball(10.0, 96, {120, -80, 640})});
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Camera camera = cameras::angiographic(25, -15);
    camera.projection = projection;
    const View view = fitted_view(scene, camera, 240, 200);
    double radius = 10.0;
    // In perspective the silhouette is the circle in which the tangent cone meets the plane of the focus.
    if (projection == Projection::perspective) {
      radius = 10.0 / std::sqrt(1.0 - std::pow(10.0 / view.focus_distance_mm, 2));
    }
    const double expected = kPi * std::pow(radius / view.mm_per_px, 2);
    EXPECT_NEAR(covered_pixels(render(scene, camera, small_picture())) / expected, 1.0, 0.01);
  }
}

TEST(Render, ATubesSilhouetteHasItsArea) {
  Scene scene;
  scene.tubes.push_back({.points = {{0, 0, 0}, {0, 0, 20}, {0, 0, 40}}, .radius_mm = {3.0}});
  Camera camera;
  camera.up = Vec3(0.3, 0.0, 1.0);  // along no row of pixels, where all samples would err alike
  const View view = fitted_view(scene, camera, 240, 200);
  const double expected = (40.0 * 6.0 + kPi * 9.0) / (view.mm_per_px * view.mm_per_px);
  EXPECT_NEAR(covered_pixels(render(scene, camera, small_picture())) / expected, 1.0, 0.01);
}

TEST(Render, LightComesFromTheViewerAndTheUpperLeft) {
  Scene scene;
  scene.meshes.push_back({.mesh = ball(10.0, 64), .color = {0.6, 0.6, 0.6}});
  const Raster raster = render(scene, {}, small_picture());
  const auto grey = [&](int x, int y) { return static_cast<int>(raster.pixel(x, y)[0]); };
  EXPECT_GT(grey(120, 100), grey(120, 175));
  EXPECT_GT(grey(120, 100), grey(195, 100));
  EXPECT_GT(grey(85, 60), grey(155, 140));
  EXPECT_EQ(raster.pixel(2, 2)[3], 0);
}

TEST(Render, AFilmHidesAsMuchAsItsOpacity) {
  Scene scene;
  scene.meshes.push_back({.mesh = sheet(10, 10, 0.0), .color = {1, 1, 1, 0.3}});
  RenderOptions options = small_picture();
  EXPECT_NEAR(render(scene, {}, options).pixel(120, 100)[3], 0.3 * 255, 1.0);
  scene.meshes.push_back({.mesh = sheet(10, 10, 5.0), .color = {1, 1, 1, 0.5}});
  EXPECT_NEAR(render(scene, {}, options).pixel(120, 100)[3], (1.0 - 0.7 * 0.5) * 255, 1.0);
  scene.meshes.push_back({.mesh = sheet(10, 10, 9.0), .color = {0, 0, 1}});
  const Raster all = render(scene, {}, options);
  EXPECT_EQ(all.pixel(120, 100)[3], 255);
  EXPECT_GT(all.pixel(120, 100)[2], all.pixel(120, 100)[0]);  // the blue one shines through
}

TEST(Render, WhatLiesInFrontHidesWhatLiesBehind) {
  Scene scene;
  scene.meshes.push_back({.mesh = sheet(10, 10, 5.0), .color = {1, 0, 0}});
  scene.meshes.push_back({.mesh = sheet(5, 5, 0.0), .color = {0, 0, 1}});
  const Raster raster = render(scene, {}, small_picture());
  EXPECT_GT(raster.pixel(120, 100)[2], 150);
  EXPECT_LT(raster.pixel(120, 100)[0], 80);
  EXPECT_GT(raster.pixel(50, 100)[0], 150);
}

TEST(Render, TrianglesKeepTheirOwnColours) {
  Scene scene;
  MeshActor actor{.mesh = sheet(10, 10)};
  actor.triangle_colors = {{1, 0, 0}, {0, 1, 0}};
  scene.meshes.push_back(actor);
  const Raster raster = render(scene, {}, small_picture());
  EXPECT_GT(raster.pixel(160, 150)[0], 150);  // lower right: the first
  EXPECT_GT(raster.pixel(80, 50)[1], 150);    // upper left: the second
}

TEST(Render, EdgesAreDrawnAlongTrianglesOnly) {
  Scene scene;
  MeshActor actor{.mesh = sheet(10, 10), .color = {1, 1, 1}};
  actor.edges = true;
  actor.edge_color = {0, 0, 0};
  actor.edge_width_px = 3.0;
  scene.meshes.push_back(actor);
  RenderOptions options = small_picture();
  options.occlusion_rays = 0;
  const Raster raster = render(scene, {}, options);
  EXPECT_LT(raster.pixel(119, 100)[0], 60);   // on the diagonal
  EXPECT_GT(raster.pixel(150, 100)[0], 200);  // away from it
  EXPECT_GT(raster.pixel(119, 60)[0], 200);
}

TEST(Render, CornersAreDarkerThanOpenPlaces) {
  Scene scene;
  geometry::TriMesh corner = sheet(10, 10, 0.0);
  const geometry::TriMesh floor{{{-10, 0, -10}, {10, 0, -10}, {10, -10, -10}, {-10, -10, -10}},
                                {{0, 2, 1}, {0, 3, 2}}};
  scene.meshes.push_back({.mesh = corner, .color = {0.8, 0.8, 0.8}});
  scene.meshes.push_back({.mesh = floor, .color = {0.8, 0.8, 0.8}});
  RenderOptions options = small_picture();
  options.occlusion_rays = 16;
  options.occlusion_reach = 0.2;
  const Raster raster = render(scene, {}, options);
  EXPECT_LT(raster.pixel(120, 184)[0] + 20, raster.pixel(120, 60)[0]);
  options.occlusion_rays = 0;
  const Raster plain = render(scene, {}, options);
  EXPECT_NEAR(plain.pixel(120, 184)[0], plain.pixel(120, 60)[0], 2);
}

TEST(Render, DoesNotDependOnTheNumberOfThreads) {
  Scene scene;
  scene.meshes.push_back({.mesh = ball(10.0, 40), .color = {0.8, 0.4, 0.3, 0.4}, .edges = true});
  scene.meshes.push_back({.mesh = ball(4.0, 40)});
  scene.tubes.push_back({.points = {{-9, 0, 0}, {9, 3, 2}}, .radius_mm = {0.5, 1.0}});
  RenderOptions options = small_picture();
  options.samples = 2;
  core::set_max_threads(1);
  const Raster one = render(scene, {}, options);
  core::set_max_threads(4);
  const Raster four = render(scene, {}, options);
  core::set_max_threads(0);
  EXPECT_EQ(one.rgba, four.rgba);
}

TEST(Render, DensityScalesTheRasterAlone) {
  Scene scene;
  scene.meshes.push_back({.mesh = ball(10.0, 48)});
  RenderOptions options = small_picture();
  const double single = covered_pixels(render(scene, {}, options));
  options.density = 2.0;
  const Raster fine = render(scene, {}, options);
  EXPECT_EQ(fine.width, 480);
  EXPECT_NEAR(covered_pixels(fine) / single, 4.0, 0.05);
}

TEST(Render, RefusesBadInput) {
  Scene good;
  good.meshes.push_back({.mesh = ball(1.0, 8)});
  EXPECT_THROW(render(Scene{}, {}), InvalidInput);
  Scene empty;
  empty.meshes.push_back({});
  EXPECT_THROW(render(empty, {}), InvalidInput);
  EXPECT_THROW(render(good, {}, {.width_px = 0}), InvalidInput);
  EXPECT_THROW(render(good, {}, {.samples = 0}), InvalidInput);
  EXPECT_THROW(render(good, {}, {.density = 99.0}), InvalidInput);
  EXPECT_THROW(render(good, {}, {.occlusion_rays = -1}), InvalidInput);
  Scene bad = good;
  bad.meshes[0].mesh.triangles.push_back({0, 1, 100000});
  EXPECT_THROW(render(bad, {}), InvalidInput);
  bad = good;
  bad.meshes[0].mesh.points[5].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(render(bad, {}), InvalidInput);
  bad = good;
  bad.meshes[0].triangle_colors.resize(3);
  EXPECT_THROW(render(bad, {}), InvalidInput);
  bad = good;
  bad.meshes[0].color.a = 1.5;
  EXPECT_THROW(render(bad, {}), InvalidInput);
  bad = good;
  bad.tubes.push_back({.points = {{0, 0, 0}, {1, 0, 0}}, .radius_mm = {0.0}});
  EXPECT_THROW(render(bad, {}), InvalidInput);
  bad.tubes[0].radius_mm = {1.0, 1.0, 1.0};
  EXPECT_THROW(render(bad, {}), InvalidInput);
  bad.tubes[0].points.clear();
  EXPECT_THROW(render(bad, {}), InvalidInput);
}

TEST(Render, ReportsItsProgressAndCanBeCancelled) {
  Scene scene;
  scene.meshes.push_back({.mesh = ball(1.0, 8)});
  const core::TaskContext task;
  render(scene, {}, small_picture(), task);
  EXPECT_DOUBLE_EQ(task.progress(), 1.0);
  task.cancel();
  EXPECT_THROW(render(scene, {}, small_picture(), task), Cancelled);
}

/// Whether the ray through the middle of a part of a pixel meets anything.
bool is_hit(const RayScene& rays, const View& view, double x, double y) {
  const Vec3 across =
      view.mm_per_px * ((x - 0.5 * view.width_px) * view.right + (y - 0.5 * view.height_px) * view.down);
  const Vec3 eye = view.eye - rays.centre();
  const Ray ray = view.projection == Projection::orthographic
                      ? Ray{eye + across, view.forward}
                      : Ray{eye, (view.focus_distance_mm * view.forward + across).normalized()};
  return rays.first_hit(RayScene::Part::opaque, ray, 0.0, INFINITY).has_value();
}

TEST(Render, NoPixelIsLeftOutThatSeesSomething) {
  Scene scene;
  scene.meshes.push_back({.mesh = ball(4.0, 16, {30, -12, 5})});
  scene.meshes.push_back({.mesh = sheet(0.05, 14.0)});  // thinner than a pixel
  scene.tubes.push_back({.points = {{-14, 3, 0}, {-2, -6, 9}, {11, 4, -8}}, .radius_mm = {0.1, 1.5, 0.4}});
  scene.tubes.push_back({.points = {{2, 2, 12}}, .radius_mm = {1.2}});
  int hits = 0, marked = 0, looks = 0;
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    for (const double lao : {0.0, 35.0, -70.0, 160.0}) {
      Camera camera = cameras::angiographic(lao, 0.3 * lao);
      camera.projection = projection;
      camera.field_of_view_deg = 80.0;
      const View view = fitted_view(scene, camera, 160, 120);
      const RayScene rays(scene, view.eye + view.focus_distance_mm * view.forward);
      const std::vector<std::uint8_t> seen = seen_pixels(scene, view);
      ASSERT_EQ(seen.size(), 160U * 120U);
      for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) {
          const bool mark = seen[static_cast<std::size_t>(y * 160 + x)] != 0;
          bool hit = false;
          for (const auto& [u, v] : {std::pair(0.02, 0.02), std::pair(0.98, 0.3), std::pair(0.5, 0.98)})
            hit = hit || is_hit(rays, view, x + u, y + v);
          EXPECT_TRUE(mark || !hit) << x << ", " << y << " from " << lao;
          hits += hit, marked += mark, ++looks;
        }
    }
  EXPECT_GT(hits, looks / 50);
  EXPECT_LT(marked, looks / 2) << "and most that sees nothing is";
}

TEST(Render, WhatReachesBehindTheEyeMayBeAnywhere) {
  Scene scene;
  scene.meshes.push_back({.mesh = sheet(5.0, 5.0)});
  scene.meshes.push_back({.mesh = sheet(5.0, 5.0, -500.0)});
  Camera camera;
  camera.projection = Projection::perspective;
  camera.focus = Vec3(0.0, 0.0, 0.0);
  camera.height_mm = 12.0;
  const View view = fitted_view(scene, camera, 40, 30);
  const std::vector<std::uint8_t> seen = seen_pixels(scene, view);
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 40 * 30);
}

}  // namespace
}  // namespace ostia::figure
