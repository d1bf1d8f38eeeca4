#include "ostia/view/linked_planes.h"

#include "pointer/measure_marks.h"
#include "scene/slice_crossings.h"

#include "ostia/core/quantity_text.h"
#include "ostia/view/words.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {
namespace {

using session::Workbench;

constexpr std::array all_planes{LinkedPlane::axial, LinkedPlane::coronal, LinkedPlane::sagittal};
constexpr double ring_share = 0.36, dot_share = 0.20;  // of the view's smaller side, from the cursor
constexpr double ring_reach_units = 12.0, dot_reach_units = 8.0;
constexpr double linked_gap_units = 14.0;
constexpr double thicker_mm = 1.0;

Role role_of_plane(LinkedPlane plane) {
  return plane == LinkedPlane::axial     ? Role::axial_plane
         : plane == LinkedPlane::coronal ? Role::coronal_plane
                                         : Role::sagittal_plane;
}

const std::string& word_of_plane(LinkedPlane plane) {
  return plane == LinkedPlane::axial     ? words().axial
         : plane == LinkedPlane::coronal ? words().coronal
                                         : words().sagittal;
}

}  // namespace

void LinkedPlanes::reset() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  axes_ = {Axes{x, y}, Axes{x, -z}, Axes{y, -z}};
  straight_ = true;
  changed.tell();
}

void LinkedPlanes::turn(LinkedPlane about, double angle_rad) {
  if (!std::isfinite(angle_rad) || angle_rad == 0.0) return;
  const Eigen::AngleAxisd turned(angle_rad, axes(about).normal().normalized());
  for (const LinkedPlane plane : all_planes) {
    if (plane == about) continue;
    Axes& own = axes_[static_cast<std::size_t>(plane)];
    own.u = (turned * own.u).normalized();
    own.v = turned * own.v;
    own.v = (own.v - own.v.dot(own.u) * own.u).normalized();
  }
  straight_ = false;
  changed.tell();
}

LinkedPlaneView::LinkedPlaneView(Workbench& bench, LinkedPlane kind, std::shared_ptr<LinkedPlanes> planes)
    : PlaneView(bench), kind_(kind), planes_(std::move(planes)) {
  keep(bench.place.observe([this](const Vec3&) { moved(); }));
  keep(bench.image_changed.observe([this] { moved(); }));
  keep(bench.vessel.observe([this](const std::int32_t&) { overlay_stale(); }));
  keep(bench.slab.observe([this](const reformat::Slab&) { overlay_stale(); }));
  keep(bench.slab_mm.observe([this](const double&) { overlay_stale(); }));
  keep(planes_->changed.observe([this] { moved(); }));
}

bool LinkedPlaneView::ready() const {
  return bench().image().volume && PlaneView::ready();
}

std::optional<PlaneView::Placement> LinkedPlaneView::placement() const {
  if (!bench().image().volume) return std::nullopt;
  const imaging::Geometry& grid = bench().image().volume->geometry;
  const Vec3 last(static_cast<double>(grid.size[0] - 1), static_cast<double>(grid.size[1] - 1),
                  static_cast<double>(grid.size[2] - 1));
  const LinkedPlanes::Axes& axes = planes_->axes(kind_);
  Placement made;
  made.u = axes.u;
  made.v = axes.v;
  const Vec3 middle = grid.world(last / 2.0), normal = axes.normal();
  made.centre = middle + (bench().place.get() - middle).dot(normal) * normal;
  double wide = 0.0, high = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 edge = grid.direction.col(axis) * grid.spacing[axis] * last[axis];
    wide += std::abs(edge.dot(made.u));
    high += std::abs(edge.dot(made.v));
  }
  const double w = std::max(1, width()), h = std::max(1, height());
  made.side_mm = std::max(1.0, std::max(wide / w, high / h) * std::min(w, h));
  return made;
}

void LinkedPlaneView::scroll(double steps) {
  if (!ready()) return;
  const double step = std::max(0.25, bench().image().volume->geometry.spacing.minCoeff());
  bench().place.set(bench().place.get() - steps * step * planes_->axes(kind_).normal());
}

void LinkedPlaneView::thicken(double steps) {
  if (bench().slab.get() == reformat::Slab::none) bench().slab.set(reformat::Slab::maximum);
  bench().slab_mm.set(bench().slab_mm.get() + steps * thicker_mm);
}

LinkedPlaneView::Line LinkedPlaneView::line_of(LinkedPlane plane) const {
  const LinkedPlanes::Axes &own = planes_->axes(kind_), &other = planes_->axes(plane);
  const Vec3 normal = other.normal();
  const Vec2 across = Vec2(normal.dot(own.u), normal.dot(own.v)).normalized();
  return {plane, Vec2(-across.y(), across.x()), across};
}

std::array<LinkedPlaneView::Line, 2> LinkedPlaneView::lines() const {
  const auto first = kind_ == LinkedPlane::axial ? LinkedPlane::coronal : LinkedPlane::axial;
  const auto second = kind_ == LinkedPlane::sagittal ? LinkedPlane::coronal : LinkedPlane::sagittal;
  return {line_of(first), line_of(second)};
}

Vec2 LinkedPlaneView::centre_px() {
  const std::optional<ViewPlace> at = project(bench().place.get());
  return at ? at->px : Vec2(width() / 2.0, height() / 2.0);
}

Vec2 LinkedPlaneView::grip_px(const Hold& hold, bool other_side) {
  const Line line = line_of(hold.plane);
  const double smaller = std::min(width(), height()), side = other_side ? -1.0 : 1.0;
  if (hold.grip == Grip::turn) return centre_px() + side * ring_share * smaller * line.along;
  const double half_px = 0.5 * bench().slab_mm.get() / pixel_mm();
  return centre_px() + dot_share * smaller * line.along + side * half_px * line.across;
}

std::optional<LinkedPlaneView::Hold> LinkedPlaneView::hold_at(const Vec2& px) {
  if (!ready()) return std::nullopt;
  std::optional<Hold> best;
  double nearest = 1.0;  // of its reach
  for (const Line& line : lines())
    for (const Grip grip : {Grip::turn, Grip::slab}) {
      if (grip == Grip::slab && bench().slab.get() == reformat::Slab::none) continue;
      const double reach = units(grip == Grip::turn ? ring_reach_units : dot_reach_units);
      for (const bool other_side : {false, true}) {
        const double share = (grip_px({grip, line.plane}, other_side) - px).norm() / reach;
        if (share >= nearest) continue;
        nearest = share;
        best = Hold{grip, line.plane};
      }
    }
  return best;
}

double LinkedPlaneView::angle_at(const Vec2& px) {
  const Vec2 from = px - centre_px();
  return std::atan2(from.y(), from.x());
}

void LinkedPlaneView::drag_slab(LinkedPlane plane, const Vec2& px) {
  const double away_mm = std::abs((px - centre_px()).dot(line_of(plane).across)) * pixel_mm();
  if (bench().slab.get() == reformat::Slab::none) bench().slab.set(reformat::Slab::maximum);
  bench().slab_mm.set(2.0 * away_mm);
}

void LinkedPlaneView::add_line(Overlay& overlay, const Line& line) {
  const Role role = role_of_plane(line.plane);
  const Vec2 centre = centre_px();
  const double far = std::hypot(width(), height()), gap = units(linked_gap_units);
  for (const double side : {-1.0, 1.0})
    overlay.lines.push_back(
        {{centre + side * gap * line.along, centre + side * far * line.along}, role, 0.85});
  for (const bool other_side : {false, true})
    overlay.marks.push_back({grip_px({Grip::turn, line.plane}, other_side), role, 5.0, 1.0, false});
  if (bench().slab.get() == reformat::Slab::none) return;
  const Vec2 border = 0.5 * bench().slab_mm.get() / pixel_mm() * line.across;
  for (const double side : {-1.0, 1.0})
    overlay.lines.push_back(
        {{centre + side * border - far * line.along, centre + side * border + far * line.along},
         role,
         0.5,
         true});
  for (const bool other_side : {false, true})
    overlay.marks.push_back({grip_px({Grip::slab, line.plane}, other_side), role, 3.0});
}

void LinkedPlaneView::add_to_overlay(Overlay& overlay) {
  const std::optional<reformat::Plane>& shown = plane();
  if (!shown) return;
  for (const Line& line : lines()) add_line(overlay, line);
  if (const lumen::LumenModel* model = bench().model())
    for (const AxisCrossing& one : crossings(*model, *shown, bench().other_phase()))
      overlay.marks.push_back(
          {one.px, one.vessel == bench().vessel.get() ? Role::axis : Role::other_axis, 2.0});
  add_letters(overlay, shown->u, shown->v);
  add_scale_bar(overlay);
  std::string text = word_of_plane(kind_);
  if (planes_->straight())
    text += "  " + core::length_text(bench().place.get().dot(shown->normal().cwiseAbs())) + " mm";
  else
    text += ", " + words().oblique;
  overlay.texts.push_back({Vec2(units(6.0), units(6.0)), text, role_of_plane(kind_), Anchor::top_left});
  add_slab(overlay);
  add_measurements(overlay, mark_reach_mm);
}

}  // namespace ostia::view
