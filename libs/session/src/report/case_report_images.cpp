// The key images of a report.

#include "report/case_report_text.h"
#include "report/case_report_words.h"
#include "walls/vessels_beside.h"

#include "ostia/core/quantity_text.h"
#include "ostia/figure/plot.h"
#include "ostia/figure/scene.h"
#include "ostia/figure/slice_figure.h"
#include "ostia/figure/strip_figure.h"
#include "ostia/lumen/tree_field.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/lumen/views.h"
#include "ostia/reformat/plane_image.h"
#include "ostia/session/case_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace ostia::session {
namespace {

using figure::Look;
using figure::Picture;
using geometry::Vec2;
using geometry::Vec3;

constexpr double strip_mm = 16.0, strip_pixel_mm = 0.15;
constexpr double section_mm = 9.0, section_pixel_mm = 0.05;
constexpr double tree_cell_mm = 0.35;
constexpr double least_shown_mm = 40.0;  // a short vessel seen along its axis is not blown up
constexpr std::size_t most_throats = 6;
constexpr figure::Color mark_color{0.84, 0.37, 0.0};  // Okabe-Ito vermilion

constexpr figure::Color outer_color{0.94, 0.89, 0.26};  // Okabe-Ito yellow: the outer wall

class Painter {
 public:
  Painter(const CaseReport& report, const lumen::LumenModel& model,
          const analysis::SurfaceOfVessel& surface_of, const imaging::ImageVolume* image)
      : report_(report), model_(model), surface_of_(surface_of), image_(image) {
    std::vector<std::shared_ptr<const lumen::ImplicitSurface>> surfaces;
    for (const auto& vessel : model.vessels) {
      surfaces.push_back(surface_of(vessel->vessel));
      for (const lumen::SurfaceSample& sample : vessel->samples) seeds_.push_back(sample.position);
    }
    field_ = std::make_shared<const lumen::TreeField>(surfaces, model.blend);
  }

  KeyImage tree(const core::TaskContext& task) const;
  KeyImage vessel(std::int32_t id, const core::TaskContext& task) const;

 private:
  figure::Scene scene(const core::TaskContext& task) const;
  figure::TubeActor ring(const ReportStenosis& stenosis) const;
  std::vector<const ReportStenosis*> stenoses_of(std::int32_t id) const;
  Picture strips(std::int32_t id, const core::TaskContext& task) const;
  Picture profile(std::int32_t id) const;
  Picture throat(const ReportStenosis& stenosis) const;
  std::string said(const std::string& text) const {
    return report_words::of(report_.options.language).say(text);
  }

  const CaseReport& report_;
  const lumen::LumenModel& model_;
  const analysis::SurfaceOfVessel& surface_of_;
  const imaging::ImageVolume* image_;
  std::vector<Vec3> seeds_;
  std::shared_ptr<const lumen::TreeField> field_;
};

std::vector<const ReportStenosis*> Painter::stenoses_of(std::int32_t id) const {
  std::vector<const ReportStenosis*> found;
  for (const ReportStenosis& one : report_.stenoses)
    if (one.stenosis.vessel == id && one.state != LesionState::rejected) found.push_back(&one);
  return found;
}

std::string mark_text(const ReportStenosis& one) {
  return report_text::label(one) + "  " + report_text::percent(one.stenosis.diameter_percent) + " %";
}

/// The worst, in their order, as many as a page shows well.
std::vector<const ReportStenosis*> worst_of(std::vector<const ReportStenosis*> stenoses) {
  std::stable_sort(stenoses.begin(), stenoses.end(), [](const ReportStenosis* a, const ReportStenosis* b) {
    return a->stenosis.diameter_percent > b->stenosis.diameter_percent;
  });
  if (stenoses.size() > most_throats) stenoses.resize(most_throats);
  std::sort(stenoses.begin(), stenoses.end(),
            [](const ReportStenosis* a, const ReportStenosis* b) { return a->number < b->number; });
  return stenoses;
}

/// A ring about the throat, outside the wall; a ball where the lumen is shut.
figure::TubeActor Painter::ring(const ReportStenosis& one) const {
  const analysis::MeasuredSection section = analysis::measured_section(
      model_, surface_of_, one.stenosis.vessel, one.stenosis.throat_mm, report_.options.profile);
  const Vec3 centre = section.measures.centroid;
  if (section.contour.size() < 3) return {{centre}, {2.4}, mark_color, {}};
  constexpr double outside_mm = 1.8;  // clear of the mark under its label
  figure::TubeActor tube{{}, {0.6}, mark_color, {}};
  for (const Vec3& place : section.contour) {
    const Vec3 out = place - centre;
    tube.points.emplace_back(place + outside_mm * out / std::max(out.norm(), 1e-9));
  }
  tube.points.push_back(tube.points.front());
  return tube;
}

figure::Scene Painter::scene(const core::TaskContext& task) const {
  lumen::TreeSurfaceOptions options;
  options.cell_mm = tree_cell_mm;
  lumen::TreeSurface surface(options);
  surface.build(field_, seeds_, task);
  figure::Scene scene;
  figure::MeshActor wall;
  wall.mesh = surface.mesh();
  scene.meshes.push_back(std::move(wall));
  for (const ReportStenosis& one : report_.stenoses) {
    if (one.state == LesionState::rejected) continue;
    scene.tubes.push_back(ring(one));
    const Vec3 place = lumen::vessel(model_, one.stenosis.vessel).axis->point(one.stenosis.throat_mm);
    scene.labels.push_back({place, report_text::label(one)});
  }
  for (const ReportVessel& vessel : report_.vessels) {
    const geometry::AxisCurve& axis = *lumen::vessel(model_, vessel.id).axis;
    scene.labels.push_back({axis.point(axis.length()), vessel.name});
  }
  return scene;
}

KeyImage Painter::tree(const core::TaskContext& task) const {
  const figure::Scene shown = scene(task.sub(0.0, 0.3));
  figure::RenderOptions how;
  how.width_px = 384;
  how.height_px = 430;
  how.density = 2.0;
  how.samples = 2;
  how.occlusion_rays = 4;
  how.look = Look::light;
  how.legend = false;
  std::vector<figure::SceneSight> sights{
      {figure::cameras::anterior(), said("from the front")},
      {figure::cameras::angiographic(50.0, 20.0), said("LAO 50, cranial 20")},
      {figure::cameras::angiographic(-30.0, -20.0), said("RAO 30, caudal 20")},
      {figure::cameras::superior(), said("from above")}};
  for (figure::SceneSight& sight : sights) {
    const figure::View fitted = figure::fitted_view(shown, sight.camera, how.width_px, how.height_px);
    if (fitted.mm_per_px * how.height_px < least_shown_mm) sight.camera.height_mm = least_shown_mm;
  }
  const std::vector<Picture> views = figure::scene_figures(shown, sights, how, task.sub(0.3, 1.0));
  return {"tree", said("The tree" + std::string(report_.stenoses.empty() ? "" : ", with stenoses ringed")),
          figure::grid(views, {.columns = 2, .look = Look::light})};
}

Picture Painter::strips(std::int32_t id, const core::TaskContext& task) const {
  const std::shared_ptr<const geometry::AxisCurve> axis = lumen::vessel(model_, id).axis;
  reformat::CurvedOptions o;
  o.theta_deg = report_.options.theta_deg;
  o.pixel_mm = strip_pixel_mm;
  o.width = static_cast<int>(std::lround(strip_mm / o.pixel_mm));
  o.height = std::max(2, static_cast<int>(std::ceil(axis->length() / o.pixel_mm)));
  const reformat::CurvedReformation first(axis, o);
  std::vector<figure::StripPanel> panels;
  for (const reformat::CurvedReformation& view : {first, first.twin()}) {
    figure::StripPanel panel{
        core::set_angle_text(view.options().theta_deg) + "\xC2\xB0", o.width, o.height, {}, {}};
    if (image_)
      panel.values = reformat::reformatted(*image_, view, imaging::Interpolation::cubic, task).values;
    else
      panel.values.assign(static_cast<std::size_t>(o.width) * static_cast<std::size_t>(o.height),
                          std::numeric_limits<float>::quiet_NaN());
    for (lumen::ContourLine& line : lumen::contour_lines(*field_, lumen::view_of(view), view.axis_px()))
      panel.contours.push_back(std::move(line.picture_px));
    panels.push_back(std::move(panel));
  }
  std::vector<figure::StripMark> marks;
  for (const ReportStenosis* one : stenoses_of(id))
    marks.push_back(
        {one->stenosis.from_mm, one->stenosis.to_mm, one->stenosis.throat_mm, mark_text(*one), mark_color});
  figure::StripFigureOptions how;
  how.along = said(how.along);
  how.pixel_mm = o.pixel_mm;
  how.px_per_mm = std::clamp(860.0 / axis->length(), 2.5, 9.0);
  how.level_hu = report_.options.level_hu;
  how.window_hu = report_.options.window_hu;
  return figure::strip_figure(panels, marks, how);
}

Picture Painter::profile(std::int32_t id) const {
  const analysis::LumenProfile sizes =
      analysis::read_through(report_.profiles.at(id), report_.references.at(id));
  const analysis::ReferenceLine& line = report_.references.at(id);
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  figure::Series measured{said("lumen"), {}, {}, figure::colors::inlet};
  figure::Series reference{said("reference"), {}, {}, figure::colors::outlet, figure::LineStyle::dashed, 1.6};
  for (std::size_t i = 0; i < sizes.sections.size(); ++i) {
    const analysis::SectionMeasures& section = sizes.sections[i];
    measured.x.push_back(section.s_mm);
    measured.y.push_back(section.found || !section.open ? section.diameter_mm : nothing);
    reference.x.push_back(section.s_mm);
    reference.y.push_back(line.diameter_mm[i] > 0.0 ? line.diameter_mm[i] : nothing);
  }
  figure::PlotOptions how;
  how.title = said("Diameter along the vessel");
  how.x_label = said("mm along the vessel");
  how.y_label = "mm";
  how.width_px = 528;
  how.height_px = 300;
  how.y_from_zero = true;
  std::vector<figure::Series> series{measured, reference};
  figure::Series throats{said("stenosis"), {}, {}, mark_color, figure::LineStyle::points, 3.0};
  for (const ReportStenosis* one : stenoses_of(id)) {
    throats.x.push_back(one->stenosis.throat_mm);
    throats.y.push_back(one->stenosis.least_diameter_mm);
    how.references.push_back(
        {figure::ReferenceLine::Along::x, one->stenosis.throat_mm, report_text::label(*one)});
  }
  if (!throats.x.empty()) series.push_back(throats);
  for (auto found = report_.ostia.find(id); found != report_.ostia.end() && found->second.parent >= 0;
       found = report_.ostia.find(found->second.parent))
    how.references.push_back({figure::ReferenceLine::Along::x, found->second.joint_mm,
                              said("leaves " + report_text::vessel_name(model_, found->second.parent))});
  const bool any = std::any_of(measured.y.begin(), measured.y.end(), [](double y) { return !std::isnan(y); });
  if (!any) how.y_range = figure::Range{0.0, 1.0};
  return figure::line_plot(series, how);
}

Picture Painter::throat(const ReportStenosis& one) const {
  const geometry::AxisCurve& axis = *lumen::vessel(model_, one.stenosis.vessel).axis;
  const reformat::Plane plane =
      reformat::cross_section_plane(axis, one.stenosis.throat_mm, section_mm, section_pixel_mm);
  reformat::PlaneImage view;
  if (image_) {
    view = reformat::slice(*image_, plane, imaging::Interpolation::cubic);
  } else {
    view.plane = plane;
    view.values.assign(static_cast<std::size_t>(plane.width) * static_cast<std::size_t>(plane.height),
                       std::numeric_limits<float>::quiet_NaN());
  }
  std::vector<Vec3> contour = analysis::measured_section(model_, surface_of_, one.stenosis.vessel,
                                                         one.stenosis.throat_mm, report_.options.profile)
                                  .contour;
  if (!contour.empty()) contour.push_back(contour.front());
  figure::SliceFigureOptions how;
  how.title = said(mark_text(one) + " at " + core::length_text(one.stenosis.throat_mm) + " mm");
  how.level_hu = report_.options.level_hu;
  how.window_hu = report_.options.window_hu;
  how.image_width_px = 256;
  how.look = Look::light;
  how.rulers = false;
  how.plane_name = false;
  std::vector<figure::SliceContour> lines{{{contour}, figure::colors::contour, 1.6, {}}};
  if (const auto walls = report_.walls.find(one.stenosis.vessel); walls != report_.walls.end()) {
    std::vector<Vec3> outer = outer_wall_ring(walls->second, one.stenosis.throat_mm);
    if (!outer.empty()) outer.push_back(outer.front());
    lines.push_back({{outer}, outer_color, 0.9, {}});
  }
  return figure::slice_figure(view, lines, {}, how);
}

std::string throats_text(std::size_t shown, std::size_t all) {
  if (shown == 0) return "";
  return shown == all ? ", and the cross-section at each throat"
                      : ", and the cross-sections at the " + std::to_string(shown) +
                            " narrowest throats of " + std::to_string(all);
}

KeyImage Painter::vessel(std::int32_t id, const core::TaskContext& task) const {
  std::vector<Picture> right{profile(id)};
  std::vector<Picture> throats;
  for (const ReportStenosis* one : worst_of(stenoses_of(id))) {
    task.throw_if_cancelled();
    throats.push_back(throat(*one));
  }
  if (!throats.empty())
    right.push_back(figure::grid(throats, {.columns = 2, .look = Look::light, .gap_px = 8}));
  const Picture along = strips(id, task);
  const std::string name = report_text::vessel_name(model_, id);
  const std::string theta = core::set_angle_text(report_.options.theta_deg) + "\u00b0 and " +
                            core::set_angle_text(report_.options.theta_deg + 90.0) + "\u00b0";
  return {"vessel-" + std::to_string(id),
          said(name + ": straightened at " + theta + " with the lumen's contour, diameter along the vessel" +
               throats_text(throats.size(), stenoses_of(id).size())),
          figure::grid({along, figure::grid(right, {.columns = 1, .look = Look::light, .gap_px = 6})},
                       {.columns = 2, .look = Look::light, .gap_px = 6})};
}

/// The vessels that have a key image, in the tree's order.
std::vector<std::int32_t> shown_vessels(const CaseReport& report, const lumen::LumenModel& model) {
  std::set<std::int32_t> shown;
  for (const analysis::VesselSegment& one : analysis::segments_of(model))
    if (one.aha && (one.aha->vessel == "RCA" || one.aha->vessel == "LAD" || one.aha->vessel == "LCX") &&
        one.aha->number != 16)
      shown.insert(one.vessel);
  if (shown.empty()) {
    std::vector<ReportVessel> longest = report.vessels;
    std::stable_sort(longest.begin(), longest.end(),
                     [](const ReportVessel& a, const ReportVessel& b) { return a.length_mm > b.length_mm; });
    for (std::size_t i = 0; i < std::min<std::size_t>(3, longest.size()); ++i) shown.insert(longest[i].id);
  }
  for (const ReportStenosis& one : report.stenoses)
    if (one.state != LesionState::rejected && one.stenosis.diameter_percent >= report.options.picture_percent)
      shown.insert(one.stenosis.vessel);
  std::vector<std::int32_t> ordered;
  for (const ReportVessel& one : report.vessels)
    if (shown.contains(one.id)) ordered.push_back(one.id);
  return ordered;
}

}  // namespace

std::vector<KeyImage> key_images(const CaseReport& report, const lumen::LumenModel& model,
                                 const analysis::SurfaceOfVessel& surface_of,
                                 const imaging::ImageVolume* image, const core::TaskContext& task) {
  task.throw_if_cancelled();
  task.set_stage("key images");
  const analysis::SurfaceOfVessel held = held_surfaces(model, surface_of);
  const Painter painter(report, model, held, image);
  const std::vector<std::int32_t> vessels = shown_vessels(report, model);
  auto drawn = beside<std::optional<KeyImage>>(
      vessels.size() + 1, task, [&](std::size_t i, const core::TaskContext& part) {
        return std::optional(i == 0 ? painter.tree(part) : painter.vessel(vessels[i - 1], part));
      });
  std::vector<KeyImage> images;
  for (std::optional<KeyImage>& one : drawn) images.push_back(std::move(*one));
  task.set_progress(1.0);
  return images;
}

}  // namespace ostia::session
