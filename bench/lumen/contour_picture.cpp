// The picture of docs/methods/lumen-contours.md: contours of a vessel's wall over both reformations and a
// cross-section of a data set, before and after an edit.
//   contour_picture DATASET_FOLDER VESSEL_FOLDER OUTPUT.png

#include "dataset.h"
#include "picture.h"
#include "tube_samples.h"

#include "ostia/figure/slice_figure.h"
#include "ostia/lumen/incremental_surface.h"
#include "ostia/lumen/view_contours.h"
#include "ostia/lumen/views.h"

#include <cmath>
#include <filesystem>

namespace {

using namespace ostia;
using geometry::Vec2;
using geometry::Vec3;
using lumen::ContourLine;

constexpr double edited_s_mm = 24.0, half_length_mm = 4.0, depth_mm = 0.8;

/// Narrows the vessel from one side, as a plaque would.
lumen::IncrementalReport push_in(lumen::IncrementalSurface& surface, const geometry::AxisCurve& axis) {
  std::vector<std::int64_t> removed;
  std::vector<lumen::SurfaceSample> added;
  for (const lumen::SurfaceSample& sample : surface.samples()) {
    const geometry::AxisFoot foot = axis.nearest_foot(sample.position);
    const double along = (foot.s_mm - edited_s_mm) / half_length_mm;
    if (std::abs(along) >= 1.0 || std::cos(foot.theta) <= 0.0) continue;
    lumen::SurfaceSample moved = sample;
    moved.id += 1000000;
    moved.origin = lumen::SampleOrigin::edit;
    moved.position -= depth_mm * std::pow(1.0 - along * along, 2) * std::cos(foot.theta) * sample.normal;
    removed.push_back(sample.id);
    added.push_back(moved);
  }
  return surface.change(removed, added);
}

figure::SliceContour drawn(const std::vector<ContourLine>& lines, const reformat::Plane& flat,
                           const figure::Color& color, const std::string& label) {
  figure::SliceContour contour;
  contour.color = color;
  contour.width_px = 1.4;
  contour.label = label;
  for (const ContourLine& line : lines) {
    contour.lines.emplace_back();
    for (const Vec2& px : line.picture_px) contour.lines.back().push_back(reformat::world(flat, px));
  }
  return contour;
}

figure::Picture panel(reformat::PlaneImage image, const std::vector<ContourLine>& before,
                      const std::vector<ContourLine>& after, const std::string& title, double zoom) {
  figure::SliceFigureOptions how;
  how.title = title;
  how.patient_letters = false;
  how.plane_name = false;
  how.image_width_px = static_cast<int>(std::lround(image.plane.width * image.plane.pixel_mm * zoom));
  const auto contours = {drawn(before, image.plane, figure::colors::cut, "before"),
                         drawn(after, image.plane, figure::colors::contour, "after")};
  return figure::slice_figure(image, contours, {}, how);
}

void make(const std::filesystem::path& dataset, const std::string& vessel, const std::filesystem::path& out) {
  const imaging::ImageVolume image = bench::image_of(dataset);
  const auto axis = bench::axis_of(dataset, vessel);
  lumen::IncrementalSurface surface(lumen::testing::tube_vessel(
      axis, [&](double s, double) { return axis->radius(s); }, 0.8));

  reformat::CurvedOptions o;
  o.pixel_mm = 0.15;
  o.s_start_mm = 14.0;
  o.width = 80;
  o.height = 240;
  const reformat::CurvedReformation cpr(axis, o), twin = cpr.twin();
  const reformat::Plane plane = reformat::cross_section_plane(*axis, edited_s_mm, 9.0, 0.075);
  lumen::ViewContours a(lumen::view_of(cpr), cpr.axis_px()), b(lumen::view_of(twin), twin.axis_px()),
      c(lumen::view_of(plane), {Vec2(0.5 * plane.width, 0.5 * plane.height)});
  const std::array<lumen::ViewContours*, 3> views{&a, &b, &c};
  for (lumen::ViewContours* view : views) view->update(*surface.surface());
  const std::array<std::vector<ContourLine>, 3> before{a.lines(), b.lines(), c.lines()};
  const lumen::IncrementalReport report = push_in(surface, *axis);
  lumen::update_views(views, *surface.surface(), report.changed);

  reformat::PlaneImage section = reformat::slice(image, plane, imaging::Interpolation::cubic);
  figure::GridOptions grid;
  grid.columns = 3;
  grid.letters = true;
  grid.title = "The wall's contours before and after an edit at 24 mm";
  figure::grid({panel(bench::flattened(image, cpr), before[0], a.lines(), "straightened", 22.0),
                panel(bench::flattened(image, twin), before[1], b.lines(), "its twin", 22.0),
                panel(section, before[2], c.lines(), "cross-section at 24 mm", 52.0)},
               grid)
      .write_png(out);
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::bench::make_picture(
      argc, argv, "DATASET_FOLDER VESSEL_FOLDER OUTPUT.png", 3,
      [](const std::vector<std::string>& given) { make(given[0], given[1], given[2]); });
}
