#include "test_shapes.h"

#include "ostia/figure/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::figure {
namespace {

RenderOptions bare() {
  RenderOptions options;
  options.width_px = options.height_px = 300;
  options.samples = 1;
  options.occlusion_rays = 0;
  options.scale_bar = options.orientation_axes = options.legend = false;
  return options;
}

int different_pixels(const Raster& a, const Raster& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    count += a.rgba[i] != b.rgba[i] || a.rgba[i + 1] != b.rgba[i + 1] || a.rgba[i + 2] != b.rgba[i + 2];
  }
  return count;
}

Scene ball_scene() {
  Scene scene;
  scene.meshes.push_back({.mesh = ball(5.0, 32)});
  return scene;
}

TEST(SceneFigure, HasTheLooksBackground) {
  for (const Look look : {Look::dark, Look::light}) {
    RenderOptions options = bare();
    options.look = look;
    const Raster raster = scene_figure(ball_scene(), {}, options).raster();
    const Color background = theme(look).background;
    EXPECT_NEAR(raster.pixel(3, 3)[0], 255 * background.r, 1);
    EXPECT_NEAR(raster.pixel(3, 3)[2], 255 * background.b, 1);
    EXPECT_EQ(raster.pixel(3, 3)[3], 255);
  }
}

TEST(SceneFigure, EachAnnotationShowsOnlyWhenAskedFor) {
  const Raster plain = scene_figure(ball_scene(), {}, bare()).raster();
  const auto changed = [&](auto&& change) {
    RenderOptions options = bare();
    Scene scene = ball_scene();
    change(options, scene);
    return different_pixels(plain, scene_figure(scene, {}, options).raster());
  };
  EXPECT_EQ(changed([](RenderOptions&, Scene&) {}), 0);
  EXPECT_GT(changed([](RenderOptions& o, Scene&) { o.title = "Title"; }), 100);
  EXPECT_GT(changed([](RenderOptions& o, Scene&) { o.scale_bar = true; }), 100);
  EXPECT_GT(changed([](RenderOptions& o, Scene&) { o.orientation_axes = true; }), 100);
  EXPECT_GT(changed([](RenderOptions& o, Scene& s) {
              o.legend = true;
              s.meshes[0].label = "lumen";
            }),
            100);
  EXPECT_EQ(changed([](RenderOptions& o, Scene&) { o.legend = true; }), 0);  // nothing has a name
  EXPECT_GT(changed([](RenderOptions&, Scene& s) { s.labels.push_back({{0, 0, 0}, "outlet"}); }), 100);
}

TEST(SceneFigure, LabelsStandAtTheirPlaceAndNotOnEachOther) {
  Scene scene = ball_scene();
  const View view = fitted_view(scene, {}, 300, 300);
  scene.labels = {{{0, -6, 0}, "one"}};
  const Raster one = scene_figure(scene, {}, bare()).raster();
  const Vec2 at = view.project({0, -6, 0});
  const std::uint8_t* dot = one.pixel(static_cast<int>(at.x()), static_cast<int>(at.y()));
  EXPECT_NEAR(dot[0], 255 * theme(Look::dark).foreground.r, 3);
  // The same place named twice: the second name is written elsewhere, so that more pixels are covered.
  const Raster plain = scene_figure(ball_scene(), {}, bare()).raster();
  const int single = different_pixels(plain, one);
  scene.labels.push_back(scene.labels[0]);
  EXPECT_GT(different_pixels(plain, scene_figure(scene, {}, bare()).raster()),
            static_cast<int>(1.5 * single));
}

TEST(SceneFigure, SeveralSightsAreThePicturesOfEach) {
  Scene scene = ball_scene();
  scene.tubes.push_back({.points = {{-9, 0, -3}, {9, 2, 3}}, .radius_mm = {0.8}});
  const std::vector<SceneSight> sights{{cameras::anterior(), "from the front"},
                                       {cameras::angiographic(50.0, 20.0), "LAO 50"},
                                       {cameras::superior(), ""}};
  const std::vector<Picture> pictures = scene_figures(scene, sights, bare());
  ASSERT_EQ(pictures.size(), sights.size());
  for (std::size_t i = 0; i < sights.size(); ++i) {
    RenderOptions options = bare();
    options.title = sights[i].title;
    const Raster alone = scene_figure(scene, sights[i].camera, options).raster();
    // Rays have another origin of their single precision: a pixel of an edge may fall to the other side.
    EXPECT_LT(different_pixels(pictures[i].raster(), alone), 30) << i;
  }
  EXPECT_GT(different_pixels(pictures[0].raster(), pictures[1].raster()), 500);
}

}  // namespace
}  // namespace ostia::figure
