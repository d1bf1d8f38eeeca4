#include "ostia/view/profile_view.h"

#include "pointer/measure_marks.h"
#include "pointer/measure_placing.h"
#include "scene/way_marks.h"

#include "ostia/core/quantity_text.h"
#include "ostia/figure/plot.h"
#include "ostia/session/outer_wall_board.h"
#include "ostia/session/plaque_sampling.h"
#include "ostia/view/evaluability_layer.h"
#include "ostia/view/words.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {

ProfileView::ProfileView(session::Workbench& bench) : bench_(bench) {
  const auto on = [this](const auto&) { touch(); };
  own_.push_back(bench.vessel.observe(on));
  own_.push_back(bench.cursor_mm.observe(on));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent&) {
    forget_flow_along();
    touch();
  }));
  own_.push_back(bench.case_changed.observe([this] {
    forget_flow_along();
    touch();
  }));
  own_.push_back(bench.phase_changed.observe([this] { forget_flow_along(); }));  // ways are that phase's
  own_.push_back(bench.annotations_changed.observe([this] { touch(); }));
  own_.push_back(bench.selected_measurement.observe(on));
  own_.push_back(area_shown.observe(on));
}

void ProfileView::set_walls(session::OuterWallBoard* board) {
  walls_changes_.clear();
  walls_ = board;
  if (board) {
    const auto on = [this](const bool&) { touch(); };
    walls_changes_.push_back(board->shown.observe(on));
    walls_changes_.push_back(board->plaque_shown.observe(on));
    walls_changes_.push_back(board->changed.observe([this] { touch(); }));
  }
  touch();
}

void ProfileView::set_evaluability(session::EvaluabilityBoard* board) {
  evaluability_changes_.clear();
  evaluability_ = board;
  if (board) {
    evaluability_changes_.push_back(board->shown.observe([this](const bool&) { touch(); }));
    evaluability_changes_.push_back(board->changed.observe([this] { touch(); }));
  }
  touch();
}

std::vector<std::pair<double, double>> ProfileView::outer_wall() const {
  if (!walls_ || !(walls_->shown.get() || walls_->plaque_shown.get())) return {};
  const session::VesselWalls* walls = walls_->of_selected();
  if (!walls) return {};
  return session::outer_diameters_mm(*walls);
}

std::optional<analysis::Stenosis> ProfileView::lesion_at(const Vec2& px) const {
  if (!ready()) return std::nullopt;
  const Frame f = frame();
  if (px.x() < f.left || px.x() > f.right || px.y() < f.top || px.y() > f.bottom) return std::nullopt;
  const double s = (px.x() - f.left) / (f.right - f.left) * f.length_mm;
  for (const analysis::Stenosis& one : bench_.known_stenoses(bench_.vessel.get()))
    if (s >= one.from_mm && s <= one.to_mm) return one;
  return std::nullopt;
}

void ProfileView::touch() {
  fresh_ = false;
  stale.tell();
}

void ProfileView::set_size(int width, int height, double density) {
  if (width == width_ && height == height_ && density == density_) return;
  width_ = width;
  height_ = height;
  density_ = density;
  touch();
}

bool ProfileView::ready() const {
  return bench_.axis() != nullptr && width_ > 40 && height_ > 30;
}

ProfileView::Frame ProfileView::frame() const {
  Frame made;
  made.left = 40.0 * density_;
  const double flow = flow_room_px();
  const double ffr = ffr_room();
  made.right = width_ - std::max(flow + ffr, area_shown.get() ? 44.0 : 12.0) * density_;
  made.top = (flow > 0.0 && ffr > 0.0 ? 48.0 : flow > 0.0 ? 34.0 : 20.0) * density_;
  made.bottom = height_ - 26.0 * density_;
  made.right = std::max(made.right, made.left + 1.0);
  made.bottom = std::max(made.bottom, made.top + 1.0);
  if (const analysis::LumenProfile* profile = bench_.profile(bench_.vessel.get())) {
    made.length_mm = std::max(1e-3, profile->length_mm);
    double widest = 1.0, largest = 1.0;
    for (const analysis::SectionMeasures& one : profile->sections) {
      widest = std::max(widest, one.diameter_mm);
      largest = std::max(largest, one.area_mm2);
    }
    for (const auto& [s, diameter] : outer_wall()) widest = std::max(widest, diameter);
    made.most_mm = 1.1 * widest;
    made.most_mm2 = 1.1 * largest;
  }
  return made;
}

double ProfileView::Frame::x(double s_mm) const {
  return left + s_mm / length_mm * (right - left);
}

double ProfileView::Frame::y(double share) const {
  return bottom - std::clamp(share, 0.0, 1.0) * (bottom - top);
}

double ProfileView::x_of(double s_mm) const {
  return frame().x(s_mm);
}

std::optional<double> ProfileView::abscissa_at(double x_px) const {
  if (!ready()) return std::nullopt;
  const Frame f = frame();
  return std::clamp((x_px - f.left) / (f.right - f.left), 0.0, 1.0) * f.length_mm;
}

std::pair<Vec2, Vec2> ProfileView::end_line(double s_mm) const {
  const double x = x_of(s_mm), bottom = frame().bottom;
  return {Vec2(x, bottom - 8.0 * density_), Vec2(x, bottom)};
}

std::optional<HandleHit> ProfileView::handle_near(const Vec2& px, double reach_px) const {
  if (!ready()) return std::nullopt;
  return end_near(bench_, px, reach_px, [this](double s_mm) { return end_line(s_mm); });
}

void ProfileView::add_text(const Vec2& px, const std::string& what, Role role, Anchor anchor) {
  overlay_.texts.push_back({px, what, role, anchor});
}

void ProfileView::add_tick(const Vec2& px, const std::string& what, Role role, Anchor anchor) {
  overlay_.texts.push_back({px, what, role, anchor, {}, true});
}

void ProfileView::add_rows(const Frame& f, double most, bool left, Role role) {
  const int rows = std::max(2, static_cast<int>((f.bottom - f.top) / (28.0 * density_)));
  const std::vector<double> values = figure::nice_ticks(0.0, most, rows);
  const double step = values.size() > 1 ? values[1] - values[0] : 1.0;
  for (const double value : values) {
    const double at = f.y(value / most);
    if (left) overlay_.lines.push_back({{Vec2(f.left, at), Vec2(f.right, at)}, Role::grid, 0.5});
    add_tick(Vec2(left ? f.left - 4 * density_ : f.right + 4 * density_, at), figure::tick_text(value, step),
             role, left ? Anchor::right : Anchor::left);
  }
}

void ProfileView::add_axes(const Frame& f) {
  add_rows(f, f.most_mm, true, Role::diameter);
  if (area_drawn()) add_rows(f, f.most_mm2, false, Role::area);
  const std::vector<double> along = figure::nice_ticks(
      0.0, f.length_mm, std::max(2, static_cast<int>((f.right - f.left) / (60.0 * density_))));
  const double step = along.size() > 1 ? along[1] - along[0] : 1.0;
  for (const double s : along) {
    overlay_.lines.push_back({{Vec2(f.x(s), f.top), Vec2(f.x(s), f.bottom)}, Role::grid, 0.3});
    add_tick(Vec2(f.x(s), f.bottom + 8 * density_), figure::tick_text(s, step), Role::information,
             Anchor::top);
  }
  overlay_.lines.push_back(
      {{Vec2(f.left, f.top), Vec2(f.left, f.bottom), Vec2(f.right, f.bottom)}, Role::grid});
}

void ProfileView::add_stenoses(const Frame& f) {
  for (const analysis::Stenosis& one : bench_.stenoses(bench_.vessel.get())) {
    overlay_.bands.push_back(
        {Vec2(f.x(one.from_mm), f.top), Vec2(f.x(one.to_mm), f.bottom), Role::stenosis, 0.25});
    const std::string label = core::stenosis_text(one.diameter_percent) + " %";
    // Between the curve and its reference, or above both.
    const double high = f.y(one.reference_diameter_mm / f.most_mm);
    const double low = f.y(one.least_diameter_mm / f.most_mm);
    const double height = 14.0 * density_;
    const double foot = low - high > height ? 0.5 * (low + high + height) : std::max(high, f.top + height);
    add_text(Vec2(std::clamp(f.x(one.throat_mm), f.left + 14 * density_, f.right - 14 * density_), foot),
             label, Role::stenosis, Anchor::bottom);
  }
}

/// A strip under the curves.
void ProfileView::add_evaluability(const Frame& f) {
  if (!evaluability_ || !evaluability_->shown.get()) return;
  for (const analysis::EvaluableStretch& one :
       stretches_of_way(*evaluability_, bench_, bench_.vessel.get())) {
    if (one.grade == analysis::Evaluability::evaluable) continue;
    const Role role = role_of(one.grade);
    const double from = f.x(one.from_mm), to = f.x(one.to_mm);
    overlay_.bands.push_back({Vec2(from, f.top), Vec2(to, f.bottom), role, 0.1});
    overlay_.bands.push_back({Vec2(from, f.bottom - 4.0 * density_), Vec2(to, f.bottom), role, 0.85});
  }
}

/// A strip above the curves in the vessels' colours, a tint over what is the parents', and their names.
void ProfileView::add_way(const Frame& f) {
  const std::vector<WayMark> way = way_marks(bench_);
  if (way.size() < 2) return;
  for (const WayMark& one : way) {
    const double from = f.x(one.from_mm), to = f.x(one.to_mm);
    overlay_.bands.push_back(
        {Vec2(from, f.top), Vec2(to, f.top + 3.0 * density_), Role::other_axis, 1.0, one.color});
    if (!one.parent) continue;
    overlay_.bands.push_back({Vec2(from, f.top), Vec2(to, f.bottom), Role::other_axis, 0.14, one.color});
    overlay_.lines.push_back({{Vec2(to, f.top), Vec2(to, f.bottom)}, Role::other_axis, 0.8, true, one.color});
    add_text(Vec2(from + 3.0 * density_, f.bottom - 18.0 * density_), one.name, Role::information,
             Anchor::bottom_left);
  }
  const auto medina =
      bench_.profile_work(way[way.size() - 2].vessel) ? std::nullopt : bench_.medina(bench_.vessel.get());
  if (medina && medina->any())
    add_text(Vec2(f.x(way.back().from_mm) + 3.0 * density_, f.bottom - 18.0 * density_),
             "Medina " + to_string(*medina), Role::stenosis, Anchor::bottom_left);
}

void ProfileView::add_stretches() {
  for (const analysis::Measurement& one : stretches_of(bench_)) {
    const std::vector<double> ends = ends_of(one);
    const auto from = end_line(ends.front()), to = end_line(ends.back());
    overlay_.lines.push_back({{from.second, from.first, to.first, to.second}, role_of(bench_, one)});
  }
}

void ProfileView::add_curve(const Frame& f, const analysis::LumenProfile& profile, const OverlayLine& style,
                            const std::vector<double>& shares) {
  OverlayLine line = style;
  const auto end = [&] {
    if (line.px.size() > 1) overlay_.lines.push_back(line);
    line.px.clear();
  };
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (!std::isfinite(shares[i]))
      end();
    else
      line.px.emplace_back(f.x(profile.sections[i].s_mm), f.y(shares[i]));
  }
  end();
}

void ProfileView::add_curves(const Frame& f, const analysis::LumenProfile& profile) {
  const std::size_t sections = profile.sections.size();
  std::vector<double> diameter(sections), area(sections);
  for (std::size_t i = 0; i < sections; ++i) {
    const analysis::SectionMeasures& one = profile.sections[i];
    diameter[i] = one.found ? one.diameter_mm / f.most_mm : std::nan("");
    area[i] = one.found ? one.area_mm2 / f.most_mm2 : std::nan("");
  }
  if (area_drawn()) add_curve(f, profile, {{}, Role::area, 0.8}, area);
  const analysis::ReferenceLine* reference = bench_.reference(bench_.vessel.get());
  if (reference && reference->diameter_mm.size() == sections) {
    std::vector<double> healthy = reference->diameter_mm;
    for (double& value : healthy) value /= f.most_mm;
    add_curve(f, profile, {{}, Role::reference, 0.9, true}, healthy);
  }
  add_curve(f, profile, {{}, Role::diameter}, diameter);
}

void ProfileView::add_outer_wall(const Frame& f) {
  OverlayLine line{{}, Role::outer_wall, 0.9, true};
  for (const auto& [s, diameter] : outer_wall()) line.px.emplace_back(f.x(s), f.y(diameter / f.most_mm));
  if (line.px.size() < 2) return;
  add_text(line.px.back() - Vec2(0.0, 2.0 * density_), words().outer_wall, Role::outer_wall,
           Anchor::bottom_right);
  overlay_.lines.push_back(std::move(line));
}

void ProfileView::add_titles(const Frame& f) {
  add_text(Vec2(f.left, 3 * density_), words().diameter, Role::diameter, Anchor::top_left);
  if (area_drawn()) add_text(Vec2(f.right, 3 * density_), words().area, Role::area, Anchor::top_right);
  add_text(Vec2(0.5 * (f.left + f.right), 3 * density_),
           bench_.vessel_name(bench_.vessel.get()) + ", " + words().from_root, Role::information,
           Anchor::top);
}

const Overlay& ProfileView::overlay() {
  if (fresh_) return overlay_;
  overlay_ = {};
  fresh_ = true;
  const analysis::LumenProfile* profile = ready() ? bench_.profile_from_ostium(bench_.vessel.get()) : nullptr;
  if (!profile) return overlay_;
  const Frame f = frame();
  add_axes(f);
  add_evaluability(f);
  add_way(f);
  add_stenoses(f);
  add_stretches();
  add_flow(f);
  add_curves(f, *profile);
  add_outer_wall(f);
  add_ffr(f);
  const double s = bench_.own_mm(bench_.cursor_mm.get());
  overlay_.lines.push_back({{Vec2(f.x(s), f.top), Vec2(f.x(s), f.bottom)}, Role::cursor});
  add_titles(f);
  return overlay_;
}

}  // namespace ostia::view
