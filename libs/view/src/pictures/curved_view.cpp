#include "ostia/view/curved_view.h"

#include "pointer/measure_marks.h"
#include "pointer/measure_placing.h"
#include "scene/wall_cut.h"
#include "scene/way_marks.h"

#include "ostia/core/quantity_text.h"
#include "ostia/lumen/views.h"
#include "ostia/session/beating.h"
#include "ostia/view/words.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {
namespace {

constexpr double least_pixel_mm = 0.01, largest_pixel_mm = 2.0;
constexpr double step_along_mm = 0.5;         // of a wheel's step
constexpr double fit_margin = 0.04;           // of the view's height kept free beyond the vessel's ends
constexpr double reading_mm_per_unit = 0.11;  // large enough to see and take hold of the wall
constexpr double follow_margin = 0.12;  // share of the view's height that the cursor keeps from its ends
constexpr double seed_step_mm = 0.5;    // along the axis, of where lines are looked for
// While a hand turns the view: lines to half a pixel, of a third of the places.
constexpr double seed_step_turning_mm = 1.5;
constexpr lumen::ContourLineOptions turning_lines{.step_px = 6.0, .largest_mm = 0.8, .bend_px = 0.5};
// Times farther apart than rows are: where the axis bends with a quarter of a place's offset as radius.
constexpr double torn_from = 5.0;
constexpr double bracket_units = 34.0;   // from the right border: clear of measurements along the vessel
constexpr double fading_reach_mm = 3.0;  // samples beside the view fade on it, too

}  // namespace

CurvedView::CurvedView(session::Workbench& bench, Which which, std::shared_ptr<CurvedFrame> frame)
    : PictureView(bench), which_(which), frame_(std::move(frame)) {
  keep(frame_->changed.observe([this] { moved(); }));
  keep(bench.vessel.observe([this](const std::int32_t&) { read(); }));
  keep(bench.case_changed.observe([this] { read(); }));
  keep(bench.theta_deg.observe([this](const double&) { moved(); }));
  keep(bench.turning.observe([this](const bool& turning) {
    if (!turning) contours_stale();
  }));
  keep(bench.curved_mode.observe([this](const reformat::CurvedMode&) { read(); }));
  keep(bench.stenoses_changed.observe([this] { overlay_stale(); }));
  keep(bench.slab.observe([this](const reformat::Slab&) { moved(); }));
  keep(bench.slab_mm.observe([this](const double&) { moved(); }));
  keep(bench.cursor_mm.observe([this](const double&) {
    follow();
    overlay_stale();
  }));
  keep(bench.model_changed.observe([this](const session::ModelEvent& event) {
    if (event.tree_changed) moved();
  }));
}

double CurvedView::theta_deg() const {
  return bench().theta_deg.get() + (which_ == Which::second ? 90.0 : 0.0);
}

bool CurvedView::ready() const {
  return bench().axis() != nullptr;
}

double CurvedView::fitted_pixel_mm() const {
  const auto axis = bench().axis();
  const double rows_shown = std::max(1, height());
  if (bench().curved_mode.get() == reformat::CurvedMode::straightened)
    return std::clamp(axis->length() / ((1.0 - 2.0 * fit_margin) * rows_shown), least_pixel_mm,
                      largest_pixel_mm);
  // Stretched: the axis' projected length and its breadth, asked of a view with pixels of 1 mm.
  reformat::CurvedOptions options;
  options.mode = reformat::CurvedMode::stretched;
  options.theta_deg = theta_deg();
  options.pixel_mm = 1.0;
  options.width = 2;
  options.height = 2;
  const reformat::CurvedReformation probe(axis, options);
  const double rows = probe.row_at_abscissa(axis->length());
  double breadth = 20.0;
  for (double s = 0.0; s <= axis->length(); s += 5.0)
    if (const auto at = probe.project(axis->point(s), s))
      breadth = std::max(breadth, 2.0 * std::abs(at->picture_px.x() - 1.0) + 20.0);
  return std::clamp(std::max(rows / ((1.0 - 2.0 * fit_margin) * rows_shown), breadth / std::max(1, width())),
                    least_pixel_mm, largest_pixel_mm);
}

double CurvedView::pixel_mm() {
  const reformat::CurvedReformation* shown = reformation();
  return shown ? shown->options().pixel_mm : 1.0;
}

const reformat::CurvedReformation* CurvedView::reformation() {
  const auto axis = bench().axis();
  if (!axis || width() <= 0 || height() <= 0) return nullptr;
  if (reformation_) return reformation_.get();
  reformat::CurvedOptions options;
  options.mode = bench().curved_mode.get();
  options.theta_deg = theta_deg();
  options.pixel_mm = frame_->pixel_mm ? *frame_->pixel_mm : fitted_pixel_mm();
  const int wider = std::min(std::abs(shift_px_), (32000 - width()) / 2);
  options.width = width() + 2 * wider;
  options.height = height();
  options.slab = bench().slab.get();
  options.slab_mm = options.slab == reformat::Slab::none ? 0.0 : bench().slab_mm.get();
  // Stretched views start with a point of the axis; rows before it are reached by moving that start.
  if (!frame_->pixel_mm && !frame_->whole)
    options.pixel_mm = std::min(options.pixel_mm, reading_mm_per_unit / density());
  options.s_start_mm = frame_->pixel_mm ? frame_->top_mm : -fit_margin * height() * options.pixel_mm;
  offset_px_ = wider - shift_px_;
  reformation_ = std::make_unique<reformat::CurvedReformation>(axis, options);
  rows_.clear();
  return reformation_.get();
}

void CurvedView::moved() {
  reformation_.reset();
  image_stale();
}

bool CurvedView::is_torn(const Vec2& picture_px) {
  const reformat::CurvedReformation* shown = reformation();
  if (!shown) return false;
  if (rows_.empty())
    for (int row = 0; row <= shown->options().height; ++row) rows_.push_back(shown->row(row));
  const auto row = static_cast<std::size_t>(std::clamp(picture_px.y(), 0.0, rows_.size() - 2.0));
  const double pixel = shown->options().pixel_mm;
  const Vec3 along_row = rows_[row + 1].along - rows_[row].along;
  const Vec3 step = rows_[row + 1].start - rows_[row].start + picture_px.x() * pixel * along_row;
  return step.norm() > torn_from * pixel;
}

std::optional<Vec3> CurvedView::world(const Vec2& px) {
  const reformat::CurvedReformation* shown = reformation();
  if (!shown) return std::nullopt;
  return shown->world(px + contour_offset());
}

std::optional<ViewPlace> CurvedView::project(const Vec3& place) {
  const reformat::CurvedReformation* shown = reformation();
  if (!shown) return std::nullopt;
  const auto at = shown->project(place);
  if (!at) return std::nullopt;
  return ViewPlace{at->picture_px - contour_offset(), at->out_mm};
}

double CurvedView::abscissa_at(double y_px) {
  const reformat::CurvedReformation* shown = reformation();
  return shown ? shown->abscissa_at_row(y_px) : 0.0;
}
double CurvedView::row_of(double s_mm) {
  const reformat::CurvedReformation* shown = reformation();
  return shown ? shown->row_at_abscissa(s_mm) : 0.0;
}
Vec2 CurvedView::axis_at(double s_mm) {
  const reformat::CurvedReformation* shown = reformation();
  if (!shown) return Vec2::Zero();
  const auto at = shown->project(shown->axis().point(s_mm), s_mm);
  return at ? Vec2(at->picture_px - contour_offset()) : Vec2(0.0, row_of(s_mm));
}

void CurvedView::zoom(double factor, const Vec2& about_px) {
  const reformat::CurvedReformation* shown = reformation();
  if (!shown || !(factor > 0.0)) return;
  const double old_mm = shown->options().pixel_mm;
  const double new_mm = std::clamp(old_mm / factor, least_pixel_mm, largest_pixel_mm);
  const double middle = width() / 2.0;
  const double from_axis_mm = (about_px.x() - middle - shift_px_) * old_mm;
  const double top_mm = shown->abscissa_at_row(about_px.y() * (1.0 - new_mm / old_mm));
  shift_px_ = static_cast<int>(std::lround(about_px.x() - middle - from_axis_mm / new_mm));
  set_frame(new_mm, top_mm);
}

void CurvedView::pan(const Vec2& delta_px) {
  const reformat::CurvedReformation* shown = reformation();
  if (!shown) return;
  shift_px_ += static_cast<int>(std::lround(delta_px.x()));
  set_frame(shown->options().pixel_mm, shown->abscissa_at_row(-delta_px.y()));
}

void CurvedView::set_frame(double pixel_mm, double top_mm) {
  frame_->pixel_mm = pixel_mm;
  frame_->top_mm = top_mm;
  frame_->changed.tell();
}

void CurvedView::read() {
  frame_->pixel_mm.reset();
  frame_->whole = false;
  shift_px_ = 0;
  frame_->changed.tell();
  follow();
}

void CurvedView::follow() {
  const reformat::CurvedReformation* shown = reformation();
  if (!shown) return;
  const double row = shown->row_at_abscissa(bench().cursor_mm.get()), rows = height();
  if (row >= follow_margin * rows && row <= (1.0 - follow_margin) * rows) return;
  const double end = shown->row_at_abscissa(shown->axis().length());
  if (row >= 0.0 && row < follow_margin * rows && shown->row_at_abscissa(0.0) >= 0.0) return;
  if (row <= rows && row > (1.0 - follow_margin) * rows && end <= rows) return;
  const double wanted = row < rows / 2.0 ? follow_margin * rows : (1.0 - follow_margin) * rows;
  set_frame(shown->options().pixel_mm, shown->abscissa_at_row(row - wanted));
}

void CurvedView::fit() {
  frame_->pixel_mm.reset();
  frame_->whole = true;
  shift_px_ = 0;
  frame_->changed.tell();
}

void CurvedView::scroll(double steps) {
  bench().cursor_mm.set(bench().cursor_mm.get() - steps * step_along_mm);
}

GreyImage CurvedView::make_image() {
  const reformat::CurvedReformation* shown = reformation();
  if (!shown) return {};
  reformat::CurvedImage wide = reformat::reformatted(*bench().shown_volume(), *shown);
  if (wide.width == width()) return {wide.width, wide.height, std::move(wide.values)};
  GreyImage cut{width(), height(), {}};
  cut.values.reserve(static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()));
  for (int row = 0; row < wide.height; ++row) {
    const auto begin = wide.values.begin() + static_cast<std::ptrdiff_t>(row) * wide.width + offset_px_;
    cut.values.insert(cut.values.end(), begin, begin + width());
  }
  return cut;
}

std::optional<lumen::ViewSurface> CurvedView::contour_surface() {
  const reformat::CurvedReformation* shown = reformation();
  if (!shown) return std::nullopt;
  return lumen::view_of(*shown);
}
// A line that is found at one row is followed along the vessel: one seed in half a millimetre finds all of
// them.
std::vector<Vec2> CurvedView::contour_seeds() {
  const reformat::CurvedReformation* shown = reformation();
  if (!shown) return {};
  const std::vector<Vec2> all = shown->axis_px();
  const double step_mm = bench().turning.get() ? seed_step_turning_mm : seed_step_mm;
  const auto step = static_cast<std::size_t>(std::max(1.0, step_mm / shown->options().pixel_mm));
  std::vector<Vec2> seeds;
  for (std::size_t i = 0; i < all.size(); i += step) seeds.push_back(all[i]);
  if (!all.empty()) seeds.push_back(all.back());
  return seeds;
}

std::vector<double> CurvedView::about_out_mm(const session::ShownPhase& phase) {
  constexpr double margin_px = 40.0;  // feet of another phase are off by less
  const reformat::CurvedReformation* shown = reformation();
  const std::vector<Vec3>& points = phase.wall()->points;
  const std::vector<double>& feet = phase.beating().wall_feet(bench().vessel.get());
  const session::CarriedAxis& axis = phase.axis(bench().vessel.get());
  std::vector<reformat::CurvedReformation::Row> rows;
  const int first = -static_cast<int>(margin_px), last = height() + static_cast<int>(margin_px);
  for (int row = first; row <= last; ++row) rows.push_back(shown->row(row));
  std::vector<double> out_mm(points.size(), std::nan(""));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isnan(feet[i])) continue;
    const double row = shown->row_at_abscissa(axis.here(feet[i]));
    if (row < first || row > last) continue;
    const reformat::CurvedReformation::Row& at = rows[static_cast<std::size_t>(std::lround(row) - first)];
    out_mm[i] = (points[i] - at.start).dot(at.across);
  }
  return out_mm;
}

std::vector<lumen::ContourLine> CurvedView::cut(const session::ShownPhase& phase) {
  constexpr double slack_mm = 0.4;   // by which a foot of the case's own phase may be off across the view
  constexpr double widest_mm = 2.0;  // of a triangle in the picture, several times its size
  const reformat::CurvedReformation* shown = reformation();
  if (!shown) return {};
  const session::CarriedAxis& axis = phase.axis(bench().vessel.get());
  const std::vector<double>& feet = phase.beating().wall_feet(bench().vessel.get());
  const std::vector<Vec3>& points = phase.wall()->points;
  return wall_cut(*phase.wall(), about_out_mm(phase), slack_mm, widest_mm / shown->options().pixel_mm,
                  [&](std::size_t i) -> std::optional<SeenCorner> {
                    const auto at = shown->project(points[i], axis.here(feet[i]));
                    if (!at) return std::nullopt;
                    return SeenCorner{at->picture_px, at->out_mm};
                  });
}

lumen::ContourLineOptions CurvedView::line_options() const {
  return bench().turning.get() ? turning_lines : PictureView::line_options();
}

std::pair<Vec2, Vec2> CurvedView::end_line(double s_mm) {
  const double row = row_of(s_mm), right = width();
  return {Vec2(right - units(26.0), row), Vec2(right, row)};
}

std::optional<HandleHit> CurvedView::handle_near(const Vec2& px, double reach_px) {
  if (!ready()) return std::nullopt;
  const std::optional<HandleHit> point = PictureView::handle_near(px, reach_px);
  const std::optional<HandleHit> end = end_near(bench(), px, point ? point->distance_px : reach_px,
                                                [this](double s_mm) { return end_line(s_mm); });
  return end ? end : point;
}

void CurvedView::add_stretches(Overlay& overlay) {
  for (const analysis::Measurement& one : stretches_of(bench())) {
    const Role role = role_of(bench(), one);
    const std::vector<double> ends = ends_of(one);
    for (const double s : ends) {
      const auto [a, b] = end_line(s);
      overlay.lines.push_back({{a, b}, role, 1.0, false, {}, one.id});
    }
    const double from = row_of(ends.front()), to = row_of(ends.back()), right = width();
    overlay.lines.push_back(
        {{Vec2(right - units(3.0), from), Vec2(right - units(3.0), to)}, role, 1.0, false, {}, one.id});
    if (to > 0.0 && from < height())
      overlay.texts.push_back({Vec2(right - units(5.0), std::clamp(from, units(16.0), height() - units(4.0))),
                               label_of(bench(), one), role, Anchor::bottom_right, one.id});
  }
}

/// Beside the picture a bracket over each parent's part, with its name, and a line across where the next
/// vessel leaves.
void CurvedView::add_parents(Overlay& overlay) {
  const double x = width() - units(bracket_units), tick = units(5.0);
  for (const WayMark& one : way_marks(bench())) {
    if (!one.parent) continue;
    const double from = row_of(bench().here_mm(one.from_mm)), to = row_of(bench().here_mm(one.to_mm));
    overlay.lines.push_back({{Vec2(x + tick, from), Vec2(x, from), Vec2(x, to), Vec2(x + tick, to)},
                             Role::other_axis,
                             1.0,
                             false,
                             one.color});
    overlay.lines.push_back(
        {{Vec2(x - units(30.0), to), Vec2(x, to)}, Role::other_axis, 0.9, true, one.color});
    const double low = std::max(from, 0.0), high = std::min(to, static_cast<double>(height()));
    if (high - low > units(16.0))
      overlay.texts.push_back({Vec2(x - units(4.0), low + std::min(0.5 * (high - low), units(60.0))),
                               one.name, Role::information, Anchor::right});
  }
}

void CurvedView::add_to_overlay(Overlay& overlay) {
  const reformat::CurvedReformation* shown = reformation();
  if (!shown) return;
  const double s = bench().cursor_mm.get(), row = shown->row_at_abscissa(s);
  OverlayLine axis;
  axis.role = Role::axis;
  axis.opacity = 0.5;
  for (const Vec2& p : shown->axis_px()) axis.px.push_back(p - contour_offset());
  if (axis.px.size() > 1) overlay.lines.push_back(std::move(axis));
  const double gap = units(14.0), middle = axis_at(s).x();
  if (row >= 0.0 && row <= height()) {
    overlay.lines.push_back({{Vec2(0.0, row), Vec2(std::max(0.0, middle - gap), row)}, Role::cursor});
    overlay.lines.push_back({{Vec2(middle + gap, row), Vec2(width(), row)}, Role::cursor});
  }
  for (const analysis::Stenosis& one : bench().known_stenoses(bench().vessel.get())) {
    const double from = shown->row_at_abscissa(bench().here_mm(one.from_mm)),
                 to = shown->row_at_abscissa(bench().here_mm(one.to_mm));
    overlay.bands.push_back({Vec2(0.0, from), Vec2(units(5.0), to), Role::stenosis, 0.8});
  }
  if (bench().tool.get() == session::Tool::axis)
    for (double at = 0.0; at < shown->axis().length() + 2.5; at += 5.0)
      overlay.marks.push_back({axis_at(std::min(at, shown->axis().length())), Role::handle, 3.0});
  add_parents(overlay);
  add_stretches(overlay);
  add_measurements(overlay, mark_reach_mm);
  add_fading(overlay, fading_reach_mm);
  add_scale_bar(overlay);
  add_slab(overlay);
  const double edge = units(6.0);
  const std::string turn = core::set_angle_text(std::remainder(theta_deg(), 360.0)) + "\u00b0";
  std::string title = bench().vessel_name(bench().vessel.get());
  const bool straight = bench().curved_mode.get() == reformat::CurvedMode::straightened;
  title += "  " + (straight ? words().straightened : words().stretched) + " ";
  overlay.texts.push_back({Vec2(edge + units(4.0), edge), title + turn, Role::information, Anchor::top_left});
  const reformat::CurvedReformation::Row across =
      shown->row(std::clamp(row, 0.0, static_cast<double>(height())));
  overlay.texts.push_back({Vec2(edge + units(4.0), height() / 2.0), reformat::patient_letters(-across.along),
                           Role::information, Anchor::left});
  overlay.texts.push_back({Vec2(width() - edge, height() / 2.0), reformat::patient_letters(across.along),
                           Role::information, Anchor::right});
}

}  // namespace ostia::view
