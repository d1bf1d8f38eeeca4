#include "ostia/pipeline/ends_picture.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/figure/scene.h"

#include <algorithm>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;

constexpr figure::Color marked{0.92, 0.22, 0.18, 1.0};
constexpr std::size_t most_views = 5;
constexpr double near_radii = 8.0;  // half of what a view from near by shows

figure::RenderOptions view_options(const std::string& title) {
  figure::RenderOptions options;
  options.width_px = 520;
  options.height_px = 480;
  options.samples = 2;
  options.legend = false;
  options.title = title;
  return options;
}

figure::Scene scene_of(const geometry::TriMesh& lumen, const geometry::VesselTree& axes) {
  figure::Scene scene;
  figure::Color glass = figure::colors::lumen;
  glass.a = 0.55;
  scene.meshes.push_back({.mesh = lumen, .color = glass});
  double thinnest = 0.0;
  for (const geometry::TreeSegment& segment : axes.segments)
    for (const double r : segment.axis.radius) thinnest = thinnest > 0.0 ? std::min(thinnest, r) : r;
  for (const geometry::TreeSegment& segment : axes.segments)
    if (segment.axis.size() > 1)
      scene.tubes.push_back(figure::tube_of(segment.axis, std::max(0.08, 0.2 * thinnest)));
  return scene;
}

void mark(figure::Scene& scene, const meshing::EndPlane& end, double radius_mm) {
  scene.tubes.push_back({.points = {end.origin}, .radius_mm = {radius_mm}, .color = marked});
  scene.labels.push_back({end.origin, meshing::end_name(end)});
}

/// The axis lies in the picture, and the plane is seen from its side.
figure::Camera near_by(const meshing::EndPlane& end) {
  figure::Camera camera;
  camera.up = end.normal;
  camera.direction = end.normal.unitOrthogonal();
  camera.focus = end.origin;
  camera.height_mm = 2.0 * near_radii * end.radius_mm;
  return camera;
}

std::string words_at(const Vec3& p) {
  return core::fixed_text(p.x(), 1) + ", " + core::fixed_text(p.y(), 1) + ", " + core::fixed_text(p.z(), 1);
}

}  // namespace

figure::Picture picture_of_ends(const geometry::TriMesh& lumen, const geometry::VesselTree& axes,
                                const std::vector<meshing::EndPlane>& not_cut,
                                const core::TaskContext& task) {
  if (lumen.triangles.empty() || not_cut.empty())
    throw InvalidInput("a picture of ends needs a surface and an end");
  const figure::Scene whole = scene_of(lumen, axes);
  figure::Scene overview = whole;
  for (const meshing::EndPlane& end : not_cut) mark(overview, end, 1.2 * end.radius_mm);
  std::vector<figure::Picture> views{figure::scene_figure(overview, figure::cameras::broadside(lumen.points),
                                                          view_options("ends that cannot be cut"),
                                                          task.sub(0.0, 0.3))};
  for (std::size_t i = 0; i < std::min(most_views, not_cut.size()); ++i) {
    figure::Scene close = whole;
    mark(close, not_cut[i], 0.25 * not_cut[i].radius_mm);
    views.push_back(figure::scene_figure(
        close, near_by(not_cut[i]),
        view_options(meshing::end_name(not_cut[i]) + " at " + words_at(not_cut[i].origin)), task));
  }
  return figure::grid(views, {.columns = 2});
}

}  // namespace ostia::pipeline
