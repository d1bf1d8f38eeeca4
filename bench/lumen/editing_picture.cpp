// Makes the picture of docs/methods/editing.md: editing_picture OUT.png
// What a stroke does to a wall, like figure 2 of [Wels]: the tangent frame bundle T* of the axis and the
// stroke, the samples that it dismisses for several beta, and the wall before and after.
#include "edited_walls.h"
#include "editing/dismissal.h"
#include "picture.h"

#include "ostia/figure/plot.h"
#include "ostia/figure/scene.h"
#include "ostia/lumen/tree_surface.h"

#include <cstdio>

namespace {

using namespace ostia;
using namespace ostia::lumen;
using namespace ostia::lumen::testing;
using figure::Color;

constexpr Color kept_color{0.34, 0.71, 0.91}, gone_color{0.90, 0.30, 0.55}, drawn_color{0.94, 0.62, 0.00},
    laid_color{0.55, 0.57, 0.60}, across_color{0.00, 0.62, 0.45}, along_color{0.80, 0.47, 0.65};
constexpr double from_mm = 5.0, to_mm = 21.0, theta = 0.0;

double plaque(double s, double) {
  return 1.9 - 1.1 * std::exp(-std::pow((s - 13.0) / 3.6, 2));
}

figure::TubeActor ball(const Vec3& place, double radius_mm, const Color& color) {
  return {{place}, {radius_mm}, color, {}};
}

figure::TubeActor line(std::vector<Vec3> points, double radius_mm, const Color& color,
                       std::string label = {}) {
  return {std::move(points), {radius_mm}, color, std::move(label)};
}

std::vector<Vec3> drawn_line(const AxisCurve& axis) {
  std::vector<Vec3> points;
  for (double s = from_mm; s <= to_mm; s += 0.1) points.push_back(axis.place(s, theta, plaque(s, theta)));
  return points;
}

geometry::TriMesh wall_of(const LumenModel& model) {
  TreeSurface surface({.cell_mm = 0.2});
  std::vector<Vec3> seeds;
  for (const SurfaceSample& sample : model.vessels[0]->samples) seeds.push_back(sample.position);
  surface.build(std::make_shared<const ImplicitSurface>(solve(*model.vessels[0])), seeds);
  return surface.mesh();
}

figure::Scene with_axis(const LumenModel& model) {
  figure::Scene scene;
  const AxisCurve& axis = axis_of(model);
  scene.tubes.push_back(figure::tube_of(axis.sampled(0.25), 0.07));
  scene.tubes.back().label = "axis c(t)";
  scene.tubes.push_back(line(drawn_line(axis), 0.09, drawn_color, "stroke"));
  return scene;
}

figure::Camera camera_of(const LumenModel& model) {
  // Across the plane of the axis and the stroke, from a little above.
  const AxisCurve& axis = axis_of(model);
  const Vec3 radial = axis.place(13.0, theta, 1.0) - axis.point(13.0);
  const Vec3 across = axis.place(13.0, theta + 0.5 * pi, 1.0) - axis.point(13.0);
  figure::Camera camera;
  camera.direction = -across - 0.6 * radial;
  camera.up = radial;
  return camera;
}

figure::RenderOptions view_options(const std::string& title) {
  figure::RenderOptions options;
  options.width_px = 760;
  options.height_px = 330;
  options.title = title;
  options.orientation_axes = false;
  return options;
}

figure::Picture bundle_panel(const LumenModel& model) {
  const AxisCurve& axis = axis_of(model);
  figure::Scene scene = with_axis(model);
  std::vector<LinePlace> places;
  for (double s = from_mm; s <= to_mm; s += 0.1)
    places.push_back({s, axis.place(s, theta, plaque(s, theta)) - axis.point(s)});
  const TangentFrameBundle bundle(model.vessels[0]->axis, places);
  for (double s = from_mm; s <= to_mm + 1e-9; s += 2.0) {
    const TangentFrameBundle::Rotation rotation = bundle.at(s);
    const Vec3 foot = axis.point(s);
    const bool first = s < from_mm + 1e-9;
    scene.tubes.push_back(line({foot, foot + 1.3 * rotation.r1}, 0.1, across_color, first ? "r1*" : ""));
    scene.tubes.push_back(line({foot, foot + 1.3 * rotation.r2}, 0.13, along_color, first ? "r2*" : ""));
  }
  scene.meshes.push_back({.mesh = wall_of(model), .color = {0.84, 0.37, 0.28, 0.16}});
  return figure::scene_figure(scene, camera_of(model),
                              view_options("The bundle T* between the axis and a stroke"));
}

figure::Picture samples_panel(const LumenModel& model, double beta_deg) {
  figure::Scene scene = with_axis(model);
  CprStroke stroke = stroke_along(axis_of(model), plaque, theta, from_mm, to_mm, 9);
  stroke.beta_deg = beta_deg;
  const VesselChange change = apply(model, stroke).changes.at(0);
  const auto add = [&](const Vec3& place, double radius, const Color& color, const char* label, bool& named) {
    scene.tubes.push_back(ball(place, radius, color));
    if (!named) scene.tubes.back().label = label;
    named = true;
  };
  bool named[3] = {false, false, false};
  for (const SurfaceSample& sample : model.vessels[0]->samples) {
    const bool gone = std::binary_search(change.removed.begin(), change.removed.end(), sample.id);
    add(sample.position, 0.13, gone ? gone_color : kept_color, gone ? "dismissed" : "kept",
        named[gone ? 1 : 0]);
  }
  for (const SurfaceSample& sample : change.added)
    if (sample.origin == SampleOrigin::edit) add(sample.position, 0.17, drawn_color, "new", named[2]);
  char title[64];
  std::snprintf(title, sizeof title, "Samples dismissed at beta = %.0f degrees", beta_deg);
  return figure::scene_figure(scene, camera_of(model), view_options(title));
}

figure::Picture after_panel(const LumenModel& model) {
  const LumenModel after = apply(model, stroke_along(axis_of(model), plaque, theta, from_mm, to_mm, 9)).model;
  figure::Scene scene = with_axis(model);
  scene.meshes.push_back({.mesh = wall_of(after), .color = {0.84, 0.37, 0.28, 1.0}});
  return figure::scene_figure(scene, camera_of(model),
                              view_options("The wall after the stroke, beta = 60 degrees"));
}

// The cross-section in the middle of the stroke.
figure::Picture section_panel(const LumenModel& model) {
  const AxisCurve& axis = axis_of(model);
  const auto outline = [&](const LumenModel& shown, const char* name, const Color& color) {
    const ImplicitSurface field = solve(*shown.vessels[0]);
    figure::Series series{.name = name, .x = {}, .y = {}, .color = color};
    for (int k = 0; k <= 180; ++k) {
      const double at = 2.0 * pi * k / 180.0, rho = radius_on_ray(field, axis, 13.0, at);
      series.x.push_back(rho * std::cos(at));
      series.y.push_back(rho * std::sin(at));
    }
    return series;
  };
  std::vector<figure::Series> series{outline(model, "before", kept_color)};
  const Color shades[3] = {{0.90, 0.62, 0.00}, {0.84, 0.37, 0.00}, {0.80, 0.47, 0.65}};
  int shade = 0;
  for (const double beta : {45.0, 60.0, 90.0}) {
    CprStroke stroke = stroke_along(axis, plaque, theta, from_mm, to_mm, 9);
    stroke.beta_deg = beta;
    char name[32];
    std::snprintf(name, sizeof name, "beta %.0f degrees", beta);
    series.push_back(outline(apply(model, stroke).model, name, shades[shade++]));
  }
  figure::Series drawn{.name = "stroke",
                       .x = {plaque(13.0, 0.0)},
                       .y = {0.0},
                       .color = drawn_color,
                       .style = figure::LineStyle::points,
                       .width_px = 6.0};
  series.push_back(drawn);
  figure::PlotOptions options;
  options.title = "The cross-section at 13 mm";
  options.x_label = "mm, towards the stroke";
  options.y_label = "mm";
  options.width_px = 760;
  options.height_px = 330;
  options.look = figure::Look::dark;
  // The same scale on both axes.
  options.x_range = figure::Range{-7.0, 7.0};
  options.y_range = figure::Range{-2.4, 2.4};
  return figure::line_plot(series, options);
}

void make(const std::string& file) {
  const LumenModel model = bent_model(26.0, 1.9);
  figure::GridOptions options;
  options.columns = 2;
  figure::grid({bundle_panel(model), samples_panel(model, 45.0), samples_panel(model, 60.0),
                samples_panel(model, 90.0), after_panel(model), section_panel(model)},
               options)
      .write(file);
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::bench::make_picture(argc, argv, "OUTPUT.png", 1,
                                    [](const std::vector<std::string>& given) { make(given[0]); });
}
