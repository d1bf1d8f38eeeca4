#include "ostia/view/plane_view.h"

#include "pointer/measure_marks.h"
#include "scene/slice_crossings.h"
#include "scene/wall_cut.h"

#include "ostia/core/quantity_text.h"
#include "ostia/core/text.h"
#include "ostia/geometry/frame.h"
#include "ostia/lumen/views.h"
#include "ostia/reformat/plane_image.h"
#include "ostia/session/beating.h"
#include "ostia/view/vessel_colors.h"
#include "ostia/view/words.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {
namespace {

constexpr double fading_depth_mm = 1.0;
constexpr double most_live_samples = 5e6;  // of a slab's picture that follows the hand as it is

}  // namespace

bool PlaneView::ready() const {
  return width() > 0 && height() > 0 && placement().has_value();
}

const std::optional<reformat::Plane>& PlaneView::plane() {
  if (plane_fresh_ && plane_ && (plane_->width != width() || plane_->height != height()))
    plane_fresh_ = false;
  if (plane_fresh_) return plane_;
  plane_.reset();
  const std::optional<Placement> at = placement();
  if (at && width() > 0 && height() > 0) {
    reformat::Plane made;
    made.u = at->u;
    made.v = at->v;
    made.width = width();
    made.height = height();
    made.pixel_mm = at->side_mm / (zoom_ * std::min(width(), height()));
    const Vec2 middle = Vec2(width(), height()) / 2.0 + pan_px_ * std::min(width(), height());
    made.origin = at->centre - made.pixel_mm * (middle.x() * made.u + middle.y() * made.v);
    plane_ = made;
  }
  plane_fresh_ = true;
  return plane_;
}

void PlaneView::moved() {
  plane_fresh_ = false;
  image_stale();
}

std::optional<Vec3> PlaneView::world(const Vec2& px) {
  const std::optional<reformat::Plane>& shown = plane();
  if (!shown) return std::nullopt;
  return reformat::world(*shown, px);
}
std::optional<ViewPlace> PlaneView::project(const Vec3& place) {
  const std::optional<reformat::Plane>& shown = plane();
  if (!shown) return std::nullopt;
  const reformat::PlanePoint at = reformat::project(*shown, place);
  return ViewPlace{at.picture_px, at.distance_mm};
}
double PlaneView::pixel_mm() {
  const std::optional<reformat::Plane>& shown = plane();
  return shown ? shown->pixel_mm : 1.0;
}

void PlaneView::zoom(double factor, const Vec2& about_px) {
  if (!(factor > 0.0) || width() <= 0 || height() <= 0) return;
  const double wanted = std::clamp(zoom_ * factor, 0.2, 50.0), by = wanted / zoom_;
  const Vec2 middle(width() / 2.0, height() / 2.0);
  const double side = std::min(width(), height());
  pan_px_ = (about_px - middle) / side + by * (pan_px_ - (about_px - middle) / side);
  zoom_ = wanted;
  moved();
}
void PlaneView::pan(const Vec2& delta_px) {
  if (width() <= 0 || height() <= 0) return;
  pan_px_ += delta_px / std::min(width(), height());
  moved();
}
void PlaneView::fit() {
  pan_px_ = Vec2::Zero();
  zoom_ = 1.0;
  moved();
}

GreyImage PlaneView::make_image() {
  const std::optional<reformat::Plane>& shown = plane();
  if (!shown) return {};
  const reformat::Slab slab = bench().slab.get();
  const imaging::ImageVolume& image = *bench().shown_volume();
  const double slab_mm = bench().slab_mm.get();
  const double samples = 2.0 * slab_mm / image.geometry.spacing.minCoeff() * shown->width * shown->height;
  const bool draft = slab != reformat::Slab::none && wants_draft() && samples > most_live_samples;
  if (draft) mark_draft();
  reformat::PlaneImage made = slab == reformat::Slab::none ? reformat::slice(image, *shown)
                              : draft ? reformat::slab_draft(image, *shown, slab, slab_mm)
                                      : reformat::slab_slice(image, *shown, slab, slab_mm);
  return {shown->width, shown->height, std::move(made.values)};
}

std::optional<lumen::ViewSurface> PlaneView::contour_surface() {
  const std::optional<reformat::Plane>& shown = plane();
  if (!shown) return std::nullopt;
  return lumen::view_of(*shown);
}

std::vector<Vec2> PlaneView::contour_seeds() {
  const std::optional<reformat::Plane>& shown = plane();
  const lumen::LumenModel* model = bench().model();
  if (!shown || !model) return {};
  return slice_seeds(*model, *bench().session().live().field(), *shown);
}

std::vector<lumen::ContourLine> PlaneView::cut(const session::ShownPhase& phase) {
  const std::optional<reformat::Plane>& shown = plane();
  if (!shown) return {};
  const std::vector<Vec3>& points = phase.wall()->points;
  const Vec3 normal = shown->normal();
  std::vector<double> out_mm(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) out_mm[i] = (points[i] - shown->origin).dot(normal);
  std::vector<lumen::ContourLine> lines =
      wall_cut(*phase.wall(), out_mm, 0.0, 1e9, [&](std::size_t i) -> std::optional<SeenCorner> {
        const reformat::PlanePoint at = reformat::project(*shown, points[i]);
        return SeenCorner{at.picture_px, out_mm[i]};
      });
  // Views across or through the tree show little of it.
  const double w = shown->width, h = shown->height;
  std::erase_if(lines, [&](const lumen::ContourLine& line) {
    return std::none_of(line.picture_px.begin(), line.picture_px.end(), [&](const Vec2& p) {
      return p.x() >= 0.0 && p.y() >= 0.0 && p.x() <= w && p.y() <= h;
    });
  });
  return lines;
}

SectionView::SectionView(session::Workbench& bench, double offset_mm, double side_mm)
    : PlaneView(bench), offset_mm_(offset_mm), side_mm_(side_mm) {
  keep(bench.cursor_mm.observe([this](const double&) { moved(); }));
  keep(bench.vessel.observe([this](const std::int32_t&) { moved(); }));
  keep(bench.case_changed.observe([this] { moved(); }));
  keep(bench.theta_deg.observe([this](const double&) { overlay_stale(); }));
  keep(bench.model_changed.observe([this](const session::ModelEvent& event) {
    if (event.tree_changed) moved();
  }));
}

double SectionView::s_mm() const {
  const auto axis = bench().axis();
  return axis ? std::clamp(bench().cursor_mm.get() + offset_mm_, 0.0, axis->length()) : 0.0;
}

bool SectionView::ready() const {
  const auto axis = bench().axis();
  if (!axis || !PlaneView::ready()) return false;
  const double s = bench().cursor_mm.get() + offset_mm_;
  return s > -1e-6 && s < axis->length() + 1e-6;
}

std::optional<PlaneView::Placement> SectionView::placement() const {
  const auto axis = bench().axis();
  if (!axis) return std::nullopt;
  const double s = s_mm();
  const geometry::Frame frame = axis->frame(s);
  const double turn = turn_deg_ * M_PI / 180.0;
  return Placement{axis->point(s), geometry::radial_direction(frame, turn),
                   geometry::radial_direction(frame, turn - M_PI / 2.0), side_mm_};
}

void SectionView::set_turn_deg(double turn_deg) {
  if (turn_deg == turn_deg_) return;
  turn_deg_ = turn_deg;
  moved();
}

// The vessel itself, also at its ends, where the plane only touches the axis.
std::vector<Vec2> SectionView::contour_seeds() {
  std::vector<Vec2> seeds = PlaneView::contour_seeds();
  if (const auto at = project(bench().axis()->point(s_mm()))) seeds.push_back(at->px);
  return seeds;
}

void SectionView::scroll(double steps) {
  bench().cursor_mm.set(bench().cursor_mm.get() - 0.5 * steps);
}

void SectionView::add_to_overlay(Overlay& overlay) {
  const std::optional<reformat::Plane>& shown = plane();
  if (!shown) return;
  const bool main = offset_mm_ == 0.0;
  const Vec2 centre = reformat::project(*shown, bench().axis()->point(s_mm())).picture_px;
  if (main) {
    // Where the two CPRs cut this section: short lines at its rim, long enough to see their angle.
    const double inner = 0.30 * std::min(width(), height()), outer = 0.46 * std::min(width(), height());
    for (int i = 0; i < 4; ++i) {
      const double angle = (bench().theta_deg.get() - turn_deg_ + 90.0 * i) * M_PI / 180.0;
      const Vec2 along(std::cos(angle), -std::sin(angle));
      overlay.lines.push_back({{centre + inner * along, centre + outer * along},
                               Role::cursor,
                               i % 2 == 0 ? 0.9 : 0.5,
                               i % 2 != 0});
    }
    add_scale_bar(overlay);
    add_letters(overlay, shown->u, shown->v);
    add_slab(overlay);
  }
  overlay.marks.push_back({centre, Role::axis, bench().tool.get() == session::Tool::axis ? 4.0 : 2.0});
  std::string text = core::length_text(bench().own_mm(s_mm())) + " mm";
  if (!main) text = core::signed_text(offset_mm_, 0);
  overlay.texts.push_back({Vec2(units(6.0), units(6.0)), text, Role::information, Anchor::top_left});
  if (main)
    if (const auto measured = bench().section(bench().vessel.get(), s_mm())) {
      const analysis::SectionMeasures& here = *measured;
      if (here.found) {
        text = core::area_text(here.area_mm2) + " mm\u00b2  \u00d8 " + core::calibre_text(here.diameter_mm) +
               " (" + core::calibre_text(here.least_diameter_mm) + "\u2013" +
               core::calibre_text(here.largest_diameter_mm) + ") mm";
        overlay.texts.push_back({Vec2(units(6.0), units(22.0)), text, Role::information, Anchor::top_left});
      }
    }
  add_measurements(overlay, main ? mark_reach_mm : 0.5);
  add_fading(overlay, fading_depth_mm);
}

std::string to_string(SliceKind kind) {
  switch (kind) {
    case SliceKind::axial:
      return "axial";
    case SliceKind::coronal:
      return "coronal";
    case SliceKind::sagittal:
      return "sagittal";
    case SliceKind::oblique:
      return "oblique";
  }
  return {};
}

SliceView::SliceView(session::Workbench& bench, SliceKind kind) : PlaneView(bench), kind_(kind) {
  keep(bench.place.observe([this](const Vec3&) { moved(); }));
  keep(bench.image_changed.observe([this] { moved(); }));
  keep(bench.first_end.observe([this](const std::optional<Vec3>&) { overlay_stale(); }));
}

bool SliceView::ready() const {
  return bench().image().volume && PlaneView::ready();
}

void SliceView::set_kind(SliceKind kind) {
  kind_ = kind;
  moved();
}

void SliceView::tilt(double about_horizontal_deg, double about_vertical_deg) {
  const double a = about_horizontal_deg * M_PI / 180.0, b = about_vertical_deg * M_PI / 180.0;
  const Vec3 n = u_.cross(v_);
  v_ = (std::cos(a) * v_ + std::sin(a) * n).normalized();
  const Vec3 m = u_.cross(v_);
  u_ = (std::cos(b) * u_ + std::sin(b) * m).normalized();
  v_ = (v_ - v_.dot(u_) * u_).normalized();
  moved();
}

std::optional<PlaneView::Placement> SliceView::placement() const {
  if (!bench().image().volume) return std::nullopt;
  const imaging::Geometry& grid = bench().image().volume->geometry;
  const Vec3 last(static_cast<double>(grid.size[0] - 1), static_cast<double>(grid.size[1] - 1),
                  static_cast<double>(grid.size[2] - 1));
  const Vec3 middle = grid.world(last / 2.0);
  Placement made;
  switch (kind_) {
    case SliceKind::axial:
      made.u = Vec3::UnitX(), made.v = Vec3::UnitY();
      break;
    case SliceKind::coronal:
      made.u = Vec3::UnitX(), made.v = -Vec3::UnitZ();
      break;
    case SliceKind::sagittal:
      made.u = Vec3::UnitY(), made.v = -Vec3::UnitZ();
      break;
    case SliceKind::oblique:
      made.u = u_, made.v = v_;
      break;
  }
  // The image's middle stays in the view's while the slice goes through the cursor's place.
  const Vec3 normal = made.u.cross(made.v);
  made.centre = middle + (bench().place.get() - middle).dot(normal) * normal;
  const Vec3 extent = grid.direction * grid.spacing.cwiseProduct(last);
  const double wide = std::abs(extent.dot(made.u)), high = std::abs(extent.dot(made.v));
  const double w = std::max(1, width()), h = std::max(1, height());
  const double pixel = std::max(wide / w, high / h);
  made.side_mm = std::max(1.0, pixel * std::min(w, h));
  return made;
}

void SliceView::scroll(double steps) {
  const std::optional<reformat::Plane>& shown = plane();
  if (!shown) return;
  const double step = bench().image().volume->geometry.spacing.minCoeff();
  bench().place.set(bench().place.get() - steps * std::max(step, 0.25) * shown->normal());
}

static const std::string& word_of(SliceKind kind) {
  return kind == SliceKind::axial     ? words().axial
         : kind == SliceKind::coronal ? words().coronal
                                      : words().sagittal;
}

void SliceView::add_to_overlay(Overlay& overlay) {
  const std::optional<reformat::Plane>& shown = plane();
  if (!shown) return;
  const Vec2 at = reformat::project(*shown, bench().place.get()).picture_px;
  const double gap = units(12.0), w = width(), h = height();
  const double edge = units(20.0);  // kept free for the letters
  const auto line = [&](const Vec2& from, const Vec2& to) {
    if ((to - from).sum() > 0.0) overlay.lines.push_back({{from, to}, Role::cursor, 0.6});
  };
  line({edge, at.y()}, {at.x() - gap, at.y()});
  line({at.x() + gap, at.y()}, {w - edge, at.y()});
  line({at.x(), edge}, {at.x(), at.y() - gap});
  line({at.x(), at.y() + gap}, {at.x(), h - edge});
  if (const lumen::LumenModel* model = bench().model())
    for (const AxisCrossing& one : crossings(*model, *shown, bench().other_phase())) {
      OverlayMark mark{one.px, Role::axis, 2.0};
      if (one.vessel != bench().vessel.get()) {
        mark.role = Role::other_axis;
        mark.color = vessel_color(bench(), one.vessel);
      }
      overlay.marks.push_back(mark);
    }
  if (const auto& begun = bench().first_end.get()) {
    const auto there = reformat::project(*shown, *begun);
    if (std::abs(there.distance_mm) <= mark_reach_mm)
      overlay.marks.push_back({there.picture_px, Role::selected, 4.0, 1.0, false});
  }
  add_letters(overlay, shown->u, shown->v);
  add_scale_bar(overlay);
  add_slab(overlay);
  const Vec3 n = shown->normal();
  const double depth = bench().place.get().dot(n.cwiseAbs());
  std::string text = words().oblique;
  if (kind_ != SliceKind::oblique) text = word_of(kind_) + "  " + core::length_text(depth) + " mm";
  overlay.texts.push_back({Vec2(units(6.0), units(6.0)), text, Role::information, Anchor::top_left});
  add_measurements(overlay, mark_reach_mm);
  add_fading(overlay, fading_depth_mm);
}

}  // namespace ostia::view
